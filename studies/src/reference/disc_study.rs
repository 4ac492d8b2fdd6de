//! Pictures of a scene with a disc compared with their reference, in several views.

use super::error::screen_error;
use super::figure::Row;
use super::{DiscReference, MeanError, PictureError, StudyError};
use lensbake_core::Motion;
use lensbake_render::camera::{Camera, View};
use lensbake_render::cpu;
use lensbake_render::disc::{Disc, Orientation};
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::Sky;
use lensbake_tables::default_atlas;
use std::sync::Arc;

/// Inclinations at which every view is measured, degrees.
const INCLINATIONS_DEG: [f64; 6] = [0.0, 30.0, 60.0, 80.0, 89.0, 90.0];
/// Largest mean error on the screen that a filtered picture may have, 1/255.
const BAR_WHOLE: f64 = 1.0;
/// As [`BAR_WHOLE`], beside the shadow's edge. The error on the disc's rims has no limit.
const BAR_BESIDE_EDGE: f64 = 4.0;

/// A view of a disc.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscCase {
    /// Name.
    pub name: String,
    /// The view.
    pub view: View,
    /// The disc.
    pub disc: Disc,
}

/// What draws a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnBy {
    /// The mean over each pixel, by the GPU.
    FilteredOnGpu,
    /// The same by the CPU.
    FilteredOnCpu,
    /// One ray per pixel, by the GPU.
    SingleOnGpu,
    /// The same by the CPU.
    SingleOnCpu,
}

/// A picture, and its error.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscPicture {
    /// What has drawn it.
    pub by: DrawnBy,
    /// The picture.
    pub picture: Picture,
    /// Its error over the whole picture and beside the shadow's edge.
    pub error: PictureError,
    /// Its error over the pixels on a rim of the disc.
    pub on_rims: MeanError,
    /// The largest error of a pixel on the screen, in 1/255.
    pub largest: f64,
    /// The column and row of that pixel.
    pub largest_at: [u32; 2],
}

/// The result for one view.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscStudy {
    /// The view.
    pub case: DiscCase,
    /// The lens.
    pub lens: Lens,
    /// The reference.
    pub reference: DiscReference,
    /// The pictures.
    pub pictures: Vec<DiscPicture>,
}

impl DrawnBy {
    /// All kinds that this machine can draw.
    pub fn all(with_gpu: bool) -> Vec<Self> {
        let on_gpu = [DrawnBy::FilteredOnGpu, DrawnBy::SingleOnGpu];
        let on_cpu = [DrawnBy::FilteredOnCpu, DrawnBy::SingleOnCpu];
        let gpu = on_gpu.into_iter().filter(|_| with_gpu);
        gpu.chain(on_cpu).collect()
    }

    /// Name.
    pub fn name(self) -> &'static str {
        match self {
            DrawnBy::FilteredOnGpu => "filtered (GPU)",
            DrawnBy::FilteredOnCpu => "filtered (CPU)",
            DrawnBy::SingleOnGpu => "one ray (GPU)",
            DrawnBy::SingleOnCpu => "one ray (CPU)",
        }
    }

    fn sampling(self) -> Sampling {
        match self {
            DrawnBy::FilteredOnGpu | DrawnBy::FilteredOnCpu => Sampling::Filtered,
            DrawnBy::SingleOnGpu | DrawnBy::SingleOnCpu => Sampling::Single,
        }
    }

    fn on_gpu(self) -> bool {
        matches!(self, DrawnBy::FilteredOnGpu | DrawnBy::SingleOnGpu)
    }
}

