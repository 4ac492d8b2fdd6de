//! The tone map and the sRGB transfer function.

use glam::Vec3;
use lensbake_render::picture::srgb_from_linear;
use lensbake_render::shaders;
use lensbake_render::tone_map::tone_map;
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};

/// Reads light and an exposure, and writes the result of each function.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read> lights: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> shown: array<array<f32, 6>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&lights) { return; }
    let light = lights[id.x];
    let mapped = tone_map(light.rgb, light.a);
    let encoded = srgb_from_linear(light.rgb);
    shown[id.x] = array(mapped.r, mapped.g, mapped.b, encoded.r, encoded.g, encoded.b);
}";

/// Light from zero to far beyond white, concentrated at the knee of the tone map and the foot of the sRGB curve.
fn lights() -> Vec<[f32; 4]> {
    let mut random = fastrand::Rng::with_seed(9);
    (0..6000)
        .map(|i| {
            let size = match i % 3 {
                0 => 10f32.powf(8.0 * random.f32() - 4.0),
                1 => 0.8 + 0.01 * (random.f32() - 0.5),
                _ => 0.0031308 + 1e-4 * (random.f32() - 0.5),
            };
            let exposure = if i % 2 == 0 {
                0.0
            } else {
                (i % 13) as f32 - 6.0
            };
            [size, size * random.f32(), size * random.f32(), exposure]
        })
        .chain([[0.0; 4]])
        .collect()
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_tone_map_and_the_srgb_curve_have_their_mirrors() {
    let lights = lights();
    let source = shaders::wgsl(&["tone_map", "srgb"]) + PROBE;
    let bindings = Bindings {
        questions: 0,
        answers: 1,
    };
    let found: Vec<[f32; 6]> = probe::probe(&gpu(), source, bindings, &lights, None);
    for (&[r, g, b, exposure], found) in lights.iter().zip(found) {
        let light = Vec3::new(r, g, b);
        let mapped = tone_map(light, exposure).to_array();
        let encoded = light.to_array().map(srgb_from_linear);
        for (ours, found) in mapped.into_iter().chain(encoded).zip(found) {
            assert!(
                (ours - found).abs() < 1e-5,
                "{light} {exposure}: {ours} {found}"
            );
        }
    }
}
