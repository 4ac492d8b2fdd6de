//! Where a ray crosses the plane of a thin disc, and the frequency shift of the light that comes from there.
//!
//! A ray traced backwards from the observer is, at the orbital angle φ from him, at the point r(φ) (cos φ Z + sin φ e),
//! with Z the direction from the hole to the observer and e = (cos α, sin α, 0) by the azimuth α of the ray's plane. With n
//! the axis of the disc, it crosses the plane of the disc where
//!
//! ```text
//! n_z cos φ + (n·e) sin φ = 0:     φ = φ₁ + kπ,     0 < φ₁ ≤ π,     k = 0, 1, 2, …
//! ```
//!
//! k is the *image order*: the number of half turns that the ray has completed, 0 for the direct image and 1 for the
//! secondary one. An observer in the plane of the disc is at φ = 0, which is no crossing; a ray within that plane has
//! none at all, since the disc is infinitely thin.
//!
//! No ray turns by half a turn outside r = 3. So only the first crossing can be in the disc on the way in, and only the
//! last one on the way out: at most two ([`ThinDisc::crossings`]). The radius is that of [`orbit::inverse_radius`] at the
//! phase ψ, which is φ_∞ − φ on the way out, and φ + ψ_o on the way in, with ψ_o the phase of the observer.

use crate::accretion::emitted_frequency;
use crate::{Observer, Ray, ShadowCoordinate, ThinDisc, exact, orbit};
use std::f64::consts::PI;

/// What the crossings of a ray depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracedRay {
    /// 1/b, in units of 1/r_s.
    pub inv_b: f64,
    /// Azimuth α of its plane about the direction of the hole, from the X axis of [`ThinDisc`] towards its Y axis, rad.
    pub azimuth: f64,
    /// φ_∞, the orbital angle between the observer and infinity, rad; `None` if the ray is captured.
    pub phi_infinity: Option<f64>,
    /// The phase ψ_o of the observer (rad) if the ray leaves inwards and he is outside the inner radius of the disc: φ_∞ of
    /// the ray that leaves in the opposite direction, 0 at infinity. `None` otherwise.
    pub observer_phase: Option<f64>,
    /// ν_obs/ν_∞ of light of the sky that comes along this ray.
    pub shift: f64,
}

/// A point where a ray crosses a disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Orbital angle φ from the observer, rad.
    pub phi: f64,
    /// Radius in units of r_s.
    pub radius: f64,
    /// Image order k: the number of half turns completed, with φ in (kπ, (k+1)π].
    pub order: u32,
    /// ν_obs/ν_em: the frequency at the observer over that at which the matter of the disc emits.
    pub shift: f64,
}

impl TracedRay {
    /// The ray that `observer` sees at the normalised shadow coordinate `at` and at `azimuth` (rad), with its orbital
    /// angles in closed form, for the crossings with `disc`.
    ///
    /// ```
    /// use lensbake_core::ThinDisc;
    /// use lensbake_core::disc_crossing::TracedRay;
    /// use lensbake_core::{Observer, ShadowCoordinate};
    ///
    /// // From far away the side of the innermost stable orbit, r = 3, is seen at the impact parameter 3.466.
    /// let disc = ThinDisc::new(3.0, 12.0, 80.0, 0.0).unwrap();
    /// let at = ShadowCoordinate::from_b(3.466_075);
    /// let ray = TracedRay::in_closed_form(&disc, &Observer::at_infinity(), at, 0.0);
    /// let image = disc.crossings(&ray).next().unwrap();
    /// assert!((image.radius - 3.0).abs() < 1e-5 && image.order == 0);
    /// ```
    pub fn in_closed_form(
        disc: &ThinDisc,
        observer: &Observer,
        at: ShadowCoordinate,
        azimuth: f64,
    ) -> Self {
        let ray = observer.ray_at(at);
        let phi = |ray: &Ray| exact::phi_infinity(ray).escaped();
        let phase = |observer: &Observer| match observer.is_at_infinity() {
            true => Some(0.0),
            false => phi(&observer.ray_at(observer.opposite(at))),
        };
        TracedRay {
            inv_b: ray.inv_b,
            azimuth,
            phi_infinity: phi(&ray),
            observer_phase: ray.enters(disc).then(|| phase(observer)).flatten(),
            shift: observer.frequency_shift(ray.theta),
        }
    }
}

