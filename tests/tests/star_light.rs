//! The light of stars that are very bright or very many: the GPU and the CPU keep all of it.

use glam::{DVec3, Vec3};
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use lensbake_tests::screen::on_screen;
use lensbake_tests::stars::{black, on_cpu, on_gpu};
use viewer::camera::{Camera, View};
use viewer::diff::PictureDifference;
use viewer::gpu::{Live, Renderer, Show, Stopwatch};
use viewer::picture::Picture;
use viewer::scene::{Method, Sampling, Scene};
use viewer::stars::{Catalogue, DEFAULT_DISC_RADIUS, PointStar, Star, StarField};

/// The angle of the stars from the hole, rad: their first image is near the middle of [`scene`]'s picture.
const BETA: f64 = 0.3;

const VIEW: View = View {
    radius: 25.0,
    orbit_deg: 0.0,
    latitude_deg: 0.0,
    yaw_deg: 27.0,
    pitch_deg: 0.0,
    roll_deg: 0.0,
    fov_deg: 40.0,
    width: 240,
    height: 160,
};

fn scene(method: Method) -> Scene {
    Scene::new(Camera::new(&VIEW).unwrap(), default_atlas(), method).unwrap()
}

/// The unit vector, sky frame, to a place at [`BETA`] from the hole, moved aside by `aside`, rad.
fn place(scene: &Scene, aside: [f64; 2]) -> DVec3 {
    let beta = BETA + aside[0];
    let in_hole = DVec3::new(beta.sin(), aside[1], -beta.cos()).normalize();
    scene.camera.sky_from_hole * in_hole
}

fn field(stars: Vec<PointStar>) -> StarField {
    StarField {
        stars,
        disc_radius: DEFAULT_DISC_RADIUS,
    }
}

/// The light of a star in all channels.
fn channels(star: &PointStar) -> f64 {
    star.light.to_array().map(f64::from).iter().sum()
}

fn light(picture: &Picture) -> f64 {
    let pixels = picture.pixels().iter();
    pixels
        .map(|p| p.iter().map(|c| f64::from(*c)).sum::<f64>())
        .sum()
}

#[track_caller]
#[expect(
    clippy::print_stdout,
    reason = "figures for the person who runs the test"
)]
fn same_light(found: f64, expected: f64, most: f64, what: &str) {
    let off = found / expected - 1.0;
    println!("{what}: light {off:+.1e}");
    // Written so that NaN is refused.
    assert!(off.abs() < most, "{what}: {found:e} for {expected:e}");
}

/// The stars of a catalogue with one star of this magnitude, in the place of [`place`].
fn one_star(scene: &Scene, magnitude: f64, stops: f64) -> StarField {
    let star = Star {
        right_ascension: 0.0,
        declination: 0.0,
        magnitude,
        colour_index: Some(1.2),
    };
    let catalogue = Catalogue::new(vec![star], DEFAULT_DISC_RADIUS).unwrap();
    let mut field = StarField::new(&catalogue, stops);
    field.stars[0].direction = place(scene, [0.0; 2]);
    field
}

/// Magnitudes and exposures, up to the most that a catalogue and the command line may ask for.
const BRIGHT: [(f64, f64); 6] = [
    (-10.0, 0.0),
    (-20.0, 0.0),
    (-26.7, 0.0),
    (-30.0, 0.0),
    (-30.0, 30.0),
    (-32.768, 32.0),
];

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn however_bright_a_star_the_gpu_draws_it_as_the_cpu_does() {
    let gpu = gpu();
    let scene = scene(Method::Lut);
    for (magnitude, stops) in BRIGHT {
        let field = one_star(&scene, magnitude, stops);
        let [by_cpu, by_gpu] = [on_cpu(&scene, &field), on_gpu(&gpu, &scene, &field)];
        let what = format!("magnitude {magnitude} at {stops} stops");
        same_light(light(&by_gpu), light(&by_cpu), 2e-4, &what);
        let difference = PictureDifference::of(&by_cpu, &by_gpu);
        println!("{what}: {difference:?}");
        // The rim of its last halo goes from black to white within a part of a pixel.
        assert!(difference.over_two <= 4, "{what}: {difference:?}");
    }
}

/// On the axis the light is greater still: an arc, whose pieces the CPU finds for both.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_ring_of_the_brightest_star_is_finite_and_the_same_on_both() {
    let gpu = gpu();
    let scene = scene(Method::Lut);
    for disc_radius in [DEFAULT_DISC_RADIUS, 1e-300] {
        let mut field = one_star(&scene, -32.768, 32.0);
        field.stars[0].direction = scene.camera.sky_from_hole * DVec3::NEG_Z;
        field.disc_radius = disc_radius;
        let [by_cpu, by_gpu] = [on_cpu(&scene, &field), on_gpu(&gpu, &scene, &field)];
        for picture in [&by_cpu, &by_gpu] {
            let mut channels = picture.pixels().iter().flatten();
            assert!(channels.all(|c| c.is_finite()), "radius {disc_radius:e}");
        }
        let what = format!("ring of a disc of {disc_radius:e} rad");
        same_light(light(&by_gpu), light(&by_cpu), 2e-4, &what);
    }
}

