//! Parsers of option values; an error says what is expected.

use lensbake_render::sky::SkySource;
use lensbake_render::stars::StarSource;
use lensbake_render::tone_map::EXPOSURES;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// The exposure of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exposure {
    /// In stops.
    Stops(f32),
    /// Such that the frequency shift does not change the mean brightness.
    Automatic,
}

/// Parses the exposure of a picture in stops, or `auto`.
pub fn exposure(text: &str) -> Result<Exposure, String> {
    if text == "auto" {
        return Ok(Exposure::Automatic);
    }
    let stops = text.parse().ok().filter(|stops| EXPOSURES.contains(stops));
    stops.map(Exposure::Stops).ok_or_else(|| {
        let (least, most) = (EXPOSURES.start(), EXPOSURES.end());
        format!("must be `auto` or a number of stops from {least} to {most}")
    })
}

/// Parses width and height in pixels, like 1920x1080.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text.split_once(['x', 'X']).and_then(|(width, height)| {
        let width = width.trim().parse().ok()?;
        Some((width, height.trim().parse().ok()?))
    });
    parsed.ok_or_else(|| "must be like 1920x1080".to_owned())
}

/// Parses right ascension and declination in degrees.
pub fn place(text: &str) -> Result<(f64, f64), String> {
    let parsed = text
        .split_once(',')
        .and_then(|(right_ascension, declination)| {
            let right_ascension: f64 = right_ascension.trim().parse().ok()?;
            Some((right_ascension, declination.trim().parse().ok()?))
        });
    parsed
        .filter(|(ra, dec)| (-360.0..=360.0).contains(ra) && (-90.0..=90.0).contains(dec))
        .ok_or_else(|| {
            "must be two angles in degrees like 83.8,-5.4: right ascension and declination"
                .to_owned()
        })
}

/// Parses inner and outer radius of a disc.
pub fn radii(text: &str) -> Result<(f64, f64), String> {
    let parsed = text.split_once(',').and_then(|(inner, outer)| {
        let inner = inner.trim().parse().ok()?;
        Some((inner, outer.trim().parse().ok()?))
    });
    parsed.ok_or_else(|| {
        "must be the inner and the outer radius, like 3,12; name both where a file follows"
            .to_owned()
    })
}

/// Parses the exposure of stars in stops.
pub fn stops(text: &str) -> Result<f64, String> {
    let parsed = text.parse().ok().filter(|stops: &f64| stops.abs() <= 30.0);
    parsed.ok_or_else(|| "must be a number of stops from -30 to 30".to_owned())
}

/// Parses the source of stars: the built-in catalogue or a file.
pub fn stars(name: OsString) -> Result<StarSource, String> {
    if name == "hipparcos" {
        Ok(StarSource::Hipparcos)
    } else if Path::new(&name).exists() {
        Ok(StarSource::File(name.into()))
    } else {
        Err("is neither a file nor the built-in catalogue hipparcos".to_owned())
    }
}

/// Parses the source of a sky. The name of an existing file is one panorama even if it contains commas.
pub fn sky(name: OsString) -> Result<SkySource, String> {
    match name.to_str() {
        Some("nebula") => return Ok(SkySource::Nebula),
        Some("starmap") => return Ok(SkySource::Starmap),
        Some("grid") => return Ok(SkySource::Grid),
        Some("stars") => return Ok(SkySource::Stars),
        _ if Path::new(&name).exists() => return Ok(SkySource::Panorama(name.into())),
        _ => {}
    }
    let files = split_at_commas(&name);
    if files.len() == 1 {
        return Err(
            "is neither a file nor a built-in sky (nebula, starmap, grid, stars)".to_owned(),
        );
    }
    let faces = <[PathBuf; 6]>::try_from(files);
    faces.map(SkySource::Faces).map_err(|files| {
        format!(
            "must be one panorama or six cube faces, not {} files",
            files.len()
        )
    })
}

/// Splits a list of file names at its commas; text that is not UTF-8 counts as one name.
fn split_at_commas(list: &OsStr) -> Vec<PathBuf> {
    match list.to_str() {
        Some(text) => text.split(',').map(PathBuf::from).collect(),
        None => vec![PathBuf::from(list)],
    }
}
