//! Contents of the panel and the help, laid out by egui.

use super::typed::typed;
use super::{disc_controls, motion_controls};
use egui::{
    Align2, ComboBox, Context, Grid, Id, Label, RichText, ScrollArea, Slider, Ui, Vec2, Window,
    vec2,
};
use lensbake_interactive::keys::{BINDINGS, Command, MOUSE};
use lensbake_interactive::motion::FIELDS_OF_VIEW;
use lensbake_interactive::panel_info::PanelInfo;
use lensbake_interactive::resolution::Resolution;
use lensbake_interactive::settings::{Comparison, SHIFTS, Settings};
use lensbake_render::scene::Sampling;
use lensbake_render::shift::Shift;
use std::time::Duration;

/// egui id of the panel.
const PANEL: &str = "panel";
/// egui id of the help.
const HELP: &str = "help";
/// Width and height that title bar, frame and margins add to the contents of an egui window, points.
const BESIDE: Vec2 = vec2(44.0, 84.0);
/// Width of the panel's contents, points.
const PANEL_WIDTH: f32 = 326.0;
/// Largest width of a column of the costs, points: a longer name is wrapped.
const NAME: f32 = 200.0;

/// What the user asks for in the panel, besides changes of the settings.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PanelAction {
    /// Index of the sky to show.
    pub sky: Option<usize>,
    /// Whether to reset to the start.
    pub reset: bool,
    /// A command of the path of the camera.
    pub path: Option<Command>,
}

/// Lays out the panel and the help, each if it is shown.
pub fn controls(context: &Context, settings: &mut Settings, facts: &PanelInfo) -> PanelAction {
    let mut action = PanelAction::default();
    if settings.panel {
        action = panel(context, settings, facts);
    }
    if settings.help {
        help(context, &mut settings.help);
    }
    action
}

fn panel(context: &Context, settings: &mut Settings, facts: &PanelInfo) -> PanelAction {
    let mut action = PanelAction::default();
    Window::new("lensbake")
        .id(Id::unique(PANEL))
        .anchor(Align2::LEFT_TOP, [12.0, 12.0])
        .resizable(false)
        .show(context, |ui| {
            in_window(ui, PANEL_WIDTH, |ui| {
                Grid::new("settings").num_columns(2).show(ui, |ui| {
                    action.sky = choices(ui, settings, facts);
                });
                ui.separator();
                costs(ui, facts);
                ui.separator();
                action.path = path(ui, facts);
                ui.separator();
                ui.horizontal(|ui| {
                    action.reset = ui.button("Reset").clicked();
                    ui.toggle_value(&mut settings.help, "Keys (H)");
                    ui.weak("Tab hides this");
                });
            });
        });
    action
}

/// Adds the buttons of the path of the camera; returns the command of the one that is clicked.
fn path(ui: &mut Ui, facts: &PanelInfo) -> Option<Command> {
    let (summary, plays) = &facts.path;
    let play = if *plays { "Stop" } else { "Play" };
    let buttons = [
        (
            "Keyframe",
            Command::SetKeyframe,
            "K: adds a keyframe of the camera as it is",
        ),
        (play, Command::PlayPath, "J: flies along the keyframes"),
        (
            "Save",
            Command::SavePath,
            "N: writes the path for viewer film",
        ),
    ];
    let mut clicked = None;
    ui.horizontal(|ui| {
        for (name, command, does) in buttons {
            if ui.button(name).on_hover_text(does).clicked() {
                clicked = Some(command);
            }
        }
        ui.weak(summary);
    });
    clicked
}

/// Adds `contents` at its own size, or with scroll bars if the window is too small for it; with scroll bars it is
/// up to `width` points wide.
fn in_window(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui)) {
    let room = (ui.ctx().content_rect().size() - BESIDE).max(vec2(1.0, 1.0));
    ScrollArea::both()
        .max_width(room.x)
        .max_height(room.y)
        .min_scrolled_width(room.x.min(width))
        .min_scrolled_height(room.y)
        .show(ui, contents);
}

