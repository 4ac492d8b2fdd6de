//! Rows of the panel for the disc around the hole, laid out by egui.

use super::typed::typed;
use egui::{RichText, Slider, Ui};
use lensbake_interactive::disc_choice::{
    BRIGHTNESSES, INCLINATIONS, NODES, RADII, radii, seen_from, seen_here,
};
use lensbake_interactive::settings::{SHIFTS, Settings};
use lensbake_render::disc::{Disc, Orientation};
use std::ops::RangeInclusive;

/// Adds the row that shows the disc or hides it, and while it is shown those of its values.
pub fn disc(ui: &mut Ui, settings: &mut Settings) {
    ui.label("disc");
    ui.checkbox(&mut settings.disc_shown, "matter in orbit (B)");
    ui.end_row();
    if !settings.disc_shown {
        return;
    }
    let inclined = seen_here(settings);
    let disc = &mut settings.disc;
    let [inner, outer] = radii(disc);
    radius(ui, "inner radius", &mut disc.inner, inner);
    radius(ui, "outer radius", &mut disc.outer, outer);
    orientation(ui, &mut disc.orientation);
    ui.label("seen here");
    ui.label(RichText::new(inclined).monospace())
        .on_hover_text("angle of the axis from the line of sight to the hole");
    ui.end_row();
    light(ui, disc);
}

/// Adds the row of a radius, whose slider stops at the ends of `stops`.
fn radius(ui: &mut Ui, name: &str, value: &mut f64, stops: RangeInclusive<f64>) {
    ui.label(name);
    let slider = Slider::new(value, RADII).logarithmic(true).suffix(" r_s");
    let shown = ui.add(typed(slider));
    if shown.changed() && (shown.dragged() || shown.drag_stopped()) {
        *value = value.clamp(*stops.start(), *stops.end());
    }
    ui.end_row();
}

/// Adds the rows of the angles.
fn orientation(ui: &mut Ui, orientation: &mut Orientation) {
    ui.label("");
    ui.weak(seen_from(orientation));
    ui.end_row();
    for (name, degrees, range, means) in [
        (
            "inclination",
            &mut orientation.inclination_deg,
            INCLINATIONS,
            "0° is face-on, 90° edge-on; beyond 90° the matter moves clockwise",
        ),
        (
            "node",
            &mut orientation.node_deg,
            NODES,
            "angle of the line of nodes from the horizontal, counter-clockwise",
        ),
    ] {
        ui.label(name);
        let slider = Slider::new(degrees, range).suffix("°");
        ui.add(typed(slider)).on_hover_text(means);
        ui.end_row();
    }
}

/// Adds the rows of the light of the disc.
fn light(ui: &mut Ui, disc: &mut Disc) {
    ui.label("opacity");
    let slider = Slider::new(&mut disc.opacity, Disc::OPACITIES);
    ui.add(typed(slider))
        .on_hover_text("the share of the light behind it that the disc takes away");
    ui.end_row();

    ui.label("temperature");
    let slider = Slider::new(&mut disc.peak_kelvin, Disc::KELVINS).logarithmic(true);
    ui.add(typed(slider.fixed_decimals(0).suffix(" K")))
        .on_hover_text("where the disc is hottest, at r = 4.78");
    ui.end_row();

    ui.label("brightness");
    let slider = Slider::new(&mut disc.brightness, BRIGHTNESSES).logarithmic(true);
    ui.add(typed(slider.suffix("×")))
        .on_hover_text("where the disc is hottest, without frequency shift: 1 is white");
    ui.end_row();

    ui.label("disc shift");
    ui.horizontal(|ui| {
        for shift in SHIFTS {
            ui.selectable_value(&mut disc.shift, shift, shift.name());
        }
    });
    ui.end_row();
}
