//! What a picture should be: the mean of many rays a pixel, each by direct integration and each a
//! bilinear sample of the sky's first level; and how far a picture is from that.
//!
//! It shares nothing with the filtered picture but camera and sky: no table, no slope, no mip level, no
//! formula for the edge.

use crate::camera::{Camera, Sight};
use crate::cpu;
use crate::footprint::Patch;
use crate::gpu::{GpuError, Output, Renderer};
use crate::picture::{Picture, srgb_from_linear};
use crate::scene::{Method, Sampling, Scene};
use crate::shadow::Shadow;
use crate::sky::Sky;
use crate::tone_map::tone_map;
use glam::Vec3;

/// Pixels from the shadow's edge that count as beside it.
pub const BESIDE_EDGE: f64 = 20.0;

/// The scene of the rays: `scene` by direct integration, each pixel cut into `side` × `side`.
fn rays(scene: &Scene, side: u32) -> Scene {
    let direct = Method::Direct {
        step: Method::DEFAULT_STEP,
    };
    Scene {
        camera: scene.camera.refined(side),
        ..scene.by(direct).sampled(Sampling::Single)
    }
}

/// Adds up rays in pixels of `side` × `side` of them.
struct Sum {
    camera: Camera,
    side: u32,
    pixels: Vec<Vec3>,
}

impl Sum {
    fn new(camera: &Camera, side: u32) -> Self {
        Sum {
            camera: *camera,
            side,
            pixels: vec![Vec3::ZERO; camera.pixels()],
        }
    }

    /// Adds a whole row of rays.
    fn add(&mut self, row: u32, light: impl Iterator<Item = Vec3>) {
        let first = (row / self.side * self.camera.width) as usize;
        for (column, light) in light.enumerate() {
            self.pixels[first + column / self.side as usize] += light;
        }
    }

    fn mean(self) -> Picture {
        let rays = (self.side * self.side) as f32;
        let pixels = self.pixels.iter().map(|sum| (*sum / rays).to_array());
        Picture::new(self.camera.width, self.camera.height, pixels.collect())
    }
}

/// The reference of a scene on a GPU with `side` × `side` rays a pixel. `row_done` is called with the
/// rows of pixels done so far.
///
/// # Errors
/// [`GpuError::Failed`] if the device does.
pub fn on_gpu(
    renderer: &Renderer,
    scene: &Scene,
    side: u32,
    row_done: impl Fn(u32),
) -> Result<Picture, GpuError> {
    let rays = rays(scene, side);
    let mut sum = Sum::new(&scene.camera, side);
    renderer.stream(&rays, Output::Picture, |band, light| {
        let rows = light.chunks_exact(band.count[0] as usize);
        for (row, light) in (band.first[1]..).zip(rows) {
            sum.add(row, light.iter().map(|&[r, g, b, _]| Vec3::new(r, g, b)));
        }
        row_done((band.first[1] + band.count[1]) / side);
    })?;
    Ok(sum.mean())
}

/// The same on the CPU, in f64; slow.
pub fn on_cpu(scene: &Scene, sky: &Sky, side: u32) -> Picture {
    let picture = cpu::render(&rays(scene, side), sky, || ());
    let mut sum = Sum::new(&scene.camera, side);
    let rows = picture.pixels().chunks_exact(picture.width() as usize);
    for (row, light) in (0..).zip(rows) {
        sum.add(row, light.iter().map(|&light| light.into()));
    }
    sum.mean()
}

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
        let (mut whole, mut beside_edge) = (MeanError::default(), MeanError::default());
        let pairs = picture.pixels().iter().zip(reference.pixels());
        for (i, (a, b)) in (0..).zip(pairs) {
            whole.add(*a, *b);
            let distance = edge_distance(scene, i % camera.width, i / camera.width);
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

/// The distance of a pixel's middle from the shadow's edge in pixels, positive outside.
pub fn edge_distance(scene: &Scene, column: u32, row: u32) -> f64 {
    let camera = &scene.camera;
    let ray = camera.ray(camera.position(column, row));
    let patch = Patch::new(ray, camera.right, camera.down);
    Shadow::of(scene).distance(Sight::of(patch.direction)) / patch.gradient()
}
