//! Draws the nebula past a black hole, on the GPU if there is one:
//! `cargo run --release -p lensbake-render --example draw -- hole.png`.

use lensbake_render::camera::{Camera, View};
use lensbake_render::gpu::{Gpu, Renderer};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::PictureFormat;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::{cpu, sky};
use lensbake_tables::default_atlas;
use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let file: PathBuf = std::env::args_os()
        .nth(1)
        .ok_or("name a picture file")?
        .into();
    let format = PictureFormat::of(&file, PictureFormat::ALL)?;

    let view = View {
        radius: 10.0, // Schwarzschild radii
        width: 960,
        height: 540,
        ..View::default()
    };
    let lens = Lens::new(Camera::new(&view)?, default_atlas(), Deflection::Lut)?;
    let sky = sky::load(&sky::SkySource::Nebula)?;
    let scene = Scene::new(lens, sky).with_sampling(Sampling::Filtered);
    let picture = match pollster::block_on(Gpu::open()) {
        Ok(gpu) => pollster::block_on(Renderer::new(&gpu).picture(&scene, |_rows| ()))?,
        Err(_) => cpu::render(&scene, || ()),
    };
    std::fs::write(file, picture.encode(format, 0.0)?)?;
    Ok(())
}
