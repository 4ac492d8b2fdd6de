//! Property tests of the state: after any sequence of keys, mouse and panel input and dropped tables there is a
//! picture, no frame is due at rest, and Home leads back to the start.

use super::controls::controls;
use egui::{Context, Pos2, RawInput, Rect, vec2};
use lensbake_core::Motion;
use lensbake_interactive::keys::{Change, Movement};
use lensbake_interactive::motion;
use lensbake_interactive::motion_choice;
use lensbake_interactive::panel_info::PanelInfo;
use lensbake_interactive::settings::Settings;
use lensbake_interactive::state::{NamedTable, State};
use lensbake_render::camera::{MAX_RADIUS, View};
use lensbake_render::disc::{Disc, Orientation};
use lensbake_tables::{Axis, Header, Measured, Rows, Solver, Table, default_atlas};
use lensbake_test_support::{coarse_atlas, one_row};
use proptest::prelude::*;
use std::sync::LazyLock;

const MOVEMENTS: [Movement; 8] = [
    Movement::LookUp,
    Movement::LookDown,
    Movement::LookLeft,
    Movement::LookRight,
    Movement::Nearer,
    Movement::Farther,
    Movement::OrbitLeft,
    Movement::OrbitRight,
];

/// Tables to drop: the atlas, four of one observer each, an atlas without rows below the horizon, and two that cannot
/// be used.
static TABLES: LazyLock<[Table; 8]> = LazyLock::new(|| {
    [
        default_atlas().clone(),
        one_row(10.0),
        one_row(1.003),
        one_row(5000.0),
        coarse_atlas(),
        one_row(0.5),
        far(Axis::Residual),
        far(Axis::UniformB {
            b_min: 3.0,
            b_max: 9.0,
        }),
    ]
});
/// How many of the tables, from the first on, can be used.
const USABLE: usize = 6;

/// A table of the observer at infinity, where there can be no camera.
fn far(axis: Axis) -> Table {
    let header = Header {
        axis,
        rows: Rows::One {
            inverse_radius: 0.0,
        },
        texels: 4,
        solver: Solver {
            name: "none".into(),
            tolerance: 1.0,
        },
        measured: Measured::NOTHING,
        measured_below: None,
    };
    Table::new(header, vec![[0.0; 2]; 4]).unwrap()
}

/// Index of the atlas without rows below the horizon.
pub(super) const ABOVE_ONLY: usize = 4;

pub(super) fn named(index: usize) -> NamedTable {
    NamedTable::new(TABLES[index].clone(), format!("/folder/table-{index}.lbt"))
}

/// What a user may do.
#[derive(Debug, Clone)]
enum UserInput {
    Hold(Movement, f64),
    Press(Change),
    Drag(f64, f64),
    RightDrag(f64, f64),
    Scroll(f64),
    /// Any number in any setting, whether or not the panel has a field for it.
    Type(usize, f64),
    Drop(usize),
    Choose(Motion),
    Wait(f64),
    Home,
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => 0.5..30.0,
        2 => -400.0..400.0,
        2 => 1.0..1.1e6,
        1 => proptest::num::f64::ANY,
        1 => Just(f64::NAN),
        1 => Just(f64::INFINITY),
        1 => Just(1.0f64.next_up()),
    ]
}

fn user_input() -> impl Strategy<Value = UserInput> {
    let pixels = || -1e4..1e4;
    prop_oneof![
        3 => (0..MOVEMENTS.len(), 0.0..20.0).prop_map(|(movement, s)| UserInput::Hold(MOVEMENTS[movement], s)),
        3 => (0..Change::ALL.len()).prop_map(|i| UserInput::Press(Change::ALL[i])),
        1 => (pixels(), pixels()).prop_map(|(x, y)| UserInput::Drag(x, y)),
        1 => (pixels(), pixels()).prop_map(|(x, y)| UserInput::RightDrag(x, y)),
        2 => (-200.0..200.0).prop_map(UserInput::Scroll),
        4 => (0..Settings::PARTS.len(), number()).prop_map(|(part, x)| UserInput::Type(part, x)),
        3 => (0..TABLES.len()).prop_map(UserInput::Drop),
        3 => any_motion().prop_map(UserInput::Choose),
        4 => (0.0..20.0).prop_map(UserInput::Wait),
        1 => Just(UserInput::Home),
    ]
}

fn any_motion() -> impl Strategy<Value = Motion> {
    let velocity = (-0.7..0.7, -0.7..0.7);
    prop_oneof![
        Just(Motion::Rest),
        Just(Motion::Fall),
        Just(Motion::Orbit),
        velocity.prop_map(|(radial, tangential)| Motion::Velocity { radial, tangential }),
    ]
}

