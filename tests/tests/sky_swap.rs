//! The sky of a finished picture, swapped in compositing: a panorama sampled by the layer `uv` and multiplied by 1 −
//! `captured` is the picture that the renderer draws with that panorama.

use glam::Vec3;
use lensbake_core::Motion;
use lensbake_render::camera::View;
use lensbake_render::layers::{self, Layer};
use lensbake_render::lens::Deflection;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::{cpu, sky};
use lensbake_tests::lens;
use std::f32::consts::{PI, TAU};
use std::path::Path;
use tempfile::TempDir;

const WIDTH: u32 = 2048;
const HEIGHT: u32 = 1024;

/// Largest difference of a swapped sky from the drawn one, of light between 0 and 1. The renderer samples the panorama
/// once more, as a cube map of half floats.
const TOLERANCE: f32 = 2e-3;

/// A panorama without a symmetry, whose values differ from pixel to pixel by a few thousandths.
fn panorama() -> image::Rgb32FImage {
    image::Rgb32FImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let longitude = TAU * ((x as f32 + 0.5) / WIDTH as f32 - 0.5);
        let latitude = PI * (0.5 - (y as f32 + 0.5) / HEIGHT as f32);
        let (x, y) = (latitude.cos() * longitude.sin(), latitude.sin());
        let z = -latitude.cos() * longitude.cos();
        let wave = |phase: f32| 0.5 + 0.4 * phase.sin();
        image::Rgb([wave(5.0 * x + y), wave(7.0 * y + 0.3), wave(6.0 * z - x)])
    })
}

/// What a compositor's STMap node does: the pixel at U from the left and V from the bottom, bilinear, repeated
/// sideways.
fn st_map(panorama: &image::Rgb32FImage, u: f32, v: f32) -> Vec3 {
    let (x, y) = (u * WIDTH as f32 - 0.5, (1.0 - v) * HEIGHT as f32 - 0.5);
    let pixel = |dx: i64, dy: i64| {
        let column = (x.floor() as i64 + dx).rem_euclid(WIDTH.into());
        let row = (y.floor() as i64 + dy).clamp(0, i64::from(HEIGHT) - 1);
        Vec3::from(panorama.get_pixel(column as u32, row as u32).0)
    };
    let (right, down) = (x - x.floor(), y - y.floor());
    let above = pixel(0, 0).lerp(pixel(1, 0), right);
    let below = pixel(0, 1).lerp(pixel(1, 1), right);
    above.lerp(below, down)
}

fn loaded(file: &Path) -> sky::Sky {
    sky::load(&sky::SkySource::Panorama(file.to_owned())).unwrap()
}

#[test]
fn a_sky_swapped_by_the_layers_is_the_one_that_the_renderer_draws() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("sky.exr");
    let panorama = panorama();
    panorama.save(&file).unwrap();
    let views = [
        (10.0, Motion::Rest, 0.0),
        (2.0, Motion::Rest, 70.0),
        (0.5, Motion::Fall, 90.0),
        (4.0, Motion::Orbit, -40.0),
    ];
    let (mut worst, mut compared) = (0_f32, 0);
    for (radius, motion, yaw_deg) in views {
        let view = View {
            radius,
            motion,
            yaw_deg,
            orbit_deg: 130.0,
            latitude_deg: 25.0,
            width: 320,
            height: 180,
            ..View::default()
        };
        let lens = lens(&view, Deflection::Lut);
        let layers = [Layer::Uv, Layer::Captured];
        let channels = layers::trace(&lens, &layers, Sampling::Single, None, || ());
        let [u, v, captured] = &channels[..] else {
            panic!("three channels")
        };
        let scene = Scene::new(lens, loaded(&file));
        let drawn = cpu::render(&scene, || ());
        for (i, pixel) in drawn.pixels().iter().enumerate() {
            let [u, v, captured] = [u, v, captured].map(|channel| channel.samples[i]);
            let swapped = st_map(&panorama, u, v) * (1.0 - captured);
            let off = (swapped - Vec3::from(*pixel)).abs().max_element();
            // Beside the shadow too: there is one ray a pixel in both.
            assert!(off < TOLERANCE, "{view:?}, pixel {i}: {off}");
            worst = worst.max(off);
            compared += usize::from(captured == 0.0);
        }
    }
    println!("swapped sky: {worst:.1e} over {compared} pixels of sky");
    assert!(compared > 100_000, "{compared}");
}
