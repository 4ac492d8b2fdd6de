//! How far a picture is from its reference.

use crate::filtered::Pixels;
use crate::picture::{Picture, srgb_from_linear};
use crate::scene::Scene;
use crate::tone_map::tone_map;
use glam::Vec3;

/// Pixels from the shadow's edge that count as beside it.
pub const BESIDE_EDGE: f64 = 20.0;

/// Mean absolute error over all channels of some pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeanError {
    /// On the screen (tone mapped, sRGB, not rounded), in 1/255.
    pub screen: f64,
    /// In linear light, in 1/255.
    pub linear: f64,
    /// How many pixels.
    pub pixels: usize,
}

/// How far a picture is from its reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureError {
    /// In the whole picture.
    pub whole: MeanError,
    /// In the pixels that see sky within [`BESIDE_EDGE`] of the shadow's edge.
    pub beside_edge: MeanError,
}

impl PictureError {
    /// Of `picture`, a picture of `scene`, against `reference`.
    pub fn of(scene: &Scene, picture: &Picture, reference: &Picture) -> Self {
        let camera = &scene.camera;
        let pixels = Pixels::new(scene);
        let (mut whole, mut beside_edge) = (MeanError::default(), MeanError::default());
        let pairs = picture.pixels().iter().zip(reference.pixels());
        for (i, (a, b)) in (0..).zip(pairs) {
            whole.add(*a, *b);
            let distance = pixels.edge_distance(i % camera.width, i / camera.width);
            if (-1.0..BESIDE_EDGE).contains(&distance) {
                beside_edge.add(*a, *b);
            }
        }
        PictureError {
            whole: whole.mean(),
            beside_edge: beside_edge.mean(),
        }
    }
}

impl MeanError {
    fn add(&mut self, a: [f32; 3], b: [f32; 3]) {
        let off = |a: Vec3, b: Vec3| f64::from((a - b).abs().element_sum()) * 255.0 / 3.0;
        let screen = |light: [f32; 3]| tone_map(light.into(), 0.0).map(srgb_from_linear);
        self.screen += off(screen(a), screen(b));
        self.linear += off(a.into(), b.into());
        self.pixels += 1;
    }

    fn mean(self) -> Self {
        let pixels = self.pixels.max(1) as f64;
        MeanError {
            screen: self.screen / pixels,
            linear: self.linear / pixels,
            pixels: self.pixels,
        }
    }
}
