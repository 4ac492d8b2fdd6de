//! Stars on the axis through hole and camera, before or behind: each is seen as an arc on either side of
//! the hole, or as Einstein's ring, once for each turn of the light.
//!
//! A star is a disc of angular radius ρ, at the distance η from the axis. In the direction φ about the
//! axis it covers a chord. The image of the chord has the light of the whole star times
//!
//! ```text
//! sin θ dθ/dϑ · chord(φ) dφ / (π ρ²)
//! ```
//!
//! taken at the chord's middle: an unresolved piece of the arc. The pieces add up to the magnification of
//! the disc, which is finite on the axis: 2 sin θ dθ/dϑ / ρ for each of the two images.

use super::images::{Lens, Way, arc_share, view_direction};
use crate::camera::Sight;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Pieces of an arc to a pixel, and at the most.
const PIECES_A_PIXEL: f64 = 2.0;
const MOST_PIECES: f64 = 8192.0;

/// A piece of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Where it is seen: a unit vector in the hole frame.
    pub direction: DVec3,
    /// Its light, in units of the star's light without the hole.
    pub magnification: f64,
}

/// A chord of the star's disc through the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Chord {
    /// Its direction about the axis, from that of the star, rad.
    azimuth: f64,
    /// Distance of its middle from the axis, rad.
    middle: f64,
    /// chord(φ) dφ / (π ρ²), 1/rad.
    weight: f64,
}

/// Calls `draw` with each piece of the arcs of the star in the unit direction `star` (hole frame). Nothing
/// if it is not on the axis. `pixel` is the angle of a pixel, rad.
pub fn arcs(lens: &Lens, star: DVec3, disc_radius: f64, pixel: f64, mut draw: impl FnMut(Piece)) {
    let sight = Sight::of(star);
    let share = arc_share(sight.sin, disc_radius);
    if share == 0.0 || matches!(lens, Lens::Flat(_)) {
        return;
    }
    let ahead = sight.cos > 0.0;
    let distance = sight.sin.atan2(sight.cos.abs());
    let toward = star.truncate().try_normalize().unwrap_or(DVec2::X);
    let ways = Way::all().flatten();
    for way in ways.filter(|way| ahead || !way.is_straight()) {
        let sky_angle =
            |from_axis: f64| way.sky_angle(if ahead { from_axis } else { PI - from_axis });
        let Some(ring) = lens.image(sky_angle(distance)) else {
            continue;
        };
        let length = arc_angle(distance, disc_radius) * ring.theta.sin();
        let pieces = (PIECES_A_PIXEL * length / pixel).min(MOST_PIECES) as u32;
        let pieces = pieces.max(least_pieces(distance, disc_radius));
        for chord in chords(distance, disc_radius, pieces) {
            let Some(image) = lens.image(sky_angle(chord.middle)) else {
                continue;
            };
            let azimuth = DVec2::from_angle(chord.azimuth).rotate(toward) * way.side;
            draw(Piece {
                direction: view_direction(azimuth, image.theta),
                magnification: share * chord.weight * image.flux_per_sine(),
            });
        }
    }
}

/// As many chords as their sum needs to be good to 1e-4.
fn least_pieces(distance: f64, radius: f64) -> u32 {
    if distance > 8.0 * radius { 4 } else { 64 }
}

/// The angle about the axis over which a disc of `radius` at `distance` reaches, rad.
fn arc_angle(distance: f64, radius: f64) -> f64 {
    if distance < radius {
        TAU
    } else {
        2.0 * (radius / distance).asin()
    }
}

/// The chords of a disc of `radius` whose middle lies at `distance` from the axis, `count` of them.
fn chords(distance: f64, radius: f64, count: u32) -> impl Iterator<Item = Chord> {
    // The weight is made of ratios: the square of a tiny radius is 0.
    let ratio = distance / radius;
    (0..count).map(move |i| {
        let share = (f64::from(i) + 0.5) / f64::from(count);
        if distance < radius {
            let azimuth = TAU * share - PI;
            let (sin, cos) = azimuth.sin_cos();
            let length = ratio * cos + (1.0 - (ratio * sin).powi(2)).sqrt();
            Chord {
                azimuth,
                middle: 0.5 * length * radius,
                weight: 2.0 * length / (radius * f64::from(count)),
            }
        } else {
            // sin φ = (ρ/η) sin t, evenly in t, so that the ends, where the chord vanishes, are smooth.
            let t = PI * share - FRAC_PI_2;
            let sin = radius / distance * t.sin();
            let cos = (1.0 - sin * sin).sqrt();
            Chord {
                azimuth: sin.asin(),
                middle: distance * cos,
                weight: 2.0 * t.cos().powi(2) / (distance * cos * f64::from(count)),
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of 1/distance over a disc, by adding up rings about the axis.
    fn mean_inverse_distance(distance: f64, radius: f64) -> f64 {
        let (n, mut sum) = (200_000, 0.0);
        let first = f64::max(0.0, distance - radius);
        let step = (distance + radius - first) / f64::from(n);
        for i in 0..n {
            let s = first + (f64::from(i) + 0.5) * step;
            // The part of the ring of radius s within the disc, as an angle.
            let cos = (s * s + distance * distance - radius * radius) / (2.0 * s * distance);
            sum += 2.0 * cos.clamp(-1.0, 1.0).acos() * step;
        }
        sum / (PI * radius * radius)
    }

    #[test]
    fn the_chords_add_up_to_the_mean_inverse_distance_of_the_disc() {
        let radius = 1e-3;
        for ratio in [1e-9, 0.1, 0.5, 0.9, 1.1, 1.5, 3.0, 16.0, 32.0] {
            let distance = ratio * radius;
            let sum: f64 = chords(distance, radius, 512).map(|c| c.weight).sum();
            let mean = mean_inverse_distance(distance, radius);
            assert!((sum / mean - 1.0).abs() < 1e-3, "{ratio}: {sum} for {mean}");
        }
        let on_axis: f64 = chords(0.0, radius, 64).map(|c| c.weight).sum();
        assert!((on_axis * radius / 2.0 - 1.0).abs() < 1e-12, "{on_axis}");
        for ratio in [8.1, 32.0, 1e5] {
            let distance = ratio * radius;
            let few = chords(distance, radius, least_pieces(distance, radius));
            let many = chords(distance, radius, 1024);
            let [few, many] = [
                few.map(|c| c.weight).sum::<f64>(),
                many.map(|c| c.weight).sum(),
            ];
            assert!((few / many - 1.0).abs() < 1e-6, "{ratio}: {few} for {many}");
            let point = few * distance - 1.0;
            assert!(
                point.abs() < 0.15 / (ratio * ratio) + 1e-9,
                "{ratio}: {point}"
            );
        }
    }
}
