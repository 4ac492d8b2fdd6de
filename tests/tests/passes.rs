//! Pictures drawn by render passes against the same pictures drawn by compute passes, on the same device and on one
//! without compute shaders.

use glam::Vec3;
use lensbake_core::Motion;
use lensbake_render::camera::{Projection, View};
use lensbake_render::diff::PictureDifference;
use lensbake_render::gpu::{
    FrameContent, Gpu, Output, Pass, RealtimeRenderer, Renderer, ResidentScene, Stopwatch,
};
use lensbake_render::lens::Deflection;
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::Shift;
use lensbake_render::sky::{self, Sky, SkySource};
use lensbake_render::stars::{StarField, hipparcos};
use lensbake_tests::screen::on_screen;
use lensbake_tests::{gpu, lens, on_gpu, trace_on_gpu};
use pollster::block_on;
use std::sync::Arc;

/// Wider than high, and its width is no multiple of the 16 pixels to which a copied row is padded.
const VIEW: View = View {
    radius: 10.0,
    motion: Motion::Rest,
    heading_deg: 0.0,
    orbit_deg: 20.0,
    latitude_deg: 10.0,
    yaw_deg: 12.0,
    pitch_deg: 5.0,
    roll_deg: 3.0,
    projection: Projection::Perspective,
    fov_deg: 90.0,
    width: 331,
    height: 187,
};

const DIRECT: Deflection = Deflection::Direct { step: 0.1 };
const SAMPLINGS: [Sampling; 2] = [Sampling::Single, Sampling::Filtered];

fn nebula() -> Arc<Sky> {
    sky::load(&SkySource::Nebula).unwrap().into()
}

