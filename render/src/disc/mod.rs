//! A thin disc of matter on circular orbits around the hole.
//!
//! The disc lies in a plane through the hole, is infinitely thin, and has the same light on both faces: that of Page
//! and Thorne's disc around a hole without spin ([`lensbake_core::accretion`]), whose matter is on circular orbits. A ray
//! meets it at most twice: once on its way towards the hole, and once on its way out to the sky (module `leg`). That
//! holds for every image order, since no ray turns by half a turn outside the innermost stable orbit, r = 3.

pub(crate) mod coverage;
mod leg;
mod light;
mod pattern;
mod rim;
mod seen;

pub use pattern::{angular_velocity, period};
pub(crate) use rim::COEFFICIENTS;
pub use rim::Rim;
pub use seen::{Hit, SeenDisc};

use crate::shift::Shift;
use glam::{DMat3, DVec3};
use lensbake_core::accretion::INNERMOST_STABLE;
use lensbake_core::thin_disc::{self, ThinDiscError};
use std::ops::RangeInclusive;
use thiserror::Error;

pub use lensbake_core::thin_disc::MAX_OUTER;

/// A disc as a user gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Inner radius in units of r_s, at least 3: the innermost stable circular orbit.
    pub inner: f64,
    /// Outer radius in units of r_s.
    pub outer: f64,
    /// Where its axis points.
    pub orientation: Orientation,
    /// The share of the light behind it that each crossing takes away, 0 to 1. What it emits is multiplied by it, too.
    pub opacity: f64,
    /// Temperature where it is hottest, at r = 4.78, kelvins.
    pub peak_kelvin: f64,
    /// Luminance where it is hottest, without frequency shift: 1 is white.
    pub brightness: f64,
    /// What of its frequency shift is shown, which does not depend on that of the sky.
    pub shift: Shift,
    /// Contrast of a pattern of clouds that turns with its matter, 0 to 1: the light is from 1 − `pattern` to 1 + `pattern`
    /// times what it is without one, and as much in the mean.
    pub pattern: f64,
    /// The time of the pattern, r_s/c: coordinate time, that of an observer at rest at infinity. The time that the light
    /// takes to the camera is left out.
    pub time: f64,
}

/// The direction of a disc's axis in the sky frame, by the angles in which a camera sees it that looks at the hole. Its
/// matter moves counter-clockwise as seen from the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orientation {
    /// Angle of the axis from the line of sight, degrees: 0 shows the disc face-on, 90 edge-on.
    pub inclination_deg: f64,
    /// Angle of the line of nodes, about which the disc is inclined, from the horizontal in the picture, degrees: at 0
    /// the near side is below the hole and comes to the right. Counter-clockwise.
    pub node_deg: f64,
    /// Longitude and latitude around the hole from which the camera looks, degrees.
    pub seen_from_deg: [f64; 2],
}

impl Default for Disc {
    /// From the innermost stable orbit to r = 12, inclined by 80°, opaque.
    fn default() -> Self {
        Disc {
            inner: INNERMOST_STABLE,
            outer: 12.0,
            orientation: Orientation {
                inclination_deg: 80.0,
                node_deg: 0.0,
                seen_from_deg: [0.0; 2],
            },
            opacity: 1.0,
            peak_kelvin: 5000.0,
            brightness: 1.0,
            shift: Shift::Colour,
            pattern: 0.0,
            time: 0.0,
        }
    }
}

impl Orientation {
    /// The unit vector of the axis in the sky frame.
    pub fn axis(&self) -> DVec3 {
        let seen = thin_disc::axis(self.inclination_deg, self.node_deg);
        self.sky_from_seen() * DVec3::from_array(seen)
    }

    /// The unit vector along the line of nodes in the sky frame, to the right for a node of 0: the azimuth 0 of the disc.
    pub fn node(&self) -> DVec3 {
        let (sin, cos) = self.node_deg.to_radians().sin_cos();
        self.sky_from_seen() * DVec3::new(cos, sin, 0.0)
    }

    fn sky_from_seen(&self) -> DMat3 {
        let [orbit, latitude] = self.seen_from_deg.map(f64::to_radians);
        DMat3::from_rotation_y(orbit) * DMat3::from_rotation_x(-latitude)
    }
}

