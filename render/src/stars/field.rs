//! Stars ready to be drawn: directions and light.

use super::{Catalogue, direction, light_of_colour_index};
use glam::{DVec3, Vec3};

/// Light of a star of magnitude 0 at exposure 0, in units of a white pixel. A star of magnitude 5 then has the
/// light of one white pixel.
pub const LIGHT_AT_MAGNITUDE_0: f64 = 100.0;

/// A star to be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointStar {
    /// Unit vector towards the star, sky frame.
    pub direction: DVec3,
    /// Its light without lensing, summed over all pixels of a picture, linear RGB.
    pub light: Vec3,
}

/// Stars to be drawn, the brightest first.
#[derive(Debug, Clone, PartialEq)]
pub struct StarField {
    /// The stars.
    pub stars: Vec<PointStar>,
    /// Angular radius of each star, rad.
    pub disc_radius: f64,
}

impl StarField {
    /// The stars of `catalogue` at an exposure of `stops`; each stop doubles the light.
    pub fn new(catalogue: &Catalogue, stops: f64) -> Self {
        let exposed = LIGHT_AT_MAGNITUDE_0 * stops.exp2();
        let stars = catalogue.stars().iter().map(|star| PointStar {
            direction: direction(star.right_ascension, star.declination),
            light: (exposed * 10f64.powf(-0.4 * star.magnitude)) as f32
                * light_of_colour_index(star.colour_index),
        });
        StarField {
            stars: stars.collect(),
            disc_radius: catalogue.disc_radius(),
        }
    }
}
