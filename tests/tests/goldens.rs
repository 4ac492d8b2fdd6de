//! Golden pictures: figures 8 to 11 of bholetrace's report, r = 50, 10, 5 and 2, with three skies.
//!
//! `LENSBAKE_BLESS=1 cargo test -p lensbake-tests --test goldens` redraws them on the CPU. Look at each before you
//! commit it.

use image::ImageReader;
use lensbake_render::camera::View;
use lensbake_render::cpu;
use lensbake_render::diff::PictureDifference;
use lensbake_render::lens::Deflection;
use lensbake_render::picture::Picture;
use lensbake_render::picture::PictureFormat;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::{self, Sky, SkySource};
use lensbake_tests::{lens, on_gpu, renderer};
use std::path::PathBuf;
use std::sync::Arc;

const RADII: [f64; 4] = [50.0, 10.0, 5.0, 2.0];
const SKIES: [(&str, SkySource); 3] = [
    ("nebula", SkySource::Nebula),
    ("starmap", SkySource::Starmap),
    ("grid", SkySource::Grid),
];

fn scene(radius: f64, sky: &Arc<Sky>) -> Scene {
    let view = View {
        radius,
        // So near the hole its shadow fills the view: look past its edge.
        yaw_deg: if radius == 2.0 { 80.0 } else { 0.0 },
        width: 320,
        height: 180,
        ..View::default()
    };
    Scene::new(lens(&view, Deflection::Lut), sky.clone()).with_sampling(Sampling::Filtered)
}

fn golden_path(sky: &str, radius: f64) -> PathBuf {
    lensbake_test_support::workspace().join(format!("tests/goldens/{sky}-r{radius}.png"))
}

fn golden(sky: &str, radius: f64) -> Vec<[u8; 3]> {
    let path = golden_path(sky, radius);
    let image = ImageReader::open(&path)
        .unwrap_or_else(|e| panic!("{}: {e}; see the head of this file", path.display()))
        .decode()
        .unwrap()
        .into_rgb8();
    image.pixels().map(|p| p.0).collect()
}

/// Another machine rounds differently, so that a footprint may get one more tap.
fn assert_same(picture: &Picture, golden: &[[u8; 3]], what: &str) {
    let difference = PictureDifference::on_screen(&picture.srgb(0.0), golden);
    assert!(difference.mean < 0.02, "{what}: {difference:?}");
    assert!(
        difference.over_two < golden.len() / 1000,
        "{what}: {difference:?}"
    );
}

#[test]
fn the_cpu_draws_the_goldens() {
    let bless = std::env::var_os("LENSBAKE_BLESS").is_some();
    for (name, source) in &SKIES {
        let sky = Arc::new(sky::load(source).unwrap());
        for radius in RADII {
            let picture = cpu::render(&scene(radius, &sky), || ());
            if bless {
                let file = picture.encode(PictureFormat::Png, 0.0).unwrap();
                std::fs::write(golden_path(name, radius), file).unwrap();
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
    let renderer = renderer();
    for (name, source) in &SKIES {
        let sky = Arc::new(sky::load(source).unwrap());
        for radius in RADII {
            let picture = on_gpu(&renderer, &scene(radius, &sky));
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
            let difference =
                PictureDifference::on_screen(&golden(name, pair[0]), &golden(name, pair[1]));
            assert!(difference.mean > 2.0, "{name} {pair:?}: {difference:?}");
        }
    }
}
