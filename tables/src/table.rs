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

    /// The row for `observer`. From the atlas it is interpolated in χ between four rows, by Lagrange's polynomial.
    ///
    /// # Errors
    /// [`TableError::OtherObserver`] if the table holds only the row of another observer.
    pub fn row(&self, observer: Observer) -> Result<Row, TableError> {
        let mix = match self.header.rows {
            Rows::One { inverse_radius } => {
                if (observer.inverse_radius() - inverse_radius).abs() > 1e-12 {
                    return Err(TableError::OtherObserver {
                        holds: 1.0 / inverse_radius,
                        asked: observer.radius(),
                    });
                }
                vec![(0, 1.0)]
            }
            Rows::Chi { count } => lagrange(observer.chi(), count).to_vec(),
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
        Ok(Row::new(self.header.axis, observer, texels))
    }
}

/// The four rows around `chi` and their weights in Lagrange's cubic polynomial, one-sided in the first and the
/// last gap between rows.
fn lagrange(chi: f64, count: u32) -> [(u32, f64); 4] {
    let position = chi / std::f64::consts::FRAC_PI_2 * f64::from(count - 1);
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
            let chi = f64::from(i) / 1000.0 * std::f64::consts::FRAC_PI_2;
            let position = chi / std::f64::consts::FRAC_PI_2 * 15.0;
            let mixed: f64 = lagrange(chi, 16)
                .iter()
                .map(|&(row, weight)| weight * cubic(f64::from(row)))
                .sum();
            assert!((mixed - cubic(position)).abs() < 1e-9, "chi {chi}");
        }
    }
}
