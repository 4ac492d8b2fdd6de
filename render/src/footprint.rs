//! The footprint, which is the patch of sky that a patch of the picture covers, and the anisotropic filter that
//! averages over it. Reference of `shaders/patch.wgsl` and `shaders/footprint.wgsl`.
//!
//! A step to the right or down in the picture changes the view direction by a radial part, away from the hole, and
//! a tangential part, around it. The lens multiplies the radial part by dθ′/dθ = 1 − dΔ/dθ, which the slope of the
//! table's row gives, and the tangential part by sin θ′/sin θ; these are the inverses of the radial and tangential
//! magnification. So one ray gives both steps on the sky (its ray differentials), without neighbouring rays.
//!
//! **The filter** is anisotropic. The mip level fits the short axis of the footprint, and trilinear taps are
//! spread along the long axis; where the largest number of taps does not reach, the level is raised. Sizes follow
//! from second moments: a pixel W texels wide, sampled bilinearly, has the variance W²/12 + 1/6 texels², and a
//! bilinear tap at level L, whose texels are means of 4^L texels, has 4^L/4. These are equal for 4^L = (W² + 2)/3.
//! The taps supply the rest of the long axis's variance: that of a row of length E with E² = W² + 2 − 3·4^L.

use crate::camera::{Camera, ViewAngle};
use crate::lens::Deflected;
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::TAU;

/// Largest distance between neighbouring taps, in texels of their mip level.
pub(crate) const SPACING: f64 = 1.5;
/// A footprint of less than this squared length, in texels, takes one bilinear tap: the sky is magnified there, as
/// in most of a picture.
pub(crate) const ONE_TAP_SQ: f64 = 2.5;
/// If the short axis of a footprint is at most 1 texel, a long axis of up to this many texels takes one tap: it needs no more
/// than a row of [`SPACING`] texels, E² = W² − 1.
pub(crate) const ONE_TAP_LONG: f64 = 1.8;

/// A patch of the picture: a view direction and its steps across the patch, in the hole frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// The unit view direction of its centre.
    pub direction: DVec3,
    /// The view angle of its centre.
    pub view_angle: ViewAngle,
    /// The radial unit vector, along which θ grows.
    pub radial: DVec3,
    /// The tangential unit vector, around the hole.
    pub tangential: DVec3,
    /// The step across the patch to the right, rad: its parts along `radial` and `tangential`.
    pub right: DVec2,
    /// The step across the patch downwards, as `right`.
    pub down: DVec2,
}

/// A patch of the sky: a direction and its steps across the patch, in any frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footprint {
    /// The unit direction of its centre.
    pub direction: DVec3,
    /// The step across the patch to the right, rad.
    pub right: DVec3,
    /// The step across the patch downwards, rad.
    pub down: DVec3,
}

/// Evenly spaced filter taps on an arc of a great circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taps {
    /// Mip level of all taps.
    pub level: f64,
    /// Number of taps.
    pub count: u32,
    /// Unit tangent of the arc at its middle.
    pub along: DVec3,
    /// Angle between neighbouring taps, rad.
    pub step: f64,
}

impl Patch {
    /// The patch around `ray` with the sides `right` and `down`. None of the three needs to be normalised.
    pub fn new(ray: DVec3, right: DVec3, down: DVec3) -> Self {
        let inverse_length = ray.length_recip();
        let direction = ray * inverse_length;
        let view_angle = ViewAngle::of(direction);
        let radius = if view_angle.sin > 0.0 {
            direction.truncate() * view_angle.sin.recip()
        } else {
            DVec2::X
        };
        let radial = (radius * view_angle.cos).extend(view_angle.sin);
        let tangential = radius.perp().extend(0.0);
        let steps =
            |step: DVec3| DVec2::new(step.dot(radial), step.dot(tangential)) * inverse_length;
        Patch {
            direction,
            view_angle,
            radial,
            tangential,
            right: steps(right),
            down: steps(down),
        }
    }

