//! Bounds on the images of intervals of sky angles, for each image order: where they are and how bright. A table
//! is computed once for a lens, so that the bounds for each cell of the sky need no evaluation of the lens.

use super::images::{ImageOrder, InverseLens, point_distance};
use std::f64::consts::PI;

/// Steps of the table from the direction of the hole to the opposite one, for image orders without windings.
const STEPS: usize = 128;
/// The same for image orders with windings, of which little is ever visible.
const STEPS_WITH_WINDINGS: usize = 16;

/// Table of the images of a lens in each image order.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageBounds {
    /// Distance from the optical axis up to which no star is drawn as points, rad.
    least: f64,
    /// One table for each of [`ImageOrder::all`], sampled at evenly spaced angles from 0 to π from the direction
    /// of the hole.
    tables: Vec<Vec<Option<Sample>>>,
}

/// The image of a sky angle ϑ.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    /// The view angle θ, rad.
    theta: f64,
    /// dθ/dϑ.
    radial_magnification: f64,
    /// sin θ / |sin ϑ|.
    tangential_magnification: f64,
}

/// Bounds on the image of an interval of sky angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest view angle θ, rad.
    pub nearest: f64,
    /// Largest view angle θ, rad.
    pub farthest: f64,
    /// Upper bound on the tangential magnification.
    pub tangential_magnification: f64,
    /// Upper bound on the magnification of a star in the interval.
    pub brightness: f64,
}

impl ImageBounds {
    /// The table of `lens`, for stars of angular radius `disc_radius` (rad).
    pub fn of(lens: &InverseLens, disc_radius: f64) -> Self {
        let least = point_distance(disc_radius);
        let table = |order: ImageOrder| {
            let steps = steps(order.windings);
            let angle = |i: usize| (i as f64 * PI / steps as f64).clamp(least, PI - least);
            let sample = |i| {
                let image = lens.image(order.sky_angle(angle(i)))?;
                Some(Sample {
                    theta: image.theta,
                    radial_magnification: image.radial_magnification,
                    tangential_magnification: image.theta.sin() / angle(i).sin(),
                })
            };
            (0..=steps).map(sample).collect()
        };
        ImageBounds {
            least,
            tables: ImageOrder::all().flatten().map(table).collect(),
        }
    }

    /// Whether a star is drawn as arcs, at least in part. `sin_distance` is the sine of its distance from the optical
    /// axis.
    pub fn may_be_arc(&self, sin_distance: f64) -> bool {
        sin_distance < 2.0 * self.least
    }

    /// Bounds on the image of the sky angles between `least` and `most` (rad from the direction of the hole), in
    /// the image order with this index in [`ImageOrder::all`]. `None` if part of the interval has no image.
    pub fn seen(&self, order: usize, least: f64, most: f64) -> Option<Bounds> {
        let table = &self.tables[order];
        let steps = (table.len() - 1) as f64;
        let step = |angle: f64| (angle / PI * steps).clamp(0.0, steps);
        let near = table[step(least).floor() as usize]?;
        let far = table[step(most).ceil() as usize]?;
        // Each magnification is a monotonic function of the angle from the hole, so its maximum is at an end.
        let tangential_magnification = near
            .tangential_magnification
            .max(far.tangential_magnification);
        Some(Bounds {
            nearest: near.theta.min(far.theta),
            farthest: near.theta.max(far.theta),
            tangential_magnification,
            brightness: tangential_magnification
                * near.radial_magnification.max(far.radial_magnification),
        })
    }
}

fn steps(windings: u32) -> usize {
    if windings == 0 {
        STEPS
    } else {
        STEPS_WITH_WINDINGS
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::lens::{Deflection, Lens};
    use lensbake_tables::default_atlas;
    use proptest::prelude::*;

    fn lens(radius: f64) -> InverseLens {
        let view = View {
            radius,
            ..View::default()
        };
        let camera = Camera::new(&view).unwrap();
        InverseLens::of(&Lens::new(camera, default_atlas(), Deflection::Lut).unwrap())
    }

    proptest! {
        #[test]
        fn what_is_seen_of_a_range_holds_what_is_seen_of_each_of_its_angles(
            radius in prop_oneof![1.01..2.0, 2.0..40.0, 40.0..1e6],
            middle in prop_oneof![0.0..PI, 0.0..0.02, PI - 0.02..PI],
            half in 0.0..0.1f64,
            part in 0.0..1.0,
        ) {
            let lens = lens(radius);
            let orders = ImageBounds::of(&lens, 1e-8);
            let (least, most): (f64, f64) = (middle - half, middle + half);
            let angle: f64 = f64::mul_add(part, most - least, least);
            let angle = angle.clamp(orders.least, PI - orders.least);
            for (index, order) in ImageOrder::all().flatten().enumerate() {
                let seen = orders.seen(index, least, most).unwrap();
                let image = lens.image(order.sky_angle(angle)).unwrap();
                prop_assert!(seen.nearest <= image.theta && image.theta <= seen.farthest);
                let tangential_magnification = image.theta.sin() / angle.sin();
                prop_assert!(tangential_magnification <= seen.tangential_magnification * (1.0 + 1e-9), "{tangential_magnification} {seen:?}");
                let brightness = tangential_magnification * image.radial_magnification;
                prop_assert!(brightness <= seen.brightness * (1.0 + 1e-9), "{brightness} {seen:?}");
            }
        }
    }
}
