//! The compact catalogue format: twelve bytes per star, and a checksum. `docs/stars.md` specifies it byte by byte.

use super::{Catalogue, MAX_STARS, Star, StarsProblem};
use std::f64::consts::TAU;

const MAGIC: [u8; 8] = *b"LBSTARS\0";
const VERSION: u32 = 1;
/// Bytes of the header: magic, version, count, radius, checksum.
const HEADER: usize = 28;
/// Position of the checksum in the header.
const CHECKSUM: std::ops::Range<usize> = 24..28;
const RECORD: usize = 12;
/// Stored units of angle per radian: a full turn is 2³² of them.
const PER_RADIAN: f64 = 4_294_967_296.0 / TAU;
/// Stored units per magnitude: magnitudes are in thousandths.
const PER_MAGNITUDE: f64 = 1000.0;
const NO_COLOUR: i16 = i16::MIN;

/// Whether `bytes` start with the magic number of a compact catalogue.
pub(super) fn is_compact(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// Encodes `catalogue`: angles to 7e-10 rad, magnitudes and colour indices to 0.0005.
pub fn to_bytes(catalogue: &Catalogue) -> Vec<u8> {
    let stars = catalogue.stars();
    let mut bytes = Vec::with_capacity(HEADER + RECORD * stars.len());
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend((stars.len() as u32).to_le_bytes());
    bytes.extend(catalogue.disc_radius().to_le_bytes());
    bytes.extend([0; 4]);
    let thousandths = |value: f64| (value * PER_MAGNITUDE).round() as i16;
    for star in stars {
        let turn = star.right_ascension.rem_euclid(TAU);
        bytes.extend(((turn * PER_RADIAN).round() as u64 as u32).to_le_bytes());
        bytes.extend(((star.declination * PER_RADIAN).round() as i32).to_le_bytes());
        bytes.extend(thousandths(star.magnitude).to_le_bytes());
        let colour = star.colour_index.map_or(NO_COLOUR, thousandths);
        bytes.extend(colour.to_le_bytes());
    }
    let checksum = checksum(&bytes);
    bytes[CHECKSUM].copy_from_slice(&checksum.to_le_bytes());
    bytes
}

/// Decodes a compact catalogue.
///
/// # Errors
/// [`StarsProblem`] says what is wrong with `bytes`.
pub fn from_bytes(bytes: &[u8]) -> Result<Catalogue, StarsProblem> {
    let found = bytes.len() as u64;
    let Some((header, records)) = bytes.split_at_checked(HEADER) else {
        return Err(StarsProblem::Length {
            expected: HEADER as u64,
            found,
        });
    };
    let version = u32::from_le_bytes(field(header, 8));
    if version != VERSION {
        return Err(StarsProblem::Version { found: version });
    }
    let count = u32::from_le_bytes(field(header, 12));
    let expected = HEADER as u64 + u64::from(count) * RECORD as u64;
    if expected != found {
        return Err(StarsProblem::Length { expected, found });
    }
    if count as usize > MAX_STARS {
        return Err(StarsProblem::TooMany { max: MAX_STARS });
    }
    let stored = u32::from_le_bytes(field(header, CHECKSUM.start));
    let computed = checksum(bytes);
    if stored != computed {
        return Err(StarsProblem::Checksum {
            expected: stored,
            found: computed,
        });
    }
    let stars = records.chunks_exact(RECORD).map(star).collect();
    Catalogue::new(stars, f64::from_le_bytes(field(header, 16)))
}

fn star(record: &[u8]) -> Star {
    let colour = i16::from_le_bytes(field(record, 10));
    let magnitudes = |thousandths: i16| f64::from(thousandths) / PER_MAGNITUDE;
    Star {
        right_ascension: f64::from(u32::from_le_bytes(field(record, 0))) / PER_RADIAN,
        declination: f64::from(i32::from_le_bytes(field(record, 4))) / PER_RADIAN,
        magnitude: magnitudes(i16::from_le_bytes(field(record, 8))),
        colour_index: (colour != NO_COLOUR).then(|| magnitudes(colour)),
    }
}

/// CRC-32 (IEEE) of all bytes except the checksum's own.
fn checksum(bytes: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&bytes[..CHECKSUM.start]);
    hasher.update(&bytes[CHECKSUM.end..]);
    hasher.finalize()
}

/// The `N` bytes from `start` on, which the caller knows to exist.
fn field<const N: usize>(bytes: &[u8], start: usize) -> [u8; N] {
    let mut field = [0; N];
    field.copy_from_slice(&bytes[start..start + N]);
    field
}

#[cfg(test)]
mod tests {
    use super::*;

    fn catalogue() -> Catalogue {
        let star = |right_ascension, declination, magnitude, colour_index| Star {
            right_ascension,
            declination,
            magnitude,
            colour_index,
        };
        let stars = vec![
            star(0.0, -1.5, -1.46, Some(0.009)),
            star(TAU - 1e-12, 1.56, 2.0, None),
            star(3.1, 0.1, 14.562, Some(-0.4)),
        ];
        Catalogue::new(stars, 2e-8).unwrap()
    }

    #[test]
    fn a_catalogue_survives_its_compact_form() {
        let catalogue = catalogue();
        let bytes = to_bytes(&catalogue);
        assert_eq!(bytes.len(), 28 + 3 * 12);
        let back = from_bytes(&bytes).unwrap();
        assert_eq!(back.disc_radius(), 2e-8);
        for (star, again) in catalogue.stars().iter().zip(back.stars()) {
            let apart = super::super::direction(star.right_ascension, star.declination)
                - super::super::direction(again.right_ascension, again.declination);
            assert!(apart.length() < 1.1e-9, "{star:?} {again:?}");
            assert!((star.magnitude - again.magnitude).abs() < 5.1e-4);
            assert_eq!(star.colour_index, again.colour_index);
        }
        assert_eq!(to_bytes(&back), bytes);
    }

    #[test]
    fn every_truncation_and_every_flipped_byte_is_refused() {
        let bytes = to_bytes(&catalogue());
        for length in 0..bytes.len() {
            assert!(from_bytes(&bytes[..length]).is_err(), "{length} bytes");
        }
        for i in MAGIC.len()..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[i] ^= 0x41;
            assert!(from_bytes(&damaged).is_err(), "byte {i}");
        }
    }
}
