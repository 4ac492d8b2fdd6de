//! The header of a table: its axis and rows, how it was computed, and its measured error.

#[cfg(feature = "files")]
use crate::text;
use crate::{Axis, Rows, TableError};
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
    /// The error measured after baking, above the horizon if there are rows on both sides of it.
    pub measured: Measured,
    /// The error measured below the horizon, if there are rows on both sides of it.
    pub measured_below: Option<Measured>,
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

/// Smallest radius of a row. Rows below 0.01 are valid, but have larger errors than those above it.
const R_MIN: f64 = 1e-3;

const UNITS: &str = "r_s = 1 (2GM = 1), c = 1; angles and texels in radians";

/// Checks that a row may have this number of texels.
pub(crate) fn check_texels(texels: u32) -> Result<(), TableError> {
    in_range("the number of texels in a row", texels.into(), TEXELS)
}

impl Header {
    /// Number of rows.
    pub fn row_count(&self) -> u32 {
        self.rows.count()
    }

    /// Number of rows above the horizon.
    pub fn rows_above(&self) -> u32 {
        match self.rows {
            Rows::ThroughHorizon { above, .. } => above,
            _ => self.row_count(),
        }
    }

    /// Smallest radius at which the table has a row.
    pub fn r_min(&self) -> f64 {
        match self.rows {
            Rows::One { inverse_radius } => 1.0 / inverse_radius,
            Rows::Chi { .. } => 1.0,
            Rows::ThroughHorizon { r_min, .. } => r_min,
        }
    }

    /// Number of texels in all: texels per row × rows.
    pub fn texel_count(&self) -> u64 {
        u64::from(self.texels) * u64::from(self.row_count())
    }

    /// The observer of row `index`.
    pub fn observer(&self, index: u32) -> Observer {
        let part = |index: u32, count: u32| f64::from(index) / f64::from(count - 1);
        let at_rest = |part: f64| Observer::at_chi(part * std::f64::consts::FRAC_PI_2);
        match self.rows {
            Rows::Chi { count } => at_rest(part(index, count)),
            Rows::ThroughHorizon { above, .. } if index < above => at_rest(part(index, above)),
            Rows::ThroughHorizon {
                above,
                below,
                r_min,
            } => row_frame(r_min.powf(part(index - above, below))),
            Rows::One { inverse_radius } => row_frame(1.0 / inverse_radius),
        }
    }

    /// The axis of row `index`. The limit at the horizon of the rows above it is on their axis.
    pub fn axis_of_row(&self, index: u32) -> Axis {
        match self.rows {
            Rows::One { .. } => self.axis.of(&self.observer(index)),
            _ if index < self.rows_above() => self.axis,
            _ => self.axis.of(&self.observer(index)),
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
            Rows::ThroughHorizon {
                above,
                below,
                r_min,
            } => {
                in_range("the number of rows above the horizon", above.into(), ROWS)?;
                in_range("the number of rows below the horizon", below.into(), ROWS)?;
                if !(R_MIN..1.0).contains(&r_min) {
                    return Err(field("r_min", r_min, "must be from 0.001 to below 1"));
                }
            }
            Rows::One { inverse_radius } => {
                if !(0.0..=1.0 / R_MIN).contains(&inverse_radius) {
                    return Err(field(
                        "inverse_radius",
                        inverse_radius,
                        "must be from 0 to 1000",
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
        if self.axis == Axis::ResidualBelow {
            return Err(field("axis", 4, "must be from 0 to 3"));
        }
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
            Rows::ThroughHorizon {
                above,
                below,
                r_min,
            } => {
                fields.push(("rows", Field::Count(above.saturating_add(below))));
                fields.push(("row_map", text("chi+ln-u")));
                fields.push(("rows_below", Field::Count(below)));
                fields.push(("r_min", Field::Real(r_min)));
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
        if let Some(below) = self.measured_below {
            fields.extend([
                ("below_max_error", Field::Real(below.max_error)),
                ("below_measured_rays", Field::Count(below.rays)),
                ("below_measured_r_min", Field::Real(below.r_min)),
                ("below_measured_edge_gap", Field::Real(below.edge_gap)),
            ]);
        }
        fields
    }

    /// Description of the rays that a lookup can answer.
    fn domain(&self) -> String {
        let observers = match self.rows {
            Rows::Chi { .. } => "1 < r <= infinity".to_owned(),
            Rows::ThroughHorizon { r_min, .. } => format!("{r_min} <= r <= infinity"),
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
            "chi+ln-u" => {
                let below = count("rows_below")?;
                Rows::ThroughHorizon {
                    above: count("rows")?.saturating_sub(below),
                    below,
                    r_min: real("r_min")?,
                }
            }
            other => {
                return Err(FieldError::Bad(field(
                    "row_map",
                    text::excerpt(other),
                    "must be one, chi or chi+ln-u",
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
            measured_below: match get("below_max_error") {
                None => None,
                Some(_) => Some(Measured {
                    max_error: real("below_max_error")?,
                    rays: count("below_measured_rays")?,
                    r_min: real("below_measured_r_min")?,
                    edge_gap: real("below_measured_edge_gap")?,
                }),
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

/// The observer at radius `r` that a row is for; `r = ∞` is the observer at infinity. The radius has been checked.
fn row_frame(r: f64) -> Observer {
    Observer::falling(r).map_or_else(
        |_| Observer::at_infinity(),
        |observer| observer.in_row_frame(),
    )
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