/// Any initial state that the flags allow, with a table that can be used for it.
fn start() -> impl Strategy<Value = State> {
    let outside = || (-12.0..MAX_RADIUS.log10()).prop_map(|power| 1.0 + 10f64.powf(power) * 0.999);
    let radius = (outside(), prop_oneof![2 => outside(), 1 => 0.01..1.0f64]);
    let fov_deg = prop_oneof![1e-4..179.9, Just(1e-4), Just(179.9)];
    let angle = || prop_oneof![-180.0..180.0, -1e6..1e6];
    let angles = (angle(), angle(), angle(), angle());
    let scene = (radius, any_motion(), fov_deg, angles);
    (0..USABLE, scene).prop_map(|(table, (radius, motion, fov_deg, angles))| {
        let radius = [radius.1, 10.0, 1.003, 5000.0, radius.0, 0.5][table];
        let possible = motion_choice::problem(radius, motion).is_none();
        let view = View {
            radius,
            motion: if possible { motion } else { Motion::Fall },
            heading_deg: angles.0,
            fov_deg,
            yaw_deg: angles.0,
            pitch_deg: angles.1,
            latitude_deg: angles.2,
            roll_deg: angles.3,
            ..View::default()
        };
        State::new(Settings::new(view, 0.05), named(table)).unwrap()
    })
}

/// Settings in which all numbers are `x`.
fn all_numbers(settings: &Settings, x: f64) -> Settings {
    Settings {
        view: View {
            radius: x,
            motion: Motion::Velocity {
                radial: x,
                tangential: x,
            },
            heading_deg: x,
            fov_deg: x,
            yaw_deg: x,
            pitch_deg: x,
            roll_deg: x,
            orbit_deg: x,
            latitude_deg: x,
            ..settings.view
        },
        divider: x,
        gain: x as f32,
        exposure: x as f32,
        target_ms: x,
        disc: Disc {
            inner: x,
            outer: 2.0 * x,
            orientation: Orientation {
                inclination_deg: x,
                node_deg: x,
                ..settings.disc.orientation
            },
            opacity: x,
            peak_kelvin: x,
            brightness: x,
            ..settings.disc
        },
        ..settings.clone()
    }
}

fn act(state: &mut State, action: &UserInput) {
    let settings = &mut state.settings;
    match *action {
        UserInput::Hold(movement, seconds) => movement.steer(&mut settings.view, seconds),
        UserInput::Press(change) => settings.change(change),
        UserInput::Drag(x, y) => motion::look(&mut settings.view, x, y),
        UserInput::RightDrag(x, y) => motion::orbit(&mut settings.view, x, y),
        UserInput::Scroll(notches) => motion::scroll(&mut settings.view, notches),
        UserInput::Type(part, x) => {
            let typed = all_numbers(settings, x);
            Settings::PARTS[part](settings, &typed);
        }
        UserInput::Drop(table) => {
            let before = state.clone();
            match state.take_table(named(table)) {
                Ok(said) => assert!(table < USABLE && said.contains(&format!("table-{table}"))),
                Err(refusal) => {
                    let no_rows = table == ABOVE_ONLY && state.settings.view.radius <= 1.0;
                    assert!(table >= USABLE || no_rows, "{refusal}");
                    assert_eq!(state.table().short_name(), before.table().short_name());
                }
            }
        }
        UserInput::Choose(motion) => settings.choose_motion(motion),
        UserInput::Wait(seconds) => drop(settings.advance(seconds)),
        UserInput::Home => drop(state.reset()),
    }
}

fn facts(state: &State) -> PanelInfo {
    PanelInfo {
        skies: (vec!["grid".into(), "nebula".into()], 0),
        interval: None,
        picture_time: None,
        frame_time: None,
        picture: [640, 360],
        table: state.table().short_name(),
        table_error: Some(1e-7),
        rounding_px: 1e-3,
        path: ("2 keyframes, 3.0 s".into(), true),
        held_radius: state.held_radius(),
        adapter: "none".into(),
    }
}

/// Runs a frame without a GPU and without input; true if it asks for another.
fn frame(state: &mut State, context: &Context) -> bool {
    state.settle();
    for window in [[1, 1], [16_384, 2], [3, 16_384], [640, 360]] {
        state.plan(window, 0.25).unwrap();
        state.plan(window, 1.0).unwrap();
    }
    let drawn = state.settings.clone();
    let facts = facts(state);
    let input = RawInput {
        screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(640.0, 360.0))),
        ..RawInput::default()
    };
    let mut painted = context.run_ui(input, |ui| {
        controls(ui.ctx(), &mut state.settings, &facts);
    });
    painted.textures_delta.clear();
    state.settle().is_some() || state.settings != drawn
}

/// The settings without panel and help, which Home leaves as they are.
fn but_for_the_panel(settings: &Settings) -> Settings {
    Settings {
        panel: false,
        help: false,
        ..settings.clone()
    }
}

