//! What the panel and the help hold, laid out by egui.

use super::keys::{BINDINGS, MOUSE};
use super::motion::{FIELDS_OF_VIEW, ORBIT_SPEEDS, RADII};
use super::resolution::Resolution;
use super::settings::{Comparison, Settings};
use super::title;
use crate::scene::Sampling;
use egui::{
    Align2, ComboBox, Context, Grid, Id, Label, RichText, ScrollArea, Slider, SliderClamping, Ui,
    Vec2, Window, vec2,
};
use std::time::Duration;

/// What egui knows the panel by.
const PANEL: &str = "panel";
/// What egui knows the help by.
const HELP: &str = "help";
/// Points that title, frame and the distance from the window's edges take beside what they hold.
const BESIDE: Vec2 = vec2(44.0, 84.0);
/// Points across what the panel holds.
const PANEL_WIDTH: f32 = 326.0;
/// Points across a name at the most: a longer one goes on in the next line.
const NAME: f32 = 200.0;

/// What the panel shows besides the settings.
#[derive(Debug, Clone)]
pub struct Facts {
    /// Names of the skies, and which is shown.
    pub skies: (Vec<String>, usize),
    /// The mean time between frames while something moves.
    pub interval: Option<Duration>,
    /// The GPU's time of the picture.
    pub picture_time: Option<Duration>,
    /// The GPU's time of the whole frame, window and panel included.
    pub frame_time: Option<Duration>,
    /// Pixels drawn, `[width, height]`.
    pub picture: [u32; 2],
    /// The table in use.
    pub table: String,
    /// Its largest error, rad, if it was measured.
    pub table_error: Option<f64>,
    /// By how much the GPU's 32-bit floats may be off, pixels.
    pub rounding_px: f64,
    /// Why the radius cannot be changed, if it cannot.
    pub held_radius: Option<String>,
    /// The adapter.
    pub adapter: String,
}

/// What the panel wants that settings do not say.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Wish {
    /// Another sky.
    pub sky: Option<usize>,
    /// Everything as at the start.
    pub reset: bool,
}

/// Panel and help, as far as they are there.
pub fn controls(context: &Context, settings: &mut Settings, facts: &Facts) -> Wish {
    let mut wish = Wish::default();
    if settings.panel {
        wish = panel(context, settings, facts);
    }
    if settings.help {
        help(context, &mut settings.help);
    }
    wish
}

fn panel(context: &Context, settings: &mut Settings, facts: &Facts) -> Wish {
    let mut wish = Wish::default();
    Window::new("lensbake")
        .id(Id::unique(PANEL))
        .anchor(Align2::LEFT_TOP, [12.0, 12.0])
        .resizable(false)
        .show(context, |ui| {
            in_window(ui, PANEL_WIDTH, |ui| {
                Grid::new("settings").num_columns(2).show(ui, |ui| {
                    wish.sky = choices(ui, settings, facts);
                });
                ui.separator();
                costs(ui, facts);
                ui.separator();
                ui.horizontal(|ui| {
                    wish.reset = ui.button("Reset").clicked();
                    ui.toggle_value(&mut settings.help, "Keys (H)");
                    ui.weak("Tab hides this");
                });
            });
        });
    wish
}

/// Adds what is as large as it is, but as wide as `width` points at the most, and can be scrolled where the
/// window has no room for it.
fn in_window(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui)) {
    let room = (ui.ctx().content_rect().size() - BESIDE).max(vec2(1.0, 1.0));
    ScrollArea::both()
        .max_width(room.x)
        .max_height(room.y)
        .min_scrolled_width(room.x.min(width))
        .min_scrolled_height(room.y)
        .show(ui, contents);
}

