//! The patch of sky that a patch of the picture covers, and how to average over it.
//!
//! One step to the right or down in the picture moves the view direction by so much along the hole's
//! radius and so much about the hole. The bending stretches the first by dθ′/dθ = 1 − dΔ/dθ, which the
//! row's slope gives, and the second by sin θ′/sin θ. So the two steps on the sky are known at one ray,
//! without a look at the neighbours. Twin of `shaders/footprint.wgsl`.
//!
//! **The filter.** A mip level is chosen for the short axis of the footprint, and trilinear taps are spread
//! along the long one; where their greatest number does not reach, the level is raised. Sizes follow from second moments: a pixel W texels
//! wide, seen bilinearly, spreads by W²/12 + 1/6 texels², and a bilinear tap at level L, whose texels
//! are means of 4^L, by 4^L/4. Where these are equal, 4^L = (W² + 2)/3. The taps supply what the long
//! axis has beyond that: as a row of length E with E² = W² + 2 − 3·4^L.

use crate::camera::Sight;
use crate::deflect::Turned;
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::TAU;

/// Distance of two taps at the most, in texels of their level.
const SPACING: f64 = 1.5;
/// A footprint of less than this squared length in texels is one bilinear tap: the magnified sky, most
/// of a picture.
const ONE_TAP_SQ: f64 = 2.5;

/// A patch of the picture as a view direction with its steps, in the hole frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// The unit view direction of its middle.
    pub direction: DVec3,
    /// Its angle from the hole.
    pub sight: Sight,
    /// The unit vector along which θ grows.
    pub away: DVec3,
    /// The unit vector about the hole.
    pub about: DVec3,
    /// What a step to the right edge's distance changes: rad along `away` and along `about`.
    pub right: DVec2,
    /// The same downwards.
    pub down: DVec2,
}

/// A patch of the sky as a direction with its steps, in any frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footprint {
    /// The unit direction of its middle.
    pub direction: DVec3,
    /// What a step across the patch to the right changes, rad.
    pub right: DVec3,
    /// The same downwards.
    pub down: DVec3,
}

/// Taps on an arc of a great circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taps {
    /// The mip level of all.
    pub level: f64,
    /// How many.
    pub count: u32,
    /// The unit vector along the arc in its middle.
    pub along: DVec3,
    /// The angle from one to the next, rad.
    pub step: f64,
}

impl Patch {
    /// The patch about `ray` with the sides `right` and `down`, none of them normalised.
    pub fn new(ray: DVec3, right: DVec3, down: DVec3) -> Self {
        let length = ray.length();
        let direction = ray / length;
        let sight = Sight::of(direction);
        let radius = if sight.sin > 0.0 {
            direction.truncate() / sight.sin
        } else {
            DVec2::X
        };
        let away = (radius * sight.cos).extend(sight.sin);
        let about = radius.perp().extend(0.0);
        let steps = |step: DVec3| DVec2::new(step.dot(away), step.dot(about)) / length;
        Patch {
            direction,
            sight,
            away,
            about,
            right: steps(right),
            down: steps(down),
        }
    }

    /// |dθ| over the side of the patch along which θ grows, rad.
    pub fn gradient(&self) -> f64 {
        self.right.x.hypot(self.down.x)
    }

    /// The patch moved by `angle` rad away from the hole, its length along the radius times `extent`.
    pub fn moved(&self, angle: f64, extent: f64) -> Self {
        let steps = |of: DVec2| self.away * (of.x * extent) + self.about * of.y;
        let ray = self.direction + self.away * angle;
        Patch::new(ray, steps(self.right), steps(self.down))
    }

    /// The patch of the sky that it covers after the hole has turned it.
    pub fn footprint(&self, turned: Turned) -> Footprint {
        let sight = turned.sight;
        let radius = self.about.truncate().perp() * -1.0;
        let away = (radius * sight.cos).extend(sight.sin) * turned.stretch;
        // On the axis, where sin θ is 0, both stretches are the same.
        let about = if self.sight.sin > 0.0 {
            self.about * (sight.sin / self.sight.sin)
        } else {
            self.about * turned.stretch
        };
        Footprint {
            direction: self.sight.turn(self.direction, sight),
            right: away * self.right.x + about * self.right.y,
            down: away * self.down.x + about * self.down.y,
        }
    }
}

impl Footprint {
    /// The same footprint after the rotation `to`.
    pub fn in_frame(&self, to: &DMat3) -> Self {
        Footprint {
            direction: *to * self.direction,
            right: *to * self.right,
            down: *to * self.down,
        }
    }

    /// At most `most` taps that average the cube map of `face_texels` over the footprint, in the frame of the cube.
    pub fn taps(&self, face_texels: f64, most: u32) -> Taps {
        let one = Taps {
            level: 0.0,
            count: 1,
            along: DVec3::ZERO,
            step: 0.0,
        };
        let size = self.direction.abs();
        let depth = size.max_element();
        let density = 0.5 * face_texels / (depth * depth);
        if (self.right.length_squared() + self.down.length_squared()) * density * density
            < ONE_TAP_SQ
        {
            return one;
        }
        let on_face = OnFace::new(self.direction, face_texels);
        let (right, down) = (on_face.texels(self.right), on_face.texels(self.down));
        // The axes of the ellipse are those of the matrix of products of both.
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
        // Once round the sky is all of it.
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
        // n points a step s apart spread as a row of the length s √(n² − 1).
        let step = length / (count * count - 1.0).max(1.0).sqrt() * (angle / long_sq.sqrt());
        Taps {
            level: 0.5 * texels_sq.log2(),
            count: count as u32,
            along: arc.normalize(),
            step,
        }
    }
}

impl Taps {
    /// The directions of the taps, from the `middle` of the arc.
    pub fn directions(self, middle: DVec3) -> impl Iterator<Item = DVec3> {
        let first = -0.5 * f64::from(self.count - 1);
        (0..self.count).map(move |i| {
            let (sin, cos) = ((first + f64::from(i)) * self.step).sin_cos();
            middle * cos + self.along * sin
        })
    }
}

/// The face of a cube map that a direction points at, to measure in its texels.
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

    /// What the small change `step` of the direction is on the face, in texels.
    fn texels(&self, step: DVec3) -> DVec3 {
        let on_plane = step - self.direction * (step.dot(self.axis) * self.inverse);
        on_plane * (self.inverse.abs() * self.half_texels)
    }
}