/// At rest, falling below the horizon, in orbit with all of the frequency shift, by direct integration, and flat.
fn scenes(sky: &Arc<Sky>) -> [(&'static str, Scene); 5] {
    let scene = |view: View, deflection| Scene::new(lens(&view, deflection), sky.clone());
    let falling = View {
        radius: 0.6,
        motion: Motion::Fall,
        yaw_deg: 60.0,
        ..VIEW
    };
    let in_orbit = View {
        radius: 3.0,
        motion: Motion::Orbit,
        yaw_deg: 50.0,
        ..VIEW
    };
    [
        ("at rest", scene(VIEW, Deflection::Lut)),
        ("falling", scene(falling, Deflection::Lut)),
        (
            "in orbit",
            scene(in_orbit, Deflection::Lut).with_shift(Shift::Colour),
        ),
        ("direct", scene(VIEW, DIRECT)),
        ("flat", scene(VIEW, Deflection::Flat)),
    ]
}

/// Checks that two pictures are the same up to rounding, which may change a pixel of the shadow's edge as a whole if
/// it is drawn by one ray.
fn assert_same(what: &str, one: &Picture, other: &Picture) {
    let light = |picture: &Picture| -> f64 {
        let all = picture.pixels().iter().flatten();
        all.map(|c| f64::from(*c)).sum::<f64>() / picture.pixels().len() as f64
    };
    assert!(light(one) > 0.01, "{what}: dark");
    let differing = one
        .pixels()
        .iter()
        .zip(other.pixels())
        .filter(|(a, b)| {
            let off = |(a, b): (&f32, &f32)| (a - b).abs() > 1e-3 * (1.0 + a.abs());
            a.iter().zip(*b).any(off)
        })
        .count();
    let off = PictureDifference::of(one, other);
    assert!(differing <= 3, "{what}: {differing} pixels, {off:?}");
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn render_passes_draw_what_compute_passes_draw() {
    let gpu = gpu();
    let [compute, fragment] =
        [Pass::Compute, Pass::Fragment].map(|pass| Renderer::with_pass(&gpu, pass));
    assert_eq!(fragment.pass(Output::Trace), Pass::Fragment);
    let stars: Arc<StarField> = StarField::new(&hipparcos(), 0.0).into();
    for (name, scene) in scenes(&nebula()) {
        for sampling in SAMPLINGS {
            let scene = scene.clone().with_sampling(sampling);
            let what = format!("{name}, {sampling:?}");
            assert_same(&what, &on_gpu(&compute, &scene), &on_gpu(&fragment, &scene));
        }
        let scene = scene
            .with_sampling(Sampling::Filtered)
            .with_stars(stars.clone());
        let what = format!("{name}, with stars");
        assert_same(&what, &on_gpu(&compute, &scene), &on_gpu(&fragment, &scene));
    }
}

/// A renderer that chooses the kind of pass, and changes it with the sampling, draws what both kinds draw.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_faster_kind_of_pass_draws_the_same() {
    let gpu = gpu();
    let chooses = Renderer::new(&gpu);
    let single = if gpu.is_software() {
        Pass::Fragment
    } else {
        Pass::Compute
    };
    assert_eq!(chooses.pass(Output::Picture(Sampling::Single)), single);
    assert_eq!(
        chooses.pass(Output::Picture(Sampling::Filtered)),
        Pass::Compute
    );
    let compute = Renderer::with_pass(&gpu, Pass::Compute);
    let (name, scene) = scenes(&nebula()).into_iter().next().unwrap();
    for sampling in SAMPLINGS.into_iter().chain(SAMPLINGS) {
        let scene = scene.clone().with_sampling(sampling);
        let what = format!("{name}, {sampling:?}, chosen");
        assert_same(&what, &on_gpu(&compute, &scene), &on_gpu(&chooses, &scene));
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn a_device_without_compute_shaders_draws_the_same() {
    let without = block_on(Gpu::open_without_compute()).unwrap();
    assert!(!without.has_compute());
    let without = Renderer::with_pass(&without, Pass::Compute);
    assert_eq!(without.pass(Output::Trace), Pass::Fragment);
    assert!(!without.draws_stars());
    let compute = Renderer::with_pass(&gpu(), Pass::Compute);
    let stars: Arc<StarField> = StarField::new(&hipparcos(), 0.0).into();
    for (name, scene) in scenes(&nebula()) {
        for sampling in SAMPLINGS {
            let scene = scene.clone().with_sampling(sampling);
            let expected = on_gpu(&compute, &scene);
            assert_same(
                &format!("{name}, {sampling:?}"),
                &expected,
                &on_gpu(&without, &scene),
            );
            // The stars are left out, without an error.
            let with_stars = scene.with_stars(stars.clone());
            let what = format!("{name}, {sampling:?}, without its stars");
            assert_same(&what, &expected, &on_gpu(&without, &with_stars));
        }
        let (one, other) = (
            trace_on_gpu(&compute, &scene.lens),
            trace_on_gpu(&without, &scene.lens),
        );
        let differing = one.iter().zip(&other).filter(|(a, b)| {
            let off = |(a, b): (glam::DVec3, glam::DVec3)| (a - b).length() > 1e-4;
            a.escaped().zip(b.escaped()).map_or(a != b, off)
        });
        assert!(differing.count() <= 3, "{name}");
    }
    assert_eq!(without.gpu().poll(), Ok(()));
}

/// What a window shows of a frame, which fills a part of the texture and is drawn over another frame.
fn frame(renderer: &Renderer, scene: &Scene, content: FrameContent) -> Vec<[u8; 3]> {
    let gpu = renderer.gpu();
    let resident: ResidentScene = block_on(renderer.upload(scene)).unwrap();
    let (width, height) = (scene.lens.camera.width, scene.lens.camera.height);
    let mut live = RealtimeRenderer::new(renderer.clone(), [width + 13, height + 7]);
    let stopwatch = Stopwatch::new(gpu);
    for content in [FrameContent::Picture, content] {
        live.show(&resident, content);
        let _ = stopwatch.submit(gpu, &live);
        block_on(gpu.wait()).unwrap();
    }
    on_screen(gpu, &live, [width, height], &scene.lens.camera)
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn frames_of_render_passes_are_those_of_compute_passes() {
    let with = gpu();
    let without = block_on(Gpu::open_without_compute()).unwrap();
    let compute = Renderer::with_pass(&with, Pass::Compute);
    let others = [
        ("by fragments", Renderer::with_pass(&with, Pass::Fragment)),
        ("without compute", Renderer::new(&without)),
    ];
    // Coarse, so that there is a difference, and in several bands.
    let coarse = Deflection::Direct { step: 0.4 };
    let split = FrameContent::Split { divider: 143 };
    let difference = FrameContent::Difference { gain: 16.0 };
    let stars: Arc<StarField> = StarField::new(&hipparcos(), 0.0).into();
    for (name, scene) in scenes(&nebula()) {
        let scene = scene.with_sampling(Sampling::Filtered);
        let coarse = scene.with_lens(scene.lens.with_deflection(coarse));
        for (scene, content) in [
            (&scene, FrameContent::Picture),
            (&scene, split),
            (&coarse, difference),
        ] {
            let expected = frame(&compute, scene, content);
            let most = expected.iter().flatten().max().unwrap();
            assert!(*most > 100, "{name}, {content:?}: dark");
            for (what, renderer) in &others {
                let drawn = frame(renderer, scene, content);
                let pairs = drawn.iter().flatten().zip(expected.iter().flatten());
                let off: Vec<u8> = pairs.map(|(a, b)| a.abs_diff(*b)).collect();
                let differing = off.iter().filter(|&&off| off > 1).count();
                println!(
                    "{name}, {content:?}, {what}: {differing} channels differ, {:?}",
                    off.iter().max()
                );
                assert!(
                    differing <= 9,
                    "{name}, {content:?}, {what}: {differing} channels"
                );
            }
        }
        let (_, fragment) = &others[0];
        let with_stars = scene.with_stars(stars.clone());
        let [one, other] = [&compute, fragment].map(|renderer| frame(renderer, &with_stars, split));
        let off = one.iter().flatten().zip(other.iter().flatten());
        let differing = off.filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert!(differing <= 9, "{name} with stars: {differing} channels");
    }
}

/// Whatever the filter of the hardware does, the mean of a sky of one colour is that colour; and what a pixel beside the
/// shadow's edge has of the sky is as with our own filter.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_anisotropic_filter_of_the_hardware_keeps_one_colour() {
    let gpus = [gpu(), block_on(Gpu::open_without_compute()).unwrap()];
    let sky: Arc<Sky> = Sky::from_fn(256, |_| Vec3::new(0.25, 0.5, 0.75)).into();
    for (name, scene) in scenes(&sky) {
        let filtered = scene.clone().with_sampling(Sampling::Filtered);
        let anisotropic = scene.with_sampling(Sampling::Anisotropic);
        for (gpu, pass) in [(0, Pass::Compute), (0, Pass::Fragment), (1, Pass::Fragment)] {
            let renderer = Renderer::with_pass(&gpus[gpu], pass);
            let [one, other] = [&filtered, &anisotropic].map(|scene| on_gpu(&renderer, scene));
            assert_same(&format!("{name}, {pass:?}, device {gpu}"), &one, &other);
        }
    }
}

/// Of llvmpipe not much is asked: docs/filter.md says why.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn a_gpus_anisotropic_filter_is_near_ours_in_either_kind_of_pass() {
    let gpu = gpu();
    let most = if gpu.is_software() { 12.0 } else { 2.0 };
    for (name, scene) in scenes(&nebula()) {
        let filtered = scene.clone().with_sampling(Sampling::Filtered);
        let anisotropic = scene.with_sampling(Sampling::Anisotropic);
        for pass in [Pass::Compute, Pass::Fragment] {
            let renderer = Renderer::with_pass(&gpu, pass);
            let [one, other] = [&filtered, &anisotropic].map(|scene| on_gpu(&renderer, scene));
            let off = PictureDifference::of(&one, &other);
            println!("{name}, {pass:?}: {off:?}");
            assert!(off.mean < most, "{name}, {pass:?}: {off:?}");
        }
    }
}
