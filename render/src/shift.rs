//! The frequency shift of the light of the sky, and how it is shown. Reference of `shaders/shift_*.wgsl`.
//!
//! Light of the sky arrives with the frequency ratio g = ν_obs/ν_∞ (gravitational and Doppler shift). The intensity per
//! frequency over the cube of the frequency is invariant along a ray, so a black body of temperature T is seen as one of
//! temperature gT, and its total intensity changes by g⁴.
//!
//! **Colour.** A pixel of an RGB sky has no spectrum. The model is: its light is that of a black body in Wien's
//! approximation, with the temperature of its ratio of blue to red, at the wavelengths 610, 550 and 465 nm of the three
//! channels; white is 6500 K. The shift multiplies the temperature by g, which multiplies each channel by
//! exp(−(c₂/λ)(1/g − 1)/T), and the result is scaled so that the luminance changes by g⁴. Stars, whose colours are
//! those of black bodies, follow the same model.

use glam::Vec3;
use std::ops::RangeInclusive;

/// What of the frequency shift is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Shift {
    /// Nothing.
    #[default]
    Off,
    /// The brightness: light is multiplied by g⁴.
    Brightness,
    /// The brightness and the colour: temperatures are multiplied by g.
    Colour,
}

/// How light of the sky becomes light of the picture: what of the frequency shift is shown, and a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rendition {
    /// What of the frequency shift is shown.
    pub shift: Shift,
    /// Factor of all light, to make up for the brightness of the shift ([`crate::exposure::automatic`]) before the
    /// picture is stored in 16-bit floats and before faint images of stars are left out. Without shift it is not used.
    pub light_scale: f32,
}

impl Default for Rendition {
    /// Without frequency shift.
    fn default() -> Self {
        Rendition::of(Shift::Off)
    }
}

impl Rendition {
    /// The rendition of this shift, with all of its brightness.
    pub const fn of(shift: Shift) -> Self {
        Rendition {
            shift,
            light_scale: 1.0,
        }
    }

    /// The linear RGB light that is seen of `light` with the frequency shift that `g` returns. `g` is called only when
    /// the shift is drawn.
    pub fn seen(self, light: Vec3, g: impl FnOnce() -> f64) -> Vec3 {
        match self.shift {
            Shift::Off => light,
            shift => shift.seen(light, g()) * self.light_scale,
        }
    }

    /// Upper bound on the factor by which a channel of light changes that has a frequency shift of at most `g`.
    pub fn largest_factor(self, g: f64) -> f64 {
        match self.shift {
            Shift::Off => 1.0,
            shift => shift.largest_factor(g) * f64::from(self.light_scale),
        }
    }
}

/// Second radiation constant c₂ = hc/k, nm K.
const C2: f64 = 1.438_777e7;
/// Wavelengths of the channels, nm.
const WAVELENGTHS: [f64; 3] = [610.0, 550.0, 465.0];
/// Temperature of white, K.
pub(crate) const WHITE_KELVIN: f64 = 6500.0;
/// Range of temperatures of the model, K.
pub(crate) const KELVINS: RangeInclusive<f64> = 1000.0..=40_000.0;
/// A channel counts as at least this part of the luminance when a temperature is estimated.
pub(crate) const DARKEST: f64 = 1e-3;

/// Luminance of linear sRGB.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// c₂ (1/λ_green − 1/λ_red), K.
pub(crate) const fn green_over_red() -> f64 {
    C2 / WAVELENGTHS[1] - C2 / WAVELENGTHS[0]
}

/// c₂ (1/λ_blue − 1/λ_red), K.
pub(crate) const fn blue_over_red() -> f64 {
    C2 / WAVELENGTHS[2] - C2 / WAVELENGTHS[0]
}

impl Shift {
    /// Name of the kind.
    pub fn name(self) -> &'static str {
        match self {
            Shift::Off => "off",
            Shift::Brightness => "brightness",
            Shift::Colour => "colour",
        }
    }

    /// The linear RGB light that is seen of `light` with the frequency shift `g`.
    pub fn seen(self, light: Vec3, g: f64) -> Vec3 {
        match self {
            Shift::Off => light,
            Shift::Brightness => light * g.powi(4) as f32,
            Shift::Colour => recoloured(light, g),
        }
    }

    fn largest_factor(self, g: f64) -> f64 {
        match self {
            Shift::Off => 1.0,
            Shift::Brightness => g.powi(4),
            // All luminance in the channel that has the least part in it.
            Shift::Colour => g.powi(4) / f64::from(LUMINANCE.min_element()),
        }
    }
}

