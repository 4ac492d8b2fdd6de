//! What the panel shows, as JSON for the page.

use lensbake_core::Motion;
use lensbake_interactive::disc_choice;
use lensbake_interactive::motion::radii;
use lensbake_interactive::motion_choice::{name, problem};
use lensbake_interactive::motion_facts::{facts, let_go_name, region, way_back_name};
use lensbake_interactive::panel_info::PanelInfo;
use lensbake_interactive::parameters::PARAMETERS;
use lensbake_interactive::settings::Settings;
use lensbake_interactive::title;
use serde_json::{Map, Value, json};
use std::time::Duration;

/// Returns what the panel shows: `values` by the names of the settings, and the choices that depend on the settings. After
/// the first frame also `costs`, as pairs of name and value.
pub fn json(settings: &Settings, info: Option<&PanelInfo>) -> Value {
    let values: Map<String, Value> = PARAMETERS
        .iter()
        .filter_map(|one| Some((one.name.to_owned(), settings.parameter(one.name)?.into())))
        .collect();
    let radii = radii(&settings.view);
    let motions: Vec<Value> = settings
        .motions()
        .map(|motion| {
            let problem = problem(settings.view.radius, motion).map(|problem| problem.to_string());
            json!({ "value": motion.to_string(), "name": name(motion), "problem": problem })
        })
        .collect();
    let mut panel = json!({
        "values": values,
        "radius": title::radius(settings.view.radius),
        "radii": [radii.start(), radii.end()],
        "region": region(settings.view.radius),
        "motions": motions,
        "heads": matches!(settings.view.motion, Motion::Orbit | Motion::Velocity { .. }),
        "disc": settings.disc_shown.then(|| disc(settings)),
        "letGo": let_go_name(settings),
        "back": way_back_name(settings),
        "facts": facts(settings),
        "moves": settings.moves(),
    });
    if let Some(info) = info {
        panel["skies"] = json!(info.skies.0);
        panel["sky"] = json!(info.skies.0[info.skies.1]);
        panel["title"] = json!(title::title(&info.skies.0[info.skies.1], settings));
        panel["heldRadius"] = json!(info.held_radius);
        panel["picture"] = json!(info.picture);
        panel["costs"] = json!(costs(info));
    }
    panel
}

/// What the panel shows of the disc: its radii and where their sliders stop, and how it is seen.
fn disc(settings: &Settings) -> Value {
    let disc = &settings.disc;
    let stops = disc_choice::radii(disc).map(|range| [*range.start(), *range.end()]);
    json!({
        "radii": [disc.inner, disc.outer],
        "stops": stops,
        "seenFrom": disc_choice::seen_from(&disc.orientation),
        "seenHere": disc_choice::seen_here(settings),
    })
}

/// The costs and error bounds of the picture: names and values.
fn costs(info: &PanelInfo) -> Vec<(&'static str, String)> {
    let [width, height] = info.picture;
    let mut costs = vec![("picture", format!("{width} × {height}"))];
    let ms = |time: Duration| format!("{:.2} ms", 1e3 * time.as_secs_f64());
    costs.extend(info.interval.map(|interval| {
        let hz = 1.0 / interval.as_secs_f64();
        ("frames per second", format!("{hz:.1}"))
    }));
    if let Some(time) = info.picture_time {
        let rays = f64::from(width) * f64::from(height);
        costs.push(("picture on the GPU", ms(time)));
        let ns = 1e9 * time.as_secs_f64() / rays;
        costs.push(("per ray (T_ray)", format!("{ns:.2} ns")));
    }
    costs.push(("table", info.table.clone()));
    let error = match info.table_error {
        Some(error) => format!("≤ {error:.1e} rad"),
        None => "not measured".to_owned(),
    };
    costs.push(("its error", error));
    costs.push(("32-bit rounding", format!("≤ {:.1e} px", info.rounding_px)));
    costs
}
