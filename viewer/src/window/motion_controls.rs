//! Rows of the panel for the radius, the motion and the passing of time, laid out by egui.

use super::typed::typed;
use egui::{Label, Rect, Response, RichText, Slider, Stroke, Ui, lerp};
use lensbake_core::{Motion, R_PHOTON};
use lensbake_interactive::motion::{CLOCK_RATES, ORBIT_SPEEDS, radii};
use lensbake_interactive::motion_choice::{name, problem};
use lensbake_interactive::motion_facts::{facts, let_go_name, region, way_back_name};
use lensbake_interactive::panel_info::PanelInfo;
use lensbake_interactive::settings::Settings;
use lensbake_interactive::title;
use std::ops::RangeInclusive;

/// Radii that are marked on the slider: the horizon and the photon sphere.
const MARKED: [f64; 2] = [1.0, R_PHOTON];

/// Adds the row of the radius.
pub fn radius(ui: &mut Ui, settings: &mut Settings, info: &PanelInfo) {
    ui.label("radius");
    let range = radii(&settings.view);
    let radius = Slider::new(&mut settings.view.radius, range.clone())
        .logarithmic(true)
        .custom_formatter(|radius, _| title::radius(radius))
        .suffix(" r_s");
    let shown = ui.add_enabled(info.held_radius.is_none(), typed(radius));
    mark(ui, &shown, &range);
    if let Some(why) = &info.held_radius {
        shown.on_disabled_hover_text(why);
    }
    ui.end_row();

    ui.label("");
    ui.label(region(settings.view.radius));
    ui.end_row();
}

/// Draws marks below the rail of a logarithmic slider, at those of [`MARKED`] that lie in its range.
fn mark(ui: &Ui, slider: &Response, range: &RangeInclusive<f64>) {
    let rail = Rect::from_min_size(
        slider.rect.min,
        egui::vec2(ui.spacing().slider_width, slider.rect.height()),
    );
    // The handle's width beside the rail, as egui has it.
    let aside = match ui.visuals().handle_shape {
        egui::style::HandleShape::Circle => 1.0,
        egui::style::HandleShape::Rect { aspect_ratio } => aspect_ratio,
    };
    let along = rail.x_range().shrink(rail.height() / 2.5 * aside);
    let part = |radius: f64| (radius / range.start()).ln() / (range.end() / range.start()).ln();
    for radius in MARKED.into_iter().filter(|radius| range.contains(radius)) {
        let x = lerp(along, part(radius) as f32);
        let stroke = Stroke::new(1.0, ui.visuals().strong_text_color());
        ui.painter()
            .vline(x, rail.bottom() - 4.0..=rail.bottom() + 2.0, stroke);
    }
}

/// Adds the rows of the motion and of what moves the camera while time passes.
pub fn motion(ui: &mut Ui, settings: &mut Settings) {
    ui.label("motion");
    ui.horizontal(|ui| choices(ui, settings));
    ui.end_row();
    if matches!(
        settings.view.motion,
        Motion::Orbit | Motion::Velocity { .. }
    ) {
        ui.label("heading");
        let heading = Slider::new(&mut settings.view.heading_deg, -180.0..=180.0).suffix("°");
        ui.add(typed(heading))
            .on_hover_text("of the motion: 0 is east, 90 is north");
        ui.end_row();
    }
    ui.label("fall");
    ui.horizontal(|ui| fall(ui, settings));
    ui.end_row();
    if matches!(settings.view.motion, Motion::Fall | Motion::Orbit) {
        clock(ui, settings);
    }
    orbit(ui, settings);
    for (what, value) in facts(settings) {
        ui.label(what);
        ui.add(Label::new(RichText::new(value).monospace()).wrap());
        ui.end_row();
    }
}

fn choices(ui: &mut Ui, settings: &mut Settings) {
    narrow(ui);
    let (now, radius) = (settings.view.motion, settings.view.radius);
    let mut chosen = now;
    for motion in settings.motions() {
        let problem = problem(radius, motion);
        ui.add_enabled_ui(problem.is_none(), |ui| {
            let shown = ui.selectable_value(&mut chosen, motion, short_name(motion));
            let shown = shown.on_hover_text(name(motion));
            if let Some(problem) = problem {
                shown.on_disabled_hover_text(problem.to_string());
            }
        });
    }
    if chosen != now {
        settings.choose_motion(chosen);
    }
}

/// The name in the row of choices.
fn short_name(motion: Motion) -> &'static str {
    match motion {
        Motion::Rest => "at rest",
        Motion::Fall => "free fall",
        Motion::Orbit => "orbit",
        Motion::Velocity { .. } => "velocity",
    }
}

/// Makes room for a row of many choices.
fn narrow(ui: &mut Ui) {
    let spacing = ui.spacing_mut();
    spacing.item_spacing.x = 2.0;
    spacing.button_padding.x = 5.0;
}

/// Adds the buttons of the fall by proper time.
fn fall(ui: &mut Ui, settings: &mut Settings) {
    if ui
        .button(format!("{} (G)", let_go_name(settings)))
        .clicked()
    {
        settings.let_go();
    }
    if let Some(back) = way_back_name(settings)
        && ui.button(format!("{back} (T)")).clicked()
    {
        settings.back_to_let_go();
    }
}

/// Adds the row of the proper time per second.
fn clock(ui: &mut Ui, settings: &mut Settings) {
    ui.label("pace");
    ui.horizontal(|ui| {
        narrow(ui);
        for (i, rate) in CLOCK_RATES.iter().enumerate() {
            ui.selectable_value(&mut settings.clock_rate, i, rate.to_string());
        }
        ui.weak("r_s/c per s")
            .on_hover_text("proper time per second; r_s/c is the time in which light travels r_s");
    });
    ui.end_row();
}

/// Adds the row of what turns the camera around the hole.
fn orbit(ui: &mut Ui, settings: &mut Settings) {
    match settings.view.motion {
        Motion::Rest => {
            ui.label("orbit speed");
            ui.horizontal(|ui| {
                for (i, speed) in ORBIT_SPEEDS.iter().enumerate() {
                    ui.selectable_value(&mut settings.orbit_speed, i, format!("{speed}×"));
                }
            });
            ui.end_row();
        }
        Motion::Orbit => {
            ui.label("orbit");
            ui.checkbox(&mut settings.true_period, "move by the true period (R)");
            ui.end_row();
        }
        Motion::Fall | Motion::Velocity { .. } => (),
    }
}