/// The settings; returns another sky if one was chosen.
fn choices(ui: &mut Ui, settings: &mut Settings, facts: &Facts) -> Option<usize> {
    let view = &mut settings.view;
    ui.label("radius");
    let radius = Slider::new(&mut view.radius, RADII)
        .logarithmic(true)
        .custom_formatter(|radius, _| title::radius(radius))
        .suffix(" r_s");
    let shown = ui.add_enabled(facts.held_radius.is_none(), typed(radius));
    if let Some(why) = &facts.held_radius {
        shown.on_disabled_hover_text(why);
    }
    ui.end_row();

    ui.label("field of view");
    let field = Slider::new(&mut view.fov_deg, FIELDS_OF_VIEW).suffix("°");
    ui.add(typed(field));
    ui.end_row();

    ui.label("orbit speed");
    ui.horizontal(|ui| {
        for (i, speed) in ORBIT_SPEEDS.iter().enumerate() {
            ui.selectable_value(&mut settings.orbit_speed, i, format!("{speed}×"));
        }
    });
    ui.end_row();

    ui.label("sky");
    let (names, shown) = &facts.skies;
    let mut chosen = *shown;
    ComboBox::from_id_salt("sky")
        .truncate()
        .show_index(ui, &mut chosen, names.len(), |i| names[i].as_str())
        .on_hover_text(&names[*shown]);
    ui.end_row();

    ui.label("exposure");
    ui.add(Slider::new(&mut settings.exposure, Settings::EXPOSURES).suffix(" EV"));
    ui.end_row();

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

/// A slider beside which any number can be typed: one from beyond its ends is left as it is. It counts when
/// it is complete, for what it begins with may be of no use.
fn typed(slider: Slider) -> Slider {
    slider
        .clamping(SliderClamping::Never)
        .update_while_editing(false)
}

/// What the picture costs, and how wrong it is.
fn costs(ui: &mut Ui, facts: &Facts) {
    let [width, height] = facts.picture;
    let rays = f64::from(width) * f64::from(height);
    let shown = |time: Option<Duration>, text: fn(f64) -> String, parts: f64| {
        time.map_or("–".into(), |time| text(time.as_secs_f64() / parts))
    };
    let ms = |s: f64| format!("{:.2} ms", 1e3 * s);
    let rows = [
        (
            "frames a second",
            shown(facts.interval, |s| format!("{:.1}", 1.0 / s), 1.0),
        ),
        ("frame on the GPU", shown(facts.frame_time, ms, 1.0)),
        ("picture", format!("{width} × {height}")),
        ("picture on the GPU", shown(facts.picture_time, ms, 1.0)),
        (
            "a ray (T_ray)",
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
    use crate::camera::View;
    use egui::{Pos2, RawInput, Rect, Shape};

    /// What a window of this size in points shows.
    struct LaidOut {
        screen: Rect,
        /// Panel, help and message.
        areas: [Rect; 3],
        /// The largest part of a line of text that is cut off at its right or left, points.
        cut: f32,
    }

    /// Panel, help and a message with names of `length` letters.
    fn laid_out([width, height]: [f32; 2], length: usize) -> LaidOut {
        let screen = Rect::from_min_size(Pos2::ZERO, vec2(width, height));
        let name = "sky-of-a-long-name".chars().cycle().take(length);
        let name: String = name.collect();
        let facts = Facts {
            skies: (vec![format!("{name}.png")], 0),
            interval: None,
            picture_time: None,
            frame_time: None,
            picture: [640, 360],
            table: format!("{name}.lbt"),
            table_error: None,
            rounding_px: 0.01,
            held_radius: None,
            adapter: "none".into(),
        };
        let mut settings = Settings::new(View::default(), 0.05);
        settings.help = true;
        let context = Context::default();
        let mut cut = 0.0;
        // A few frames, for egui finds sizes out as it goes.
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
                let LaidOut { screen, areas, cut } = laid_out(size, length);
                for area in areas {
                    assert!(screen.contains_rect(area), "{size:?}, {length}: {area:?}");
                }
                let narrow = size[0] < 480.0;
                assert!(narrow || cut < 1.0, "{size:?}, {length}: {cut} cut off");
            }
        }
    }
}