/// What is wrong with a disc.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum DiscError {
    /// Its radii or its angles.
    #[error(transparent)]
    Place(#[from] ThinDiscError),
    /// A number is out of range.
    #[error("{what} {value} is not from {least} to {most}")]
    OutOfRange {
        /// Name of the number.
        what: &'static str,
        /// The given value.
        value: f64,
        /// Least valid value.
        least: f64,
        /// Greatest valid value.
        most: f64,
    },
}

impl Disc {
    /// Valid opacities.
    pub const OPACITIES: RangeInclusive<f64> = 0.0..=1.0;
    /// Valid peak temperatures, kelvins: those of the colour model.
    pub const KELVINS: RangeInclusive<f64> = crate::shift::KELVINS;
    /// Valid brightnesses.
    pub const BRIGHTNESSES: RangeInclusive<f64> = 0.0..=1e4;
    /// Valid contrasts of the pattern.
    pub const PATTERNS: RangeInclusive<f64> = 0.0..=1.0;
    /// Valid times of the pattern, r_s/c.
    pub const TIMES: RangeInclusive<f64> = -1e9..=1e9;

    /// Checks all values.
    ///
    /// # Errors
    /// [`DiscError`] names the first that is out of range.
    pub fn check(&self) -> Result<(), DiscError> {
        let Orientation {
            inclination_deg,
            node_deg,
            ..
        } = self.orientation;
        thin_disc::check_radii(self.inner, self.outer)?;
        thin_disc::check_angles(inclination_deg, node_deg)?;
        for (what, value, range) in [
            ("opacity", self.opacity, Self::OPACITIES),
            ("temperature", self.peak_kelvin, Self::KELVINS),
            ("brightness", self.brightness, Self::BRIGHTNESSES),
            ("pattern", self.pattern, Self::PATTERNS),
            ("time", self.time, Self::TIMES),
        ] {
            if !range.contains(&value) {
                let (least, most) = range.into_inner();
                return Err(DiscError::OutOfRange {
                    what,
                    value,
                    least,
                    most,
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_is_inclined_to_the_line_of_sight() {
        let axis = |inclination_deg, node_deg, seen_from_deg| {
            Orientation {
                inclination_deg,
                node_deg,
                seen_from_deg,
            }
            .axis()
        };
        assert_eq!(axis(0.0, 0.0, [0.0; 2]), DVec3::Z);
        assert_eq!(axis(90.0, 0.0, [0.0; 2]), DVec3::Y);
        assert_eq!(axis(90.0, 90.0, [0.0; 2]), DVec3::NEG_X);
        // From longitude 90° the line of sight is the X axis.
        assert!((axis(0.0, 17.0, [90.0, 0.0]) - DVec3::X).length() < 1e-15);
        let seen = axis(60.0, 20.0, [0.0; 2]);
        assert!((seen.z - 0.5).abs() < 1e-15 && (seen.length() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn bad_values_are_named() {
        let message = |change: fn(&mut Disc)| {
            let mut disc = Disc::default();
            change(&mut disc);
            disc.check().map_err(|problem| problem.to_string())
        };
        assert_eq!(message(|_| ()), Ok(()));
        for (change, found) in [
            ((|d| d.inner = 1.4) as fn(&mut Disc), "inner radius 1.4"),
            (|d| d.inner = f64::NAN, "inner radius NaN"),
            (|d| d.outer = 3.0, "outer radius 3"),
            (|d| d.outer = f64::INFINITY, "outer radius inf"),
            (|d| d.orientation.node_deg = f64::NAN, "node NaN"),
            (|d| d.opacity = -0.1, "opacity -0.1"),
            (|d| d.peak_kelvin = -5000.0, "temperature -5000"),
            (|d| d.brightness = f64::NAN, "brightness NaN"),
            (|d| d.pattern = 1.5, "pattern 1.5"),
            (|d| d.time = f64::INFINITY, "time inf"),
        ] {
            let problem = message(change).unwrap_err();
            assert!(problem.contains(found), "{problem}");
        }
    }
}
