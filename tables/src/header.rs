//! The header of a table: its axis and rows, how it was computed, and its measured error.

#[cfg(feature = "files")]
use crate::text;
use crate::{Axis, TableError};
use lensbake_core::Observer;
#[cfg(feature = "files")]
use serde::{Deserialize, Serialize};

/// The header of a table.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize))]
pub struct Header {
    /// The axis along a row.
    pub axis: Axis,
    /// The observers that the rows are for.
    pub rows: Rows,
    /// Number of texels per row.
    pub texels: u32,
    /// How the texels were computed.
    pub solver: Solver,
    /// The error measured after baking.
    pub measured: Measured,
}

/// The observers that the rows are for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize))]
pub enum Rows {
    /// One row, for the static observer at 1/r.
    One {
        /// 1/r; 0 is the observer at infinity.
        inverse_radius: f64,
    },
    /// Rows uniform in χ, 1/r = sin²χ, from χ = 0 (r = ∞) to π/2 (the horizon), both included.
    Chi {
        /// Number of rows, at least 4.
        count: u32,
    },
}

/// How the texels were computed.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize))]
pub struct Solver {
    /// Name of the solver: at most 4016 bytes of UTF-8.
    pub name: String,
    /// The solver's tolerance, rad per radian of orbital angle.
    pub tolerance: f64,
}

/// The error of a table's f64 lookup relative to the closed form, measured between the nodes of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize))]
pub struct Measured {
    /// Largest error, rad.
    pub max_error: f64,
    /// Number of rays measured.
    pub rays: u32,
    /// Smallest radius of their observers.
    pub r_min: f64,
    /// Smallest 1 − x of the rays: how close to the shadow boundary they come.
    pub edge_gap: f64,
}

impl Measured {
    /// Placeholder until the error has been measured.
    pub const NOTHING: Measured = Measured {
        max_error: 0.0,
        rays: 0,
        r_min: 0.0,
        edge_gap: 0.0,
    };
}

/// A header field as shown in files and by `bake inspect`.
#[derive(Debug, Clone, PartialEq)]
pub enum Field {
    /// A count.
    Count(u32),
    /// A quantity.
    Real(f64),
    /// A name.
    Text(String),
}

/// Limits on the size of a table: texels per row (up to 2¹⁶), rows (up to 2¹²), and both together (up to 2²²
/// texels, 32 MiB).
const TEXELS: (u64, u64) = (4, 1 << 16);
const ROWS: (u64, u64) = (4, 1 << 12);
/// Most texels that a table may have in all.
pub(crate) const MAX_TEXELS: u64 = 1 << 22;
/// Most bytes of a solver's name; this limit ensures that every header fits into a binary file.
pub(crate) const MAX_SOLVER_NAME: usize = 4016;

const UNITS: &str = "r_s = 1 (2GM = 1), c = 1; angles and texels in radians";

/// Checks that a row may have this number of texels.
pub(crate) fn check_texels(texels: u32) -> Result<(), TableError> {
    in_range("the number of texels in a row", texels.into(), TEXELS)
}

impl Header {
    /// Number of rows.
    pub fn row_count(&self) -> u32 {
        match self.rows {
            Rows::One { .. } => 1,
            Rows::Chi { count } => count,
        }
    }

    /// Number of texels in all: texels per row × rows.
    pub fn texel_count(&self) -> u64 {
        u64::from(self.texels) * u64::from(self.row_count())
    }

    /// The observer of row `index`.
    pub fn observer(&self, index: u32) -> Observer {
        match self.rows {
            Rows::Chi { count } => Observer::at_chi(
                f64::from(index) / f64::from(count - 1) * std::f64::consts::FRAC_PI_2,
            ),
            Rows::One { inverse_radius } => {
                Observer::at(1.0 / inverse_radius).unwrap_or_else(|_| Observer::at_infinity())
            }
        }
    }

    /// Checks everything that a lookup relies on.
    ///
    /// # Errors
    /// [`TableError::Size`] or [`TableError::Field`] with what is wrong.
    pub fn validate(&self) -> Result<(), TableError> {
        check_texels(self.texels)?;
        match self.rows {
            Rows::Chi { count } => in_range("the number of rows", count.into(), ROWS)?,
            Rows::One { inverse_radius } => {
                if !(0.0..1.0).contains(&inverse_radius) {
                    return Err(field(
                        "inverse_radius",
                        inverse_radius,
                        "must be from 0 to below 1",
                    ));
                }
            }
        }
        in_range(
            "the number of texels in all",
            self.texel_count(),
            (1, MAX_TEXELS),
        )?;
        in_range(
            "the length of the solver's name in bytes",
            self.solver.name.len() as u64,
            (0, MAX_SOLVER_NAME as u64),
        )?;
        if let Some((b_min, b_max)) = self.axis.b_range() {
            if !(b_min > lensbake_core::B_CRIT && b_max > b_min && b_max.is_finite()) {
                return Err(field(
                    "b_min",
                    b_min,
                    "needs b_c < b_min < b_max < infinity",
                ));
            }
            if self.rows
                != (Rows::One {
                    inverse_radius: 0.0,
                })
            {
                return Err(field(
                    "axis",
                    self.axis.name(),
                    "an axis in b needs the far observer",
                ));
            }
        }
        Ok(())
    }

