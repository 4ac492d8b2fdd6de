//! The table in memory.

use crate::{Header, Row, Rows, TableError};
use lensbake_core::Observer;

/// A texel: the stored value and its slope per texel, in rad.
pub type Texel = [f32; 2];

/// A bending table: its header and rows × texels of [`Texel`], row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    header: Header,
    texels: Vec<Texel>,
}

impl Table {
    /// A table of `texels`, array of shape `[rows][texels]`.
    ///
    /// # Errors
    /// [`TableError`] if the header is invalid, the number of texels differs from the header's, or a texel is not
    /// finite.
    pub fn new(header: Header, texels: Vec<Texel>) -> Result<Self, TableError> {
        header.validate()?;
        if texels.len() as u64 != header.texel_count() {
            return Err(TableError::TexelCount {
                expected: header.texel_count(),
                found: texels.len() as u64,
            });
        }
        if let Some(bad) = texels.iter().position(|t| !t.iter().all(|c| c.is_finite())) {
            return Err(TableError::NotFinite {
                row: bad / header.texels as usize,
                texel: bad % header.texels as usize,
            });
        }
        Ok(Table { header, texels })
    }

    /// The header.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The same table with another header of the same shape, for example with the measured error.
    ///
    /// # Errors
    /// As [`Table::new`].
    pub fn with_header(self, header: Header) -> Result<Self, TableError> {
        Table::new(header, self.texels)
    }

    /// All texels, array of shape `[rows][texels]`.
    pub fn texels(&self) -> &[Texel] {
        &self.texels
    }

    /// Size of the texels in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.texels.as_slice())
    }

    /// The texels of row `index`.
    pub fn row_texels(&self, index: u32) -> &[Texel] {
        let n = self.header.texels as usize;
        &self.texels[index as usize * n..][..n]
    }

    /// The row for `observer`, at rest or in radial motion. From the atlas it is interpolated between four rows, by
    /// Lagrange's polynomial: in χ above the horizon, in ln u below. The rows of a table are for the observers of
    /// [`Observer::in_row_frame`]; for another motion the difference of the view angles is added to each texel.
    ///
    /// # Errors
    /// [`TableError::OtherObserver`] if the table holds only the row of another observer,
    /// [`TableError::NoRowsBelow`] if it does not reach down to this observer.
    pub fn row(&self, observer: Observer) -> Result<Row, TableError> {
        let u = observer.inverse_radius();
        let mix = match self.header.rows {
            Rows::One { inverse_radius } => {
                if (u - inverse_radius).abs() > 1e-12 * inverse_radius.max(1.0) {
                    return Err(TableError::OtherObserver {
                        holds: 1.0 / inverse_radius,
                        asked: observer.radius(),
                    });
                }
                vec![(0, 1.0)]
            }
            _ if !observer.is_inside() => {
                lagrange(chi_part(&observer), self.header.rows_above()).to_vec()
            }
            Rows::Chi { .. } => {
                return Err(TableError::NoRowsBelow {
                    reach: 1.0,
                    asked: observer.radius(),
                });
            }
            Rows::ThroughHorizon {
                above,
                below,
                r_min,
            } => {
                let part = u.ln() / -r_min.ln();
                if part > 1.0 + 1e-12 {
                    return Err(TableError::NoRowsBelow {
                        reach: r_min,
                        asked: observer.radius(),
                    });
                }
                let rows = lagrange(part.min(1.0), below);
                rows.map(|(row, weight)| (above + row, weight)).to_vec()
            }
        };
        let texels = (0..self.header.texels as usize)
            .map(|i| {
                let mut texel = [0.0; 2];
                for &(row, weight) in &mix {
                    let stored = self.row_texels(row)[i];
                    texel[0] += weight * f64::from(stored[0]);
                    texel[1] += weight * f64::from(stored[1]);
                }
                texel
            })
            .collect();
        let row_frame = observer.in_row_frame();
        let row = Row::new(self.header.axis.of(&observer), row_frame, texels);
        let moves = observer.redshifts()[1] != row_frame.redshifts()[1];
        Ok(if moves && !observer.is_at_rest() {
            row.in_frame_of(observer)
        } else {
            row.with_observer(observer)
        })
    }
}

/// χ of `observer` as a part of π/2.
fn chi_part(observer: &Observer) -> f64 {
    observer.chi() / std::f64::consts::FRAC_PI_2
}

/// The four rows around the part `t` in [0, 1] of `count` uniform rows, and their weights in Lagrange's cubic
/// polynomial, one-sided in the first and the last gap between rows.
fn lagrange(t: f64, count: u32) -> [(u32, f64); 4] {
    let position = t * f64::from(count - 1);
    let first = (position.floor() as u32).saturating_sub(1).min(count - 4);
    let t = position - f64::from(first);
    let weight = |k: usize| {
        (0..4)
            .filter(|&j| j != k)
            .map(|j| (t - j as f64) / (k as f64 - j as f64))
            .product()
    };
    std::array::from_fn(|k| (first + k as u32, weight(k)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lagrange_reproduces_cubics_everywhere() {
        let cubic = |t: f64| 1.0 + t * (2.0 + t * (-3.0 + 0.5 * t));
        for i in 0..=1000 {
            let part = f64::from(i) / 1000.0;
            let position = part * 15.0;
            let mixed: f64 = lagrange(part, 16)
                .iter()
                .map(|&(row, weight)| weight * cubic(f64::from(row)))
                .sum();
            assert!((mixed - cubic(position)).abs() < 1e-9, "{part}");
        }
    }
}
