//! Star catalogues.

use super::StarsProblem;
use glam::DVec3;

/// A star of a catalogue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Star {
    /// Right ascension, J2000, rad.
    pub right_ascension: f64,
    /// Declination, J2000, rad.
    pub declination: f64,
    /// Magnitude.
    pub magnitude: f64,
    /// Colour index B − V, mag; `None` if unknown.
    pub colour_index: Option<f64>,
}

/// Angular radius of a star if its catalogue states none, rad: that of Sirius (3 mas). It limits the magnification
/// of a star on the optical axis. The radii of the naked-eye stars lie between 1e-9 and 1e-7 rad.
pub const DEFAULT_DISC_RADIUS: f64 = 1.5e-8;

/// Largest angular radius of a star, rad: about a pixel, because an arc is drawn with the width of a point.
pub const MAX_DISC_RADIUS: f64 = 1e-3;

/// Largest number of stars in a catalogue.
pub const MAX_STARS: usize = 2_000_000;

/// Stars, the brightest first, all with the same angular radius.
#[derive(Debug, Clone, PartialEq)]
pub struct Catalogue {
    stars: Vec<Star>,
    disc_radius: f64,
}

impl Catalogue {
    /// The catalogue of `stars`, each a disc of angular radius `disc_radius` (rad).
    ///
    /// # Errors
    /// [`StarsProblem`] if there is no star, if there are more than [`MAX_STARS`], or unless the radius is above 0
    /// and at most [`MAX_DISC_RADIUS`].
    pub fn new(mut stars: Vec<Star>, disc_radius: f64) -> Result<Self, StarsProblem> {
        if stars.is_empty() {
            return Err(StarsProblem::Empty);
        }
        if stars.len() > MAX_STARS {
            return Err(StarsProblem::TooMany { max: MAX_STARS });
        }
        if !(disc_radius > 0.0 && disc_radius <= MAX_DISC_RADIUS) {
            return Err(StarsProblem::DiscRadius(disc_radius));
        }
        stars.sort_by(|a, b| a.magnitude.total_cmp(&b.magnitude));
        Ok(Catalogue { stars, disc_radius })
    }

    /// The stars, the brightest first.
    pub fn stars(&self) -> &[Star] {
        &self.stars
    }

    /// Angular radius of each star, rad.
    pub fn disc_radius(&self) -> f64 {
        self.disc_radius
    }
}

/// Unit vector in the sky frame towards a right ascension and declination (rad).
pub fn direction(right_ascension: f64, declination: f64) -> DVec3 {
    let (sin_ra, cos_ra) = right_ascension.sin_cos();
    let (sin_dec, cos_dec) = declination.sin_cos();
    DVec3::new(-cos_dec * sin_ra, sin_dec, -cos_dec * cos_ra)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn right_ascension_grows_to_the_left_and_north_is_up() {
        assert!((direction(0.0, 0.0) - DVec3::NEG_Z).length() < 1e-15);
        assert!((direction(FRAC_PI_2, 0.0) - DVec3::NEG_X).length() < 1e-15);
        assert!((direction(1.0, FRAC_PI_2) - DVec3::Y).length() < 1e-15);
    }

    #[test]
    fn the_brightest_star_comes_first() {
        let star = |magnitude| Star {
            right_ascension: 0.0,
            declination: 0.0,
            magnitude,
            colour_index: None,
        };
        let stars = [3.0, -1.0, 2.0].map(star).to_vec();
        let sorted = Catalogue::new(stars, DEFAULT_DISC_RADIUS).unwrap();
        let magnitudes: Vec<f64> = sorted.stars().iter().map(|s| s.magnitude).collect();
        assert_eq!(magnitudes, [-1.0, 2.0, 3.0]);
        assert!(matches!(
            Catalogue::new(Vec::new(), 1e-8),
            Err(StarsProblem::Empty)
        ));
        for radius in [0.0, -1.0, 0.1, f64::NAN] {
            let refused = Catalogue::new(vec![star(0.0)], radius);
            assert!(matches!(refused, Err(StarsProblem::DiscRadius(_))));
        }
    }
}
