//! Where an observer at infinity sees a point of a thin disc, and in what light.

use lensbake_core::{B_CRIT, Ray, RayOutcome, accretion, exact, orbit};
use std::f64::consts::PI;

/// A thin disc as an observer at infinity sees it. In the picture the axis of the disc points up, and its matter comes
/// towards the observer on the left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarDisc {
    /// Angle of the axis from the line of sight, rad, above 0 and below π/2.
    pub inclination: f64,
}

/// Which image of the disc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Image {
    /// Of the light that crosses the plane of the disc nowhere else.
    Direct,
    /// Of the light that has gone half of a turn farther around the hole, from the other face of the disc.
    Secondary,
}

/// A point of the disc in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Its place: to the right and up from the hole, in units of r_s.
    pub place: [f64; 2],
    /// 1 + z, the frequency at which the light was emitted over that at which it is seen.
    pub redshift: f64,
    /// The bolometric flux that is seen of it, in units of the greatest flux that the disc emits.
    pub flux: f64,
}

impl Image {
    /// Name.
    pub fn name(self) -> &'static str {
        match self {
            Image::Direct => "direct",
            Image::Secondary => "secondary",
        }
    }
}

impl FarDisc {
    /// The point at `radius` ≥ 3 whose image lies in the direction `azimuth` (rad, counter-clockwise from the right) from
    /// the hole.
    pub fn seen(&self, image: Image, radius: f64, azimuth: f64) -> Seen {
        let (sin, cos) = azimuth.sin_cos();
        let b = self.impact_parameter(image, radius, azimuth);
        let angular_momentum = -b * cos * self.inclination.sin();
        let redshift = accretion::emitted_frequency(radius, angular_momentum);
        Seen {
            place: [b * cos, b * sin],
            redshift,
            flux: accretion::flux(radius) / redshift.powi(4),
        }
    }

    /// The impact parameter of the image of the point at `radius` ≥ 3 in the direction `azimuth`.
    pub fn impact_parameter(&self, image: Image, radius: f64, azimuth: f64) -> f64 {
        impact_parameter(self.orbital_angle(image, azimuth), 1.0 / radius)
    }

    /// The angle at the hole from the observer to the point of the disc whose image lies in the direction `azimuth`:
    /// cos γ = cos a / √(cos² a + cot² i), with a the angle from the upward direction.
    fn orbital_angle(&self, image: Image, azimuth: f64) -> f64 {
        let (sin, cos) = self.inclination.sin_cos();
        // n · (Z cos φ + e sin φ) = 0.
        let direct = cos.atan2(-sin * azimuth.sin());
        match image {
            Image::Direct => direct,
            Image::Secondary => direct + PI,
        }
    }
}

/// The impact parameter of the ray that is at the inverse radius `u` ≤ 1/3 at the orbital angle `angle` from the observer at
/// infinity. As it falls from that of a ray that turns round at u, a ray meets u on its way out, at ever larger angles.
fn impact_parameter(angle: f64, u: f64) -> f64 {
    let turning = 1.0 / (u * (1.0 - u).sqrt());
    let on_way_in = |b: f64| orbit::phase(1.0 / b, u).unwrap_or(0.5 * total_angle(turning));
    match angle <= on_way_in(turning) {
        true => bisect(0.0, turning, |b| on_way_in(b) < angle),
        false => bisect(B_CRIT, turning, |b| total_angle(b) - on_way_in(b) > angle),
    }
}

/// The orbital angle from infinity to infinity of the ray with impact parameter `b`; ∞ if it is captured.
fn total_angle(b: f64) -> f64 {
    match Ray::from_infinity(b).map(|ray| exact::bend(&ray)) {
        Ok(RayOutcome::Escapes(bend)) => PI + bend,
        _ => f64::INFINITY,
    }
}

/// Where `below` changes from true to false between `low` and `high`.
fn bisect(mut low: f64, mut high: f64, below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match below(middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const INCLINED: FarDisc = FarDisc {
        inclination: 80.0 * PI / 180.0,
    };

    #[test]
    fn images_lie_on_the_orbit() {
        for image in [Image::Direct, Image::Secondary] {
            for radius in [3.0, 5.0, 15.0] {
                for azimuth in [-1.4, -0.3, 0.0, 0.8, 1.57, 3.0] {
                    let b = INCLINED.impact_parameter(image, radius, azimuth);
                    let angle = INCLINED.orbital_angle(image, azimuth);
                    let phase = angle.min(total_angle(b) - angle);
                    let u = orbit::inverse_radius(1.0 / b, phase);
                    assert!(
                        (u * radius - 1.0).abs() < 1e-8,
                        "{image:?} {radius} {azimuth}"
                    );
                }
            }
        }
    }

    /// The impact parameters that the Python package luminet 0.2.3 finds, in units of M.
    #[test]
    fn another_program_finds_the_images_at_the_same_places() {
        let known = [
            (Image::Direct, 6.0, 90.0, 6.669_365),
            (Image::Direct, 6.0, 0.0, 6.932_148),
            (Image::Direct, 30.0, 60.0, 15.225_941),
            (Image::Secondary, 6.0, -90.0, 6.304_566),
            (Image::Secondary, 10.0, -30.0, 7.058_258),
            (Image::Secondary, 30.0, 90.0, 5.356_122),
        ];
        for (image, radius, azimuth, b) in known {
            let azimuth = f64::to_radians(azimuth);
            let found = 2.0 * INCLINED.impact_parameter(image, 0.5 * radius, azimuth);
            assert!((found - b).abs() < 1e-4, "{image:?} {radius}: {found} {b}");
        }
    }

    #[test]
    fn far_from_the_hole_the_disc_is_an_ellipse() {
        for azimuth in [-2.0, -0.5, 0.0, 0.7, 1.5] {
            let [x, y] = INCLINED.seen(Image::Direct, 1e7, azimuth).place;
            let radius = x.hypot(y / INCLINED.inclination.cos());
            assert!((radius / 1e7 - 1.0).abs() < 1e-5, "{azimuth}: {radius}");
        }
    }

    #[test]
    fn what_comes_towards_the_observer_is_bluer_and_brighter() {
        let left = INCLINED.seen(Image::Direct, 5.0, PI);
        let right = INCLINED.seen(Image::Direct, 5.0, 0.0);
        assert!(left.redshift < 1.0 && right.redshift > 1.0);
        assert!(left.flux > 5.0 * right.flux);
    }
}
