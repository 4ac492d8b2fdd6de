//! The error of a picture against its reference.

use glam::Vec3;
use lensbake_render::filter::FilteredPixels;
use lensbake_render::lens::Lens;
use lensbake_render::picture::{Picture, srgb_from_linear};
use lensbake_render::shift::Rendition;
use lensbake_render::tone_map::tone_map;

/// Distance from the shadow's edge, in pixels, below which a pixel that sees sky is beside the edge.
pub const BESIDE_EDGE: f64 = 20.0;

/// Mean absolute error over all channels of a set of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeanError {
    /// On the screen (tone mapped, sRGB, not rounded), in 1/255.
    pub screen: f64,
    /// In linear light, in 1/255.
    pub linear: f64,
    /// Number of pixels.
    pub pixels: usize,
}

/// The error of a picture against its reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureError {
    /// Over the whole picture.
    pub whole: MeanError,
    /// Over the pixels that see sky within [`BESIDE_EDGE`] of the shadow's edge.
    pub beside_edge: MeanError,
}

impl PictureError {
    /// The error of `picture`, drawn through `lens`, against `reference`.
    pub fn of(lens: &Lens, picture: &Picture, reference: &Picture) -> Self {
        let camera = &lens.camera;
        let pixels = FilteredPixels::new(lens, Rendition::default());
        let beside_edge = |i: u32| {
            let distance = pixels.edge_distance(i % camera.width, i / camera.width);
            (-1.0..BESIDE_EDGE).contains(&distance)
        };
        PictureError {
            whole: MeanError::of(picture, reference, |_| true),
            beside_edge: MeanError::of(picture, reference, beside_edge),
        }
    }
}

/// The mean over the channels of a pixel of the difference of `a` and `b` on the screen, in 1/255.
pub(super) fn screen_error(a: [f32; 3], b: [f32; 3]) -> f64 {
    let screen = |light: [f32; 3]| tone_map(light.into(), 0.0).map(srgb_from_linear);
    mean_of_channels(screen(a), screen(b))
}

fn mean_of_channels(a: Vec3, b: Vec3) -> f64 {
    f64::from((a - b).abs().element_sum()) * 255.0 / 3.0
}

impl MeanError {
    /// The error of `picture` against `reference` over the pixels that are `among` the set, by their index.
    pub(super) fn of(picture: &Picture, reference: &Picture, among: impl Fn(u32) -> bool) -> Self {
        let mut sum = MeanError::default();
        let pairs = picture.pixels().iter().zip(reference.pixels());
        for (_, (a, b)) in (0..).zip(pairs).filter(|(i, _)| among(*i)) {
            sum.add(*a, *b);
        }
        sum.mean()
    }

    fn add(&mut self, a: [f32; 3], b: [f32; 3]) {
        self.screen += screen_error(a, b);
        self.linear += mean_of_channels(a.into(), b.into());
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