/// Adds the widgets of the settings; returns the index of another sky if one was chosen.
fn choices(ui: &mut Ui, settings: &mut Settings, facts: &PanelInfo) -> Option<usize> {
    motion_controls::radius(ui, settings, facts);
    motion_controls::motion(ui, settings);

    ui.label("field of view");
    let field = Slider::new(&mut settings.view.fov_deg, FIELDS_OF_VIEW).suffix("°");
    ui.add(typed(field));
    ui.end_row();

    ui.label("sky");
    let (names, shown) = &facts.skies;
    let mut chosen = *shown;
    ComboBox::from_id_salt("sky")
        .truncate()
        .show_index(ui, &mut chosen, names.len(), |i| names[i].as_str())
        .on_hover_text(&names[*shown]);
    ui.end_row();

    disc_controls::disc(ui, settings);
    light(ui, settings);

    ui.label("deflection");
    ui.checkbox(&mut settings.deflection, "");
    ui.end_row();

    ui.label("method");
    ui.add_enabled_ui(settings.deflection, |ui| {
        ComboBox::from_id_salt("method")
            .selected_text(settings.comparison.name())
            .show_ui(ui, |ui| {
                for one in Comparison::ALL {
                    ui.selectable_value(&mut settings.comparison, one, one.name());
                }
            });
    });
    ui.end_row();

    if settings.deflection && settings.comparison == Comparison::Difference {
        ui.label("amplified");
        ui.add(
            Slider::new(&mut settings.gain, Settings::GAINS)
                .logarithmic(true)
                .suffix("×"),
        );
        ui.end_row();
    }

    ui.label("a pixel is");
    ui.horizontal(|ui| {
        let mut choice = |sampling, name| {
            ui.selectable_value(&mut settings.sampling, sampling, name);
        };
        choice(Sampling::Filtered, "its mean");
        choice(Sampling::Anisotropic, "anisotropic");
        choice(Sampling::Single, "one ray");
    });
    ui.end_row();

    ui.label("resolution");
    ComboBox::from_id_salt("resolution")
        .selected_text(settings.resolution.name())
        .show_ui(ui, |ui| {
            for one in Resolution::ALL {
                ui.selectable_value(&mut settings.resolution, one, one.name());
            }
        });
    ui.end_row();

    if settings.resolution == Resolution::Auto {
        ui.label("frame time");
        ui.add(
            Slider::new(&mut settings.target_ms, Settings::TARGETS_MS)
                .logarithmic(true)
                .suffix(" ms"),
        );
        ui.end_row();
    }
    (chosen != *shown).then_some(chosen)
}

/// Adds the rows of the frequency shift and the exposure.
fn light(ui: &mut Ui, settings: &mut Settings) {
    ui.label("shift");
    ui.horizontal(|ui| {
        for shift in SHIFTS {
            ui.selectable_value(&mut settings.shift, shift, shift.name());
        }
    });
    ui.end_row();

    ui.label("exposure");
    ui.horizontal(|ui| {
        ui.add(Slider::new(&mut settings.exposure, Settings::EXPOSURES).suffix(" EV"));
        // Without the shift, nothing changes the brightness.
        ui.add_enabled_ui(settings.shift != Shift::Off, |ui| {
            ui.checkbox(&mut settings.auto_exposure, "auto")
                .on_hover_text("makes up for the brightness of the frequency shift (E)");
        });
    });
    ui.end_row();
}

/// Adds the costs and error bounds of the picture.
fn costs(ui: &mut Ui, facts: &PanelInfo) {
    let [width, height] = facts.picture;
    let rays = f64::from(width) * f64::from(height);
    let shown = |time: Option<Duration>, text: fn(f64) -> String, parts: f64| {
        time.map_or("–".into(), |time| text(time.as_secs_f64() / parts))
    };
    let ms = |s: f64| format!("{:.2} ms", 1e3 * s);
    let rows = [
        (
            "frames per second",
            shown(facts.interval, |s| format!("{:.1}", 1.0 / s), 1.0),
        ),
        ("frame on the GPU", shown(facts.frame_time, ms, 1.0)),
        ("picture", format!("{width} × {height}")),
        ("picture on the GPU", shown(facts.picture_time, ms, 1.0)),
        (
            "per ray (T_ray)",
            shown(facts.picture_time, |s| format!("{:.2} ns", 1e9 * s), rays),
        ),
        ("table", facts.table.clone()),
        (
            "its error",
            facts
                .table_error
                .map_or("not measured".into(), |error| format!("≤ {error:.1e} rad")),
        ),
        ("32-bit rounding", format!("≤ {:.1e} px", facts.rounding_px)),
    ];
    ui.weak(RichText::new(&facts.adapter).small());
    Grid::new("costs")
        .num_columns(2)
        .max_col_width(NAME)
        .show(ui, |ui| {
            for (what, value) in rows {
                ui.label(what);
                ui.add(Label::new(RichText::new(value).monospace()).wrap());
                ui.end_row();
            }
        });
}

