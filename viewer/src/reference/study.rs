//! The filtered and the single-sampled picture against the reference, in the views that matter.

use super::{PictureError, on_gpu};
use crate::camera::{Camera, CameraError, View};
use crate::gpu::{GpuError, Renderer};
use crate::picture::Picture;
use crate::scene::{Method, Sampling, Scene, SceneError};
use lensbake_core::Observer;
use lensbake_tables::default_atlas;
use thiserror::Error;

/// Mean error on the screen that a filtered picture may have, 1/255.
const BAR_WHOLE: f64 = 1.0;
/// The same beside the shadow's edge.
const BAR_BESIDE_EDGE: f64 = 4.0;

/// A view that is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// What it is called.
    pub name: String,
    /// The view.
    pub view: View,
    /// Whether the bars hold for it.
    pub barred: bool,
}

/// A picture by one sampling, and its error.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The picture.
    pub picture: Picture,
    /// Its distance from the reference.
    pub error: PictureError,
}

/// What was found in one view.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The view.
    pub case: Case,
    /// The scene, sampled once a pixel.
    pub scene: Scene,
    /// The reference.
    pub reference: Picture,
    /// The mean of all of a pixel.
    pub filtered: Entry,
    /// One ray a pixel.
    pub single: Entry,
}

/// A study that cannot be made.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The camera, which no size in its range brings about.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// The views: the four of the seed report, for which the bars hold, one in which the shadow is more
/// than half of the sky, one far away, and one close up of the edge.
pub fn cases(width: u32, height: u32) -> Vec<Case> {
    let case = |name: &str, barred, radius, yaw_deg, fov_deg| Case {
        name: name.to_owned(),
        view: View {
            radius,
            yaw_deg,
            fov_deg,
            width,
            height,
            ..View::default()
        },
        barred,
    };
    let edge_at_10 = Observer::at(10.0).map_or(0.0, |o| o.edge_angle().to_degrees());
    vec![
        case("r = 50", true, 50.0, 0.0, 90.0),
        case("r = 10", true, 10.0, 0.0, 90.0),
        case("r = 5", true, 5.0, 0.0, 90.0),
        case("r = 2", true, 2.0, 80.0, 90.0),
        case("r = 1.2", false, 1.2, 140.0, 90.0),
        case("r = 1000", false, 1000.0, 0.0, 90.0),
        case("r = 10, 5° of the edge", false, 10.0, edge_at_10, 5.0),
    ]
}

/// Studies one view with `side` × `side` rays a pixel. `row_done` is called with the rows of the reference
/// done so far.
///
/// # Errors
/// [`StudyError`] if the size is none or the device fails.
pub fn study(
    renderer: &Renderer,
    case: Case,
    side: u32,
    row_done: impl Fn(u32),
) -> Result<Study, StudyError> {
    let scene = Scene::new(Camera::new(&case.view)?, default_atlas(), Method::Lut)?;
    let reference = on_gpu(renderer, &scene, side, row_done)?;
    let entry = |sampling| -> Result<Entry, GpuError> {
        let picture = renderer.picture(&scene.sampled(sampling), |_| ())?;
        Ok(Entry {
            error: PictureError::of(&scene, &picture, &reference),
            picture,
        })
    };
    Ok(Study {
        filtered: entry(Sampling::Filtered)?,
        single: entry(Sampling::Single)?,
        case,
        scene,
        reference,
    })
}

impl Study {
    /// Whether the filtered picture keeps the bars, if they hold for it.
    pub fn is_good(&self) -> bool {
        let error = &self.filtered.error;
        let kept = error.whole.screen <= BAR_WHOLE && error.beside_edge.screen <= BAR_BESIDE_EDGE;
        kept || !self.case.barred
    }
}