/// The window's picture is of 16-bit floats, which end at 65504: nothing in it may become infinite, for then
/// the screen shows black in the middle of the star.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn however_bright_a_star_the_window_shows_it_as_the_cpu_draws_it() {
    let gpu = gpu();
    let scene = scene(Method::Lut);
    let picture = [scene.camera.width, scene.camera.height];
    let twice_as_large = View {
        width: 480,
        height: 320,
        ..VIEW
    };
    let camera = Camera::new(&twice_as_large).unwrap();
    let enlarged = Scene::new(camera, default_atlas(), Method::Lut).unwrap();
    for (magnitude, stops) in BRIGHT {
        let what = format!("magnitude {magnitude} at {stops} stops");
        let field = one_star(&scene, magnitude, stops);
        let renderer = Renderer::new(&gpu, &black()).unwrap().with_stars(&field);
        let mut live = Live::new(renderer, &scene.row, picture, &[0.05]);
        live.show(&scene, Show::Picture);
        Stopwatch::new(&gpu).submit(&gpu, &live);
        let shown = on_screen(&gpu, &live, picture, &scene);
        let by_cpu = on_cpu(&scene, &field).srgb(0.0);
        let difference = PictureDifference::on_screen(&by_cpu, &shown);
        println!("{what}: {difference:?}");
        assert!(difference.over_two <= 4, "{what}: {difference:?}");
        let large = on_screen(&gpu, &live, picture, &enlarged);
        for (i, pixel) in shown.iter().enumerate() {
            // Enlarged by two, a pixel in the midst of like ones is four of the same.
            let (column, row) = (i as u32 % picture[0], i as u32 / picture[0]);
            let of_four = large[(2 * row * 2 * picture[0] + 2 * column) as usize];
            if pixel.iter().all(|c| *c >= 100) {
                assert!(
                    of_four.iter().any(|c| *c > 0),
                    "{what}: {column}, {row} is black"
                );
            }
        }
    }
}

/// `count` stars within a hundredth of a pixel, each of this light more or less: sums of equal floats would be
/// rounded the same way each time.
fn heap(scene: &Scene, count: u32, light: f32, aside: f64) -> Vec<PointStar> {
    let mut random = fastrand::Rng::with_seed(11);
    // The pixels are 3e-3 rad wide.
    let mut star = |_| PointStar {
        direction: place(scene, [aside + 1e-5 * random.f64(), 1e-5 * random.f64()]),
        light: Vec3::new(1.0, 0.5, 0.25) * (light * (0.5 + random.f32())),
    };
    (0..count).map(&mut star).collect()
}

/// Stars in one place, and the light of each in white pixels: in the core alone, and in halos too.
const MANY: [(u32, f32); 4] = [(60_000, 0.5), (80_000, 0.5), (200_000, 0.5), (80_000, 3.0)];

#[test]
fn the_cpu_keeps_the_light_of_many_stars_in_one_pixel() {
    let scene = scene(Method::Lut);
    for (count, each) in MANY {
        let found = light(&on_cpu(&scene, &field(heap(&scene, count, each, 0.0))));
        // One star with the light of all of them has the same images, in f64.
        let stars = heap(&scene, count, each, 0.0);
        let magnification = light(&on_cpu(&scene, &field(heap(&scene, 1, 1.0, 0.0))))
            / heap(&scene, 1, 1.0, 0.0).iter().map(channels).sum::<f64>();
        let expected = magnification * stars.iter().map(channels).sum::<f64>();
        same_light(found, expected, 1e-4, &format!("{count} stars of {each}"));
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_keeps_the_light_of_many_stars_in_one_pixel() {
    let gpu = gpu();
    for method in [Method::Lut, Method::Direct { step: 0.05 }, Method::Flat] {
        for sampling in [Sampling::Single, Sampling::Filtered] {
            let scene = scene(method).sampled(sampling);
            for (count, each) in MANY {
                let field = field(heap(&scene, count, each, 0.0));
                let [by_cpu, by_gpu] = [on_cpu(&scene, &field), on_gpu(&gpu, &scene, &field)];
                let what = format!("{count} stars of {each}, {method:?}, {sampling:?}");
                same_light(light(&by_gpu), light(&by_cpu), 1e-4, &what);
                let difference = PictureDifference::of(&by_cpu, &by_gpu);
                assert!(difference.over_two == 0, "{what}: {difference:?}");
            }
        }
    }
}

/// Heaps of different heights beside each other, each in its own pixels.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_keeps_the_light_of_many_heaps_of_stars() {
    let gpu = gpu();
    let scene = scene(Method::Lut);
    let heaps = (0..12).flat_map(|i| heap(&scene, 9_000 * i, 0.5, 0.02 * f64::from(i) - 0.12));
    let field = field(heaps.collect());
    let [by_cpu, by_gpu] = [on_cpu(&scene, &field), on_gpu(&gpu, &scene, &field)];
    same_light(light(&by_gpu), light(&by_cpu), 1e-4, "twelve heaps");
    let difference = PictureDifference::of(&by_cpu, &by_gpu);
    assert!(difference.over_two == 0, "{difference:?}");
    let pairs = by_cpu.pixels().iter().zip(by_gpu.pixels());
    for (i, (cpu, gpu)) in pairs.enumerate() {
        let [cpu, gpu] = [cpu, gpu].map(|p| f64::from(p[0]));
        assert!(
            (cpu - gpu).abs() < 1e-3 * cpu + 1e-2,
            "pixel {i}: {gpu} for {cpu}"
        );
    }
}
