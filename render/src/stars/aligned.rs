//! Stars on the optical axis, the line through hole and camera, in front of the camera or behind it. Such a star
//! is seen as an arc on either side of the hole or, on the axis itself, as an Einstein ring, once for each number
//! of windings of the light.
//!
//! A star is a disc of angular radius ρ at the distance η from the axis. At the azimuth φ about the axis it covers
//! a chord. The image of the chord has the light of the whole star times
//!
//! ```text
//! sin θ dθ/dϑ · chord(φ) dφ / (π ρ²)
//! ```
//!
//! evaluated at the chord's middle, and is drawn as an unresolved piece of the arc. The pieces add up to the
//! magnification of the disc, which is finite on the axis: 2 sin θ dθ/dϑ / ρ for each of the two images.

use super::images::{ImageOrder, InverseLens, arc_share, view_direction};
use crate::camera::ViewAngle;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Pieces of an arc per pixel of its length.
const PIECES_PER_PIXEL: f64 = 2.0;
/// Largest number of pieces of an arc.
const MAX_PIECES: f64 = 8192.0;

/// A piece of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// View direction: a unit vector in the hole frame.
    pub direction: DVec3,
    /// Its light, in units of the light of the star without lensing.
    pub magnification: f64,
}

/// A chord of the star's disc, on a line through the optical axis.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Chord {
    /// Azimuth about the axis, measured from that of the star, rad.
    azimuth: f64,
    /// Distance of its middle from the axis, rad.
    middle: f64,
    /// chord(φ) dφ / (π ρ²), 1/rad.
    weight: f64,
}

/// Calls `draw` with each piece of the arcs of a star in the unit direction `star` (hole frame). Draws nothing if
/// the star is not on the optical axis ([`arc_share`] is 0) or without bending. `pixel` is the angular size of a
/// pixel, rad.
pub fn arcs(
    lens: &InverseLens,
    star: DVec3,
    disc_radius: f64,
    pixel: f64,
    mut draw: impl FnMut(Piece),
) {
    let view_angle = ViewAngle::of(star);
    let share = arc_share(view_angle.sin, disc_radius);
    if share == 0.0 || matches!(lens, InverseLens::Flat(_)) {
        return;
    }
    let ahead = view_angle.cos > 0.0;
    let distance = view_angle.sin.atan2(view_angle.cos.abs());
    let toward = star.truncate().try_normalize().unwrap_or(DVec2::X);
    let orders = ImageOrder::all().flatten();
    for order in orders.filter(|order| ahead || !order.is_straight()) {
        let sky_angle =
            |from_axis: f64| order.sky_angle(if ahead { from_axis } else { PI - from_axis });
        let Some(ring) = lens.image(sky_angle(distance)) else {
            continue;
        };
        let length = arc_angle(distance, disc_radius) * ring.theta.sin();
        let pieces = (PIECES_PER_PIXEL * length / pixel).min(MAX_PIECES) as u32;
        let pieces = pieces.max(least_pieces(distance, disc_radius));
        for chord in chords(distance, disc_radius, pieces) {
            let Some(image) = lens.image(sky_angle(chord.middle)) else {
                continue;
            };
            let azimuth = DVec2::from_angle(chord.azimuth).rotate(toward) * order.side;
            draw(Piece {
                direction: view_direction(azimuth, image.theta),
                magnification: share * chord.weight * image.flux_per_sine(),
            });
        }
    }
}

/// Number of chords for which their sum is accurate to 1e-4.
fn least_pieces(distance: f64, radius: f64) -> u32 {
    if distance > 8.0 * radius { 4 } else { 64 }
}

/// Range of azimuth about the axis that a disc of `radius` at `distance` covers, rad.
fn arc_angle(distance: f64, radius: f64) -> f64 {
    if distance < radius {
        TAU
    } else {
        2.0 * (radius / distance).asin()
    }
}

/// Divides a disc of `radius` whose centre is at `distance` from the axis into `count` chords.
fn chords(distance: f64, radius: f64, count: u32) -> impl Iterator<Item = Chord> {
    // Computed from ratios: the square of a tiny radius would underflow to 0.
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
            // sin φ = (ρ/η) sin t with t evenly spaced: smooth at the ends, where the chord vanishes.
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

    /// Mean of 1/distance over a disc, summed over rings about the axis.
    fn mean_inverse_distance(distance: f64, radius: f64) -> f64 {
        let (n, mut sum) = (200_000, 0.0);
        let first = f64::max(0.0, distance - radius);
        let step = (distance + radius - first) / f64::from(n);
        for i in 0..n {
            let s = first + (f64::from(i) + 0.5) * step;
            // Angle of the part of the ring of radius s that lies within the disc.
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
