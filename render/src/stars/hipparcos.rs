//! The Hipparcos catalogue in its new reduction (van Leeuwen 2007, Astron. Astrophys. 474, 653; CDS I/311): the
//! parser of the raw file `hip2.dat`, and the built-in catalogue in compact form.

use super::{Catalogue, DEFAULT_DISC_RADIUS, Star, StarsProblem, compact};
use std::ops::Range;
use std::str;

static COMPACT: &[u8] = include_bytes!("../../assets/hipparcos.stars");

/// Years from the catalogue's epoch, J1991.25, to J2000.
const YEARS: f64 = 8.75;
/// One milliarcsecond, rad.
const MAS: f64 = std::f64::consts::PI / 180.0 / 3_600_000.0;

/// The built-in Hipparcos catalogue: 117,955 stars.
///
/// # Panics
/// Never: a test decodes it.
pub fn hipparcos() -> Catalogue {
    compact::from_bytes(COMPACT).expect("the built-in catalogue decodes")
}

/// Parses the raw file `hip2.dat` and moves the stars to J2000 by their proper motions. The magnitude is Hp, the
/// satellite's own broad band, within about 0.3 of V.
///
/// # Errors
/// [`StarsProblem::NotHipparcos`] with the first line that is not a record.
pub fn read_hipparcos(bytes: &[u8]) -> Result<Catalogue, StarsProblem> {
    let lines = bytes.split(|byte| *byte == b'\n').enumerate();
    let stars = lines
        .filter(|(_, line)| !line.trim_ascii().is_empty())
        .map(|(index, line)| {
            star(line).map_err(|what| StarsProblem::NotHipparcos {
                line: index + 1,
                what,
            })
        })
        .collect::<Result<_, _>>()?;
    Catalogue::new(stars, DEFAULT_DISC_RADIUS)
}

/// Parses a record. The columns are those of the file's own description, counted from 0.
fn star(line: &[u8]) -> Result<Star, &'static str> {
    let number = |columns: Range<usize>, what| {
        let text = line
            .get(columns)
            .and_then(|field| str::from_utf8(field).ok());
        let value = text.and_then(|text| text.trim().parse::<f64>().ok());
        value.filter(|value| value.is_finite()).ok_or(what)
    };
    let right_ascension = number(15..28, "no right ascension in columns 16-28")?;
    let declination = number(29..42, "no declination in columns 30-42")?;
    let motion_ra = number(51..59, "no proper motion in columns 52-59")?;
    let motion_dec = number(60..68, "no proper motion in columns 61-68")?;
    Ok(Star {
        right_ascension: right_ascension + YEARS * motion_ra * MAS / declination.cos(),
        declination: declination + YEARS * motion_dec * MAS,
        magnitude: number(129..136, "no magnitude in columns 130-136")?,
        colour_index: Some(number(152..158, "no B-V in columns 153-158")?),
    })
}

#[cfg(test)]
mod tests {
    use super::super::direction;
    use super::*;

    /// (name, right ascension and declination in degrees, Hp, B − V) of well-known stars, J2000.
    const KNOWN: [(&str, f64, f64, f64, f64); 4] = [
        ("Sirius", 101.2872, -16.7161, -1.09, 0.01),
        ("Betelgeuse", 88.7929, 7.4071, 0.50, 1.50),
        ("Rigel", 78.6345, -8.2016, 0.19, -0.03),
        ("Barnard's star", 269.4521, 4.6934, 9.49, 1.57),
    ];

    #[test]
    fn the_built_in_catalogue_has_the_stars_that_everyone_knows() {
        let catalogue = hipparcos();
        assert_eq!(catalogue.stars().len(), 117_955);
        for (name, ra, dec, magnitude, colour) in KNOWN {
            let place = direction(ra.to_radians(), dec.to_radians());
            let near = |star: &&Star| {
                let apart = direction(star.right_ascension, star.declination) - place;
                apart.length() < 5e-6
            };
            let star = catalogue.stars().iter().find(near);
            let star = star.unwrap_or_else(|| panic!("no star at {name}"));
            assert!(
                (star.magnitude - magnitude).abs() < 0.02,
                "{name}: {star:?}"
            );
            let found = star.colour_index.unwrap();
            assert!((found - colour).abs() < 0.02, "{name}: {star:?}");
        }
    }

    /// HIP 1, the first record of the file.
    const RECORD: &str = "     1   5 0 1  0.0000159148  0.0190068680    4.55    -4.55    -1.19   1.29   0.66   1.33   1.25   0.75  90  0.91  0    0.0    0  9.2043 0.0020 0.017 0  0.482 0.025  0.550   1.19  -0.71   1.00  -0.02   0.02   1.00   0.45  -0.05   0.03   1.09  -0.41   0.09   0.08  -0.60   1.00";

    #[test]
    fn a_record_is_read_and_moved_to_j2000() {
        let catalogue = read_hipparcos(RECORD.as_bytes()).unwrap();
        let [star] = catalogue.stars() else { panic!() };
        assert_eq!((star.magnitude, star.colour_index), (9.2043, Some(0.482)));
        let moved = (star.declination - 0.019_006_868) / MAS;
        assert!((moved + 1.19 * 8.75).abs() < 1e-3, "{moved} mas");
    }

    #[test]
    fn what_is_no_record_is_told_with_its_line() {
        let text = format!("{RECORD}\nra,dec\n");
        let told = read_hipparcos(text.as_bytes()).unwrap_err().to_string();
        assert!(
            told.starts_with("line 2 is no record of hip2.dat"),
            "{told}"
        );
        assert!(matches!(read_hipparcos(b""), Err(StarsProblem::Empty)));
    }
}
