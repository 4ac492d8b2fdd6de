//! Automatic exposure: makes up for the brightness of the frequency shift.

use crate::lens::Lens;
use crate::shift::Shift;
use lensbake_core::RayOutcome;

/// Rays along each side of the picture.
const RAYS: u32 = 24;

/// The exposure, in stops, at which an evenly bright sky keeps its mean brightness in the picture of `lens` with this
/// frequency shift: minus the mean of log₂ g⁴ over the rays of the picture that see the sky. The mean of the logarithm, as
/// in a camera, is not dominated by a small bright patch ahead. 0 without shift, or if no ray sees the sky.
pub fn automatic(lens: &Lens, shift: Shift) -> f32 {
    if shift == Shift::Off {
        return 0.0;
    }
    let camera = &lens.camera;
    let along = |i: u32, side: u32| (f64::from(i) + 0.5) / f64::from(RAYS) * f64::from(side);
    let middle = 0.5 * glam::DVec2::new(camera.width.into(), camera.height.into());
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..RAYS * RAYS {
        let at = glam::DVec2::new(
            along(i % RAYS, camera.width),
            along(i / RAYS, camera.height),
        );
        if let RayOutcome::Escapes(ray) = lens.ray(camera.ray(at - middle).normalize()) {
            sum += 4.0 * ray.frequency_shift.log2();
            count += 1.0;
        }
    }
    if count == 0.0 {
        0.0
    } else {
        (-sum / count) as f32
    }
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
}
