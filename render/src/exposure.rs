//! Automatic exposure: makes up for the brightness of the frequency shift.

use crate::camera::Mapping;
use crate::lens::Lens;
use crate::shift::Shift;
use glam::DVec2;
use lensbake_core::RayOutcome;

/// Rays along each side of the picture.
const RAYS: u32 = 24;

/// The exposure, in stops, at which an evenly bright sky keeps its mean brightness in the picture of `lens` with this
/// frequency shift: minus the mean of log₂ g⁴ over the rays of the picture that see the sky. The mean of the logarithm, as
/// in a camera, is not dominated by a small bright patch ahead. If none of these rays sees the sky, the corners of the
/// picture count, or the rim of a fisheye, which are the last to do so. 0 without shift, or if no ray sees the sky at all.
pub fn automatic(lens: &Lens, shift: Shift) -> f32 {
    automatic_of_all(std::slice::from_ref(lens), shift)
}

/// As [`automatic`], one exposure for pictures that are shown together, such as the faces of a cube.
pub fn automatic_of_all(lenses: &[Lens], shift: Shift) -> f32 {
    if shift == Shift::Off {
        return 0.0;
    }
    let even = |i: u32| (f64::from(i) + 0.5) / f64::from(RAYS) - 0.5;
    let grid = (0..RAYS * RAYS).map(|i| DVec2::new(even(i % RAYS), even(i / RAYS)));
    let border = lenses
        .iter()
        .flat_map(|lens| border(lens).map(move |place| (lens, place)));
    let inside = lenses.iter().flat_map(|lens| {
        let shown = grid.clone().filter(|&place| is_shown(lens, place));
        shown.map(move |place| (lens, place))
    });
    let brightness = mean_brightness(inside)
        .or_else(|| mean_brightness(border))
        .unwrap_or(0.0);
    -brightness as f32
}

/// Whether a place is in the picture: for a fisheye, on its disc. Places are in units of the picture's width and height from
/// its centre.
fn is_shown(lens: &Lens, place: DVec2) -> bool {
    lens.camera.coverage_at(place * size(lens)) > 0.5
}

/// Width and height of the picture, pixels.
fn size(lens: &Lens) -> DVec2 {
    DVec2::new(lens.camera.width.into(), lens.camera.height.into())
}

/// The corners of a picture, or four places on the rim of a fisheye.
fn border(lens: &Lens) -> impl Iterator<Item = DVec2> {
    let aside = match lens.camera.mapping {
        Mapping::Equidistant => 0.5_f64.sqrt(),
        Mapping::Perspective | Mapping::Equirectangular => 1.0,
    };
    let side = [-0.5 * aside, 0.5 * aside];
    side.into_iter()
        .flat_map(move |x| side.map(|y| DVec2::new(x, y)))
}

/// The mean of log₂ g⁴ over the rays through these places of the pictures that see the sky, if any do.
fn mean_brightness<'a>(places: impl Iterator<Item = (&'a Lens, DVec2)>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for (lens, place) in places {
        let direction = lens.camera.ray(place * size(lens)).normalize();
        if let RayOutcome::Escapes(ray) = lens.ray(direction) {
            sum += 4.0 * ray.frequency_shift.log2();
            count += 1.0;
        }
    }
    (count > 0.0).then_some(sum / count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::lens::Deflection;
    use lensbake_core::Motion;
    use lensbake_tables::default_atlas;

    fn stops(radius: f64, motion: Motion, yaw_deg: f64, shift: Shift) -> f32 {
        let view = View {
            radius,
            motion,
            yaw_deg,
            ..View::default()
        };
        let lens = Lens::new(
            Camera::new(&view).unwrap(),
            default_atlas(),
            Deflection::Lut,
        );
        automatic(&lens.unwrap(), shift)
    }

    #[test]
    fn it_undoes_the_shift() {
        // At rest at r = 2 all light is √2 times as energetic: g⁴ = 4.
        assert!((stops(2.0, Motion::Rest, 180.0, Shift::Brightness) + 2.0).abs() < 1e-6);
        assert_eq!(stops(2.0, Motion::Rest, 180.0, Shift::Off), 0.0);
        let ahead = stops(3.0, Motion::Orbit, 90.0, Shift::Colour);
        let back = stops(3.0, Motion::Orbit, -90.0, Shift::Colour);
        assert!(ahead < -2.0 && back > 0.0, "{ahead} {back}");
        // Looking at the hole from deep inside, no ray sees the sky.
        assert_eq!(stops(0.1, Motion::Fall, 0.0, Shift::Colour), 0.0);
    }

    /// Until the sky is out of sight, its last light in the corners does not become a thousand times as bright.
    #[test]
    fn it_changes_steadily_until_no_sky_is_left() {
        let mut before = stops(1.0, Motion::Fall, 0.0, Shift::Brightness);
        let mut radius: f64 = 1.0;
        loop {
            radius *= 0.99;
            let now = stops(radius, Motion::Fall, 0.0, Shift::Brightness);
            let view = View {
                radius,
                motion: Motion::Fall,
                ..View::default()
            };
            let camera = Camera::new(&view).unwrap();
            let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
            if lens.ray(camera.direction(0, 0)) == RayOutcome::Captured {
                break;
            }
            assert!((now - before).abs() < 0.5, "{radius}: {before} {now}");
            before = now;
        }
        assert!(radius > 0.1 && before < -4.0, "{radius} {before}");
    }
}
