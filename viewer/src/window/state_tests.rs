//! Whatever keys, mouse, panel and dropped tables do: there is a picture, nothing stirs at rest, and Home
//! leads back to the start.

use super::controls::{Facts, controls};
use super::keys::{Change, Drive};
use super::motion;

use super::settings::Settings;
use super::state::{NamedTable, State};
use crate::camera::{MAX_RADIUS, View};
use egui::{Context, Pos2, RawInput, Rect, vec2};
use lensbake_tables::{Axis, Header, Measured, Rows, Solver, Table, default_atlas};
use lensbake_tests::one_row;
use proptest::prelude::*;
use std::sync::LazyLock;

const DRIVES: [Drive; 8] = [
    Drive::LookUp,
    Drive::LookDown,
    Drive::LookLeft,
    Drive::LookRight,
    Drive::Nearer,
    Drive::Farther,
    Drive::OrbitLeft,
    Drive::OrbitRight,
];

/// Tables to drop: of all observers, of one each, and two that nothing can be drawn with.
static TABLES: LazyLock<[Table; 6]> = LazyLock::new(|| {
    [
        default_atlas().clone(),
        one_row(10.0),
        one_row(1.003),
        one_row(5000.0),
        far(Axis::Residual),
        far(Axis::UniformB {
            b_min: 3.0,
            b_max: 9.0,
        }),
    ]
});
/// Those of them that can be drawn with.
const USABLE: usize = 4;

/// A table of the observer at infinity, who is no camera.
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
    };
    Table::new(header, vec![[0.0; 2]; 4]).unwrap()
}

fn named(index: usize) -> NamedTable {
    NamedTable::new(TABLES[index].clone(), format!("/folder/table-{index}.lbt"))
}

