//! Golden pictures: the seed report's figures 8 to 11, r = 50, 10, 5 and 2, before three skies.
//!
//! `LENSBAKE_BLESS=1 cargo test -p lensbake-tests --test goldens` draws them anew on the CPU. Look at
//! each before you commit it.

use image::ImageReader;
use lensbake_tables::default_atlas;
use std::path::PathBuf;
use viewer::camera::{Camera, View};
use viewer::cpu;
use viewer::diff::PictureDifference;
use viewer::gpu::Renderer;
use viewer::picture::Picture;
use viewer::scene::{Method, Scene};
use viewer::sky::{self, SkySource};

const RADII: [f64; 4] = [50.0, 10.0, 5.0, 2.0];
const SKIES: [(&str, SkySource); 3] = [
    ("nebula", SkySource::Nebula),
    ("starmap", SkySource::Starmap),
    ("grid", SkySource::Grid),
];

fn scene(radius: f64) -> Scene {
    let view = View {
        radius,
        // So near the hole its shadow fills the view: look past its edge.
        yaw_deg: if radius == 2.0 { 80.0 } else { 0.0 },
        width: 320,
        height: 180,
        ..View::default()
    };
    Scene::new(Camera::new(&view).unwrap(), default_atlas(), Method::Lut).unwrap()
}

fn golden_path(sky: &str, radius: f64) -> PathBuf {
    lensbake_tests::workspace().join(format!("tests/goldens/{sky}-r{radius}.png"))
}

fn golden(sky: &str, radius: f64) -> Picture {
    let path = golden_path(sky, radius);
    let image = ImageReader::open(&path)
        .unwrap_or_else(|e| panic!("{}: {e}; see the head of this file", path.display()))
        .decode()
        .unwrap()
        .into_rgb8();
    let linear = |c: u8| {
        let c = f32::from(c) / 255.0;
        if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    };
    let pixels = image.pixels().map(|p| p.0.map(linear)).collect();
    Picture::new(image.width(), image.height(), pixels)
}

/// Beside the edge a pixel is one sample of a sky that is squeezed a thousandfold: a rounding moves it.
/// So a few pixels may differ by much, the rest by no more than rounding.
fn assert_same(picture: &Picture, golden: &Picture, what: &str) {
    let difference = PictureDifference::of(picture, golden);
    assert!(difference.mean < 0.25, "{what}: {difference:?}");
    assert!(
        difference.over_two < golden.pixels().len() / 100,
        "{what}: {difference:?}"
    );
}

#[test]
fn the_cpu_draws_the_goldens() {
    let bless = std::env::var_os("LENSBAKE_BLESS").is_some();
    for (name, source) in &SKIES {
        let sky = sky::load(source).unwrap();
        for radius in RADII {
            let picture = cpu::render(&scene(radius), &sky, || ());
            if bless {
                picture.write(&golden_path(name, radius)).unwrap();
            }
            assert_same(
                &picture,
                &golden(name, radius),
                &format!("{name} at r {radius}"),
            );
        }
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_the_goldens() {
    let gpu = lensbake_tests::gpu();
    for (name, source) in &SKIES {
        let renderer = Renderer::new(&gpu, &sky::load(source).unwrap()).unwrap();
        for radius in RADII {
            let picture = renderer.picture(&scene(radius), |_| ()).unwrap();
            assert_same(
                &picture,
                &golden(name, radius),
                &format!("{name} at r {radius}"),
            );
        }
    }
}

#[test]
fn a_golden_is_not_like_the_next() {
    for (name, _) in &SKIES {
        for pair in RADII.windows(2) {
            let difference = PictureDifference::of(&golden(name, pair[0]), &golden(name, pair[1]));
            assert!(difference.mean > 2.0, "{name} {pair:?}: {difference:?}");
        }
    }
}
