//! The difference between two methods of drawing a scene: on the sky, in image space and in the picture.

use crate::camera::{Camera, ViewAngle};
use crate::cpu;
use crate::footprint::Patch;
use crate::lens::{Lens, LensedRay};
use crate::picture::Picture;
use glam::DVec3;
use lensbake_core::RayOutcome;
use lensbake_tables::statistics::ErrorStatistics;
use rayon::prelude::*;

/// The closed form's ray outcome at each pixel, in f64, and the derivatives that convert errors to pixels.
#[derive(Debug, Clone)]
pub struct Reference {
    camera: Camera,
    pixels: Vec<ReferencePixel>,
}

/// One pixel of a [`Reference`].
#[derive(Debug, Clone, Copy)]
pub struct ReferencePixel {
    column: u32,
    row: u32,
    /// View direction in the hole frame.
    view: DVec3,
    /// Ray outcome by the closed form.
    light: RayOutcome<LensedRay>,
    /// |dθ/d pixel|, rad.
    gradient: f64,
    /// Ratio of the frequencies, camera over the observer of its row: the scale of the aberration.
    doppler: f64,
    /// |θ − θ_c| in pixels.
    edge_distance: f64,
}

/// The difference between two methods at one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PixelError {
    /// Both rays are captured.
    BothCaptured,
    /// Both rays escape to the sky.
    BothEscape {
        /// Angle between their directions on the sky, rad.
        radians: f64,
        /// That angle in image space, pixels: divided by dθ′/d pixel.
        pixels: f64,
    },
    /// A direction on the sky is not finite, so the error has no value.
    NoValue,
    /// One ray escapes and the other is captured.
    OutcomesDiffer {
        /// Distance of the pixel from the shadow's edge, pixels.
        pixels: f64,
    },
}

impl PixelError {
    /// The error on the sky, rad; `None` if the ray outcomes differ, infinite without a value.
    pub fn radians(&self) -> Option<f64> {
        match *self {
            PixelError::BothCaptured => Some(0.0),
            PixelError::NoValue => Some(f64::INFINITY),
            PixelError::BothEscape { radians, .. } => Some(radians),
            PixelError::OutcomesDiffer { .. } => None,
        }
    }

    /// The error in image space, pixels; infinite without a value.
    pub fn pixels(&self) -> f64 {
        match *self {
            PixelError::BothCaptured => 0.0,
            PixelError::NoValue => f64::INFINITY,
            PixelError::BothEscape { pixels, .. } | PixelError::OutcomesDiffer { pixels } => pixels,
        }
    }
}

impl Reference {
    /// The reference for the camera of `lens`. `row_done` is called after each row of pixels.
    pub fn new(lens: &Lens, row_done: impl Fn() + Sync) -> Self {
        let camera = lens.camera;
        let pixels = cpu::by_pixel(&camera, row_done, |column, row| {
            ReferencePixel::new(lens, column, row)
        });
        Reference { camera, pixels }
    }

    /// The directions on the sky, row-major `[height][width]`.
    pub fn trace(&self) -> Vec<RayOutcome<DVec3>> {
        let direction = |p: &ReferencePixel| p.light.map(|ray| ray.direction);
        self.pixels.iter().map(direction).collect()
    }

    /// The difference between two traces pixel by pixel, row-major `[height][width]`.
    pub fn errors(&self, a: &[RayOutcome<DVec3>], b: &[RayOutcome<DVec3>]) -> Vec<PixelError> {
        assert_eq!(a.len(), self.camera.pixels());
        assert_eq!(b.len(), self.camera.pixels());
        let pairs = a.par_iter().zip(b).zip(&self.pixels);
        pairs.map(|((a, b), pixel)| pixel.error(a, b)).collect()
    }
}

impl ReferencePixel {
    /// The reference at pixel (column, row) of the picture through `lens`, whose row must be the table's, not
    /// resampled.
    pub fn new(lens: &Lens, column: u32, row: u32) -> Self {
        let camera = &lens.camera;
        let view = camera.direction(column, row);
        let gradient = Patch::seen_by(camera, camera.position(column, row), 1.0).gradient();
        let (seen, doppler) = camera.unboosted(view);
        let from_edge = ViewAngle::of(seen).radians() - camera.observer.shadow_angle();
        ReferencePixel {
            column,
            row,
            view,
            light: lens.exact_ray(view),
            gradient,
            doppler,
            edge_distance: from_edge.abs() / gradient,
        }
    }

