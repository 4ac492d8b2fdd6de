//! Light of very bright and of very many stars: neither the GPU nor the CPU loses any of it.

use glam::{DVec3, Vec3};
use lensbake_core::Motion;
use lensbake_render::camera::{Camera, Projection, View};
use lensbake_render::cpu;
use lensbake_render::diff::PictureDifference;
use lensbake_render::gpu::{FrameContent, Gpu, RealtimeRenderer, Renderer, Stopwatch};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::Sampling;
use lensbake_render::stars::{Catalogue, DEFAULT_DISC_RADIUS, PointStar, Star, StarField};
use lensbake_tests::screen::on_screen;
use lensbake_tests::stars::scene;
use lensbake_tests::{lens, renderer};
use pollster::block_on;

/// The angle of the stars from the hole, rad: their first image is near the middle of the picture of [`VIEW`].
const BETA: f64 = 0.3;

const VIEW: View = View {
    radius: 25.0,
    motion: Motion::Rest,
    heading_deg: 0.0,
    orbit_deg: 0.0,
    latitude_deg: 0.0,
    yaw_deg: 27.0,
    pitch_deg: 0.0,
    roll_deg: 0.0,
    projection: Projection::Perspective,
    fov_deg: 40.0,
    width: 240,
    height: 160,
};

/// The picture of the stars alone, one ray per pixel, as the CPU draws it.
fn on_cpu(lens: &Lens, field: &StarField) -> Picture {
    cpu::render(&scene(lens, field), || ())
}

/// The same picture as the GPU draws it.
fn on_gpu(renderer: &Renderer, lens: &Lens, field: &StarField) -> Picture {
    lensbake_tests::on_gpu(renderer, &scene(lens, field))
}

/// The unit vector, sky frame, at [`BETA`] from the hole, offset by `aside`, rad.
fn place(lens: &Lens, aside: [f64; 2]) -> DVec3 {
    let beta = BETA + aside[0];
    let in_hole = DVec3::new(beta.sin(), aside[1], -beta.cos()).normalize();
    lens.camera.sky_from_hole * in_hole
}

fn field(stars: Vec<PointStar>) -> StarField {
    StarField {
        stars,
        disc_radius: DEFAULT_DISC_RADIUS,
    }
}

/// The light of a star, summed over the channels.
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

/// A field of one star of this magnitude, at [`place`].
fn one_star(lens: &Lens, magnitude: f64, stops: f64) -> StarField {
    let star = Star {
        right_ascension: 0.0,
        declination: 0.0,
        magnitude,
        colour_index: Some(1.2),
    };
    let catalogue = Catalogue::new(vec![star], DEFAULT_DISC_RADIUS).unwrap();
    let mut field = StarField::new(&catalogue, stops);
    field.stars[0].direction = place(lens, [0.0; 2]);
    field
}

/// Magnitudes and exposures (stops), at least up to the most that a catalogue and the command line accept.
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
    let renderer = renderer();
    let lens = lens(&VIEW, Deflection::Lut);
    for (magnitude, stops) in BRIGHT {
        let field = one_star(&lens, magnitude, stops);
        let [by_cpu, by_gpu] = [on_cpu(&lens, &field), on_gpu(&renderer, &lens, &field)];
        let what = format!("magnitude {magnitude} at {stops} stops");
        same_light(light(&by_gpu), light(&by_cpu), 2e-4, &what);
        let difference = PictureDifference::of(&by_cpu, &by_gpu);
        println!("{what}: {difference:?}");
        // The rim of its last halo goes from black to white within a fraction of a pixel.
        assert!(difference.over_two <= 4, "{what}: {difference:?}");
    }
}

/// On the axis the magnification is greater still: the image is an arc, whose pieces the CPU computes for both.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_ring_of_the_brightest_star_is_finite_and_the_same_on_both() {
    let renderer = renderer();
    let lens = lens(&VIEW, Deflection::Lut);
    for disc_radius in [DEFAULT_DISC_RADIUS, 1e-300] {
        let mut field = one_star(&lens, -32.768, 32.0);
        field.stars[0].direction = lens.camera.sky_from_hole * DVec3::NEG_Z;
        field.disc_radius = disc_radius;
        let [by_cpu, by_gpu] = [on_cpu(&lens, &field), on_gpu(&renderer, &lens, &field)];
        for picture in [&by_cpu, &by_gpu] {
            let mut channels = picture.pixels().iter().flatten();
            assert!(channels.all(|c| c.is_finite()), "radius {disc_radius:e}");
        }
        let what = format!("ring of a disc of {disc_radius:e} rad");
        same_light(light(&by_gpu), light(&by_cpu), 2e-4, &what);
    }
}

