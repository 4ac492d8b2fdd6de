//! What a model would be off by in a picture, before it is drawn.
//!
//! The error is the one that `viewer diff` measures: of where a pixel's light comes from, against the
//! closed form, in image space. It is computed at sample pixels of the very picture and, in pictures of
//! which those are not all, pursued from the worst of them to the worst pixel near by.

use super::samples;
use crate::camera::Camera;
use crate::diff::ReferencePixel;
use crate::scene::Scene;
use rayon::prelude::*;

/// The numbers a picture is drawn in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// On the CPU.
    F64,
    /// On a GPU.
    F32,
}

impl Precision {
    /// By how much rounding moves a direction, rad: a few units in the last place of a unit vector.
    pub fn rounding(self) -> f64 {
        const ULPS: f64 = 8.0;
        match self {
            Precision::F64 => 0.0,
            Precision::F32 => ULPS * 0.5 * f64::from(f32::EPSILON),
        }
    }

    /// By how much rounding moves the middle of the picture of `camera`, in its pixels.
    pub fn rounding_px(self, camera: &Camera) -> f64 {
        self.rounding() / camera.right.length()
    }
}

/// The largest error of a model in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// In image space, pixels; rounding included.
    pub pixels: f64,
    /// On the sky at that pixel, rad; `None` if it sees the sky where the closed form sees the horizon,
    /// or the other way round.
    pub radians: Option<f64>,
    /// (column, row) of the pixel.
    pub worst: (u32, u32),
}

impl Prediction {
    fn worse(self, other: Self) -> Self {
        // The earlier of equals, so that threads do not decide.
        let order = self.pixels.total_cmp(&other.pixels);
        if order.then(other.worst.cmp(&self.worst)).is_ge() {
            self
        } else {
            other
        }
    }
}

/// A climb starts at the worst of this many samples.
const SAMPLES_A_CLIMB: usize = 1024;

/// Predicts errors in the picture of one scene.
pub struct Predictor<'a> {
    scene: &'a Scene,
    precision: Precision,
    samples: Vec<ReferencePixel>,
}

impl<'a> Predictor<'a> {
    /// For the picture of `scene`, whose row is the table's.
    pub fn new(scene: &'a Scene, precision: Precision) -> Self {
        let samples = samples::pixels(&scene.camera)
            .into_par_iter()
            .map(|(column, row)| ReferencePixel::new(scene, column, row))
            .collect();
        Predictor {
            scene,
            precision,
            samples,
        }
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    /// The most by which rounding alone moves a sample, pixels.
    pub fn rounding_px(&self) -> f64 {
        let moved = self.samples.iter().map(|sample| self.rounding(sample));
        moved.fold(0.0, f64::max)
    }

    /// By how much rounding moves a pixel, in pixels: not at all well inside the shadow.
    fn rounding(&self, pixel: &ReferencePixel) -> f64 {
        let moved = self.precision.rounding() / pixel.gradient();
        if pixel.is_captured() && pixel.edge_distance() > moved {
            0.0
        } else {
            moved
        }
    }

    /// The largest error when the picture is drawn as `drawn`.
    pub fn predict(&self, drawn: &Scene) -> Prediction {
        let nothing = || Prediction {
            pixels: 0.0,
            radians: Some(0.0),
            worst: (0, 0),
        };
        self.samples
            .par_chunks(SAMPLES_A_CLIMB)
            .map(|samples| {
                let errors = samples.iter().map(|sample| self.error(drawn, sample));
                let worst = errors.fold(nothing(), Prediction::worse);
                if samples::are_all(&self.scene.camera) {
                    worst
                } else {
                    self.climb(drawn, worst)
                }
            })
            .reduce(nothing, Prediction::worse)
    }

    /// From `start` to a pixel with none worse around it, in strides halved from the lattice's.
    fn climb(&self, drawn: &Scene, start: Prediction) -> Prediction {
        let mut best = start;
        let mut stride = samples::spacing(&self.scene.camera);
        while stride > 0 {
            let around = self.neighbours(best.worst, stride);
            let worst = around
                .map(|(column, row)| {
                    self.error(drawn, &ReferencePixel::new(self.scene, column, row))
                })
                .fold(best, Prediction::worse);
            if worst.pixels > best.pixels {
                best = worst;
            } else {
                stride /= 2;
            }
        }
        best
    }

    /// The pixels of the picture `stride` away from one, straight and aslant.
    fn neighbours(
        &self,
        (column, row): (u32, u32),
        stride: u32,
    ) -> impl Iterator<Item = (u32, u32)> + use<> {
        let (width, height) = (self.scene.camera.width, self.scene.camera.height);
        let stride = i64::from(stride);
        let moved = |at: u32, by: i64, side: u32| {
            let to = u32::try_from(i64::from(at) + by).ok()?;
            (to < side).then_some(to)
        };
        [-stride, 0, stride].into_iter().flat_map(move |down| {
            [-stride, 0, stride].into_iter().filter_map(move |right| {
                Some((moved(column, right, width)?, moved(row, down, height)?))
            })
        })
    }

    fn error(&self, drawn: &Scene, pixel: &ReferencePixel) -> Prediction {
        let error = pixel.error_of(drawn);
        Prediction {
            pixels: error.pixels() + self.rounding(pixel),
            radians: error.radians(),
            worst: pixel.at(),
        }
    }
}