    /// Its (column, row).
    pub fn at(&self) -> (u32, u32) {
        (self.column, self.row)
    }

    /// |dθ/d pixel|, rad.
    pub fn gradient(&self) -> f64 {
        self.gradient
    }

    /// |θ − θ_c| in pixels.
    pub fn edge_distance(&self) -> f64 {
        self.edge_distance
    }

    /// Whether the closed form captures its ray.
    pub fn is_captured(&self) -> bool {
        self.light == RayOutcome::Captured
    }

    /// The error of the CPU renderer with the lens `drawn` at this pixel.
    pub fn error_of(&self, drawn: &Lens) -> PixelError {
        let light = drawn.ray(self.view).map(|ray| ray.direction);
        self.error(&light, &self.light.map(|ray| ray.direction))
    }

    fn error(&self, a: &RayOutcome<DVec3>, b: &RayOutcome<DVec3>) -> PixelError {
        match (a, b) {
            (RayOutcome::Escapes(a), RayOutcome::Escapes(b)) => {
                let radians = a.cross(*b).length().atan2(a.dot(*b));
                if !radians.is_finite() {
                    return PixelError::NoValue;
                }
                let radial = self
                    .light
                    .escaped()
                    .map_or(1.0, |ray| ray.jacobian.radial.abs() / self.doppler);
                PixelError::BothEscape {
                    radians,
                    pixels: radians / (radial * self.gradient),
                }
            }
            (RayOutcome::Captured, RayOutcome::Captured) => PixelError::BothCaptured,
            _ => PixelError::OutcomesDiffer {
                pixels: self.edge_distance,
            },
        }
    }
}

/// Statistics of the errors of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceStatistics {
    /// On the sky, rad, over the pixels where both rays escape.
    pub radians: ErrorStatistics,
    /// In image space, pixels, over those and the pixels whose ray outcomes differ.
    pub pixels: ErrorStatistics,
    /// Number of pixels whose ray outcomes differ.
    pub differing_outcomes: usize,
    /// Number of pixels whose error has no value.
    pub no_value: usize,
}

impl TraceStatistics {
    /// The statistics of `errors`; `None` if both rays escape at no pixel.
    pub fn of(errors: &[PixelError]) -> Option<Self> {
        let radians = errors.iter().filter_map(|e| match e {
            PixelError::BothEscape { radians, .. } => Some(*radians),
            PixelError::NoValue => Some(f64::INFINITY),
            PixelError::BothCaptured | PixelError::OutcomesDiffer { .. } => None,
        });
        let seen = errors.iter().filter(|e| **e != PixelError::BothCaptured);
        let differs = |e: &&PixelError| matches!(e, PixelError::OutcomesDiffer { .. });
        Some(TraceStatistics {
            radians: ErrorStatistics::of(radians)?,
            pixels: ErrorStatistics::of(seen.map(PixelError::pixels))?,
            differing_outcomes: errors.iter().filter(differs).count(),
            no_value: errors.iter().filter(|e| **e == PixelError::NoValue).count(),
        })
    }
}

/// The difference between two pictures as a screen shows them: tone mapped 8-bit sRGB, in 1/255 per channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureDifference {
    /// The largest difference.
    pub max: u8,
    /// The mean over all channels.
    pub mean: f64,
    /// Number of pixels with a channel that differs by more than 2.
    pub over_two: usize,
}

impl PictureDifference {
    /// Compares two pictures of the same size.
    ///
    /// # Panics
    /// If the sizes differ, which is a bug in the caller.
    pub fn of(a: &Picture, b: &Picture) -> Self {
        assert_eq!((a.width(), a.height()), (b.width(), b.height()));
        Self::on_screen(&a.srgb(0.0), &b.srgb(0.0))
    }

    /// Compares 8-bit sRGB pixels. Both slices must have the same length.
    pub fn on_screen(a: &[[u8; 3]], b: &[[u8; 3]]) -> Self {
        let (mut max, mut sum, mut over_two) = (0, 0u64, 0);
        for (a, b) in a.iter().zip(b) {
            let off: [u8; 3] = std::array::from_fn(|c| a[c].abs_diff(b[c]));
            let worst = off[0].max(off[1]).max(off[2]);
            max = max.max(worst);
            sum += off.iter().map(|&o| u64::from(o)).sum::<u64>();
            over_two += usize::from(worst > 2);
        }
        PictureDifference {
            max,
            mean: sum as f64 / (3 * a.len()) as f64,
            over_two,
        }
    }
}
