//! The inverse of a row: from the position of a point on the sky to the directions in which its images are seen.
//!
//! The *unwrapped* sky angle ϑ = θ − Δ(θ) of the light seen at the view angle θ increases strictly with θ, from −∞
//! at the shadow boundary (critical curve) to π straight away from the hole. A star at the angle β from the
//! direction of the hole therefore has one image for each ϑ = β, −β, β − 2π, −β − 2π, …: one on its own side of
//! the hole, one on the other side, and two more, one on each side, for each further turn of the light round the
//! hole (image orders). The magnification of an image is
//!
//! ```text
//! μ = sin θ dθ / (|sin ϑ| dϑ).
//! ```
//!
//! The inverse row holds θ(ϑ). In weak fields, θ − θ_c is close to the view angle θ_w of a point lens with the
//! Einstein angle θ_E = √(2/r),
//!
//! ```text
//! θ_w = (ϑ + √(ϑ² + 4 θ_E²)) / 2 = θ_E e^v,     ϑ = 2 θ_E sinh v
//! ```
//!
//! and at the shadow boundary ln(θ − θ_c) → ϑ + const. The stored value is therefore Λ = ln((θ − θ_c)/θ_w), which
//! is nearly 0 in weak fields and smooth everywhere. It is tabulated against v, which resolves the transition of
//! width θ_E at ϑ = 0 however narrow it is. Storing the slope of Λ as well gives the magnification the same
//! relative accuracy at every image order. With this, 64 texels are enough at every radius.
//!
//! For an observer who falls near the hole, v is measured from ϑ = π instead: ϑ = π + scale sinh v.
//!
//! Between texels the interpolation is cubic Hermite, as in the row itself.

mod gpu;

pub use gpu::{GpuImage, GpuInverseRow, Inverse, WGSL, exp_arsinh, wgsl_row};

use crate::{Interpolation, Row};
use lensbake_core::{BendAndSlope, CoreError, Observer, RayOutcome, ShadowCoordinate};
use std::f64::consts::PI;

/// Number of texels in an inverse row: 512 bytes on a GPU, like the row itself.
pub const INVERSE_TEXELS: u32 = 64;

/// ϑ of the first texel, rad. Below it ln(θ − θ_c) is linear in ϑ to 1e-6.
const FIRST: f64 = -5.0 * PI;

/// An image of a point of the sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Image {
    /// θ, the view angle from the direction of the hole, rad.
    pub theta: f64,
    /// Radial magnification dθ/dϑ > 0: how much the image is stretched along the view angle.
    pub radial_magnification: f64,
}

/// The inverse row of one observer.
///
/// ```
/// use lensbake_core::Observer;
/// use lensbake_tables::{InverseRow, default_atlas};
///
/// let observer = Observer::at(10.0).unwrap();
/// let row = InverseRow::new(&default_atlas().row(observer).unwrap()).unwrap();
/// // A point 0.5 rad from the direction of the hole is seen on both sides of it.
/// let primary = row.image(0.5);
/// let secondary = row.image(-0.5);
/// assert!(primary.theta > secondary.theta && secondary.theta > observer.shadow_angle());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct InverseRow {
    observer: Observer,
    centre: f64,
    scale: f64,
    first: f64,
    per_texel: f64,
    texels: Vec<[f64; 2]>,
}

impl InverseRow {
    /// The inverse of `row`. For an observer at rest from r = 1.001 to 1e6, θ is accurate to 4e-7 rad and dθ/dϑ to a
    /// relative error of 2e-4. For an observer in free fall from r = 0.01 to 100, θ is accurate to 2e-5 rad.
    ///
    /// # Errors
    /// [`CoreError::NoViewAngle`] for the observer at infinity, who sees the hole as a point.
    pub fn new(row: &Row) -> Result<Self, CoreError> {
        Self::of(*row.observer(), |at| row.bend_and_slope(at))
    }

