//! What the fuzz targets share.

use lensbake_core::{EdgeCoordinate, Fate, Observer};
use lensbake_tables::{InverseRow, Problem, Rows, Table};
use viewer::stars::{Catalogue, StarField};

/// What the checksum is called in an EXR table, with the name of its type and its length behind it.
const EXR_CHECKSUM: &[u8] = b"lensbake.crc32\0int\0\x04\0\0\0";
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The table in `file`; if all that is wrong is the checksum, it is put right, since no mutation would ever
/// do so.
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

/// Asks a table for rows and the rows for rays, as the programs do.
///
/// # Panics
/// If an answer is no number: a finding.
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
    };
    for observer in observers {
        let Ok(row) = table.row(observer) else {
            continue;
        };
        for at in edge_coordinates() {
            if let Fate::Escapes(bend) = row.bend(at) {
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

/// From the edge of the shadow to straight away.
fn edge_coordinates() -> impl Iterator<Item = EdgeCoordinate> {
    let near_edge =
        [0.0, f64::MIN_POSITIVE, 1e-300, 1e-16, 1e-9].map(|one_minus_x| EdgeCoordinate {
            x: 1.0 - one_minus_x,
            one_minus_x,
        });
    let rest = [1.0 - 1e-6, 0.9, 0.5, 0.1, 1e-9, 1e-300, 0.0].map(|x| EdgeCoordinate {
        x,
        one_minus_x: 1.0 - x,
    });
    near_edge.into_iter().chain(rest)
}

/// Makes the stars of a catalogue ready to be drawn.
///
/// # Panics
/// If one has no direction or no light: a finding.
pub fn exercise_stars(catalogue: &Catalogue) {
    for stops in [0.0, -32.0, 32.0] {
        for star in StarField::new(catalogue, stops).stars {
            assert!((star.direction.length() - 1.0).abs() < 1e-12, "{star:?}");
            assert!(star.light.is_finite(), "{star:?}");
            assert!(star.light.min_element() >= 0.0, "{star:?}");
        }
    }
}
