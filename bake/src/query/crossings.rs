//! Where the ray of a question crosses a thin disc.

use super::{Answers, QueryMethod, Question};
use lensbake_core::disc_crossing::{Crossing, TracedRay};
use lensbake_core::rk4::Stepper;
use lensbake_core::{Ray, RayOutcome, ThinDisc, direct, exact};
use lensbake_tables::TableError;
use lensbake_tables::baking::ObservedRay;

impl Answers<'_> {
    /// The crossings of the ray with `disc`, in the order in which the traced ray meets them, two at most. The orbital
    /// angles to infinity are those of the method, the radius that of the closed form of the orbit.
    ///
    /// # Errors
    /// As [`Answers::answer`].
    pub fn crossings(
        &mut self,
        question: &Question,
        disc: &ThinDisc,
    ) -> Result<Vec<Crossing>, TableError> {
        let Question { ray, observed, .. } = *question;
        let traced = TracedRay {
            inv_b: ray.inverse_impact_parameter(),
            azimuth: question.azimuth,
            phi_infinity: self.phi_infinity(&ray, observed)?.escaped(),
            observer_phase: match ray.enters(disc) {
                true => self.observer_phase(observed)?,
                false => None,
            },
            shift: question.shift,
        };
        Ok(disc.crossings(&traced).collect())
    }

    /// φ_∞ of the ray that leaves in the opposite direction, rad; 0 at infinity.
    fn observer_phase(&mut self, ray: ObservedRay) -> Result<Option<f64>, TableError> {
        if ray.observer.is_at_infinity() {
            return Ok(Some(0.0));
        }
        let observer = ray.observer.in_row_frame();
        let at = observer.opposite(ray.at);
        let opposite = ObservedRay { observer, at };
        Ok(self.phi_infinity(&observer.ray_at(at), opposite)?.escaped())
    }

    /// φ_∞, the orbital angle of `ray` to infinity, rad. `observed` is the same ray.
    fn phi_infinity(&mut self, ray: &Ray, observed: ObservedRay) -> Result<RayOutcome, TableError> {
        Ok(match self.method {
            QueryMethod::Lookup(table) => {
                let ObservedRay { observer, at } = observed;
                let observer = observer.in_row_frame();
                // π − θ, without a difference.
                let from_outward = 2.0 * at.x.atan2(observer.tan_half_shadow());
                self.look_up(table, ObservedRay { observer, at })?
                    .map(|bend| from_outward + bend)
            }
            QueryMethod::Rk4(tolerance) => direct::phi_infinity(ray, Stepper::Adaptive(tolerance)),
            QueryMethod::Exact => exact::phi_infinity(ray),
        })
    }
}
