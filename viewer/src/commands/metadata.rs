//! The metadata of an .exr: for people, what the picture shows; for `--like`, the options that it was drawn with.

use super::CommandError;
use crate::cli::{
    ATTRIBUTE, DrawingArgs, LightArgs, MethodName, PROGRAM, RecordedOptions, StarArgs, shift_name,
};
use lensbake_core::Motion;
use lensbake_program::message;
use lensbake_render::camera::{Projection, View};
use lensbake_render::disc::Disc;
use lensbake_render::lens::Lens;
use lensbake_render::openexr::{Metadata, Value};
use lensbake_render::sky::SkySource;
use lensbake_render::stars::StarSource;
use lensbake_tables::Header;
use std::path::Path;

/// The bending table that a picture is drawn with.
#[derive(Debug)]
pub struct TableFacts {
    /// Its name: the path, or that of the built-in atlas.
    pub name: String,
    /// The largest error that it states for the camera's side of the horizon, rad; `None` if it states none.
    pub error: Option<f64>,
}

impl TableFacts {
    /// What is said of the table with this `name` and `header` in pictures through `lens`.
    pub fn new(name: String, header: &Header, lens: &Lens) -> Self {
        let below = header.measured_below;
        let measured = match lens.camera.observer.is_inside() {
            true => below.unwrap_or(header.measured),
            false => header.measured,
        };
        TableFacts {
            name,
            error: (measured.rays > 0).then_some(measured.max_error),
        }
    }
}

/// What a picture is drawn of and how, apart from its camera.
#[derive(Debug, Clone, Copy)]
pub struct Described<'a> {
    /// Sky, table and frequency shift.
    pub light: &'a LightArgs,
    /// How it is drawn.
    pub drawing: &'a DrawingArgs,
    /// The stars.
    pub stars: &'a StarArgs,
    /// The disc around the hole, if there is one.
    pub disc: Option<&'a Disc>,
    /// The error budget of the least model, if it is drawn with that.
    pub budget_px: Option<f64>,
    /// The options to record, if they can be.
    pub recorded: Option<&'a RecordedOptions>,
}

/// The metadata of the picture of `view`, drawn with `table` on `device`.
///
/// # Errors
/// [`CommandError::Json`] if they cannot be written as JSON.
pub fn of(
    of: &Described,
    view: &View,
    table: &TableFacts,
    device: &str,
) -> Result<Metadata, CommandError> {
    let observer = observer(view);
    let text = |name, text: &str| (name, Value::Text(text.to_owned()));
    let mut attributes = vec![
        text("lensbake.observer", &observer),
        ("lensbake.radius", Value::Real(view.radius)),
        text("lensbake.motion", &view.motion.to_string()),
        text("lensbake.camera", &camera(view)),
        text("lensbake.sky", &sky(&of.light.sky)),
        text("lensbake.method", &method(of)),
        text("lensbake.table", &table.name),
        text("lensbake.device", device),
    ];
    attributes.extend(
        table
            .error
            .map(|error| ("lensbake.tableError", Value::Real(error))),
    );
    attributes.extend(stars(of).map(|stars| ("lensbake.stars", Value::Text(stars))));
    attributes.extend(of.disc.map(|d| ("lensbake.disc", Value::Text(disc(d)))));
    if let Some(recorded) = of.recorded {
        let recorded = recorded.clone().with_frame(view).with_disc(of.disc);
        let json = serde_json::to_string(&recorded).map_err(CommandError::Json)?;
        attributes.push((ATTRIBUTE, Value::Text(json)));
    }
    Ok(Metadata {
        software: format!("lensbake viewer {PROGRAM}"),
        comments: format!(
            "The sky as a black hole deflects its light, seen by an observer {observer}"
        ),
        attributes,
    })
}

/// Says once for all pictures of a command if they cannot record its options; `output` is the name of their files.
pub fn report_unrecorded(recorded: Option<&RecordedOptions>, output: &Path) {
    if recorded.is_none() {
        message!(
            "viewer: {} does not record its options for --like, because one of its paths is not UTF-8",
            output.display()
        );
    }
}

/// The deflection method.
fn method(of: &Described) -> String {
    match (of.budget_px, of.drawing.method) {
        (Some(budget_px), _) => format!("the least model within {budget_px} px"),
        (None, MethodName::Lut) => "table lookup".to_owned(),
        (None, MethodName::Direct) => {
            format!("direct integration in steps of {} rad", of.light.step)
        }
        (None, MethodName::Flat) => "no deflection".to_owned(),
    }
}

/// Place and motion of the observer.
fn observer(view: &View) -> String {
    let motion = match view.motion {
        Motion::Rest => "at rest".to_owned(),
        Motion::Fall => "in free fall from rest at infinity".to_owned(),
        Motion::Orbit => "in circular orbit".to_owned(),
        Motion::Velocity { radial, tangential } => {
            format!("at the velocity {radial} c outwards, {tangential} c across")
        }
    };
    format!("{motion} at r = {} Schwarzschild radii", view.radius)
}

/// Projection, orientation and picture size of the camera.
fn camera(view: &View) -> String {
    let (width, height, fov) = (view.width, view.height, view.fov_deg);
    let projection = match view.projection {
        Projection::Perspective => format!("{fov}° across"),
        Projection::Equirectangular => "equirectangular".to_owned(),
        Projection::Fisheye => format!("equidistant fisheye, {fov}° across"),
        Projection::Dome { tilt_deg } => format!("dome, {fov}° across, tilted by {tilt_deg}°"),
        Projection::CubeFace(face) => format!("{} face of a cube", face.name()),
    };
    format!(
        "{width}x{height} pixels, {projection}, yaw {}°, pitch {}°, roll {}°, orbit {}°, latitude {}°, heading {}°",
        view.yaw_deg,
        view.pitch_deg,
        view.roll_deg,
        view.orbit_deg,
        view.latitude_deg,
        view.heading_deg
    )
}

/// The name of a built-in sky, or its files.
fn sky(source: &SkySource) -> String {
    if source.is_built_in() {
        return source.name();
    }
    let files = source.files().iter();
    let files: Vec<_> = files.map(|file| file.display().to_string()).collect();
    files.join(",")
}

/// The catalogue of the stars, if there are any.
fn stars(of: &Described) -> Option<String> {
    match of.stars.source(&of.light.sky)? {
        StarSource::Hipparcos => Some("hipparcos".to_owned()),
        StarSource::File(path) => Some(path.display().to_string()),
    }
}

/// Size, orientation and light of the disc.
fn disc(disc: &Disc) -> String {
    let angles = &disc.orientation;
    let [orbit, latitude] = angles.seen_from_deg;
    format!(
        "r = {} to {} Schwarzschild radii, inclination {}° and node {}° from orbit {orbit}°, latitude {latitude}°, \
         opacity {}, {} K and brightness {} where it is hottest, frequency shift {}, pattern of contrast {} at {} r_s/c",
        disc.inner,
        disc.outer,
        angles.inclination_deg,
        angles.node_deg,
        disc.opacity,
        disc.peak_kelvin,
        disc.brightness,
        shift_name(disc),
        disc.pattern,
        disc.time
    )
}