fn help(context: &Context, open: &mut bool) {
    Window::new("Keys and mouse")
        .id(Id::unique(HELP))
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .resizable(false)
        .collapsible(false)
        .open(open)
        .show(context, |ui| {
            in_window(ui, f32::INFINITY, |ui| {
                let keys = Grid::new("keys").num_columns(2).striped(true);
                keys.show(ui, |ui| {
                    let keys = BINDINGS.iter().map(|b| (b.names, b.does));
                    for (names, does) in keys.chain(MOUSE.iter().copied()) {
                        ui.label(RichText::new(names).monospace().strong());
                        ui.label(does);
                        ui.end_row();
                    }
                });
            });
        });
}

#[cfg(test)]
mod tests {
    use super::super::message;
    use super::*;
    use egui::{Pos2, RawInput, Rect, Shape};
    use lensbake_core::Motion;
    use lensbake_render::camera::View;

    /// The layout of a window, in points.
    struct LaidOut {
        screen: Rect,
        /// Rectangles of panel, help and message.
        areas: [Rect; 3],
        /// Largest part of a line of text that is clipped at its right or left, points.
        cut: f32,
    }

    /// The settings in each motion, with all rows that it has in the panel.
    fn in_all_motions() -> [Settings; 4] {
        let velocity = Motion::Velocity {
            radial: -0.123456,
            tangential: 0.654321,
        };
        [Motion::Rest, Motion::Fall, Motion::Orbit, velocity].map(|motion| {
            let view = View {
                motion,
                ..View::default()
            };
            let mut settings = Settings::new(view, 0.05);
            settings.help = true;
            settings.shift = Shift::Colour;
            settings.disc_shown = true;
            settings.given_velocity = Some(velocity);
            if motion == Motion::Fall {
                settings.let_go();
            }
            settings
        })
    }

    /// Lays out panel, help and a message in a window of this size, with names of `length` letters.
    fn laid_out([width, height]: [f32; 2], length: usize, mut settings: Settings) -> LaidOut {
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(width, height));
        let name = "sky-of-a-long-name".chars().cycle().take(length);
        let name: String = name.collect();
        let facts = PanelInfo {
            skies: (vec![format!("{name}.png")], 0),
            interval: None,
            picture_time: None,
            frame_time: None,
            picture: [640, 360],
            table: format!("{name}.lbt"),
            table_error: None,
            rounding_px: 0.01,
            path: ("no keyframes".into(), false),
            held_radius: None,
            adapter: "none".into(),
        };
        let context = Context::default();
        let mut cut = 0.0;
        // egui needs a few frames to settle on sizes.
        for _ in 0..4 {
            let input = RawInput {
                screen_rect: Some(screen),
                ..RawInput::default()
            };
            let mut painted = context.run_ui(input, |ui| {
                controls(ui.ctx(), &mut settings, &facts);
                message::show(ui.ctx(), &format!("/{name}/{name}: no such file"));
            });
            painted.textures_delta.clear();
            let texts = painted.shapes.iter().filter_map(|clipped| {
                let Shape::Text(text) = &clipped.shape else {
                    return None;
                };
                let (text, clip) = (text.visual_bounding_rect(), clipped.clip_rect);
                Some((clip.left() - text.left()).max(text.right() - clip.right()))
            });
            cut = texts.fold(0.0, f32::max);
        }
        let areas = [PANEL, HELP, message::ID].map(Id::unique);
        let areas = areas.map(|id| context.memory(|memory| memory.area_rect(id)).unwrap());
        LaidOut { screen, areas, cut }
    }

    #[test]
    fn whatever_the_names_are_all_lies_in_the_window() {
        for size in [[1280.0, 720.0], [640.0, 360.0], [300.0, 200.0]] {
            for length in [3, 255, 4000] {
                for settings in in_all_motions() {
                    let motion = settings.view.motion;
                    let LaidOut { screen, areas, cut } = laid_out(size, length, settings);
                    for area in areas {
                        assert!(screen.contains_rect(area), "{size:?}, {length}: {area:?}");
                    }
                    let narrow = size[0] < 480.0;
                    assert!(
                        narrow || cut < 1.0,
                        "{size:?}, {length}, {motion}: {cut} cut off"
                    );
                }
            }
        }
    }
}
