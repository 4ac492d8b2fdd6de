//! How far two ways of drawing a scene are apart: on the sky, in image space, and in the picture.

use crate::camera::{Camera, Sight};
use crate::cpu;
use crate::deflect::closed_form;
use crate::picture::Picture;
use crate::scene::Scene;
use glam::DVec3;
use lensbake_core::Fate;
use lensbake_tables::statistics::ErrorStatistics;
use rayon::prelude::*;

/// Where the light of each pixel comes from by the closed form, in f64, with what errors are judged by.
#[derive(Debug, Clone)]
pub struct Reference {
    camera: Camera,
    pixels: Vec<ReferencePixel>,
}

/// One pixel of it.
#[derive(Debug, Clone, Copy)]
pub struct ReferencePixel {
    column: u32,
    row: u32,
    /// View direction in the hole frame.
    view: DVec3,
    /// Direction of the light in the hole frame, and dθ′/dθ.
    light: Fate<(DVec3, f64)>,
    /// |dθ/d pixel|, rad.
    gradient: f64,
    /// |θ − θ_c| in pixels.
    edge_distance: f64,
}

/// The difference of two ways at one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PixelError {
    /// Both see the horizon.
    BothCaptured,
    /// Both see the sky.
    BothEscape {
        /// Angle between the directions their light comes from, rad.
        radians: f64,
        /// That angle in image space, pixels: ÷ dθ′/d pixel.
        pixels: f64,
    },
    /// One of them has found no direction: its numbers are not finite.
    NoValue,
    /// One sees the sky and the other the horizon.
    OtherFate {
        /// The pixel's distance from the shadow's edge, pixels.
        pixels: f64,
    },
}

impl PixelError {
    /// The error on the sky, rad; `None` where the fates differ, infinite without a value.
    pub fn radians(&self) -> Option<f64> {
        match *self {
            PixelError::BothCaptured => Some(0.0),
            PixelError::NoValue => Some(f64::INFINITY),
            PixelError::BothEscape { radians, .. } => Some(radians),
            PixelError::OtherFate { .. } => None,
        }
    }

    /// The error in image space, pixels; infinite without a value.
    pub fn pixels(&self) -> f64 {
        match *self {
            PixelError::BothCaptured => 0.0,
            PixelError::NoValue => f64::INFINITY,
            PixelError::BothEscape { pixels, .. } | PixelError::OtherFate { pixels } => pixels,
        }
    }
}

impl Reference {
    /// The reference of a scene's camera. `row_done` is called after each row of pixels.
    pub fn new(scene: &Scene, row_done: impl Fn() + Sync) -> Self {
        let camera = scene.camera;
        let pixels = cpu::by_pixel(&camera, row_done, |column, row| {
            ReferencePixel::new(scene, column, row)
        });
        Reference { camera, pixels }
    }

    /// The directions, row-major `[height][width]`.
    pub fn trace(&self) -> Vec<Fate<DVec3>> {
        let direction = |p: &ReferencePixel| p.light.map(|(direction, _)| direction);
        self.pixels.iter().map(direction).collect()
    }

    /// The difference of two traces pixel by pixel, row-major `[height][width]`.
    pub fn errors(&self, a: &[Fate<DVec3>], b: &[Fate<DVec3>]) -> Vec<PixelError> {
        assert_eq!(a.len(), self.camera.pixels());
        assert_eq!(b.len(), self.camera.pixels());
        let pairs = a.par_iter().zip(b).zip(&self.pixels);
        pairs.map(|((a, b), pixel)| pixel.error(a, b)).collect()
    }
}

impl ReferencePixel {
    /// Pixel (column, row) of the picture of `scene`, whose row is the table's.
    pub fn new(scene: &Scene, column: u32, row: u32) -> Self {
        let camera = &scene.camera;
        let view = camera.direction(column, row);
        let gradient = camera.view_angle_gradient(column, row);
        let from_edge = Sight::of(view).angle() - camera.observer.edge_angle();
        ReferencePixel {
            column,
            row,
            view,
            light: cpu::turned_direction(view, |sight| closed_form(&scene.row, sight)),
            gradient,
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

    /// Whether it sees the horizon.
    pub fn is_captured(&self) -> bool {
        self.light == Fate::Captured
    }

    /// The error here of the CPU's picture of `drawn`.
    pub fn error_of(&self, drawn: &Scene) -> PixelError {
        let light = cpu::light_direction(drawn, self.view);
        self.error(&light, &self.light.map(|(direction, _)| direction))
    }

    fn error(&self, a: &Fate<DVec3>, b: &Fate<DVec3>) -> PixelError {
        match (a, b) {
            (Fate::Escapes(a), Fate::Escapes(b)) => {
                let radians = a.cross(*b).length().atan2(a.dot(*b));
                if !radians.is_finite() {
                    return PixelError::NoValue;
                }
                let stretch = self
                    .light
                    .escaped()
                    .map_or(1.0, |(_, stretch)| stretch.abs());
                PixelError::BothEscape {
                    radians,
                    pixels: radians / (stretch * self.gradient),
                }
            }
            (Fate::Captured, Fate::Captured) => PixelError::BothCaptured,
            _ => PixelError::OtherFate {
                pixels: self.edge_distance,
            },
        }
    }
}

/// What the errors of a picture come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceStatistics {
    /// On the sky, rad, over the pixels that both ways see the sky in.
    pub radians: ErrorStatistics,
    /// In image space, pixels, over those and the pixels whose fates differ.
    pub pixels: ErrorStatistics,
    /// Pixels whose fates differ.
    pub other_fates: usize,
    /// Pixels without a value.
    pub no_value: usize,
}

impl TraceStatistics {
    /// Of the errors of a picture; `None` if no pixel sees the sky.
    pub fn of(errors: &[PixelError]) -> Option<Self> {
        let radians = errors.iter().filter_map(|e| match e {
            PixelError::BothEscape { radians, .. } => Some(*radians),
            PixelError::NoValue => Some(f64::INFINITY),
            PixelError::BothCaptured | PixelError::OtherFate { .. } => None,
        });
        let seen = errors.iter().filter(|e| **e != PixelError::BothCaptured);
        let other_fate = |e: &&PixelError| matches!(e, PixelError::OtherFate { .. });
        Some(TraceStatistics {
            radians: ErrorStatistics::of(radians)?,
            pixels: ErrorStatistics::of(seen.map(PixelError::pixels))?,
            other_fates: errors.iter().filter(other_fate).count(),
            no_value: errors.iter().filter(|e| **e == PixelError::NoValue).count(),
        })
    }
}

/// The difference of two pictures as a screen shows them, in 1/255 a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureDifference {
    /// The largest.
    pub max: u8,
    /// The mean over all channels.
    pub mean: f64,
    /// Pixels with any channel off by more than 2.
    pub over_two: usize,
}

impl PictureDifference {
    /// Of two pictures of the same size.
    ///
    /// # Panics
    /// If the sizes differ: a fault of the caller.
    pub fn of(a: &Picture, b: &Picture) -> Self {
        assert_eq!((a.width(), a.height()), (b.width(), b.height()));
        Self::on_screen(&a.srgb(0.0), &b.srgb(0.0))
    }

    /// Of the pixels that a screen shows, as many in `a` as in `b`.
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
