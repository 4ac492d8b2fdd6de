//! The colour of a star: the colour index gives a temperature, and the temperature gives the light of a black
//! body.

use glam::{DMat3, DVec3, Vec3};
use std::sync::LazyLock;

/// Range of colour indices; those outside are clamped.
const INDICES: (f64, f64) = (-0.4, 5.5);
const STEPS: usize = 256;

/// hc/k, K nm: the second radiation constant.
const HC_OVER_K: f64 = 1.438_776_877e7;

/// Linear sRGB of luminance 1, for colour indices evenly spaced over [`INDICES`].
static COLOURS: LazyLock<[Vec3; STEPS]> = LazyLock::new(|| {
    let (first, last) = INDICES;
    std::array::from_fn(|i| {
        let share = i as f64 / (STEPS - 1) as f64;
        black_body(temperature(first + share * (last - first))).as_vec3()
    })
});

/// The light of a star with colour index B − V, linear sRGB with luminance 1; white if the index is `None`.
pub fn light_of_colour_index(colour_index: Option<f64>) -> Vec3 {
    let Some(index) = colour_index else {
        return Vec3::ONE;
    };
    let (first, last) = INDICES;
    let place = (index.clamp(first, last) - first) / (last - first) * (STEPS - 1) as f64;
    let below = (place as usize).min(STEPS - 2);
    COLOURS[below].lerp(COLOURS[below + 1], (place - below as f64) as f32)
}

/// The light of a black body of this temperature in K, linear sRGB with luminance 1.
#[cfg(test)]
pub(crate) fn light_of_temperature(temperature: f64) -> Vec3 {
    black_body(temperature).as_vec3()
}

/// The temperature of a star of colour index B − V, K, for B − V > −0.6: from the ratio of a black body's light in
/// two filters (Ballesteros 2012, Europhys. Lett. 97, 34008).
pub fn temperature(colour_index: f64) -> f64 {
    let scaled = 0.92 * colour_index;
    4600.0 * (1.0 / (scaled + 1.7) + 1.0 / (scaled + 0.62))
}

/// The light of a black body, linear sRGB with luminance 1. Negative channels, of colours outside the sRGB gamut,
/// are set to 0.
fn black_body(temperature: f64) -> DVec3 {
    let rgb = (rgb_from_xyz() * xyz(temperature)).max(DVec3::ZERO);
    rgb / rgb.dot(LUMINANCE)
}

/// Weights of the linear sRGB channels in the luminance (IEC 61966-2-1).
const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// CIE 1931 tristimulus values of a black body by Planck's law, in arbitrary units.
fn xyz(temperature: f64) -> DVec3 {
    (0..=400)
        .map(|i| {
            let wavelength = 380.0 + f64::from(i);
            let radiance = wavelength.powi(-5) / (HC_OVER_K / (wavelength * temperature)).exp_m1();
            radiance * colour_matching(wavelength)
        })
        .sum()
}

/// The CIE 1931 colour matching functions at `wavelength` in nm, as sums of Gaussians, each with two widths
/// (Wyman, Sloan & Shirley 2013, J. Comput. Graph. Tech. 2, 1).
fn colour_matching(wavelength: f64) -> DVec3 {
    let lobe = |height: f64, middle: f64, below: f64, above: f64| {
        let width = if wavelength < middle { below } else { above };
        height * (-0.5 * ((wavelength - middle) / width).powi(2)).exp()
    };
    DVec3::new(
        lobe(1.056, 599.8, 37.9, 31.0)
            + lobe(0.362, 442.0, 16.0, 26.7)
            + lobe(-0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    )
}

/// From CIE XYZ to linear sRGB (IEC 61966-2-1).
fn rgb_from_xyz() -> DMat3 {
    DMat3::from_cols(
        DVec3::new(3.2406, -0.9689, 0.0557),
        DVec3::new(-1.5372, 1.8758, -0.2040),
        DVec3::new(-0.4986, 0.0415, 1.0570),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chromaticities of black bodies: that at 2856 K is CIE illuminant A, the others are tabulated points of the
    /// Planckian locus (Wyszecki & Stiles 1982).
    #[test]
    fn black_bodies_have_their_known_chromaticity() {
        for (kelvin, x, y) in [
            (2856.0, 0.4476, 0.4074),
            (5000.0, 0.3451, 0.3516),
            (10_000.0, 0.2806, 0.2883),
        ] {
            let xyz = xyz(kelvin);
            let chromaticity = xyz / xyz.element_sum();
            let off = (chromaticity.x - x).hypot(chromaticity.y - y);
            assert!(off < 0.003, "{kelvin} K: {chromaticity}");
        }
    }

    #[test]
    fn the_sun_has_its_temperature_and_colours_their_luminance() {
        assert!((temperature(0.65) - 5778.0).abs() < 60.0);
        assert!((temperature(0.0) - 10_000.0).abs() < 200.0);
        for index in [-9.0, -0.3, 0.0, 0.6, 1.5, 3.0, 99.0] {
            let light = light_of_colour_index(Some(index));
            let luminance = light.as_dvec3().dot(LUMINANCE);
            assert!((luminance - 1.0).abs() < 1e-3, "{index}: {light}");
            assert!(light.min_element() >= 0.0, "{index}: {light}");
        }
        assert_eq!(light_of_colour_index(None), Vec3::ONE);
    }

    #[test]
    fn hot_stars_are_blue_and_cool_stars_are_red() {
        let ratio = |index| {
            let light = light_of_colour_index(Some(index));
            light.z / light.x
        };
        assert!(
            ratio(-0.2) > 1.5 && ratio(1.5) < 0.5,
            "{} {}",
            ratio(-0.2),
            ratio(1.5)
        );
        for i in -3..20 {
            let index = f64::from(i) * 0.1;
            assert!(ratio(index) > ratio(index + 0.1), "{index}");
        }
    }
}