    /// The inverse of any `bending` that grows without bound towards the shadow boundary, as `observer` sees it.
    ///
    /// # Errors
    /// As [`InverseRow::new`].
    pub fn of(
        observer: Observer,
        bending: impl Fn(ShadowCoordinate) -> RayOutcome<BendAndSlope>,
    ) -> Result<Self, CoreError> {
        if !observer.has_view_angles() {
            return Err(CoreError::NoViewAngle);
        }
        let (centre, scale) = axis(&observer);
        let v = |sky_angle: f64| ((sky_angle - centre) / scale).asinh();
        let (first, last) = (v(FIRST), v(PI));
        let per_texel = (last - first) / f64::from(INVERSE_TEXELS - 1);
        // Solve from straight away from the hole, where θ = ϑ = π and dθ/dϑ = √(1−1/r), towards the shadow
        // boundary. The first guess for each texel is on the tangent at the previous one.
        let mut texels = vec![[0.0; 2]; INVERSE_TEXELS as usize];
        let mut log_offset = (PI - observer.shadow_angle()).ln();
        let mut slope = observer.redshifts()[1] * (PI - centre).hypot(scale) / log_offset.exp();
        for i in (0..INVERSE_TEXELS).rev() {
            let v = first + f64::from(i) * per_texel;
            let sky_angle = centre + scale * v.sinh();
            if i < INVERSE_TEXELS - 1 {
                let from = log_offset - slope * per_texel;
                (log_offset, slope) = solve(&observer, &bending, sky_angle, from);
                slope *= scale * v.cosh();
            }
            // θ_w = (scale/2) e^v, so ln θ_w has the slope 1 in v.
            let weak = v + (0.5 * scale).ln();
            texels[i as usize] = [log_offset - weak, (slope - 1.0) * per_texel];
        }
        Ok(InverseRow {
            observer,
            centre,
            scale,
            first,
            per_texel,
            texels,
        })
    }

    /// The observer that the inverse row is for.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }

    /// The image for the unwrapped sky angle `sky_angle` ≤ π (rad): the direction in which light from there is
    /// seen.
    pub fn image(&self, sky_angle: f64) -> Image {
        let last = f64::from(INVERSE_TEXELS - 1);
        // Below the first texel's ϑ, ln(θ − θ_c) is linear in ϑ with slope 1.
        let inside = sky_angle.max(FIRST);
        let v = ((inside - self.centre) / self.scale).asinh();
        let q = (v - self.first) / (self.per_texel * last);
        let stored = Interpolation::Hermite.between(&self.texels, q);
        let weak = 0.5 * self.scale * v.exp();
        let offset = weak * (stored.value + (sky_angle - inside)).exp();
        let slope = 1.0 + stored.slope / (self.per_texel * last);
        Image {
            theta: self.observer.shadow_angle() + offset,
            radial_magnification: offset * slope / (inside - self.centre).hypot(self.scale),
        }
    }
}

impl Image {
    /// Magnification of a point source at this image for the unwrapped sky angle `sky_angle` (rad), the ratio of
    /// its brightness to that without the hole: μ = sin θ dθ / (|sin ϑ| dϑ). It grows without bound towards the
    /// axis (sin ϑ = 0), except for the one image straight away from the hole.
    pub fn magnification(&self, sky_angle: f64) -> f64 {
        // Straight away from the hole both sines vanish; their ratio is dθ/dϑ up to terms of order (π − ϑ)².
        if PI - sky_angle < 1e-4 {
            return self.radial_magnification * self.radial_magnification;
        }
        self.flux_per_sine() / sky_angle.sin().abs()
    }

    /// sin θ dθ/dϑ: the magnification times |sin ϑ|, which stays finite on the axis.
    pub fn flux_per_sine(&self) -> f64 {
        self.theta.sin() * self.radial_magnification
    }
}

/// The centre and the scale of the axis ϑ = centre + scale sinh v, rad. Texels crowd at the centre: at ϑ = 0, where a
/// distant hole has its Einstein ring, or at ϑ = π, straight away, for an observer who falls near the hole, because the
/// aberration spreads that part of the sky.
fn axis(observer: &Observer) -> (f64, f64) {
    const NEAR: f64 = 5.0;
    let r = observer.radius();
    if !observer.is_at_rest() && r < NEAR {
        (PI, 0.6 * r.powf(0.4))
    } else {
        (0.0, 2.0 * (2.0 / r).sqrt())
    }
}

