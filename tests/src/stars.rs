//! Pictures of stars before a black sky, on both devices.

use glam::Vec3;
use viewer::cpu;
use viewer::gpu::{Gpu, Renderer};
use viewer::picture::Picture;
use viewer::scene::Scene;
use viewer::sky::Sky;
use viewer::stars::{self, StarField};

/// A sky without light.
pub fn black() -> Sky {
    Sky::from_fn(1, |_| Vec3::ZERO)
}

/// The stars of `field` as the CPU draws them.
///
/// # Panics
/// If they can't be drawn.
pub fn on_cpu(scene: &Scene, field: &StarField) -> Picture {
    let mut picture = cpu::render(scene, &black(), || ());
    stars::draw(&mut picture, scene, field).unwrap();
    picture
}

/// The stars of `field` as the GPU draws them.
///
/// # Panics
/// If they can't be drawn.
pub fn on_gpu(gpu: &Gpu, scene: &Scene, field: &StarField) -> Picture {
    let renderer = Renderer::new(gpu, &black()).unwrap().with_stars(field);
    renderer.picture(scene, |_| ()).unwrap()
}
