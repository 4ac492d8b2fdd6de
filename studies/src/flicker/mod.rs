//! Flicker of stars: in an orbit about the hole, the light of each star in each picture compared with the analytic
//! curve. The star is drawn as a point, and in two ways as a texel of a sky.
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

use lensbake_core::CoreError;
use lensbake_render::camera::{Camera, CameraError, View};
use lensbake_render::gpu::GpuError;
use lensbake_render::lens::{Deflection, Lens, LensError};
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
    #[error("no star comes into the picture in this orbit: try a larger radius or more frames")]
    NoStar,
}

/// A camera on a circular orbit about the hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// The view; each frame sets its own longitude, the first one 0.
    pub view: View,
    /// Number of frames.
    pub frames: u32,
}

impl Orbit {
    /// The lenses of the frames, in order, with the built-in atlas.
    ///
    /// # Errors
    /// [`FlickerError`] if the view is not a valid camera.
    pub fn lenses(&self) -> Result<Vec<Lens>, FlickerError> {
        (0..self.frames).map(|frame| self.lens(frame)).collect()
    }

    fn lens(&self, frame: u32) -> Result<Lens, FlickerError> {
        let camera = Camera::new(&View {
            orbit_deg: 360.0 * f64::from(frame) / f64::from(self.frames),
            ..self.view
        })?;
        Ok(Lens::new(camera, default_atlas(), Deflection::Lut)?)
    }
}
