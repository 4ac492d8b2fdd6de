//! Where the ways of the light show the sky by the angle from the hole, and how bright: a table made once a
//! frame, so that what is asked of it for each cell of the sky takes no lens.

use super::images::{Lens, Way, point_distance};
use std::f64::consts::PI;

/// Steps of the table from towards the hole to straight away from it, by the ways without a further turn and
/// by the others, of which little is ever seen.
const STEPS: usize = 256;
const STEPS_OF_FURTHER_TURNS: usize = 32;

/// The ways of the light, in the order of [`Way::all`].
#[derive(Debug, Clone, PartialEq)]
pub struct Ways {
    /// The distance from the axis up to which there are no points, rad.
    least: f64,
    /// At angles from the hole as far from each other as from 0 and π.
    tables: Vec<Vec<Option<Sample>>>,
}

/// What a lens makes of an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sample {
    /// The view angle θ, rad.
    theta: f64,
    /// dθ/dϑ.
    stretch: f64,
    /// sin θ / |sin ϑ|.
    about_axis: f64,
}

/// What is seen of a range of angles, at the most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// The view angles θ that it lies between, rad.
    pub nearest: f64,
    /// The greater of them.
    pub farthest: f64,
    /// How much it is stretched about the axis.
    pub about_axis: f64,
    /// How many times brighter a star in it is.
    pub brightness: f64,
}

impl Ways {
    /// Of `lens`, for stars of this angular radius (rad).
    pub fn of(lens: &Lens, disc_radius: f64) -> Self {
        let least = point_distance(disc_radius);
        let table = |way: Way| {
            let steps = steps(way.windings);
            let angle = |i: usize| (i as f64 * PI / steps as f64).clamp(least, PI - least);
            let sample = |i| {
                let image = lens.image(way.sky_angle(angle(i)))?;
                Some(Sample {
                    theta: image.theta,
                    stretch: image.stretch,
                    about_axis: image.theta.sin() / angle(i).sin(),
                })
            };
            (0..=steps).map(sample).collect()
        };
        Ways {
            least,
            tables: Way::all().flatten().map(table).collect(),
        }
    }

    /// Whether a star that is no farther than `distance` (rad) from the axis is drawn as an arc.
    pub fn may_be_arc(&self, distance: f64) -> bool {
        distance < 2.0 * self.least
    }

    /// What is seen by the way of this index of all between two angles from the hole (rad); `None` if of
    /// something there nothing is.
    pub fn seen(&self, way: usize, least: f64, most: f64) -> Option<Seen> {
        let table = &self.tables[way];
        let steps = (table.len() - 1) as f64;
        let step = |angle: f64| (angle / PI * steps).clamp(0.0, steps);
        let near = table[step(least).floor() as usize]?;
        let far = table[step(most).ceil() as usize]?;
        // Both fall, or both grow, from the hole outwards.
        let about_axis = near.about_axis.max(far.about_axis);
        Some(Seen {
            nearest: near.theta.min(far.theta),
            farthest: near.theta.max(far.theta),
            about_axis,
            brightness: about_axis * near.stretch.max(far.stretch),
        })
    }
}

fn steps(windings: u32) -> usize {
    if windings == 0 {
        STEPS
    } else {
        STEPS_OF_FURTHER_TURNS
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::scene::{Method, Scene};
    use lensbake_tables::default_atlas;
    use proptest::prelude::*;

    fn lens(radius: f64) -> Lens {
        let view = View {
            radius,
            ..View::default()
        };
        let camera = Camera::new(&view).unwrap();
        Lens::of(&Scene::new(camera, default_atlas(), Method::Lut).unwrap()).unwrap()
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
            let ways = Ways::of(&lens, 1e-8);
            let (least, most): (f64, f64) = (middle - half, middle + half);
            let angle: f64 = f64::mul_add(part, most - least, least);
            let angle = angle.clamp(ways.least, PI - ways.least);
            for (index, way) in Way::all().flatten().enumerate() {
                let seen = ways.seen(index, least, most).unwrap();
                let image = lens.image(way.sky_angle(angle)).unwrap();
                prop_assert!(seen.nearest <= image.theta && image.theta <= seen.farthest);
                let about_axis = image.theta.sin() / angle.sin();
                prop_assert!(about_axis <= seen.about_axis * (1.0 + 1e-9), "{about_axis} {seen:?}");
                let brightness = about_axis * image.stretch;
                prop_assert!(brightness <= seen.brightness * (1.0 + 1e-9), "{brightness} {seen:?}");
            }
        }
    }
}
