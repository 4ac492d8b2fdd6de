//! The filtered and the single-sampled picture compared with the reference, in several views.

use super::{PictureError, on_gpu};
use lensbake_core::{Motion, Observer};
use lensbake_render::camera::{Camera, CameraError, View};
use lensbake_render::disc::DiscError;
use lensbake_render::gpu::{GpuError, Renderer};
use lensbake_render::lens::{Deflection, Lens, LensError};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::Sky;
use lensbake_tables::default_atlas;
use std::sync::Arc;
use thiserror::Error;

/// Largest mean error on the screen that a filtered picture may have, 1/255.
const BAR_WHOLE: f64 = 1.0;
/// As [`BAR_WHOLE`], beside the shadow's edge.
const BAR_BESIDE_EDGE: f64 = 4.0;

/// A view to measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Name.
    pub name: String,
    /// The view.
    pub view: View,
    /// Whether the limits of the error apply to it.
    pub barred: bool,
}

/// A picture by one sampling, and its error.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledPicture {
    /// The picture.
    pub picture: Picture,
    /// Its error against the reference.
    pub error: PictureError,
}

/// The result for one view.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The view.
    pub case: Case,
    /// The lens.
    pub lens: Lens,
    /// The reference picture.
    pub reference: Picture,
    /// The picture of the mean over each pixel.
    pub filtered: SampledPicture,
    /// The same by the anisotropic filter of the hardware.
    pub anisotropic: SampledPicture,
    /// The picture of one ray per pixel.
    pub single: SampledPicture,
}

/// Why a study cannot be made.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The camera is invalid; with an allowed size none is.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The lens is invalid.
    #[error(transparent)]
    Lens(#[from] LensError),
    /// The disc is invalid.
    #[error(transparent)]
    Disc(#[from] DiscError),
    /// The GPU failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// The views: the four of the bholetrace report, to which the limits of the error apply; one in which the shadow
/// is more than half of the sky; one far away; one close-up of the shadow's edge; and moving cameras at the horizon, below
/// it, in orbit and below the horizon under way, to which the limits apply as well.
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
    let moving = |name: &str, radius, motion, yaw_deg| {
        let at_rest = case(name, true, radius, yaw_deg, 90.0);
        Case {
            view: View {
                motion,
                ..at_rest.view
            },
            ..at_rest
        }
    };
    let sideways = Motion::Velocity {
        radial: 0.0,
        tangential: 0.3,
    };
    let edge_at_10 = Observer::at(10.0).map_or(0.0, |o| o.shadow_angle().to_degrees());
    vec![
        case("r = 50", true, 50.0, 0.0, 90.0),
        case("r = 10", true, 10.0, 0.0, 90.0),
        case("r = 5", true, 5.0, 0.0, 90.0),
        case("r = 2", true, 2.0, 80.0, 90.0),
        case("r = 1.2", false, 1.2, 140.0, 90.0),
        case("r = 1000", false, 1000.0, 0.0, 90.0),
        case("r = 10, 5° of the edge", false, 10.0, edge_at_10, 5.0),
        moving("falling, r = 1", 1.0, Motion::Fall, 40.0),
        moving("falling, r = 0.3", 0.3, Motion::Fall, 90.0),
        moving("in orbit, r = 3", 3.0, Motion::Orbit, 60.0),
        moving("0.3 c sideways, r = 0.7", 0.7, sideways, 60.0),
    ]
}

/// Studies one view of `sky`, against a reference of `side` × `side` rays per pixel. `row_done` is called with the
/// number of rows of the reference done so far.
///
/// # Errors
/// [`StudyError`] if no camera has this size or the device fails.
pub async fn study(
    renderer: &Renderer,
    sky: &Arc<Sky>,
    case: Case,
    side: u32,
    row_done: impl Fn(u32),
) -> Result<Study, StudyError> {
    let lens = Lens::new(Camera::new(&case.view)?, default_atlas(), Deflection::Lut)?;
    let scene = Scene::new(lens, sky.clone());
    let reference = on_gpu(renderer, &scene, side, row_done).await?;
    let sampled = async |sampling| {
        let picture = renderer
            .picture(&scene.clone().with_sampling(sampling), |_| ())
            .await?;
        Ok::<_, GpuError>(SampledPicture {
            error: PictureError::of(&scene.lens, &picture, &reference),
            picture,
        })
    };
    Ok(Study {
        filtered: sampled(Sampling::Filtered).await?,
        anisotropic: sampled(Sampling::Anisotropic).await?,
        single: sampled(Sampling::Single).await?,
        case,
        lens: scene.lens.clone(),
        reference,
    })
}

impl Study {
    /// Whether the filtered picture is within the limits of the error, or they do not apply.
    pub fn is_good(&self) -> bool {
        let error = &self.filtered.error;
        let kept = error.whole.screen <= BAR_WHOLE && error.beside_edge.screen <= BAR_BESIDE_EDGE;
        kept || !self.case.barred
    }
}
