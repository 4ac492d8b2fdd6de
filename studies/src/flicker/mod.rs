//! Flicker of stars: in an orbit about the hole or a fall into it, the light of each star in each picture compared with
//! the analytic curve. The star is drawn as a point, and in two ways as a texel of a sky.
//!
//! The analytic curve shares only the camera and the stars' positions with the pictures: it comes from
//! root-finding on the closed form of the bending. Each star is drawn alone before black, so that the sum over the
//! picture is its light.

mod analytic;
mod choice;
pub mod figure;
pub mod report;
mod texel;
mod track;

pub use analytic::{ExactImage, Expected, exact_image, expected};
pub use choice::{Subject, choose, closer_look};
pub use texel::{FACE_TEXELS, Texel, filtered_sky, nearest_sample};
pub use track::{BAR, Departure, FlickerFrame, TexelFrame, Track, follow, point_on_gpu};

use lensbake_core::{CoreError, Motion, geodesic};
use lensbake_render::camera::{Camera, CameraError, View};
use lensbake_render::gpu::GpuError;
use lensbake_render::lens::{Deflection, Lens, LensError};
use lensbake_render::shift::Shift;
use lensbake_tables::default_atlas;
use thiserror::Error;

/// Why flicker cannot be measured.
#[derive(Debug, Error)]
pub enum FlickerError {
    /// The camera is invalid.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The lens is invalid.
    #[error(transparent)]
    Lens(#[from] LensError),
    /// The observer is invalid.
    #[error(transparent)]
    Observer(#[from] CoreError),
    /// The GPU failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// No star comes into the picture.
    #[error(
        "no star comes into the picture in this flight: try a larger radius, another --yaw or more frames"
    )]
    NoStar,
}

/// A camera that moves about the hole or falls into it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// The view and the motion. In free fall each frame sets its own radius, the first one that of the view; in any other
    /// motion its own longitude, the first one 0.
    pub view: View,
    /// Number of frames.
    pub frames: u32,
}

/// Where a fall ends.
pub const FALL_END: f64 = 0.05;

impl Flight {
    /// The lenses of the frames, in order, with the built-in atlas. The frames of a fall are evenly spaced in proper time
    /// and end at [`FALL_END`].
    ///
    /// # Errors
    /// [`FlickerError`] if the view is not a valid camera.
    pub fn lenses(&self) -> Result<Vec<Lens>, FlickerError> {
        (0..self.frames).map(|frame| self.lens(frame)).collect()
    }

    fn lens(&self, frame: u32) -> Result<Lens, FlickerError> {
        let part = f64::from(frame) / f64::from(self.frames);
        let view = match self.view.motion {
            Motion::Fall => {
                let [start, end] = [self.view.radius, FALL_END].map(geodesic::fall_time);
                View {
                    radius: geodesic::fall_radius(start + part * (end - start)),
                    ..self.view
                }
            }
            _ => View {
                orbit_deg: 360.0 * part,
                ..self.view
            },
        };
        Ok(Lens::new(
            Camera::new(&view)?,
            default_atlas(),
            Deflection::Lut,
        )?)
    }
}

/// What of the frequency shift is measured: for a moving camera the brightness, which changes from frame to frame.
fn shift(lens: &Lens) -> Shift {
    let camera = &lens.camera;
    match camera.boost.is_none() && camera.observer.is_at_rest() {
        true => Shift::Off,
        false => Shift::Brightness,
    }
}