fn recoloured(light: Vec3, g: f64) -> Vec3 {
    let before = f64::from(light.dot(LUMINANCE));
    if before.is_nan() || before <= 0.0 {
        return Vec3::ZERO;
    }
    let change = (1.0 / g - 1.0) / temperature(light);
    let [red, green, blue] = light.to_array().map(f64::from);
    let shifted = [
        red,
        green * (-green_over_red() * change).exp(),
        blue * (-blue_over_red() * change).exp(),
    ];
    let after: f64 = (0..3).map(|i| f64::from(LUMINANCE[i]) * shifted[i]).sum();
    let scale = before * g.powi(4) / after.max(1e-30);
    Vec3::from_array(shifted.map(|channel| (channel * scale) as f32))
}

/// The light of a black body of this temperature, K, in linear RGB with luminance 1, by the model of this module.
/// Temperatures outside [`KELVINS`] have the colour of the nearest inside.
pub(crate) fn black_body(kelvin: f64) -> Vec3 {
    // NaN, of matter without light, counts as cold.
    let inverse = (1.0 / kelvin)
        .min(1.0 / KELVINS.start())
        .max(1.0 / KELVINS.end());
    let change = inverse - 1.0 / WHITE_KELVIN;
    let light =
        [0.0, green_over_red(), blue_over_red()].map(|factor| (-factor * change).exp() as f32);
    let light = Vec3::from_array(light);
    light / light.dot(LUMINANCE)
}

/// Temperature of the black body whose ratio of blue to red is that of `light`, K.
fn temperature(light: Vec3) -> f64 {
    let least = DARKEST * f64::from(light.dot(LUMINANCE));
    let [red, _, blue] = light
        .to_array()
        .map(|channel| f64::from(channel).max(least));
    let inverse = 1.0 / WHITE_KELVIN - (blue / red).ln() / blue_over_red();
    1.0 / inverse.clamp(1.0 / KELVINS.end(), 1.0 / KELVINS.start())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stars::colour::light_of_temperature;

    #[test]
    fn no_shift_changes_nothing_and_luminance_goes_as_the_fourth_power() {
        for light in [
            Vec3::ONE,
            Vec3::new(0.9, 0.5, 0.2),
            Vec3::new(0.0, 0.0, 3.0),
            Vec3::new(1.0, 0.0, 0.0),
        ] {
            for shift in [Shift::Off, Shift::Brightness, Shift::Colour] {
                assert!((shift.seen(light, 1.0) - light).length() < 1e-6 * light.length());
            }
            for g in [0.01, 0.3, 0.9, 2.0, 30.0] {
                let seen = Shift::Colour.seen(light, g);
                let ratio = f64::from(seen.dot(LUMINANCE)) / f64::from(light.dot(LUMINANCE));
                assert!(
                    (ratio / g.powi(4) - 1.0).abs() < 1e-5,
                    "{light} {g}: {ratio}"
                );
                assert!(
                    f64::from(seen.max_element())
                        <= f64::from(light.max_element().max(light.dot(LUMINANCE)))
                            * Shift::Colour.largest_factor(g)
                            * 1.0001
                );
            }
        }
        assert_eq!(Shift::Colour.seen(Vec3::ZERO, 2.0), Vec3::ZERO);
    }

    /// The model against the spectrum: a black body at gT by the CIE's colour matching functions.
    #[test]
    fn black_bodies_keep_the_colour_of_their_temperature() {
        for kelvin in [3500.0, 5000.0, 6500.0, 10_000.0] {
            for g in [0.6, 0.8, 1.25, 1.6] {
                let seen = Shift::Colour.seen(light_of_temperature(kelvin), g);
                let known = light_of_temperature(g * kelvin);
                let chromaticity = |light: Vec3| light / light.element_sum();
                let off = (chromaticity(seen) - chromaticity(known)).length();
                assert!(off < 0.06, "{kelvin} K, {g}: {off}: {seen} {known}");
            }
        }
    }
}