proptest! {
    #[test]
    fn every_state_is_drawn_rests_and_is_left_again(
        first in start(),
        actions in prop::collection::vec(prop::collection::vec(user_input(), 0..3), 1..12),
    ) {
        let context = Context::default();
        let mut state = first.clone();
        prop_assert!(!frame(&mut state, &context), "{:?}", state.settings);
        prop_assert_eq!(&state.settings, &first.settings);
        for actions in actions {
            actions.iter().for_each(|action| act(&mut state, action));
            let wanted = state.settings.clone();
            let said = state.settle();
            // Only these parts are reverted, and only with a message.
            let mut expected = wanted.clone();
            if said.is_some() {
                for part in Settings::PARTS {
                    part(&mut expected, &state.settings);
                }
                expected.fall = state.settings.fall;
            }
            prop_assert_eq!(&state.settings, &expected);
            prop_assert!(!frame(&mut state, &context), "{actions:?}: {:?}", state.settings);
        }
        state.reset();
        let home = but_for_the_panel(&state.settings);
        prop_assert_eq!(&home, &but_for_the_panel(&first.settings));
        prop_assert!(!frame(&mut state, &context));
        // From there the keys move the camera, unless the table at the start fixes the radius.
        if state.held_radius().is_none() {
            let before = state.settings.view.radius;
            let moved = [Movement::Nearer, Movement::Farther].map(|movement| {
                movement.steer(&mut state.settings.view, 0.1);
                state.settle().is_none() && state.settings.view.radius != before
            });
            prop_assert!(moved.contains(&true));
        }
    }
}

pub(super) fn at(radius: f64, table: usize) -> State {
    let view = View {
        radius,
        ..View::default()
    };
    State::new(Settings::new(view, 0.05), named(table)).unwrap()
}

#[test]
fn a_table_of_one_row_takes_the_camera_there_and_holds_it_until_home() {
    let mut state = at(25.0, 0);
    let said = state.take_table(named(1)).unwrap();
    assert!(
        said.contains("table-1.lbt") && said.contains("r = 10.00 only"),
        "{said}"
    );
    assert_eq!(state.settings.view.radius, 10.0);
    // Two keys at once: the reverted one does not stop the other.
    Movement::Nearer.steer(&mut state.settings.view, 0.1);
    Movement::LookUp.steer(&mut state.settings.view, 0.1);
    let said = state.settle().unwrap();
    for words in ["table-1.lbt holds r = 10.00 only", "Home for table-0.lbt"] {
        assert!(said.contains(words), "{said}");
    }
    assert_eq!(state.settings.view.radius, 10.0);
    assert!(state.settings.view.pitch_deg > 0.0);
    let said = state.reset().unwrap();
    assert!(said.contains("table-0.lbt"), "{said}");
    assert_eq!(
        (state.settings.view.radius, state.held_radius()),
        (25.0, None)
    );
}

#[test]
fn home_keeps_a_table_that_serves_the_start() {
    let mut state = at(10.0, 1);
    assert!(state.held_radius().unwrap().contains("drop another table"));
    state.take_table(named(0)).unwrap();
    state.settings.view.radius = 30.0;
    assert_eq!(state.settle(), None);
    assert_eq!(state.reset(), None);
    assert_eq!(state.table().short_name(), "table-0.lbt");
    assert_eq!(state.settings.view.radius, 10.0);
}

#[test]
fn what_cannot_be_drawn_is_named() {
    let mut state = at(25.0, 0);
    for (part, x, words) in [
        (0, 1.0, "radius 1"),
        (0, f64::NAN, "radius NaN"),
        (0, 2e6, "at most 1e6"),
        (1, 180.0, "field of view 180"),
        (3, f64::INFINITY, "pitch inf"),
        (7, 1.5, "divider 1.5"),
        (9, f64::NAN, "exposure NaN"),
        (10, f64::NAN, "frame time NaN"),
        (11, f64::NAN, "heading NaN"),
        (12, 0.9, "a speed of 1.27"),
        (13, 2.9, "the disc: the inner radius 2.9 is below 3"),
        (13, 12.0, "the disc: the outer radius 12 is not above"),
        (14, f64::INFINITY, "the disc: the outer radius inf"),
        (15, f64::NAN, "the disc: inclination NaN"),
        (16, f64::NAN, "the disc: node NaN"),
        (17, 1.5, "the disc: opacity 1.5"),
        (18, 0.0, "the disc: temperature 0"),
        (19, -1.0, "the disc: brightness -1"),
    ] {
        let before = state.settings.clone();
        act(&mut state, &UserInput::Type(part, x));
        let said = state.settle().unwrap();
        assert!(said.contains(words), "{said}");
        assert_eq!(state.settings, before);
    }
    let refused = |index| {
        let refusal = at(25.0, 0).take_table(named(index)).unwrap_err();
        refusal.to_string()
    };
    let [far, axis] = [6, 7].map(refused);
    assert!(far.contains("table-6.lbt holds one observer only"), "{far}");
    assert!(far.contains("radius inf is too far"), "{far}");
    assert!(axis.contains("table-7.lbt: the table's axis"), "{axis}");
}