    /// The patch of the picture of `camera` with sides of `side` pixels around `at`, in pixels from the centre of the
    /// picture, as [`Camera::observer`] sees it.
    pub fn seen_by(camera: &Camera, at: DVec2, side: f64) -> Self {
        let ray = camera.view_ray(at);
        let Some(boost) = camera.boost else {
            return Patch::new(ray.direction, ray.right * side, ray.down * side);
        };
        let length = ray.direction.length();
        let direction = ray.direction / length;
        let step = |step: DVec3| {
            let across = (step - direction * step.dot(direction)) * (side / length);
            DVec3::from(boost.unboosted_step(direction.to_array(), across.to_array()))
        };
        let (row_direction, _) = camera.unboosted(direction);
        Patch::new(row_direction, step(ray.right), step(ray.down))
    }

    /// |dθ| across the patch along the gradient of θ, rad.
    pub fn gradient(&self) -> f64 {
        DVec2::new(self.right.x, self.down.x).length()
    }

    /// Whether the sky is magnified, so that the footprint takes one bilinear tap of a cube map of `face_texels`
    /// ([`Footprint::taps`]), which has `on_sky`, the direction after deflection, in its own frame.
    pub fn is_magnified(&self, deflected: Deflected, on_sky: DVec3, face_texels: f64) -> bool {
        let stretch = |deflected: Deflected| match self.view_angle.sin > 0.0 {
            true => deflected.sky.sin / self.view_angle.sin,
            false => deflected.radial,
        };
        let (radial, tangential) = (deflected.radial, stretch(deflected));
        let square = |along: f64, a: f64, b: f64| along * along * (a * a + b * b);
        let size_sq = square(radial, self.right.x, self.down.x)
            + square(tangential, self.right.y, self.down.y);
        takes_one_tap(on_sky, size_sq, face_texels)
    }

    /// The unit direction on the sky after deflection.
    pub fn on_sky(&self, deflected: Deflected) -> DVec3 {
        self.view_angle.turn(self.direction, deflected.sky)
    }

    /// The patch moved by `angle` rad away from the hole, its radial length multiplied by `extent`.
    pub fn moved(&self, angle: f64, extent: f64) -> Self {
        let steps = |of: DVec2| self.radial * (of.x * extent) + self.tangential * of.y;
        let ray = self.direction + self.radial * angle;
        Patch::new(ray, steps(self.right), steps(self.down))
    }

    /// The footprint: the patch of sky that it covers after deflection.
    pub fn footprint(&self, deflected: Deflected) -> Footprint {
        let sky = deflected.sky;
        let radius = self.tangential.truncate().perp() * -1.0;
        let radial = (radius * sky.cos).extend(sky.sin) * deflected.radial;
        // On the axis, where sin θ is 0, both derivatives are equal.
        let tangential = if self.view_angle.sin > 0.0 {
            self.tangential * (sky.sin / self.view_angle.sin)
        } else {
            self.tangential * deflected.radial
        };
        Footprint {
            direction: self.on_sky(deflected),
            right: radial * self.right.x + tangential * self.right.y,
            down: radial * self.down.x + tangential * self.down.y,
        }
    }
}

impl Footprint {
    /// The footprint rotated by `to`.
    pub fn in_frame(&self, to: &DMat3) -> Self {
        Footprint {
            direction: *to * self.direction,
            right: *to * self.right,
            down: *to * self.down,
        }
    }