impl Ray {
    /// Whether an observer at this ray's start who is outside the inner radius of `disc` has the way in before him, so
    /// that [`TracedRay::observer_phase`] is needed.
    pub fn enters(&self, disc: &ThinDisc) -> bool {
        self.du_dphi > 0.0 && self.u * disc.inner() < 1.0
    }

    /// 1/b, in units of 1/r_s.
    pub fn inverse_impact_parameter(&self) -> f64 {
        self.inv_b
    }
}

impl ThinDisc {
    /// The crossings of `ray` with the disc, in the order in which the traced ray meets them: at most one on the way in and
    /// one on the way out.
    pub fn crossings(&self, ray: &TracedRay) -> impl Iterator<Item = Crossing> + use<> {
        [self.on_the_way_in(ray), self.on_the_way_out(ray)]
            .into_iter()
            .flatten()
    }

    fn on_the_way_in(&self, ray: &TracedRay) -> Option<Crossing> {
        let (first, start) = (self.first_angle(ray)?, ray.observer_phase?);
        let before_periapsis = ray
            .phi_infinity
            .is_none_or(|end| first <= periapsis(end, start));
        self.crossing(ray, 0, first, first + start)
            .filter(|_| before_periapsis)
    }

    fn on_the_way_out(&self, ray: &TracedRay) -> Option<Crossing> {
        let (first, end) = (self.first_angle(ray)?, ray.phi_infinity?);
        let order = ((end - first) / PI).ceil() - 1.0;
        let last = first + order * PI;
        let after_periapsis = ray
            .observer_phase
            .is_none_or(|start| last > periapsis(end, start));
        (order >= 0.0 && after_periapsis)
            .then(|| self.crossing(ray, order as u32, last, end - last))
            .flatten()
    }

    /// φ₁, the first orbital angle above 0 in the plane of the disc; `None` if the ray is radial or within that plane.
    fn first_angle(&self, ray: &TracedRay) -> Option<f64> {
        let [x, y, z] = self.axis();
        let (sin, cos) = ray.azimuth.sin_cos();
        let along = x * cos + y * sin;
        if ray.inv_b.is_infinite() || (z == 0.0 && along == 0.0) {
            return None;
        }
        let angle = z.abs().atan2(if z < 0.0 { along } else { -along });
        Some(if z == 0.0 { PI } else { angle })
    }

    /// The crossing at the orbital angle `phi` and at `phase` from infinity, if it lies in the disc.
    fn crossing(&self, ray: &TracedRay, order: u32, phi: f64, phase: f64) -> Option<Crossing> {
        // Beyond the phase of the inner edge the ray is inside it, or past the horizon. A ray that does not reach the inner
        // edge has no such phase.
        let is_outside =
            orbit::phase(ray.inv_b, 1.0 / self.inner()).is_none_or(|edge| phase <= edge);
        let radius = 1.0 / orbit::inverse_radius(ray.inv_b, phase);
        (is_outside && (self.inner()..=self.outer()).contains(&radius)).then(|| Crossing {
            phi,
            radius,
            order,
            shift: ray.shift / emitted_frequency(radius, self.angular_momentum(ray)),
        })
    }

    /// The angular momentum of the light about the axis of the disc, over its energy: b (e × Z)·n, units of r_s.
    fn angular_momentum(&self, ray: &TracedRay) -> f64 {
        let [x, y, _] = self.axis();
        let (sin, cos) = ray.azimuth.sin_cos();
        (x * sin - y * cos) / ray.inv_b
    }
}

/// The orbital angle of the periapsis of a ray from `observer_phase` before it to `phi_infinity` after it, rad.
fn periapsis(phi_infinity: f64, observer_phase: f64) -> f64 {
    0.5 * (phi_infinity - observer_phase)
}

#[cfg(test)]
mod tests;
