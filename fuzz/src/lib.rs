//! What the fuzz targets share.

use lensbake_core::{Observer, RayOutcome, ShadowCoordinate};
use lensbake_render::stars::{Catalogue, StarField};
use lensbake_tables::{InverseRow, Problem, Rows, Table};

/// The checksum attribute of an EXR table: its name, its type, and its length.
const EXR_CHECKSUM: &[u8] = b"lensbake.crc32\0int\0\x04\0\0\0";
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The table in `file`. If only the checksum is wrong, it is corrected first, because no mutation would ever do
/// so.
pub fn repaired(
    mut file: Vec<u8>,
    read: impl Fn(&[u8]) -> Result<Table, Problem>,
) -> Option<Table> {
    match read(&file) {
        Ok(table) => Some(table),
        Err(Problem::Checksum { found, .. }) => {
            let at = checksum_place(&file)?;
            file.get_mut(at..at + 4)?
                .copy_from_slice(&found.to_le_bytes());
            read(&file).inspect_err(one_line).ok()
        }
        Err(problem) => {
            one_line(&problem);
            None
        }
    }
}

fn checksum_place(file: &[u8]) -> Option<usize> {
    if file.starts_with(&EXR_MAGIC) {
        let found = file.windows(EXR_CHECKSUM.len());
        let at = found.into_iter().position(|bytes| bytes == EXR_CHECKSUM)?;
        Some(at + EXR_CHECKSUM.len())
    } else {
        file.len().checked_sub(4)
    }
}

/// Checks that a message is one line.
///
/// # Panics
/// If it is not: a finding.
pub fn one_line(message: &impl ToString) {
    let message = message.to_string();
    assert_eq!(message.lines().count(), 1, "{message:?}");
}

/// Looks up rows and rays in a table, as the programs do.
///
/// # Panics
/// If a result is NaN: a finding.
pub fn exercise_table(table: &Table) {
    let header = table.header();
    for field in header.fields() {
        std::hint::black_box(field);
    }
    let observers = match header.rows {
        Rows::One { .. } => vec![header.observer(0)],
        Rows::Chi { count } => [0, 1, count / 2, count - 1]
            .map(|row| header.observer(row))
            .into_iter()
            .chain([1.001, 1.5, 3.0, 1e6].map(|radius| Observer::at(radius).unwrap()))
            .collect(),
        Rows::ThroughHorizon { above, below, .. } => [0, above - 1, above, above + below - 1]
            .map(|row| header.observer(row))
            .into_iter()
            .chain([1.001, 3.0].map(|radius| Observer::at(radius).unwrap()))
            .chain([3.0, 1.0, 0.5, 0.01].map(|radius| Observer::falling(radius).unwrap()))
            .collect(),
    };
    for observer in observers {
        let Ok(row) = table.row(observer) else {
            continue;
        };
        for at in shadow_coordinates() {
            if let RayOutcome::Escapes(bend) = row.bend(at) {
                assert!(!bend.is_nan(), "{header:?} at {at:?}");
            }
            std::hint::black_box(row.bend_and_slope(at));
        }
        if let Ok(inverse) = InverseRow::new(&row) {
            for sky_angle in [0.0, 1e-9, 0.1, 1.5, 3.1, std::f64::consts::PI] {
                let image = inverse.image(sky_angle);
                std::hint::black_box(image.magnification(sky_angle));
            }
        }
    }
}

/// Normalised shadow coordinates from the shadow's edge to the direction away from the hole.
fn shadow_coordinates() -> impl Iterator<Item = ShadowCoordinate> {
    let near_edge =
        [0.0, f64::MIN_POSITIVE, 1e-300, 1e-16, 1e-9].map(|one_minus_x| ShadowCoordinate {
            x: 1.0 - one_minus_x,
            one_minus_x,
        });
    let rest = [1.0 - 1e-6, 0.9, 0.5, 0.1, 1e-9, 1e-300, 0.0].map(|x| ShadowCoordinate {
        x,
        one_minus_x: 1.0 - x,
    });
    near_edge.into_iter().chain(rest)
}

/// Prepares the stars of a catalogue for drawing.
///
/// # Panics
/// If a star's direction is not a unit vector, or its light is not finite and at least 0: a finding.
pub fn exercise_stars(catalogue: &Catalogue) {
    for stops in [0.0, -32.0, 32.0] {
        for star in StarField::new(catalogue, stops).stars {
            assert!((star.direction.length() - 1.0).abs() < 1e-12, "{star:?}");
            assert!(star.light.is_finite(), "{star:?}");
            assert!(star.light.min_element() >= 0.0, "{star:?}");
        }
    }
}
