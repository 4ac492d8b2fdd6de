//! Which images of cells may be in a picture, and how bright.

use super::image_bounds::Bounds;
use super::images::view_direction;
use super::kernel::REACHES;
use crate::camera::{Camera, ViewAngle};
use crate::shift::{Rendition, Shift};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::PI;

/// A circle of directions, as the observer of the row sees them, that contains an image of a cell.
pub(super) struct ImageCircle {
    middle: DVec3,
    /// rad.
    radius: f64,
}

impl ImageCircle {
    /// The circle around the image in the half-plane of `azimuth` of a cell of this angular `radius` (rad).
    pub(super) fn around(azimuth: DVec2, seen: &Bounds, radius: f64) -> Self {
        let along = 0.5 * (seen.farthest - seen.nearest);
        let middle = 0.5 * (seen.farthest + seen.nearest);
        let tangential = radius * seen.tangential_magnification.max(1.0);
        ImageCircle {
            middle: view_direction(azimuth, middle),
            radius: (along * along + tangential * tangential).sqrt(),
        }
    }
}

/// The view frustum of a picture, with a margin for the widest point-spread kernel.
pub(super) struct Frustum<'a> {
    camera: &'a Camera,
    /// Rotates directions of the sky frame into the hole frame.
    pub(super) hole_from_sky: DMat3,
    rendition: Rendition,
    /// Inward unit normals of its sides.
    sides: [DVec3; 4],
    margin: f64,
}

impl<'a> Frustum<'a> {
    pub(super) fn of(camera: &'a Camera, rendition: Rendition) -> Self {
        let half = |step: DVec3, side: u32| step * (0.5 * f64::from(side));
        let (right, down) = (
            half(camera.right, camera.width),
            half(camera.down, camera.height),
        );
        let forward = camera.forward;
        let side = |towards: DVec3| {
            // Normal to the plane through the camera and an edge of the picture.
            let edge = forward + towards;
            (forward * towards.length_squared() - towards * forward.dot(edge)).normalize()
        };
        Frustum {
            camera,
            hole_from_sky: camera.sky_from_hole.transpose(),
            rendition,
            sides: [side(right), side(-right), side(down), side(-down)],
            margin: REACHES[REACHES.len() - 1] * camera.right.length(),
        }
    }

    /// Whether neither motion nor shift change the light of images unequally.
    pub(super) fn is_even(&self) -> bool {
        self.camera.boost.is_none() && self.rendition.shift == Shift::Off
    }

    /// Upper bound on the factor by which aberration and frequency shift change the light of a star in the image.
    pub(super) fn largest_factor(&self, image: &ImageCircle) -> f64 {
        let (low, high) = self.camera.doppler_bounds(image.middle, image.radius);
        let by_aberration = 1.0 / (low * low);
        if self.rendition.shift == Shift::Off {
            return by_aberration;
        }
        let theta = ViewAngle::of(image.middle).radians();
        // The shift of an observer in radial motion is a monotonic function of the view angle.
        let shift = |theta: f64| {
            let g = self.camera.observer.frequency_shift(theta.clamp(0.0, PI));
            if g > 0.0 { g } else { f64::INFINITY }
        };
        let radial = shift(theta - image.radius).max(shift(theta + image.radius));
        self.rendition.largest_factor(high * radial) * by_aberration
    }

    /// Whether part of the image may be in the picture.
    pub(super) fn may_see(&self, image: &ImageCircle) -> bool {
        let (low, _) = self.camera.doppler_bounds(image.middle, image.radius);
        let (direction, _) = self.camera.boosted(image.middle);
        // For a direction that lies outside a side of the frustum, the dot product is minus the sine of its angular distance
        // from the side. The sine is at most the angle.
        let reach = image.radius / low + self.margin;
        self.sides.iter().all(|side| side.dot(direction) > -reach)
    }
}
