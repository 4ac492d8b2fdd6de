//! The images of a point of the sky: where the hole shows it, and how bright.

use crate::camera::Sight;
use crate::scene::{Method, Scene};
use glam::{DVec2, DVec3};
use lensbake_core::rk4::Stepper;
use lensbake_core::{CoreError, Observer, direct};
use lensbake_tables::InverseRow;
use lensbake_tables::inverse::Image;
use std::f64::consts::{PI, TAU};

/// An image whose light is less, in white pixels, is not drawn: not even in the middle of a pixel would
/// it lift black by half a step of 8 bits.
pub const FAINTEST: f32 = 1.0 / 1024.0;

/// The most light of an image or of a piece of an arc, in white pixels: two million of them, which is as many as
/// are drawn, on one pixel are no more than f32 holds. No star that a catalogue can hold, at any exposure that the
/// command line takes, comes near as a point; an arc does only if its star's disc is far smaller than any star's.
pub const BRIGHTEST: f32 = (1u128 << 104) as f32;

/// Further turns of the light about the hole that are looked at, on either side. Each is fainter than the
/// one before by about e^2π = 535.
pub const MAX_WINDINGS: u32 = 3;

/// The least distance from the axis, rad, at which a star is drawn as points: there the hole magnifies a
/// rounding of its direction to f32 to no more than a hundredth of a pixel.
const LEAST_POINT_DISTANCE: f64 = 4e-3;

/// Where images are: whoever turns the light, backwards.
#[derive(Debug, Clone, PartialEq)]
pub enum Lens {
    /// The hole bends the light: by the inverse of what the method makes of it.
    Bent(InverseRow),
    /// Nobody does: the black sphere before the undeflected sky.
    Flat(Observer),
}

/// One of a star's images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StarImage {
    /// Where it is seen: a unit vector in the hole frame.
    pub direction: DVec3,
    /// How many times brighter than without the hole.
    pub magnification: f64,
}

/// One of the ways that the light of a star at β from the direction of the hole takes to the observer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    /// +1: it is seen on its own side of the hole; −1: on the other.
    pub side: f64,
    /// Further turns about the hole.
    pub windings: u32,
}

impl Way {
    /// The ways in pairs, fewest turns first.
    pub fn all() -> impl Iterator<Item = [Way; 2]> {
        (0..=MAX_WINDINGS).map(|windings| [1.0, -1.0].map(|side| Way { side, windings }))
    }

    /// The unwrapped sky angle ϑ = ±β − 2πk.
    pub fn sky_angle(self, beta: f64) -> f64 {
        self.side * beta - TAU * f64::from(self.windings)
    }

    /// Whether it leads straight: the one way on which a star behind the observer is no ring.
    pub fn is_straight(self) -> bool {
        self.side > 0.0 && self.windings == 0
    }
}

/// The unit direction in the hole frame at `theta` from the hole, in the half-plane of `azimuth`.
pub fn view_direction(azimuth: DVec2, theta: f64) -> DVec3 {
    let (sin, cos) = theta.sin_cos();
    (azimuth * sin).extend(-cos)
}

/// The part of its light with which a star at `distance` (rad) from the axis through hole and camera is
/// drawn as an arc, 1 on the axis and 0 for nearly every star: the rest is drawn as points. Between 16 and
/// 32 radii of its disc both are the same to 5e-4.
pub fn arc_share(distance: f64, disc_radius: f64) -> f64 {
    let least = point_distance(disc_radius);
    let t = ((distance - least) / least).clamp(0.0, 1.0);
    1.0 - t * t * (3.0 - 2.0 * t)
}

/// The distance from the axis (rad) up to which a star is drawn as an arc alone; from twice it on, as
/// points alone.
pub fn point_distance(disc_radius: f64) -> f64 {
    LEAST_POINT_DISTANCE.max(16.0 * disc_radius)
}

impl Lens {
    /// The lens of `scene`'s camera, by its method.
    ///
    /// # Errors
    /// [`CoreError::FarHasNoAngle`] for an observer at infinity, which no camera is.
    pub fn of(scene: &Scene) -> Result<Self, CoreError> {
        let observer = scene.camera.observer;
        Ok(match scene.method {
            Method::Lut => Lens::Bent(InverseRow::new(&scene.row)?),
            Method::Direct { step } => Lens::Bent(InverseRow::of(observer, |at| {
                direct::bend_and_slope(&observer, at, Stepper::Fixed(step))
            })?),
            Method::Flat => Lens::Flat(observer),
        })
    }

    /// The images of the star in the unit direction `star` (hole frame), two for each number of further
    /// turns of the light. What is drawn as an arc ([`arc_share`]) is taken off.
    pub fn images(
        &self,
        star: DVec3,
        disc_radius: f64,
    ) -> impl Iterator<Item = [Option<StarImage>; 2]> {
        let sight = Sight::of(star);
        let beta = sight.angle();
        let azimuth = star.truncate().try_normalize().unwrap_or(DVec2::X);
        let points = 1.0 - arc_share(sight.sin, disc_radius);
        Way::all().map(move |pair| {
            pair.map(|way| {
                let share = match self {
                    Lens::Bent(_) if !(way.is_straight() && sight.cos < 0.0) => points,
                    _ => 1.0,
                };
                let sky_angle = way.sky_angle(beta);
                let image = (share > 0.0).then(|| self.image(sky_angle))??;
                Some(StarImage {
                    direction: view_direction(azimuth * way.side, image.theta),
                    magnification: share * self.magnification(image, sky_angle),
                })
            })
        })
    }

    /// Where the light from the unwrapped sky angle ϑ (rad) is seen.
    pub fn image(&self, sky_angle: f64) -> Option<Image> {
        match self {
            Lens::Bent(inverse) => Some(inverse.image(sky_angle)),
            Lens::Flat(observer) => {
                let beside = sky_angle > 0.5 * PI || sky_angle.sin() >= observer.inverse_radius();
                (sky_angle > 0.0 && beside).then_some(Image {
                    theta: sky_angle,
                    stretch: 1.0,
                })
            }
        }
    }

    fn magnification(&self, image: Image, sky_angle: f64) -> f64 {
        match self {
            Lens::Bent(_) => image.magnification(sky_angle),
            Lens::Flat(_) => 1.0,
        }
    }
}
