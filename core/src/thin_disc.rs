//! A thin disc around the hole: its radii, and where its axis points.

use crate::accretion::INNERMOST_STABLE;
use thiserror::Error;

/// Largest outer radius of a disc, units of r_s.
pub const MAX_OUTER: f64 = 1e6;

/// An infinitely thin disc in a plane through the hole. Its matter is on circular orbits, counter-clockwise as seen from
/// its axis.
///
/// Vectors are in the frame of an observer who looks at the hole: X to the right, Y up, Z from the hole to the observer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinDisc {
    inner: f64,
    outer: f64,
    axis: [f64; 3],
}

/// What is wrong with a disc.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ThinDiscError {
    /// The inner radius is inside the innermost stable orbit.
    #[error(
        "the inner radius {0} is below {INNERMOST_STABLE}, where the innermost stable circular orbit is"
    )]
    Inner(f64),
    /// The outer radius is not beyond the inner one, or too large.
    #[error(
        "the outer radius {outer} is not above the inner radius {inner} and at most {MAX_OUTER:e}"
    )]
    Outer {
        /// The given inner radius.
        inner: f64,
        /// The given outer radius.
        outer: f64,
    },
    /// An angle is not finite.
    #[error("{what} {degrees} is not an angle in degrees")]
    Angle {
        /// Name of the angle.
        what: &'static str,
        /// The given value, degrees.
        degrees: f64,
    },
}

impl ThinDisc {
    /// The disc from radius `inner` to `outer` (units of r_s), whose axis is at the angle `inclination_deg` from the line
    /// from the hole to the observer: 0 shows the disc face-on, 90 edge-on. The line of nodes, about which it is
    /// inclined, is at the angle `node_deg` from the X axis, counter-clockwise as the observer sees it. At 0 the near side
    /// of a disc of inclination 80 is below the hole, and moves to the right.
    ///
    /// # Errors
    /// [`ThinDiscError`] names what is out of range.
    pub fn new(
        inner: f64,
        outer: f64,
        inclination_deg: f64,
        node_deg: f64,
    ) -> Result<Self, ThinDiscError> {
        check_radii(inner, outer)?;
        check_angles(inclination_deg, node_deg)?;
        Ok(ThinDisc {
            inner,
            outer,
            axis: axis(inclination_deg, node_deg),
        })
    }

    /// Inner radius, units of r_s.
    pub fn inner(&self) -> f64 {
        self.inner
    }

    /// Outer radius, units of r_s.
    pub fn outer(&self) -> f64 {
        self.outer
    }

    /// The unit vector of the axis.
    pub fn axis(&self) -> [f64; 3] {
        self.axis
    }
}

/// Checks the radii of a disc: `inner` is at least [`INNERMOST_STABLE`], `outer` is above it and at most [`MAX_OUTER`].
///
/// # Errors
/// [`ThinDiscError::Inner`] or [`ThinDiscError::Outer`].
pub fn check_radii(inner: f64, outer: f64) -> Result<(), ThinDiscError> {
    if inner.is_nan() || inner < INNERMOST_STABLE {
        return Err(ThinDiscError::Inner(inner));
    }
    if outer.is_nan() || outer <= inner || outer > MAX_OUTER {
        return Err(ThinDiscError::Outer { inner, outer });
    }
    Ok(())
}

/// Checks the angles of a disc, degrees: they are finite.
///
/// # Errors
/// [`ThinDiscError::Angle`].
pub fn check_angles(inclination_deg: f64, node_deg: f64) -> Result<(), ThinDiscError> {
    for (what, degrees) in [("inclination", inclination_deg), ("node", node_deg)] {
        if !degrees.is_finite() {
            return Err(ThinDiscError::Angle { what, degrees });
        }
    }
    Ok(())
}

/// The unit vector of the axis of a disc in the frame of [`ThinDisc`], by its angles as [`ThinDisc::new`] takes them,
/// degrees. Exact at multiples of 90°; NaN unless both angles are finite.
pub fn axis(inclination_deg: f64, node_deg: f64) -> [f64; 3] {
    let (sin, cos) = exact_sin_cos(inclination_deg);
    let (sin_node, cos_node) = exact_sin_cos(node_deg);
    [-sin * sin_node, sin * cos_node, cos]
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90°: a disc seen edge-on is.
fn exact_sin_cos(degrees: f64) -> (f64, f64) {
    let quarters = (degrees / 90.0).round();
    let (sin, cos) = (degrees - 90.0 * quarters).to_radians().sin_cos();
    match quarters.rem_euclid(4.0) {
        0.0 => (sin, cos),
        1.0 => (cos, -sin),
        2.0 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_is_inclined_about_the_line_of_nodes() {
        assert_eq!(axis(0.0, 0.0), [0.0, 0.0, 1.0]);
        assert_eq!(axis(90.0, 0.0), [0.0, 1.0, 0.0]);
        assert_eq!(axis(90.0, 90.0), [-1.0, 0.0, 0.0]);
        assert_eq!(axis(180.0, 0.0), [0.0, 0.0, -1.0]);
        assert_eq!(axis(-90.0, 0.0), axis(270.0, 360.0));
        let [x, y, z] = axis(60.0, 20.0);
        assert!((z - 0.5).abs() < 1e-15 && (x.hypot(y).hypot(z) - 1.0).abs() < 1e-15);
        let (sin, cos) = 20f64.to_radians().sin_cos();
        assert!((x * cos + y * sin).abs() < 1e-15, "the node is in the disc");
    }

    #[test]
    fn what_is_no_disc_is_named() {
        let message = |inner, outer, inclination, node| {
            ThinDisc::new(inner, outer, inclination, node)
                .unwrap_err()
                .to_string()
        };
        let (inf, nan) = (f64::INFINITY, f64::NAN);
        for (problem, found) in [
            (message(2.999, 12.0, 80.0, 0.0), "inner radius 2.999"),
            (message(nan, 12.0, 80.0, 0.0), "inner radius NaN"),
            (message(5.0, 5.0, 80.0, 0.0), "outer radius 5"),
            (message(12.0, 3.0, 80.0, 0.0), "outer radius 3"),
            (message(3.0, nan, 80.0, 0.0), "outer radius NaN"),
            (message(3.0, inf, 80.0, 0.0), "outer radius inf"),
            (message(3.0, 12.0, inf, 0.0), "inclination inf"),
            (message(3.0, 12.0, 80.0, nan), "node NaN"),
        ] {
            assert!(problem.contains(found), "{problem}");
        }
        assert!(ThinDisc::new(3.0, MAX_OUTER, 1e300, -1e300).is_ok());
    }
}
