//! Parsers of the values of options. Each says what a value must be.

use lensbake_core::Observer;
use lensbake_core::thin_disc::check_radii;

/// The radii of a disc, units of the Schwarzschild radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Radii {
    /// Inner radius.
    pub inner: f64,
    /// Outer radius.
    pub outer: f64,
}

pub(super) fn observer(text: &str) -> Result<Observer, String> {
    if text == "far" {
        return Ok(Observer::at_infinity());
    }
    let r: f64 = text
        .parse()
        .map_err(|_| "must be `far` or a radius in units of r_s".to_owned())?;
    match r > 1.0 {
        true => Observer::at(r),
        false => Observer::falling(r).map(|observer| observer.in_row_frame()),
    }
    .map_err(|e| e.to_string())
}

pub(super) fn finite_radius(text: &str) -> Result<f64, String> {
    let radius = number(text)?;
    match radius.is_infinite() {
        true => {
            Err("to an observer at infinity the hole is a point: give a large radius".to_owned())
        }
        false => Ok(radius),
    }
}

pub(super) fn function_name(text: &str) -> Result<String, String> {
    let is_word = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let starts_well = text.starts_with(|c: char| c.is_ascii_alphabetic());
    // GLSL reserves names with two underscores and names that begin with gl_.
    let is_free = !text.contains("__") && !text.starts_with("gl_") && !text.ends_with('_');
    if is_word && starts_well && is_free && text.len() <= 64 {
        Ok(text.to_owned())
    } else {
        Err("must be a name of at most 64 letters, digits and single underscores that begins with a letter".to_owned())
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "is not a number".to_owned())
}

pub(super) fn positive(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err("must be a positive number".to_owned())
    }
}

pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if (1e-13..=1e-2).contains(&value) {
        Ok(value)
    } else {
        Err("must be from 1e-13 to 1e-2".to_owned())
    }
}

pub(super) fn radii(text: &str) -> Result<Radii, String> {
    let (inner, outer) = text
        .split_once(',')
        .ok_or("must be two radii, such as 3,12")?;
    let [inner, outer] = [inner, outer].map(|word| {
        let radius = number(word.trim());
        radius.map_err(|problem| format!("'{word}' {problem}"))
    });
    let radii = Radii {
        inner: inner?,
        outer: outer?,
    };
    check_radii(radii.inner, radii.outer).map_err(|problem| problem.to_string())?;
    Ok(radii)
}

pub(super) fn angle(text: &str) -> Result<f64, String> {
    let degrees = number(text)?;
    match degrees.is_finite() {
        true => Ok(degrees),
        false => Err("must be a finite number of degrees".to_owned()),
    }
}

pub(super) fn field_of_view(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 && value < 180.0 {
        Ok(value)
    } else {
        Err("must be between 0 and 180 degrees".to_owned())
    }
}

/// An inclination at which a disc is seen neither face-on nor edge-on.
pub(super) fn visible_inclination(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok();
    degrees
        .filter(|degrees| (1.0..=89.0).contains(degrees))
        .ok_or_else(|| "must be an angle in degrees from 1 to 89".to_owned())
}