/// The views: from outside the disc, near its outer rim, within its radii above its plane, and from free fall in the gap
/// between the disc and the hole, each at several inclinations down to edge-on.
pub fn disc_cases(disc: &Disc, width: u32, height: u32) -> Vec<DiscCase> {
    let places = [
        ("r = 25", 25.0, Motion::Rest, 0.0),
        ("r = 10", 10.0, Motion::Rest, 0.0),
        ("r = 4", 4.0, Motion::Rest, 40.0),
        ("falling, r = 1.2", 1.2, Motion::Fall, 60.0),
    ];
    let at = |(name, radius, motion, yaw_deg): (&str, f64, Motion, f64)| {
        INCLINATIONS_DEG.map(|inclination_deg| DiscCase {
            name: format!("{name}, {inclination_deg}°"),
            view: View {
                radius,
                motion,
                yaw_deg,
                width,
                height,
                ..View::default()
            },
            disc: Disc {
                orientation: Orientation {
                    inclination_deg,
                    ..disc.orientation
                },
                ..*disc
            },
        })
    };
    places.into_iter().flat_map(at).collect()
}

/// Studies one view of a disc before `sky`, against a reference of `side` × `side` rays per pixel. Without `renderer` only
/// the CPU draws. `row_done` is called after each row of the reference.
///
/// # Errors
/// [`StudyError`] if no camera has this size, the disc is invalid or the device fails.
pub async fn disc_study(
    renderer: Option<&Renderer>,
    sky: &Arc<Sky>,
    case: DiscCase,
    side: u32,
    row_done: impl Fn() + Sync,
) -> Result<DiscStudy, StudyError> {
    case.disc.check()?;
    let lens = Lens::new(Camera::new(&case.view)?, default_atlas(), Deflection::Lut)?;
    let scene = Scene::new(lens, sky.clone()).with_disc(case.disc);
    let reference = DiscReference::new(&scene, &case.disc, side, row_done);
    let mut pictures = Vec::new();
    for by in DrawnBy::all(renderer.is_some()) {
        let scene = scene.clone().with_sampling(by.sampling());
        let picture = match renderer {
            Some(renderer) if by.on_gpu() => renderer.picture(&scene, |_| ()).await?,
            _ => cpu::render(&scene, || ()),
        };
        pictures.push(DiscPicture::new(by, picture, &scene.lens, &reference));
    }
    Ok(DiscStudy {
        case,
        lens: scene.lens,
        reference,
        pictures,
    })
}

impl DiscPicture {
    fn new(by: DrawnBy, picture: Picture, lens: &Lens, reference: &DiscReference) -> Self {
        let truth = &reference.picture;
        let on_rim = |i: u32| reference.on_rim[i as usize];
        let errors = picture.pixels().iter().zip(truth.pixels());
        let errors = errors.map(|(a, b)| screen_error(*a, *b));
        let largest = (0..).zip(errors).max_by(|a, b| a.1.total_cmp(&b.1));
        let (index, largest) = largest.unwrap_or((0_u32, 0.0));
        DiscPicture {
            by,
            error: PictureError::of(lens, &picture, truth),
            on_rims: MeanError::of(&picture, truth, on_rim),
            largest,
            largest_at: [index % picture.width(), index / picture.width()],
            picture,
        }
    }

    /// Whether it is within the limits of the error, or one ray per pixel, to which they do not apply.
    fn is_good(&self) -> bool {
        let error = &self.error;
        let kept = error.whole.screen <= BAR_WHOLE && error.beside_edge.screen <= BAR_BESIDE_EDGE;
        kept || !self.by.sampling().averages()
    }
}

impl DiscStudy {
    /// Whether the filtered pictures are within the limits of the error.
    pub fn is_good(&self) -> bool {
        self.pictures.iter().all(DiscPicture::is_good)
    }
}

impl<'a> From<&'a DiscStudy> for Row<'a> {
    /// The reference, the first filtered and the last single-sampled picture.
    fn from(study: &'a DiscStudy) -> Self {
        let filtered = &study.pictures[0];
        let single = &study.pictures[study.pictures.len() - 1];
        let errors = |entry: &DiscPicture| {
            let (whole, rims) = (entry.error.whole.screen, entry.on_rims.screen);
            format!(
                "{}: off by {whole:.2}/255, on rims {rims:.2}/255",
                entry.by.name()
            )
        };
        Row {
            lens: &study.lens,
            pictures: [&study.reference.picture, &filtered.picture, &single.picture],
            texts: [
                format!("{}: reference", study.case.name),
                errors(filtered),
                errors(single),
            ],
        }
    }
}
