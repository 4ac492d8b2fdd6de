//! The filtered picture: against many rays a pixel, on the GPU against the CPU, and what its edge and its
//! seams look like.

use glam::Vec3;
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use viewer::camera::{Camera, View};
use viewer::cpu;
use viewer::diff::PictureDifference;
use viewer::gpu::Renderer;
use viewer::picture::Picture;
use viewer::reference::{self, PictureError};
use viewer::scene::{Method, Sampling, Scene};
use viewer::sky::{self, Sky};

fn scene(view: View, method: Method) -> Scene {
    Scene::new(Camera::new(&view).unwrap(), default_atlas(), method).unwrap()
}

fn small(radius: f64, yaw_deg: f64) -> View {
    View {
        radius,
        yaw_deg,
        width: 160,
        height: 90,
        ..View::default()
    }
}

/// The seed report's four radii, and the skies of a quarter of the resolution of those shipped: as in
/// a picture four times as wide, a pixel is about half a texel.
const VIEWS: [(f64, f64); 4] = [(50.0, 0.0), (10.0, 0.0), (5.0, 0.0), (2.0, 80.0)];

fn skies() -> [(&'static str, Sky); 3] {
    [
        ("nebula", sky::nebula(256)),
        ("starmap", sky::starmap(256)),
        ("grid", sky::grid(256)),
    ]
}

/// The bars of `viewer reference`, on the CPU in f64 and with 64 rays a pixel.
#[test]
fn the_filtered_picture_is_the_mean_of_many_rays() {
    for (name, sky) in skies() {
        for (radius, yaw_deg) in VIEWS {
            let scene = scene(small(radius, yaw_deg), Method::Lut);
            let many = reference::on_cpu(&scene, &sky, 8);
            let error = |sampling| {
                let picture = cpu::render(&scene.sampled(sampling), &sky, || ());
                PictureError::of(&scene, &picture, &many)
            };
            let (filtered, single) = (error(Sampling::Filtered), error(Sampling::Single));
            let at = format!("{name}, r {radius}: {filtered:?} and {single:?}");
            assert!(filtered.beside_edge.pixels > 500, "{at}");
            assert!(filtered.whole.screen < 1.0, "{at}");
            assert!(filtered.beside_edge.screen < 4.0, "{at}");
            assert!(
                2.0 * filtered.beside_edge.screen < single.beside_edge.screen,
                "{at}"
            );
        }
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_filters_as_the_cpu_does() {
    let gpu = gpu();
    let sky = sky::grid(300);
    let renderer = Renderer::new(&gpu, &sky).unwrap();
    let turned = View {
        orbit_deg: 40.0,
        latitude_deg: -25.0,
        pitch_deg: 10.0,
        roll_deg: 5.0,
        ..small(6.0, 15.0)
    };
    let close = View {
        fov_deg: 0.01,
        ..small(1e6, 0.0)
    };
    let mut compared = 0;
    for view in [
        turned,
        small(1.01, 150.0),
        small(1.2, 180.0),
        small(1000.0, 0.0),
        close,
    ] {
        for method in [Method::Lut, Method::Direct { step: 0.05 }, Method::Flat] {
            // f32 cannot integrate from so far away: the orbit starts too flat.
            if view.radius > 1e5 && matches!(method, Method::Direct { .. }) {
                continue;
            }
            let scene = scene(view, method).sampled(Sampling::Filtered);
            let on_cpu = cpu::render(&scene, &sky, || ());
            let on_gpu = renderer.picture(&scene, |_| ()).unwrap();
            let difference = PictureDifference::of(&on_cpu, &on_gpu);
            let at = format!("{view:?} {method:?}: {difference:?}");
            assert!(difference.mean < 0.1, "{at}");
            assert!(difference.over_two < on_cpu.pixels().len() / 200, "{at}");
            compared += 1;
        }
    }
    assert_eq!(compared, 14);
}

/// Beside the edge a single ray flickers from pixel to pixel; the mean of the crowded images does not.
/// The sky turned by any angle about the line of sight gives the ring the same light.
#[test]
fn the_ring_at_the_edge_has_no_noise() {
    // Bright on one side: every winding passes through light and dark.
    let sky = Sky::from_fn(64, |d| Vec3::splat(if d.x > 0.0 { 1.0 } else { 0.0 }));
    for radius in [1.2, 3.0, 30.0] {
        let edge = Camera::new(&small(radius, 0.0))
            .unwrap()
            .observer
            .edge_angle();
        let view = View {
            orbit_deg: 90.0,
            fov_deg: 10.0,
            ..small(radius, edge.to_degrees())
        };
        let jitter = |sampling| {
            let scene = scene(view, Method::Lut).sampled(sampling);
            let picture = cpu::render(&scene, &sky, || ());
            let along_edge = |row: usize| ring(&scene, &picture, row as u32);
            let steps = (30..60).map(|row| (along_edge(row + 1) - along_edge(row)).abs());
            steps.fold(0.0, f64::max)
        };
        let (single, filtered) = (jitter(Sampling::Single), jitter(Sampling::Filtered));
        assert!(filtered < 0.1, "r {radius}: {filtered}");
        assert!(single > 3.0 * filtered, "r {radius}: {single} {filtered}");
    }
}

/// The light of the three pixels of a row that lie next to the edge.
fn ring(scene: &Scene, picture: &Picture, row: u32) -> f64 {
    let pixels = viewer::filtered::Pixels::new(scene);
    let line =
        (0..picture.width()).filter(|&x| (-1.0..2.0).contains(&pixels.edge_distance(x, row)));
    line.map(|x| f64::from(picture.pixels()[(row * picture.width() + x) as usize][0]))
        .sum()
}

/// Minified a hundredfold, the sky has no seam where the cube's faces meet.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn coarse_levels_have_no_seam() {
    let sky = Sky::from_fn(512, |direction| 0.5 + 0.4 * direction);
    let renderer = Renderer::new(&gpu(), &sky).unwrap();
    for (yaw_deg, pitch_deg) in [(180.0, 0.0), (135.0, 35.0), (225.0, -35.0), (180.0, 80.0)] {
        let view = View {
            pitch_deg,
            width: 64,
            height: 36,
            ..small(1000.0, yaw_deg)
        };
        let scene = scene(view, Method::Lut).sampled(Sampling::Filtered);
        let picture = renderer.picture(&scene, |_| ()).unwrap();
        let width = picture.width() as usize;
        let smooth = |pair: [usize; 2]| {
            let [a, b] = pair.map(|i| Vec3::from(picture.pixels()[i]));
            (a - b).abs().max_element() < 0.03
        };
        assert!((0..picture.pixels().len() - width).all(|i| smooth([i, i + width])));
    }
}
