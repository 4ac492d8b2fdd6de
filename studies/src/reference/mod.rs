//! Reference pictures, and the error of a picture against them. A reference pixel is the mean of many rays, each
//! by direct integration and each a bilinear sample of the sky's first level.
//!
//! The reference shares only the camera and the sky with the filtered picture: no table, no slope, no mip level,
//! no formula for the shadow's edge.

mod cost;
pub mod csv;
mod disc_orbit;
mod disc_rays;
mod disc_study;
mod error;
pub mod figure;
mod study;

pub use cost::{Cost, cost};
pub use disc_rays::DiscReference;
pub use disc_study::{DiscCase, DiscPicture, DiscStudy, DrawnBy, disc_cases, disc_study};
pub use error::{BESIDE_EDGE, MeanError, PictureError};
pub use study::{Case, SampledPicture, Study, StudyError, cases, study};

use glam::Vec3;
use lensbake_render::camera::Camera;
use lensbake_render::cpu;
use lensbake_render::gpu::{GpuError, Renderer};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};

/// `scene` by direct integration, with each pixel divided into `side` × `side`.
fn rays(scene: &Scene, side: u32) -> Scene {
    let direct = Deflection::Direct {
        step: Deflection::DEFAULT_STEP,
    };
    let lens = Lens {
        camera: scene.lens.camera.refined(side),
        ..scene.lens.with_deflection(direct)
    };
    scene.with_lens(lens).with_sampling(Sampling::Single)
}

/// Sums up rays in pixels of `side` × `side` rays.
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

    /// Adds a whole row of rays, numbered `row`.
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

/// The reference picture of `scene` on a GPU, with `side` × `side` rays per pixel. `row_done` is called with the
/// number of pixel rows done so far.
///
/// # Errors
/// [`GpuError::Failed`] if the device fails.
pub async fn on_gpu(
    renderer: &Renderer,
    scene: &Scene,
    side: u32,
    row_done: impl Fn(u32),
) -> Result<Picture, GpuError> {
    let rays = rays(scene, side);
    let mut sum = Sum::new(&scene.lens.camera, side);
    renderer
        .stream(&rays, |band, light| {
            let rows = light.chunks_exact(band.count[0] as usize);
            for (row, light) in (band.first[1]..).zip(rows) {
                sum.add(row, light.iter().map(|&[r, g, b, _]| Vec3::new(r, g, b)));
            }
            row_done((band.first[1] + band.count[1]) / side);
        })
        .await?;
    Ok(sum.mean())
}

/// As [`on_gpu`], but on the CPU, in f64 and slow.
pub fn on_cpu(scene: &Scene, side: u32) -> Picture {
    let picture = cpu::render(&rays(scene, side), || ());
    let mut sum = Sum::new(&scene.lens.camera, side);
    let rows = picture.pixels().chunks_exact(picture.width() as usize);
    for (row, light) in (0..).zip(rows) {
        sum.add(row, light.iter().map(|&light| light.into()));
    }
    sum.mean()
}
