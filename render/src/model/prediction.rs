//! Predicts the error of a model in a picture, before the picture is drawn.
//!
//! The error is the one that `viewer diff` measures: that of a pixel's direction on the sky against the closed
//! form, in image space. It is computed at sample pixels of the picture. If these are not all of its pixels, hill
//! climbs start at the worst samples and end at the worst pixel nearby.

use super::disc::{DiscPixel, DiscReference};
use super::samples;
use crate::camera::Camera;
use crate::diff::ReferencePixel;
use crate::disc::SeenDisc;
use crate::lens::Lens;
use rayon::prelude::*;

/// Floating-point precision of a renderer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// f64, on the CPU.
    F64,
    /// f32, on a GPU.
    F32,
}

impl Precision {
    /// Error of a direction by rounding, rad: a few units in the last place of a unit vector.
    pub fn rounding(self) -> f64 {
        const ULPS: f64 = 8.0;
        match self {
            Precision::F64 => 0.0,
            Precision::F32 => ULPS * 0.5 * f64::from(f32::EPSILON),
        }
    }

    /// Error by rounding in the centre of the picture of `camera`, pixels.
    pub fn rounding_px(self, camera: &Camera) -> f64 {
        self.rounding() / camera.right.length()
    }
}

/// The largest error of a model in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// In image space, pixels, including rounding.
    pub pixels: f64,
    /// At that pixel, rad: on the sky, or for a disc the angle by which its image is displaced. `None` if the ray outcome
    /// differs from the closed form's.
    pub radians: Option<f64>,
    /// Whether it is an error of the disc.
    pub on_disc: bool,
    /// (column, row) of the pixel.
    pub worst: (u32, u32),
}

impl Prediction {
    fn worse(self, other: Self) -> Self {
        // Ties go to the earlier pixel, so that the result does not depend on the order of threads.
        let order = self.pixels.total_cmp(&other.pixels);
        if order.then(other.worst.cmp(&self.worst)).is_ge() {
            self
        } else {
            other
        }
    }
}

/// Samples per hill climb, which starts at the worst of them.
const SAMPLES_PER_CLIMB: usize = 1024;

/// Predicts errors in the picture through one lens.
pub struct Predictor<'a> {
    lens: &'a Lens,
    precision: Precision,
    disc: Option<DiscReference<'a>>,
    samples: Vec<Sample>,
}

/// A sample pixel.
struct Sample {
    sky: ReferencePixel,
    disc: Option<DiscPixel>,
}

/// What draws a picture.
struct Drawn<'a> {
    lens: &'a Lens,
    /// The plane of the disc, if there is one.
    disc: Option<SeenDisc<'a>>,
}

impl<'a> Predictor<'a> {
    /// For the picture of the sky and `disc` through `lens`, whose row must be the table's, not resampled.
    pub fn new(lens: &'a Lens, disc: Option<DiscReference<'a>>, precision: Precision) -> Self {
        let mut predictor = Predictor {
            lens,
            precision,
            disc,
            samples: Vec::new(),
        };
        let pixels = samples::pixels(&lens.camera).into_par_iter();
        predictor.samples = pixels.map(|pixel| predictor.sample(pixel)).collect();
        predictor
    }

    fn sample(&self, (column, row): (u32, u32)) -> Sample {
        let disc = self.disc.as_ref();
        Sample {
            sky: ReferencePixel::new(self.lens, column, row),
            disc: disc.and_then(|disc| disc.pixel(column, row)),
        }
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    /// Number of samples that show the disc; `None` without one.
    pub fn samples_of_disc(&self) -> Option<usize> {
        let shows_disc = |sample: &&Sample| sample.disc.is_some();
        let shown = self.samples.iter().filter(shows_disc).count();
        self.disc.is_some().then_some(shown)
    }

    /// Largest error of a sample by rounding alone, pixels.
    pub fn rounding_px(&self) -> f64 {
        let moved = self.samples.iter().map(|sample| self.rounding(sample));
        moved.fold(0.0, f64::max)
    }

    /// Error of a pixel by rounding, pixels; 0 well inside the shadow, unless it shows the disc.
    fn rounding(&self, Sample { sky, disc }: &Sample) -> f64 {
        let moved = self.precision.rounding() / sky.gradient();
        if disc.is_none() && sky.is_captured() && sky.edge_distance() > moved {
            0.0
        } else {
            moved
        }
    }

    /// The largest error of the picture if it is drawn through `drawn`.
    pub fn predict(&self, drawn: &Lens) -> Prediction {
        let nothing = || Prediction {
            pixels: 0.0,
            radians: Some(0.0),
            on_disc: false,
            worst: (0, 0),
        };
        let disc = self.disc.as_ref();
        let drawn = &Drawn {
            lens: drawn,
            disc: disc.map(|disc| disc.plane_in(drawn)),
        };
        self.samples
            .par_chunks(SAMPLES_PER_CLIMB)
            .map(|samples| {
                let errors = samples.iter().map(|sample| self.error(drawn, sample));
                let worst = errors.fold(nothing(), Prediction::worse);
                if samples::are_all(&self.lens.camera) {
                    worst
                } else {
                    self.climb(drawn, worst)
                }
            })
            .reduce(nothing, Prediction::worse)
    }

    /// Climbs from `start` to a pixel without a worse neighbour. The stride starts at the lattice spacing and is
    /// halved.
    fn climb(&self, drawn: &Drawn, start: Prediction) -> Prediction {
        let mut best = start;
        let mut stride = samples::spacing(&self.lens.camera);
        while stride > 0 {
            let around = self.neighbours(best.worst, stride);
            let worst = around
                .map(|pixel| self.error(drawn, &self.sample(pixel)))
                .fold(best, Prediction::worse);
            if worst.pixels > best.pixels {
                best = worst;
            } else {
                stride /= 2;
            }
        }
        best
    }

    /// The pixel itself and the pixels of the picture one `stride` away along its row, column and diagonals.
    fn neighbours(
        &self,
        (column, row): (u32, u32),
        stride: u32,
    ) -> impl Iterator<Item = (u32, u32)> + use<> {
        let (width, height) = (self.lens.camera.width, self.lens.camera.height);
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

    fn error(&self, drawn: &Drawn, sample: &Sample) -> Prediction {
        let (sky, rounding) = (&sample.sky, self.rounding(sample));
        let error = sky.error_of(drawn.lens);
        let of_sky = Prediction {
            pixels: error.pixels() + rounding,
            radians: error.radians(),
            on_disc: false,
            worst: sky.at(),
        };
        let (Some(pixel), Some(disc)) = (&sample.disc, &drawn.disc) else {
            return of_sky;
        };
        let displaced = pixel.error_of(disc, &self.lens.camera);
        of_sky.worse(Prediction {
            pixels: displaced + rounding,
            radians: Some(displaced * sky.gradient()),
            on_disc: true,
            worst: sky.at(),
        })
    }
}
