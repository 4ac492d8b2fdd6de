//! The light of a disc.

use super::Disc;
use crate::shift::{Shift, black_body};
use glam::Vec3;
use lensbake_core::accretion::flux;

impl Disc {
    /// The linear RGB light of the disc at radius `r`, seen with the frequency shift `g` = ν_obs/ν_em, without its opacity.
    /// Its luminance is [`Disc::brightness`] times Page and Thorne's flux relative to the greatest, times g⁴ if the shift
    /// is shown; its colour is that of a black body, at g times its temperature if the colour is shown.
    pub fn light(&self, r: f64, g: f64) -> Vec3 {
        let flux = flux(r);
        let luminance = match self.shift {
            Shift::Off => flux,
            Shift::Brightness | Shift::Colour => flux * g.powi(4),
        };
        let kelvin = self.peak_kelvin * flux.sqrt().sqrt();
        let seen = match self.shift {
            Shift::Off | Shift::Brightness => kelvin,
            Shift::Colour => g * kelvin,
        };
        black_body(seen) * (self.brightness * luminance) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_core::accretion::BRIGHTEST_RADIUS;

    #[test]
    fn a_disc_at_the_temperature_of_white_is_white_where_it_is_hottest() {
        let disc = Disc {
            peak_kelvin: 6500.0,
            shift: Shift::Off,
            ..Disc::default()
        };
        let light = disc.light(BRIGHTEST_RADIUS, 2.0);
        assert!((light - Vec3::ONE).length() < 1e-5, "{light}");
        let farther = disc.light(10.0, 2.0);
        assert!(farther.x > farther.y && farther.y > farther.z);
        assert_eq!(disc.light(3.0, 1.0), Vec3::ZERO);
    }

    #[test]
    fn the_shift_brightens_by_its_fourth_power() {
        let disc = |shift| Disc {
            shift,
            ..Disc::default()
        };
        let luminance = |light: Vec3| light.dot(Vec3::new(0.2126, 0.7152, 0.0722));
        let unshifted = disc(Shift::Off).light(5.0, 1.3);
        let brighter = disc(Shift::Brightness).light(5.0, 1.3);
        let bluer = disc(Shift::Colour).light(5.0, 1.3);
        for light in [brighter, bluer] {
            assert!((luminance(light) / luminance(unshifted) - 1.3f32.powi(4)).abs() < 1e-4);
        }
        assert!(bluer.z / bluer.x > 1.2 * brighter.z / brighter.x);
    }
}
