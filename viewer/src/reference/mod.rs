//! What a picture should be: the mean of many rays a pixel, each by direct integration and each a
//! bilinear sample of the sky's first level; and how far a picture is from that.
//!
//! It shares nothing with the filtered picture but camera and sky: no table, no slope, no mip level, no
//! formula for the edge.

mod cost;
pub mod csv;
mod error;
pub mod figure;
mod study;

pub use cost::{Cost, cost};
pub use error::{BESIDE_EDGE, MeanError, PictureError};
pub use study::{Case, Entry, Study, StudyError, cases, study};

use crate::camera::Camera;
use crate::cpu;
use crate::gpu::{GpuError, Output, Renderer};
use crate::picture::Picture;
use crate::scene::{Method, Sampling, Scene};
use crate::sky::Sky;
use glam::Vec3;

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