/// The window's picture has 16-bit floats, of which the largest is 65504. No value may become infinite: the screen
/// would show black in the middle of the star.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn however_bright_a_star_the_window_shows_it_as_the_cpu_draws_it() {
    let renderer = renderer();
    let lens = lens(&VIEW, Deflection::Lut);
    let gpu: &Gpu = renderer.gpu();
    let picture = [lens.camera.width, lens.camera.height];
    let twice_as_large = View {
        width: 480,
        height: 320,
        ..VIEW
    };
    let enlarged = Camera::new(&twice_as_large).unwrap();
    for (magnitude, stops) in BRIGHT {
        let what = format!("magnitude {magnitude} at {stops} stops");
        let field = one_star(&lens, magnitude, stops);
        let mut live = RealtimeRenderer::new(renderer.clone(), picture);
        let resident = block_on(renderer.upload(&scene(&lens, &field))).unwrap();
        live.show(&resident, FrameContent::Picture);
        Stopwatch::new(gpu).submit(gpu, &live);
        let shown = on_screen(gpu, &live, picture, &lens.camera);
        let by_cpu = on_cpu(&lens, &field).srgb(0.0);
        let difference = PictureDifference::on_screen(&by_cpu, &shown);
        println!("{what}: {difference:?}");
        assert!(difference.over_two <= 4, "{what}: {difference:?}");
        let large = on_screen(gpu, &live, picture, &enlarged);
        for (i, pixel) in shown.iter().enumerate() {
            // Enlarged by two, a pixel among similar ones becomes four similar ones.
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

/// `count` stars within a hundredth of a pixel, each of about this light. Their light varies because sums of equal
/// floats would be rounded in the same direction each time.
fn star_cluster(lens: &Lens, count: u32, light: f32, aside: f64) -> Vec<PointStar> {
    let mut random = fastrand::Rng::with_seed(11);
    // The pixels are 3e-3 rad wide.
    let mut star = |_| PointStar {
        direction: place(lens, [aside + 1e-5 * random.f64(), 1e-5 * random.f64()]),
        light: Vec3::new(1.0, 0.5, 0.25) * (light * (0.5 + random.f32())),
    };
    (0..count).map(&mut star).collect()
}

/// Numbers of stars in one place, and the light of each in white pixels: drawn as cores alone, and with halos.
const MANY: [(u32, f32); 4] = [(60_000, 0.5), (80_000, 0.5), (200_000, 0.5), (80_000, 3.0)];

#[test]
fn the_cpu_keeps_the_light_of_many_stars_in_one_pixel() {
    let lens = lens(&VIEW, Deflection::Lut);
    for (count, each) in MANY {
        let found = light(&on_cpu(
            &lens,
            &field(star_cluster(&lens, count, each, 0.0)),
        ));
        // One star with the light of all of them has the same images, in f64.
        let stars = star_cluster(&lens, count, each, 0.0);
        let magnification = light(&on_cpu(&lens, &field(star_cluster(&lens, 1, 1.0, 0.0))))
            / star_cluster(&lens, 1, 1.0, 0.0)
                .iter()
                .map(channels)
                .sum::<f64>();
        let expected = magnification * stars.iter().map(channels).sum::<f64>();
        same_light(found, expected, 1e-4, &format!("{count} stars of {each}"));
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_keeps_the_light_of_many_stars_in_one_pixel() {
    let renderer = renderer();
    for method in [
        Deflection::Lut,
        Deflection::Direct { step: 0.05 },
        Deflection::Flat,
    ] {
        for sampling in [Sampling::Single, Sampling::Filtered] {
            let lens = lens(&VIEW, method);
            for (count, each) in MANY {
                let field = field(star_cluster(&lens, count, each, 0.0));
                let scene = scene(&lens, &field).with_sampling(sampling);
                let by_cpu = cpu::render(&scene, || ());
                let by_gpu = lensbake_tests::on_gpu(&renderer, &scene);
                let what = format!("{count} stars of {each}, {method:?}, {sampling:?}");
                same_light(light(&by_gpu), light(&by_cpu), 1e-4, &what);
                let difference = PictureDifference::of(&by_cpu, &by_gpu);
                assert!(difference.over_two == 0, "{what}: {difference:?}");
            }
        }
    }
}

/// Groups of different numbers of stars beside each other, each in its own pixels.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_keeps_the_light_of_many_heaps_of_stars() {
    let renderer = renderer();
    let lens = lens(&VIEW, Deflection::Lut);
    let heaps =
        (0..12).flat_map(|i| star_cluster(&lens, 9_000 * i, 0.5, 0.02 * f64::from(i) - 0.12));
    let field = field(heaps.collect());
    for sampling in [Sampling::Single, Sampling::Filtered] {
        let scene = scene(&lens, &field).with_sampling(sampling);
        let by_cpu = cpu::render(&scene, || ());
        let by_gpu = lensbake_tests::on_gpu(&renderer, &scene);
        same_light(light(&by_gpu), light(&by_cpu), 1e-4, "twelve heaps");
        let difference = PictureDifference::of(&by_cpu, &by_gpu);
        assert!(difference.over_two == 0, "{sampling:?}: {difference:?}");
        let pairs = by_cpu.pixels().iter().zip(by_gpu.pixels());
        for (i, (cpu, gpu)) in pairs.enumerate() {
            let [cpu, gpu] = [cpu, gpu].map(|p| f64::from(p[0]));
            assert!(
                (cpu - gpu).abs() < 1e-3 * cpu + 1e-2,
                "{sampling:?}, pixel {i}: {gpu} for {cpu}"
            );
        }
    }
}
