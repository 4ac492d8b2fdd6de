//! The comment at the top of an exported text: what it takes and returns, its error, and how it was made.

use super::measure::{Errors, RAYS, WIDTH};
use super::source::{Place, Shape};
use super::{Language, Request};

/// Longest line, without the comment's sign.
const COLUMNS: usize = 112;
/// Width of the names of parameters.
const NAMES: usize = 16;

/// The comment for `request`, whose lookup has this shape and whose numbers have these errors.
pub fn header(request: &Request, shape: &Shape, errors: Errors) -> String {
    let mut lines = wrapped("", &whose(request));
    lines.push(String::new());
    lines.extend(match request.language {
        Language::Python => python_interface(&request.function),
        _ => interface(request, shape.place, shape.rows),
    });
    lines.push(String::new());
    lines.extend(wrapped("", &accuracy(request, shape.texels, errors)));
    lines.push(String::new());
    lines.extend(wrapped("", &format!("Made by: {}", request.command())));
    lines.push("Part of lensbake. Licence: MIT or Apache-2.0, as you like.".to_owned());
    let comment = request.language.comment();
    let lines = lines
        .iter()
        .map(|line| format!("{comment} {line}").trim_end().to_owned() + "\n");
    lines.collect()
}

/// The words of `text` in lines, the first after `name`, the others below its text.
fn wrapped(name: &str, text: &str) -> Vec<String> {
    let indent = if name.is_empty() { 0 } else { NAMES };
    let mut lines = vec![format!("{name:indent$}")];
    for word in text.split_whitespace() {
        let line = lines.last().map_or(0, |line| line.len());
        if line + 1 + word.len() > COLUMNS {
            lines.push(" ".repeat(indent));
        }
        if let Some(line) = lines.last_mut() {
            if line.len() > indent {
                line.push(' ');
            }
            *line += word;
        }
    }
    lines
}

fn whose(request: &Request) -> String {
    let what = "The bending of light by a black hole that does not rotate";
    match request.observer {
        Some(observer) => {
            let motion = match observer.is_at_rest() {
                true => "at rest",
                false => "in free fall from rest at infinity,",
            };
            format!(
                "{what}, for the observer {motion} at r = {} Schwarzschild radii.",
                observer.radius()
            )
        }
        None => format!("{what}, for all observers at rest."),
    }
}

fn accuracy(request: &Request, texels: u32, errors: Errors) -> String {
    let pixels = match errors.pixels < 1e-3 {
        true => format!("{:.1e}", errors.pixels),
        false => format!("{:.3}", errors.pixels),
    };
    // Cycles rounds the directions of its own rays, too.
    let rounding = match request.language {
        Language::Osl => "2e-3",
        _ => "5e-4",
    };
    format!(
        "Error of the numbers ({}, {texels} texels a row) against the closed form: {:.1e} rad on the sky, {pixels} pixels of \
         a picture {WIDTH} pixels wide and 90 degrees across. These are the largest of {RAYS} random rays in 64-bit \
         arithmetic; 32-bit arithmetic adds up to {rounding} pixels.",
        request.precision.name(),
        errors.radians
    )
}

fn python_interface(name: &str) -> Vec<String> {
    wrapped(
        "",
        &format!(
            "{name}(d, hole) turns view directions into directions on the sky; bend(theta) is the angle between them."
        ),
    )
}

/// What the function takes and returns.
fn interface(request: &Request, place: Place, rows: u32) -> Vec<String> {
    let name = &request.function;
    let mut parameters = vec![
        ("d", "unit view direction, in any frame".to_owned()),
        (
            "hole",
            "unit direction of the hole, in the same frame, for example (0, 0, -1)".to_owned(),
        ),
    ];
    if request.observer.is_none() {
        let r = "radius of the observer in Schwarzschild radii, above 1; 1e30 for infinity";
        parameters.push(("r", r.to_owned()));
    }
    parameters.extend(data(request, place, rows));
    let names: Vec<_> = parameters.iter().map(|(name, _)| *name).collect();
    let mut lines = wrapped(
        "",
        &format!(
            "{name}({}) returns the direction on the sky from which the light comes that is seen in the direction d, or \
             (0, 0, 0) if the ray ends in the hole: draw it black.",
            names.join(", ")
        ),
    );
    for (name, what) in parameters {
        lines.extend(wrapped(&format!("  {name}"), &what));
    }
    lines.extend(wrapped(
        "",
        &format!(
            "{name}_bend returns the bending (deflection angle) in radians. Compute in 32-bit floats: with 16 bits \
             (mediump, half) the picture is off by up to 3 pixels and grainy."
        ),
    ));
    lines
}

/// The parameters that hold the table.
fn data(request: &Request, place: Place, rows: u32) -> Vec<(&'static str, String)> {
    let texels = request.texels;
    let line = if request.flip { "lowest" } else { "top" };
    let range = match request.precision {
        super::Precision::Unorm16 => "16-bit integers that are read as numbers from 0 to 1",
        _ => "floats",
    };
    match (place, request.language) {
        (Place::Row, Language::C) => {
            let name = &request.function;
            vec![(
                "row",
                format!("filled by {name}_row(r, row) when r changes"),
            )]
        }
        (Place::Row, _) => vec![(
            "row",
            format!(
                "texture of {texels} x 1 texels in 32-bit floats, R the value and G the slope: the row of the observer, \
                 mixed from the rows of the atlas by the caller when r changes. Texels are loaded, not filtered"
            ),
        )],
        (Place::Filtered, language) => {
            let atlas = format!(
                "texture of {texels} x {rows} texels, R the value ({range}), the first row at v = 0, which is the {line} \
                 line of the file: linear data (no sRGB), no mipmaps, no compression, linear filter, clamped to the edge"
            );
            let sampler = ("linear_clamp", "its sampler".to_owned());
            match language {
                Language::Wgsl | Language::Hlsl | Language::Msl => vec![("atlas", atlas), sampler],
                _ => vec![("atlas", atlas)],
            }
        }
        (Place::Array | Place::Atlas, Language::Osl) => {
            vec![("row", "the array of the numbers".to_owned())]
        }
        (Place::Array | Place::Atlas, _) => Vec::new(),
    }
}
