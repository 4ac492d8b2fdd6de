//! The images of a point of the sky: their view directions and magnifications.

use crate::camera::ViewAngle;
use crate::lens::{Deflection, Lens};
use glam::{DVec2, DVec3};
use lensbake_core::rk4::Stepper;
use lensbake_core::{Observer, direct};
use lensbake_tables::InverseRow;
use lensbake_tables::inverse::Image;
use std::f64::consts::{PI, TAU};

/// Images with less light than this, in units of a white pixel, are not drawn: even centred on a pixel, such an
/// image would raise black by less than two steps of an 8-bit sRGB channel.
pub const MIN_LIGHT: f32 = 1.0 / 1024.0;

/// Largest light of an image or of a piece of an arc, in units of a white pixel. Two million of them, the largest
/// number that is drawn, on one pixel add up to no more than f32 holds. As a point, no star that a catalogue can
/// hold comes near this limit, at any exposure that the command line accepts. An arc reaches it only if its star's
/// disc is far smaller than any star's.
pub const MAX_LIGHT: f32 = (1u128 << 104) as f32;

/// Largest number of windings (further full turns of the light around the hole), on either side of the hole. Each
/// winding makes the image fainter by a factor of about e^2π = 535.
pub const MAX_WINDINGS: u32 = 3;

/// Smallest distance from the optical axis, rad, at which a star is drawn as points: there the hole magnifies the
/// error of rounding its direction to f32 to at most a hundredth of a pixel.
const MIN_POINT_DISTANCE: f64 = 4e-3;

/// The inverse of the lens: maps sky angles to images.
#[derive(Debug, Clone, PartialEq)]
pub enum InverseLens {
    /// With bending: the inverse row of the deflection method.
    Bent(InverseRow),
    /// Without bending: a black sphere in front of the undeflected sky.
    Flat(Observer),
}

/// One of a star's images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StarImage {
    /// View direction: a unit vector in the hole frame.
    pub direction: DVec3,
    /// Its light divided by that of the star without lensing.
    pub magnification: f64,
}

/// Image order: which of the paths the light takes to the observer from a star at the angle β from the direction
/// of the hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageOrder {
    /// +1 if the image is on the star's side of the hole, −1 if it is on the opposite side.
    pub side: f64,
    /// Further full turns of the light around the hole.
    pub windings: u32,
}

impl ImageOrder {
    /// All image orders, fewest windings first, in pairs of the sides +1 and −1.
    pub fn all() -> impl Iterator<Item = [ImageOrder; 2]> {
        (0..=MAX_WINDINGS).map(|windings| [1.0, -1.0].map(|side| ImageOrder { side, windings }))
    }

    /// The image order of light with the unwrapped sky angle `sky_angle` (rad, at most π): the inverse of
    /// [`ImageOrder::sky_angle`].
    pub fn at(sky_angle: f64) -> Self {
        let half_windings = (1.0 - sky_angle / PI).max(0.0) as u32;
        ImageOrder {
            side: if half_windings.is_multiple_of(2) {
                1.0
            } else {
                -1.0
            },
            windings: half_windings / 2,
        }
    }

    /// How often the light crosses the axis through the camera and the hole on its way: 0 for the primary image, 1 for
    /// the secondary image on the other side of the hole, then one more for each further half turn. Images of odd
    /// orders are mirrored.
    pub fn half_windings(self) -> u32 {
        2 * self.windings + u32::from(self.side < 0.0)
    }

    /// The unwrapped sky angle ϑ = ±β − 2πk, rad, with k windings.
    pub fn sky_angle(self, beta: f64) -> f64 {
        self.side * beta - TAU * f64::from(self.windings)
    }

    /// Whether this is the primary image, on the direct path. It is the only image order in which a star behind
    /// the observer is not a ring.
    pub fn is_straight(self) -> bool {
        self.side > 0.0 && self.windings == 0
    }
}

/// Unit vector in the hole frame at the view angle `theta` (rad), in the half-plane of `azimuth`.
pub fn view_direction(azimuth: DVec2, theta: f64) -> DVec3 {
    let (sin, cos) = theta.sin_cos();
    (azimuth * sin).extend(-cos)
}