    /// The header as named fields, which become the attributes of an OpenEXR file.
    pub fn fields(&self) -> Vec<(&'static str, Field)> {
        let text = |s: &str| Field::Text(s.to_owned());
        let mut fields = vec![
            ("axis", text(self.axis.name())),
            ("texels", Field::Count(self.texels)),
        ];
        if let Some((b_min, b_max)) = self.axis.b_range() {
            fields.push(("b_min", Field::Real(b_min)));
            fields.push(("b_max", Field::Real(b_max)));
        }
        match self.rows {
            Rows::One { inverse_radius } => {
                fields.push(("rows", Field::Count(1)));
                fields.push(("row_map", text("one")));
                fields.push(("inverse_radius", Field::Real(inverse_radius)));
            }
            Rows::Chi { count } => {
                fields.push(("rows", Field::Count(count)));
                fields.push(("row_map", text("chi")));
            }
        }
        fields.extend([
            ("units", text(UNITS)),
            ("domain", Field::Text(self.domain())),
            ("solver", text(&self.solver.name)),
            ("tolerance", Field::Real(self.solver.tolerance)),
            ("max_error", Field::Real(self.measured.max_error)),
            ("measured_rays", Field::Count(self.measured.rays)),
            ("measured_r_min", Field::Real(self.measured.r_min)),
            ("measured_edge_gap", Field::Real(self.measured.edge_gap)),
        ]);
        fields
    }

    /// Description of the rays that a lookup can answer.
    fn domain(&self) -> String {
        let observers = match self.rows {
            Rows::Chi { .. } => "1 < r <= infinity".to_owned(),
            Rows::One {
                inverse_radius: 0.0,
            } => "r = infinity".to_owned(),
            Rows::One { inverse_radius } => format!("r = {}", 1.0 / inverse_radius),
        };
        match self.axis.b_range() {
            None => format!("{observers}, 0 <= x < 1; captured at x >= 1"),
            Some((b_min, b_max)) => {
                format!("{observers}, {b_min} <= b <= {b_max}; captured at b <= b_c")
            }
        }
    }

    /// The inverse of [`Header::fields`]; `get` finds a field by name.
    ///
    /// # Errors
    /// [`FieldError::Missing`] for the first field that is missing or of the wrong type, [`FieldError::Bad`] for
    /// an invalid value.
    #[cfg(feature = "files")]
    pub(crate) fn from_fields(get: impl Fn(&str) -> Option<Field>) -> Result<Self, FieldError> {
        let missing = |name: &str| FieldError::Missing(name.to_owned());
        let count = |name| match get(name) {
            Some(Field::Count(n)) => Ok(n),
            _ => Err(missing(name)),
        };
        let real = |name| match get(name) {
            Some(Field::Real(x)) => Ok(x),
            _ => Err(missing(name)),
        };
        let text = |name| match get(name) {
            Some(Field::Text(s)) => Ok(s),
            _ => Err(missing(name)),
        };
        let b_range = || Ok::<_, FieldError>((real("b_min")?, real("b_max")?));
        let axis = match text("axis")?.as_str() {
            "residual" => Axis::Residual,
            "b" => b_range().map(|(b_min, b_max)| Axis::UniformB { b_min, b_max })?,
            "inverse-b" => {
                b_range().map(|(b_min, b_max)| Axis::UniformInverseB { b_min, b_max })?
            }
            "log-b" => b_range().map(|(b_min, b_max)| Axis::UniformLogB { b_min, b_max })?,
            other => {
                let expected = "must be residual, b, inverse-b or log-b";
                return Err(FieldError::Bad(field(
                    "axis",
                    text::excerpt(other),
                    expected,
                )));
            }
        };
        let rows = match text("row_map")?.as_str() {
            "one" => Rows::One {
                inverse_radius: real("inverse_radius")?,
            },
            "chi" => Rows::Chi {
                count: count("rows")?,
            },
            other => {
                return Err(FieldError::Bad(field(
                    "row_map",
                    text::excerpt(other),
                    "must be one or chi",
                )));
            }
        };
        Ok(Header {
            axis,
            rows,
            texels: count("texels")?,
            solver: Solver {
                name: text("solver")?,
                tolerance: real("tolerance")?,
            },
            measured: Measured {
                max_error: real("max_error")?,
                rays: count("measured_rays")?,
                r_min: real("measured_r_min")?,
                edge_gap: real("measured_edge_gap")?,
            },
        })
    }
}

/// Why fields do not form a header.
#[cfg(feature = "files")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FieldError {
    /// A field is missing or of the wrong type.
    Missing(String),
    /// A field has an invalid value.
    Bad(TableError),
}

fn in_range(what: &'static str, found: u64, (min, max): (u64, u64)) -> Result<(), TableError> {
    if (min..=max).contains(&found) {
        Ok(())
    } else {
        Err(TableError::Size {
            what,
            found,
            min,
            max,
        })
    }
}

fn field(field: &str, found: impl ToString, expected: &'static str) -> TableError {
    TableError::Field {
        field: field.to_owned(),
        found: found.to_string(),
        expected,
    }
}
