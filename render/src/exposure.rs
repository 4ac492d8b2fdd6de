//! Automatic exposure: makes up for the brightness of the frequency shift.

use crate::lens::Lens;
use crate::shift::Shift;
use glam::DVec2;
use lensbake_core::RayOutcome;

/// Rays along each side of the picture.
const RAYS: u32 = 24;

/// The exposure, in stops, at which an evenly bright sky keeps its mean brightness in the picture of `lens` with this
/// frequency shift: minus the mean of log₂ g⁴ over the rays of the picture that see the sky. The mean of the logarithm, as
/// in a camera, is not dominated by a small bright patch ahead. If none of these rays sees the sky, the corners of the
/// picture count, which are the last to do so. 0 without shift, or if no ray sees the sky at all.
pub fn automatic(lens: &Lens, shift: Shift) -> f32 {
    if shift == Shift::Off {
        return 0.0;
    }
    let even = |i: u32| (f64::from(i) + 0.5) / f64::from(RAYS) - 0.5;
    let grid = (0..RAYS * RAYS).map(|i| DVec2::new(even(i % RAYS), even(i / RAYS)));
    let corners = [-0.5, 0.5].map(|x| [-0.5, 0.5].map(|y| DVec2::new(x, y)));
    let brightness = mean_brightness(lens, grid)
        .or_else(|| mean_brightness(lens, corners.into_iter().flatten()))
        .unwrap_or(0.0);
    -brightness as f32
}

/// The mean of log₂ g⁴ over the rays through `places` that see the sky, if any do. Places are in units of the picture's
/// width and height from its centre.
fn mean_brightness(lens: &Lens, places: impl Iterator<Item = DVec2>) -> Option<f64> {
    let camera = &lens.camera;
    let size = DVec2::new(camera.width.into(), camera.height.into());
    let (mut sum, mut count) = (0.0, 0.0);
    for place in places {
        if let RayOutcome::Escapes(ray) = lens.ray(camera.ray(place * size).normalize()) {
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
