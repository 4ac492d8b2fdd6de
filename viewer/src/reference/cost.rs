//! What filtering costs: the filtered frame against the frame of one ray a pixel.

use super::StudyError;
use crate::camera::{Camera, View};
use crate::chart::{FrameTimes, interleaved};
use crate::gpu::{Output, Renderer};
use crate::scene::{Method, Sampling, Scene};
use lensbake_tables::default_atlas;
use std::fmt;

/// Frames of each kind that are timed.
const ROUNDS: u32 = 15;

/// The cost of one view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Radius of the camera.
    pub radius: f64,
    /// One ray a pixel.
    pub single: FrameTimes,
    /// The mean of all of a pixel.
    pub filtered: FrameTimes,
}

/// Times both samplings in turns at a camera of `radius` that looks at the hole, or at the edge of its
/// shadow below r = 3.
///
/// # Errors
/// [`StudyError`] if there is no such camera or the device fails.
pub fn cost(renderer: &Renderer, radius: f64, size: (u32, u32)) -> Result<Cost, StudyError> {
    let view = View {
        radius,
        yaw_deg: if radius < 3.0 { 80.0 } else { 0.0 },
        width: size.0,
        height: size.1,
        ..View::default()
    };
    let scene = Scene::new(Camera::new(&view)?, default_atlas(), Method::Lut)?;
    let single = renderer.prepare(&scene, Output::Picture);
    let filtered = renderer.prepare(&scene.sampled(Sampling::Filtered), Output::Picture);
    let frames = [single, filtered];
    let times = interleaved(
        renderer.gpu(),
        &frames,
        scene.camera.pixels(),
        ROUNDS,
        || (),
    )?;
    Ok(Cost {
        radius,
        single: times[0],
        filtered: times[1],
    })
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (single, filtered) = (self.single.best(), self.filtered.best());
        write!(
            f,
            "r = {:<5} one ray {:6.2} ns a pixel (spread {:.0} %), filtered {:6.2} ns ({:.0} %): {:.2} times",
            self.radius,
            single.ns,
            100.0 * single.spread,
            filtered.ns,
            100.0 * filtered.spread,
            filtered.ns / single.ns,
        )
    }
}