    /// At most `most` taps that average a cube map of `face_texels` over the footprint, which must be in the
    /// cube's frame.
    pub fn taps(&self, face_texels: f64, most: u32) -> Taps {
        let one = Taps {
            level: 0.0,
            count: 1,
            along: DVec3::ZERO,
            step: 0.0,
        };
        let size_sq = self.right.length_squared() + self.down.length_squared();
        if takes_one_tap(self.direction, size_sq, face_texels) {
            return one;
        }
        let on_face = OnFace::new(self.direction, face_texels);
        let (right, down) = (on_face.texels(self.right), on_face.texels(self.down));
        // The squared axes of the ellipse are the eigenvalues of the Gram matrix of the two steps.
        let (rr, dd, rd) = (
            right.length_squared(),
            down.length_squared(),
            right.dot(down),
        );
        let (mean, half) = (0.5 * (rr + dd), 0.5 * (rr - dd));
        let root = half.hypot(rd);
        let mut long_sq = mean + root;
        let short_sq = ((rr * dd - rd * rd) / long_sq).max(0.0);
        let axis = if half >= 0.0 {
            DVec2::new(half + root, rd)
        } else {
            DVec2::new(rd, root - half)
        };
        let axis = axis.try_normalize().unwrap_or(DVec2::X);
        let arc = self.right * axis.x + self.down * axis.y;
        // Clamp the arc to 2π.
        let round = (TAU / arc.length()).min(1.0);
        let angle = arc.length() * round;
        long_sq *= round * round;

        let reach = SPACING * f64::from(most);
        let texels_sq = ((short_sq + 2.0) / 3.0)
            .max(long_sq / (reach * reach))
            .clamp(1.0, face_texels * face_texels);
        let length = (long_sq + 2.0 - 3.0 * texels_sq).max(0.0).sqrt();
        let wanted = (length / (SPACING * texels_sq.sqrt())).ceil();
        let count = wanted.clamp(1.0, f64::from(most));
        // n points at spacing s have the variance of a row of length s √(n² − 1).
        let step = length / (count * count - 1.0).max(1.0).sqrt() * (angle / long_sq.sqrt());
        Taps {
            level: 0.5 * texels_sq.log2(),
            count: count as u32,
            along: arc.normalize(),
            step,
        }
    }
}

/// Whether a footprint in this direction of the cube's frame, with steps of this sum of squares, takes one bilinear tap.
fn takes_one_tap(direction: DVec3, size_sq: f64, face_texels: f64) -> bool {
    let depth = direction.abs().max_element();
    let density = 0.5 * face_texels / (depth * depth);
    size_sq * density * density < ONE_TAP_SQ
}

impl Taps {
    /// The directions of the taps; `middle` is the middle of the arc.
    pub fn directions(self, middle: DVec3) -> impl Iterator<Item = DVec3> {
        let first = -0.5 * f64::from(self.count - 1);
        (0..self.count).map(move |i| {
            let (sin, cos) = ((first + f64::from(i)) * self.step).sin_cos();
            middle * cos + self.along * sin
        })
    }
}

/// The cube face that a direction points at, to measure lengths in its texels.
struct OnFace {
    direction: DVec3,
    axis: DVec3,
    /// 1/depth along the axis.
    inverse: f64,
    half_texels: f64,
}

impl OnFace {
    fn new(direction: DVec3, face_texels: f64) -> Self {
        let size = direction.abs();
        let axis = if size.z >= size.x && size.z >= size.y {
            DVec3::Z
        } else if size.y >= size.x {
            DVec3::Y
        } else {
            DVec3::X
        };
        OnFace {
            direction,
            axis,
            inverse: 1.0 / direction.dot(axis),
            half_texels: 0.5 * face_texels,
        }
    }

    /// The small change `step` of the direction, projected onto the face, in texels.
    fn texels(&self, step: DVec3) -> DVec3 {
        let on_plane = step - self.direction * (step.dot(self.axis) * self.inverse);
        on_plane * (self.inverse.abs() * self.half_texels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::View;

    #[test]
    fn the_gradient_of_the_view_angle_is_its_difference() {
        let camera = Camera::new(&View {
            yaw_deg: 20.0,
            pitch_deg: -10.0,
            width: 4001,
            height: 2001,
            ..View::default()
        })
        .unwrap();
        let angle = |c, r| ViewAngle::of(camera.direction(c, r)).radians();
        for (c, r) in [(100, 100), (3000, 500), (2000, 1999), (50, 1500)] {
            let across = 0.5 * (angle(c + 1, r) - angle(c - 1, r));
            let along = 0.5 * (angle(c, r + 1) - angle(c, r - 1));
            let gradient = Patch::seen_by(&camera, camera.position(c, r), 1.0).gradient();
            assert!((gradient / across.hypot(along) - 1.0).abs() < 1e-5);
        }
    }
}