/// The fraction of the light of a star at `distance` (rad) from the optical axis that is drawn as arcs: 1 on the
/// axis and 0 for nearly every star. The rest is drawn as points. Between 16 and 32 radii of the star's disc, arcs
/// and points agree to 5e-4.
pub fn arc_share(distance: f64, disc_radius: f64) -> f64 {
    let least = point_distance(disc_radius);
    let t = ((distance - least) / least).clamp(0.0, 1.0);
    1.0 - t * t * (3.0 - 2.0 * t)
}

/// The distance from the optical axis, rad, up to which a star is drawn as arcs only. From twice this distance on
/// it is drawn as points only.
pub fn point_distance(disc_radius: f64) -> f64 {
    MIN_POINT_DISTANCE.max(16.0 * disc_radius)
}

impl InverseLens {
    /// The inverse of `lens`, by the same deflection method.
    ///
    /// # Panics
    /// Never: only an observer at infinity has no inverse row, and a camera is at a finite radius.
    pub fn of(lens: &Lens) -> Self {
        let observer = lens.camera.observer;
        let row = match lens.deflection {
            Deflection::Lut => InverseRow::new(&lens.row),
            Deflection::Direct { step } => InverseRow::of(observer, |at| {
                direct::bend_and_slope(&observer, at, Stepper::Fixed(step))
            }),
            Deflection::Flat => return InverseLens::Flat(observer),
        };
        InverseLens::Bent(row.expect("a camera is at a finite radius"))
    }

    /// The images of a star in the unit direction `star` (hole frame) in the pairs of [`ImageOrder::all`], without
    /// the fraction of its light that is drawn as arcs ([`arc_share`]). `None` where no light is left or there is
    /// no image.
    pub fn images(
        &self,
        star: DVec3,
        disc_radius: f64,
    ) -> impl Iterator<Item = [Option<StarImage>; 2]> {
        let view_angle = ViewAngle::of(star);
        let beta = view_angle.radians();
        let azimuth = star.truncate().try_normalize().unwrap_or(DVec2::X);
        let points = 1.0 - arc_share(view_angle.sin, disc_radius);
        ImageOrder::all().map(move |pair| {
            pair.map(|order| {
                let share = match self {
                    InverseLens::Bent(_) if !(order.is_straight() && view_angle.cos < 0.0) => {
                        points
                    }
                    _ => 1.0,
                };
                let sky_angle = order.sky_angle(beta);
                let image = (share > 0.0).then(|| self.image(sky_angle))??;
                Some(StarImage {
                    direction: view_direction(azimuth * order.side, image.theta),
                    magnification: share * self.magnification(image, sky_angle),
                })
            })
        })
    }

    /// The image of the unwrapped sky angle ϑ (rad). `None` only without bending: if the black sphere hides it or
    /// if ϑ ≤ 0.
    pub fn image(&self, sky_angle: f64) -> Option<Image> {
        match self {
            InverseLens::Bent(inverse) => Some(inverse.image(sky_angle)),
            InverseLens::Flat(observer) => {
                let beside = sky_angle > 0.5 * PI || sky_angle.sin() >= observer.inverse_radius();
                (sky_angle > 0.0 && beside).then_some(Image {
                    theta: sky_angle,
                    radial_magnification: 1.0,
                })
            }
        }
    }

    fn magnification(&self, image: Image, sky_angle: f64) -> f64 {
        match self {
            InverseLens::Bent(_) => image.magnification(sky_angle),
            InverseLens::Flat(_) => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_order_is_found_again_by_its_sky_angle() {
        let mut last = None;
        for (number, order) in ImageOrder::all().flatten().enumerate() {
            for beta in [1e-9, 0.3, 1.6, PI - 1e-9] {
                assert_eq!(ImageOrder::at(order.sky_angle(beta)), order, "{beta}");
            }
            assert_eq!(order.half_windings() as usize, number);
            last = Some(order.half_windings());
        }
        assert_eq!(last, Some(2 * MAX_WINDINGS + 1));
        // Straight away from the hole, where rounding can exceed π.
        assert!(ImageOrder::at(PI + 1e-12).is_straight());
    }
}
