//! Golden pictures: figures 8 to 11 of bholetrace's report, r = 50, 10, 5 and 2, with three skies; and moving cameras at
//! the horizon, below it and in orbit.
//!
//! `LENSBAKE_BLESS=1 cargo test -p lensbake-tests --test goldens` redraws them on the CPU. Look at each before you
//! commit it.

use image::ImageReader;
use lensbake_core::Motion;
use lensbake_render::camera::View;
use lensbake_render::diff::PictureDifference;
use lensbake_render::lens::Deflection;
use lensbake_render::picture::Picture;
use lensbake_render::picture::PictureFormat;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::Shift;
use lensbake_render::sky::{self, Sky, SkySource};
use lensbake_render::{cpu, exposure};
use lensbake_tests::{lens, on_gpu, renderer};
use std::path::PathBuf;
use std::sync::Arc;

const RADII: [f64; 4] = [50.0, 10.0, 5.0, 2.0];
const SKIES: [(&str, SkySource); 3] = [
    ("nebula", SkySource::Nebula),
    ("starmap", SkySource::Starmap),
    ("grid", SkySource::Grid),
];

/// A golden picture.
struct Golden {
    name: String,
    scene: Scene,
    /// Exposure, in stops.
    stops: f32,
}

impl Golden {
    fn new(name: String, view: View, sky: &Arc<Sky>, shift: Shift) -> Self {
        let view = View {
            width: 320,
            height: 180,
            ..view
        };
        let lens = lens(&view, Deflection::Lut);
        Golden {
            name,
            stops: exposure::automatic(&lens, shift),
            scene: Scene::new(lens, sky.clone())
                .with_sampling(Sampling::Filtered)
                .with_shift(shift),
        }
    }

    fn path(&self) -> PathBuf {
        path(&self.name)
    }

    /// Another machine rounds differently, so that a footprint may get one more tap.
    fn assert_same(&self, picture: &Picture) {
        let golden = pixels(&self.name);
        let difference = PictureDifference::on_screen(&picture.srgb(self.stops), &golden);
        assert!(difference.mean < 0.02, "{}: {difference:?}", self.name);
        assert!(
            difference.over_two < golden.len() / 1000,
            "{}: {difference:?}",
            self.name
        );
    }
}

fn goldens() -> Vec<Golden> {
    let mut all = Vec::new();
    for (name, source) in &SKIES {
        let sky = Arc::new(sky::load(source).unwrap());
        all.extend(RADII.map(|radius| {
            let view = View {
                radius,
                // So near the hole its shadow fills the view: look past its edge.
                yaw_deg: if radius == 2.0 { 80.0 } else { 0.0 },
                ..View::default()
            };
            Golden::new(format!("{name}-r{radius}"), view, &sky, Shift::Off)
        }));
    }
    all.extend(in_motion());
    all
}

fn in_motion() -> Vec<Golden> {
    let sky = |source| Arc::new(sky::load(&source).unwrap());
    let (nebula, grid) = (sky(SkySource::Nebula), sky(SkySource::Grid));
    let view = |radius, motion, yaw_deg| View {
        radius,
        motion,
        yaw_deg,
        ..View::default()
    };
    let golden =
        |name: &str, view, sky, shift| Golden::new(format!("moving-{name}"), view, sky, shift);
    let sideways = Motion::Velocity {
        radial: 0.0,
        tangential: 0.5,
    };
    vec![
        golden(
            "fall-r1",
            view(1.0, Motion::Fall, 30.0),
            &nebula,
            Shift::Off,
        ),
        golden(
            "fall-r1-grid",
            view(1.0, Motion::Fall, 30.0),
            &grid,
            Shift::Off,
        ),
        golden(
            "fall-r0.3",
            view(0.3, Motion::Fall, 70.0),
            &nebula,
            Shift::Colour,
        ),
        golden(
            "fall-r0.03",
            view(0.03, Motion::Fall, 100.0),
            &grid,
            Shift::Off,
        ),
        golden(
            "orbit-r3",
            view(3.0, Motion::Orbit, 60.0),
            &nebula,
            Shift::Colour,
        ),
        golden(
            "sideways-r0.6",
            view(0.6, sideways, 60.0),
            &nebula,
            Shift::Brightness,
        ),
    ]
}

fn path(name: &str) -> PathBuf {
    lensbake_test_support::workspace().join(format!("tests/goldens/{name}.png"))
}

fn pixels(name: &str) -> Vec<[u8; 3]> {
    let path = path(name);
    let image = ImageReader::open(&path)
        .unwrap_or_else(|e| panic!("{}: {e}; see the head of this file", path.display()))
        .decode()
        .unwrap()
        .into_rgb8();
    image.pixels().map(|p| p.0).collect()
}

#[test]
fn the_cpu_draws_the_goldens() {
    let bless = std::env::var_os("LENSBAKE_BLESS").is_some();
    for golden in goldens() {
        let picture = cpu::render(&golden.scene, || ());
        if bless {
            let file = picture.encode(PictureFormat::Png, golden.stops).unwrap();
            std::fs::write(golden.path(), file).unwrap();
        }
        golden.assert_same(&picture);
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_draws_the_goldens() {
    let renderer = renderer();
    for golden in goldens() {
        golden.assert_same(&on_gpu(&renderer, &golden.scene));
    }
}

#[test]
fn a_golden_is_not_like_the_next() {
    let at_rest = SKIES.map(|(name, _)| RADII.map(|radius| format!("{name}-r{radius}")));
    let moving: Vec<String> = in_motion().into_iter().map(|golden| golden.name).collect();
    for names in at_rest.iter().map(|names| &names[..]).chain([&moving[..]]) {
        for pair in names.windows(2) {
            let difference = PictureDifference::on_screen(&pixels(&pair[0]), &pixels(&pair[1]));
            assert!(difference.mean > 2.0, "{pair:?}: {difference:?}");
        }
    }
}