/// ln(θ − θ_c) at the θ with θ − Δ(θ) = `sky_angle`, and its derivative with respect to ϑ, by Newton's method from
/// the first guess `from`.
fn solve(
    observer: &Observer,
    bending: impl Fn(ShadowCoordinate) -> RayOutcome<BendAndSlope>,
    sky_angle: f64,
    from: f64,
) -> (f64, f64) {
    const MAX_STEPS: usize = 30;
    let edge = observer.shadow_angle();
    let mut log_offset = from;
    let mut slope = 1.0;
    for _ in 0..MAX_STEPS {
        let offset = log_offset.exp().min(PI - edge);
        let at = observer.shadow_coordinate(edge + offset);
        // Captured by rounding only: `FIRST` is seven decades outside the shadow boundary.
        let RayOutcome::Escapes(BendAndSlope { bend, slope: by_x }) = bending(at) else {
            break;
        };
        let sky_slope = 1.0 - by_x / observer.view_angle_slope(at.x);
        slope = 1.0 / (offset * sky_slope);
        let step = (sky_angle - (edge + offset - bend)) * slope;
        log_offset = offset.ln() + step;
        if step.abs() < 1e-13 {
            break;
        }
    }
    (log_offset, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::default_atlas;
    use lensbake_core::exact;

    fn inverse(r: f64) -> InverseRow {
        let row = default_atlas().row(Observer::at(r).unwrap()).unwrap();
        InverseRow::new(&row).unwrap()
    }

    /// ϑ(θ) by the closed form.
    fn sky_angle(observer: &Observer, theta: f64) -> f64 {
        theta
            - exact::bend(&observer.ray(theta).unwrap())
                .escaped()
                .unwrap()
    }

    /// View angles from seven decades outside the shadow boundary to straight away from the hole.
    fn view_angles(observer: &Observer) -> impl Iterator<Item = f64> {
        let edge = observer.shadow_angle();
        (1..=2000)
            .map(move |i| edge + (PI - edge) * 10f64.powf(-7.0 * f64::from(i) / 2000.0))
            .chain((0..=500).map(move |i| PI - (PI - edge) * f64::from(i) / 501.0))
    }

    #[test]
    fn the_inverse_of_the_falling_observer_is_good_to_2e_5_rad() {
        for r in [100.0, 10.0, 5.1, 4.9, 3.0, 1.5, 1.0, 0.5, 0.1, 0.03, 0.01] {
            let observer = Observer::falling(r).unwrap();
            let inverse = InverseRow::new(&default_atlas().row(observer).unwrap()).unwrap();
            let mirror = GpuInverseRow::new(&inverse);
            let (mut theta_error, mut mirror_error) = (0.0_f64, 0.0_f64);
            for theta in view_angles(&observer) {
                let sky_angle = sky_angle(&observer, theta);
                let image = inverse.image(sky_angle);
                theta_error = theta_error.max((image.theta - theta).abs());
                let [cos, sin] = mirror.image(sky_angle as f32).cos_sin.map(f64::from);
                let (sin_theta, cos_theta) = image.theta.sin_cos();
                mirror_error = mirror_error.max((cos - cos_theta).hypot(sin - sin_theta));
            }
            println!("r {r}: {theta_error:.1e} rad, in f32 {mirror_error:.1e}");
            assert!(theta_error < 2e-5, "r {r}: {theta_error:e} rad");
            assert!(mirror_error < 1e-5, "r {r}: {mirror_error:e} rad");
        }
    }

    const RADII: [f64; 12] = [
        1.001, 1.05, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 25.0, 1e3, 1e5, 1e6,
    ];

    #[test]
    fn the_inverse_is_good_to_4e_7_rad_and_its_slope_to_2e_4() {
        for r in RADII {
            let inverse = inverse(r);
            let observer = *inverse.observer();
            let (mut theta_error, mut slope_error) = (0.0_f64, 0.0_f64);
            for theta in view_angles(&observer) {
                let image = inverse.image(sky_angle(&observer, theta));
                theta_error = theta_error.max((image.theta - theta).abs());
                let offset = theta - observer.shadow_angle();
                // Closer to the shadow boundary or to θ = π, differences of the closed form are dominated by
                // rounding.
                if offset > 1e-6 && PI - theta > 1e-3 {
                    let h = 1e-3 * offset.min(PI - theta);
                    let rise = sky_angle(&observer, theta + h) - sky_angle(&observer, theta - h);
                    slope_error = slope_error
                        .max((image.radial_magnification * rise / (2.0 * h) - 1.0).abs());
                }
            }
            println!("r {r}: {theta_error:.1e} rad, slope {slope_error:.1e}");
            assert!(theta_error < 4e-7, "r {r}: {theta_error:e} rad");
            assert!(slope_error < 2e-4, "r {r}: slope {slope_error:e}");
        }
    }

    /// The deflection angle of a distant ray is x r_s/(r T) with T = tan(θ_c/2): the weak-field lens equation.
    #[test]
    fn a_distant_hole_has_its_einstein_ring() {
        for r in [1e4, 1e6] {
            let theta = inverse(r).image(0.0).theta;
            let einstein = f64::sqrt(2.0 / r);
            assert!(
                (theta / einstein - 1.0).abs() < 2.0 * einstein,
                "r {r}: {theta}"
            );
        }
    }

    /// The magnifications of the two images of a distant point lens add up to (u² + 2)/(u √(u² + 4)), β = u θ_E
    /// (Paczyński 1986, Astrophys. J. 304, 1).
    #[test]
    fn a_distant_hole_magnifies_as_a_point_lens() {
        let inverse = inverse(1e6);
        let einstein = f64::sqrt(2.0 / 1e6);
        for u in [0.01, 0.1, 0.5, 1.0, 2.0, 5.0] {
            let beta = u * einstein;
            let sum: f64 = [beta, -beta]
                .map(|angle| inverse.image(angle).magnification(angle))
                .iter()
                .sum();
            let expected = (u * u + 2.0) / (u * (u * u + 4.0).sqrt());
            assert!(
                (sum / expected - 1.0).abs() < 1e-3,
                "u {u}: {sum} for {expected}"
            );
        }
    }

    #[test]
    fn straight_away_the_magnification_is_one_over_the_rate_of_the_clock() {
        for r in RADII {
            let inverse = inverse(r);
            let lapse = inverse.observer().lapse();
            for angle in [PI, PI - 5e-5, PI - 2e-4, PI - 1e-2] {
                let mu = inverse.image(angle).magnification(angle);
                assert!(
                    (mu / (lapse * lapse) - 1.0).abs() < 1e-3,
                    "r {r}: {mu} at {angle}"
                );
            }
        }
    }

    #[test]
    fn the_mirror_in_f32_follows() {
        for r in RADII {
            let inverse = inverse(r);
            let mirror = GpuInverseRow::new(&inverse);
            for i in 0..4000 {
                let angle = (PI - 7.0 * PI * f64::from(i) / 4000.0) as f32;
                let (image, theirs) = (inverse.image(angle.into()), mirror.image(angle));
                let [cos, sin] = theirs.cos_sin.map(f64::from);
                let (sin_theta, cos_theta) = image.theta.sin_cos();
                let off = (cos - cos_theta).hypot(sin - sin_theta);
                assert!(off < 1.5e-6, "r {r}, {angle}: {off:e}");
                let ratio = f64::from(theirs.radial_magnification) / image.radial_magnification;
                assert!((ratio - 1.0).abs() < 5e-5, "r {r}, {angle}: {ratio}");
            }
        }
    }

    #[test]
    fn an_observer_without_view_angles_has_none() {
        let row = default_atlas().row(Observer::at_infinity()).unwrap();
        assert_eq!(InverseRow::new(&row), Err(CoreError::NoViewAngle));
        let row_frame = Observer::falling(0.5).unwrap().in_row_frame();
        let row = default_atlas().row(row_frame).unwrap();
        assert_eq!(InverseRow::new(&row), Err(CoreError::NoViewAngle));
    }
}
