//! The filtered picture: against many rays a pixel, on the GPU against the CPU, and what its edge and its
//! seams look like.

use glam::Vec3;
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use viewer::camera::{Camera, View};
use viewer::cpu;
use viewer::diff::PictureDifference;
use viewer::gpu::Renderer;
use viewer::reference::{self, PictureError};
use viewer::scene::{Method, Sampling, Scene};
use viewer::sky::{self, Sky, SkySource};

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

/// What `viewer reference` measures, on the CPU in f64, with 64 rays a pixel and in small pictures across
/// the edge with pixels as large as there. Turned about the hole, a picture may be harder than those that
/// its bars are for: beside the edge it may be off by 6.
#[test]
fn the_filtered_picture_is_the_mean_of_many_rays() {
    for source in [SkySource::Starmap, SkySource::Grid] {
        let sky = sky::load(&source).unwrap();
        for radius in [50.0, 10.0, 5.0, 2.0] {
            let view = View {
                orbit_deg: 30.0,
                latitude_deg: 20.0,
                fov_deg: 25.0,
                ..small(radius, edge_deg(radius))
            };
            let scene = scene(view, Method::Lut);
            let many = reference::on_cpu(&scene, &sky, 8);
            let error = |sampling| {
                let picture = cpu::render(&scene.sampled(sampling), &sky, || ());
                PictureError::of(&scene, &picture, &many)
            };
            let (filtered, single) = (error(Sampling::Filtered), error(Sampling::Single));
            let at = format!("{source:?}, r {radius}: {filtered:?} and {single:?}");
            assert!(filtered.beside_edge.pixels > 500, "{at}");
            assert!(filtered.whole.screen < 1.0, "{at}");
            assert!(filtered.beside_edge.screen < 6.0, "{at}");
            assert!(
                2.0 * filtered.beside_edge.screen < single.beside_edge.screen,
                "{at}"
            );
        }
    }
}

fn edge_deg(radius: f64) -> f64 {
    let camera = Camera::new(&small(radius, 0.0)).unwrap();
    camera.observer.edge_angle().to_degrees()
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
            let finite = |light: &[f32; 3]| light.iter().all(|channel| channel.is_finite());
            assert!(on_gpu.pixels().iter().all(finite), "{at}");
            assert!(difference.mean < 0.1, "{at}");
            assert!(difference.over_two < on_cpu.pixels().len() / 200, "{at}");
            compared += 1;
        }
    }
    assert_eq!(compared, 14);
}

/// Before a sky of rings about the hole, what a row of pixels across the edge sees changes smoothly from
/// row to row. Single rays beside the edge fall on light or dark by chance.
#[test]
fn the_ring_at_the_edge_has_no_noise() {
    let sky = Sky::from_fn(256, |d| {
        Vec3::splat((3.0 * d.z + 0.5).floor().rem_euclid(2.0))
    });
    for radius in [1.2, 3.0, 30.0] {
        let view = View {
            fov_deg: 10.0,
            ..small(radius, edge_deg(radius))
        };
        let noise = |sampling| {
            let scene = scene(view, Method::Lut).sampled(sampling);
            let picture = cpu::render(&scene, &sky, || ());
            // From within the shadow to six pixels beyond its edge in the middle row.
            let across = |row: &[[f32; 3]]| row[..86].iter().map(|light| light[0]).sum::<f32>();
            let rows: Vec<f32> = picture.pixels().chunks_exact(160).map(across).collect();
            let bends = rows.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs());
            bends.sum::<f32>() / 88.0
        };
        let (single, filtered) = (noise(Sampling::Single), noise(Sampling::Filtered));
        assert!(filtered < 0.1, "r {radius}: {filtered}");
        assert!(single > 10.0 * filtered, "r {radius}: {single} {filtered}");
    }
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
