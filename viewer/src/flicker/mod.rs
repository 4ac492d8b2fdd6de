//! Whether stars flicker: in an orbit about the hole, the light of each star in each picture against the
//! analytic curve, by the point drawing and by two ways that know a star only as a texel of a sky.
//!
//! The curve shares nothing with what it judges but the camera and the stars' places: it is root-finding on
//! the closed form of the bending. Each star is drawn alone, before black, so that the sum over the picture
//! is its light and nothing else's.

mod choice;
mod closed_form;
pub mod csv;
mod curve;
mod departure;
pub mod figure;
mod gpu;
mod orbit;
pub mod report;
mod texel;
mod track;

pub use choice::{Subject, choose, closer_look};
pub use closed_form::{ExactImage, exact_image};
pub use curve::{Expected, expected};
pub use departure::Departure;
pub use gpu::point_on_gpu;
pub use orbit::Orbit;
pub use texel::{FACE_TEXELS, Texel, filtered_sky, nearest_sample};
pub use track::{BAR, Frame, TexelFrame, Track, follow};

use crate::camera::CameraError;
use crate::gpu::GpuError;
use crate::scene::SceneError;
use lensbake_core::CoreError;
use thiserror::Error;

/// Flicker that cannot be measured.
#[derive(Debug, Error)]
pub enum FlickerError {
    /// The camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The observer.
    #[error(transparent)]
    Observer(#[from] CoreError),
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// No star to look at.
    #[error("no star comes into the picture in this orbit: try a larger radius or more frames")]
    NoStar,
}
