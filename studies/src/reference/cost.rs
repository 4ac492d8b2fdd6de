//! The cost of filtering: the time of a filtered frame compared with that of one ray per pixel.

use super::StudyError;
use crate::gpu_time::{FrameTimes, interleaved};
use lensbake_render::camera::{Camera, View};
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::Sky;
use lensbake_tables::default_atlas;
use std::fmt;
use std::sync::Arc;

/// Timed frames of each sampling.
const ROUNDS: u32 = 15;

/// Frame times of one view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Radius of the camera, units of r_s.
    pub radius: f64,
    /// One ray per pixel.
    pub single: FrameTimes,
    /// The mean over each pixel.
    pub filtered: FrameTimes,
    /// The same by the anisotropic filter of the hardware.
    pub anisotropic: FrameTimes,
}

/// Times the samplings in turns, at a camera of `radius` that looks at the hole, or below r = 3 at the edge of
/// its shadow.
///
/// # Errors
/// [`StudyError`] if there is no such camera or the device fails.
pub async fn cost(
    renderer: &Renderer,
    sky: &Arc<Sky>,
    radius: f64,
    size: (u32, u32),
) -> Result<Cost, StudyError> {
    let view = View {
        radius,
        yaw_deg: if radius < 3.0 { 80.0 } else { 0.0 },
        width: size.0,
        height: size.1,
        ..View::default()
    };
    let lens = Lens::new(Camera::new(&view)?, default_atlas(), Deflection::Lut)?;
    let scene = renderer.upload(&Scene::new(lens, sky.clone())).await?;
    let rays = scene.lens.camera.pixels();
    let frames = [Sampling::Single, Sampling::Filtered, Sampling::Anisotropic]
        .map(|sampling| renderer.prepare(&scene.clone().with_sampling(sampling)));
    let times = interleaved(renderer.gpu(), &frames, rays, ROUNDS, || ()).await?;
    Ok(Cost {
        radius,
        single: times[0],
        filtered: times[1],
        anisotropic: times[2],
    })
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (single, filtered) = (self.single.best(), self.filtered.best());
        let anisotropic = self.anisotropic.best();
        write!(
            f,
            "r = {:<5} one ray {:6.2} ns per pixel (spread {:.0} %), filtered {:6.2} ns ({:.0} %): {:.2} times, \
             anisotropic {:6.2} ns ({:.0} %): {:.2} times",
            self.radius,
            single.ns,
            100.0 * single.spread,
            filtered.ns,
            100.0 * filtered.spread,
            filtered.ns / single.ns,
            anisotropic.ns,
            100.0 * anisotropic.spread,
            anisotropic.ns / single.ns,
        )
    }
}
