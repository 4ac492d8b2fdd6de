//! Shared by the cross-checks: the GPU, and what is drawn or computed on it.

pub mod probe;
pub mod screen;
pub mod stars;

use lensbake_render::camera::{Camera, View};
use lensbake_render::gpu::{Gpu, Renderer, Trace};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::Scene;
use lensbake_tables::default_atlas;
use pollster::block_on;

/// The GPU, hardware or software.
///
/// # Panics
/// If there is no GPU: no test is skipped silently. With `--features no-gpu` the tests that call this are listed
/// as ignored.
pub fn gpu() -> Gpu {
    block_on(Gpu::open()).unwrap_or_else(|e| {
        panic!("{e}; or test with --features lensbake-render/no-gpu,lensbake-tests/no-gpu,viewer/no-gpu")
    })
}

/// A renderer on [`gpu`].
pub fn renderer() -> Renderer {
    Renderer::new(&gpu())
}

/// The lens of a view, with the built-in atlas.
///
/// # Panics
/// If the view is not a valid camera.
pub fn lens(view: &View, deflection: Deflection) -> Lens {
    Lens::new(Camera::new(view).unwrap(), default_atlas(), deflection).unwrap()
}

/// The picture of a scene as the GPU draws it.
///
/// # Panics
/// If the device fails.
pub fn on_gpu(renderer: &Renderer, scene: &Scene) -> Picture {
    block_on(renderer.picture(scene, |_| ())).unwrap()
}

/// The ray outcome of each pixel, as the GPU computes it.
///
/// # Panics
/// If the device fails.
pub fn trace_on_gpu(renderer: &Renderer, lens: &Lens) -> Trace {
    block_on(renderer.trace(lens, |_| ())).unwrap()
}

/// The Rust code of the READMEs, compiled and run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
#[doc = include_str!("../../core/README.md")]
#[doc = include_str!("../../tables/README.md")]
#[doc = include_str!("../../render/README.md")]
pub struct Readmes;