/// What a person may do.
#[derive(Debug, Clone)]
enum Deed {
    Hold(Drive, f64),
    Press(Change),
    Drag(f64, f64),
    RightDrag(f64, f64),
    Scroll(f64),
    /// Any number in any field of the panel, also in those that it does not have.
    Type(usize, f64),
    Drop(usize),
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

fn deed() -> impl Strategy<Value = Deed> {
    let pixels = || -1e4..1e4;
    prop_oneof![
        3 => (0..DRIVES.len(), 0.0..20.0).prop_map(|(drive, s)| Deed::Hold(DRIVES[drive], s)),
        3 => (0..Change::ALL.len()).prop_map(|i| Deed::Press(Change::ALL[i])),
        1 => (pixels(), pixels()).prop_map(|(x, y)| Deed::Drag(x, y)),
        1 => (pixels(), pixels()).prop_map(|(x, y)| Deed::RightDrag(x, y)),
        2 => (-200.0..200.0).prop_map(Deed::Scroll),
        4 => (0..Settings::PARTS.len(), number()).prop_map(|(part, x)| Deed::Type(part, x)),
        3 => (0..TABLES.len()).prop_map(Deed::Drop),
        1 => Just(Deed::Home),
    ]
}

/// Any start that the flags allow, with a table that serves it.
fn start() -> impl Strategy<Value = State> {
    let radius = (-12.0..MAX_RADIUS.log10()).prop_map(|power| 1.0 + 10f64.powf(power) * 0.999);
    let fov_deg = prop_oneof![1e-4..179.9, Just(1e-4), Just(179.9)];
    let angle = || prop_oneof![-180.0..180.0, -1e6..1e6];
    let angles = (angle(), angle(), angle(), angle());
    (0..USABLE, radius, fov_deg, angles).prop_map(|(table, radius, fov_deg, angles)| {
        let view = View {
            radius: [radius, 10.0, 1.003, 5000.0][table],
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

/// Settings all of whose numbers are `x`.
fn all_numbers(settings: &Settings, x: f64) -> Settings {
    Settings {
        view: View {
            radius: x,
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
        ..settings.clone()
    }
}

fn act(state: &mut State, deed: &Deed) {
    let settings = &mut state.settings;
    match *deed {
        Deed::Hold(drive, seconds) => drive.steer(&mut settings.view, seconds),
        Deed::Press(change) => settings.change(change),
        Deed::Drag(x, y) => motion::look(&mut settings.view, x, y),
        Deed::RightDrag(x, y) => motion::orbit(&mut settings.view, x, y),
        Deed::Scroll(notches) => motion::scroll(&mut settings.view, notches),
        Deed::Type(part, x) => {
            let typed = all_numbers(settings, x);
            Settings::PARTS[part](settings, &typed);
        }
        Deed::Drop(table) => {
            let before = state.clone();
            match state.take_table(named(table)) {
                Ok(said) => assert!(table < USABLE && said.contains(&format!("table-{table}"))),
                Err(refusal) => {
                    assert!(table >= USABLE, "{refusal}");
                    assert_eq!(state.table().short_name(), before.table().short_name());
                }
            }
        }
        Deed::Home => drop(state.reset()),
    }
}

fn facts(state: &State) -> Facts {
    Facts {
        skies: (vec!["grid".into(), "nebula".into()], 0),
        interval: None,
        picture_time: None,
        frame_time: None,
        picture: [640, 360],
        table: state.table().short_name(),
        table_error: Some(1e-7),
        rounding_px: 1e-3,
        held_radius: state.held_radius(),
        adapter: "none".into(),
    }
}

/// A frame without a GPU, in which nobody touches the panel; true if it asks for another.
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

/// The settings without what Home leaves as it is.
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
        deeds in prop::collection::vec(prop::collection::vec(deed(), 0..3), 1..12),
    ) {
        let context = Context::default();
        let mut state = first.clone();
        prop_assert!(!frame(&mut state, &context), "{:?}", state.settings);
        prop_assert_eq!(&state.settings, &first.settings);
        for deeds in deeds {
            deeds.iter().for_each(|deed| act(&mut state, deed));
            let wanted = state.settings.clone();
            let said = state.settle();
            // What is put back is numbers, and only if something is said of it.
            let mut expected = wanted.clone();
            for part in Settings::PARTS.iter().filter(|_| said.is_some()) {
                part(&mut expected, &state.settings);
            }
            prop_assert_eq!(&state.settings, &expected);
            prop_assert!(!frame(&mut state, &context), "{deeds:?}: {:?}", state.settings);
        }
        state.reset();
        let home = but_for_the_panel(&state.settings);
        prop_assert_eq!(&home, &but_for_the_panel(&first.settings));
        prop_assert!(!frame(&mut state, &context));
        // From there the keys lead on, unless the table at the start holds the radius.
        if state.held_radius().is_none() {
            let before = state.settings.view.radius;
            let moved = [Drive::Nearer, Drive::Farther].map(|drive| {
                drive.steer(&mut state.settings.view, 0.1);
                state.settle().is_none() && state.settings.view.radius != before
            });
            prop_assert!(moved.contains(&true));
        }
    }
}

fn at(radius: f64, table: usize) -> State {
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
    // Two keys at once: the one that cannot be obeyed does not stop the other.
    Drive::Nearer.steer(&mut state.settings.view, 0.1);
    Drive::LookUp.steer(&mut state.settings.view, 0.1);
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
    ] {
        let before = state.settings.clone();
        act(&mut state, &Deed::Type(part, x));
        let said = state.settle().unwrap();
        assert!(said.contains(words), "{said}");
        assert_eq!(state.settings, before);
    }
    let refused = |index| {
        let refusal = at(25.0, 0).take_table(named(index)).unwrap_err();
        refusal.to_string()
    };
    let [far, axis] = [4, 5].map(refused);
    assert!(far.contains("table-4.lbt holds one observer only"), "{far}");
    assert!(far.contains("radius inf is too far"), "{far}");
    assert!(axis.contains("table-5.lbt: the table's axis"), "{axis}");
}
