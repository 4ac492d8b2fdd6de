//! The texts in WGSL: run on this machine's adapter.

use super::rays::{Answer, Errors, RADII, Ray, rays, rows};
use super::{F32_BOUND, SIMPLE_BOUND, report};
use half::f16;
use lensbake_render::gpu::Gpu;
use lensbake_test_support::workspace;
use lensbake_tests::gpu;
use lensbake_tests::probe::{Bindings, probe_with, texel_texture, uploaded};
use wgpu::*;

/// Declares what a text is called with; `CALL` is the call.
pub const PROBE: &str = "
@group(0) @binding(0) var<storage, read> rays: array<array<f32, 8>>;
@group(0) @binding(1) var<storage, read_write> answers: array<array<f32, 3>>;
@group(0) @binding(2) var data: texture_2d<f32>;
@group(0) @binding(3) var filtering: sampler;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&rays) { return; }
    let ray = rays[id.x];
    let r = ray[0];
    let d = vec3(ray[1], ray[2], ray[3]);
    let hole = vec3(ray[4], ray[5], ray[6]);
    let seen = CALL;
    answers[id.x] = array(seen.x, seen.y, seen.z);
}";

fn answers(
    gpu: &Gpu,
    file: &str,
    call: &str,
    rays: &[Ray],
    resources: &[BindGroupEntry],
) -> Vec<Answer> {
    let path = workspace().join("kit/wgsl").join(file);
    let source = std::fs::read_to_string(path).unwrap() + &PROBE.replace("CALL", call);
    let bindings = Bindings {
        questions: 0,
        answers: 1,
    };
    probe_with(gpu, source, bindings, rays, resources)
}

fn entry(binding: u32, resource: BindingResource) -> BindGroupEntry {
    BindGroupEntry { binding, resource }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn row_of_each_observer() {
    let gpu = gpu();
    let rays = rays(&RADII);
    let mut all = Vec::new();
    for (of_one, row) in rays
        .chunk_by(|a, b| a.r == b.r)
        .zip(rows(&RADII).chunks(64))
    {
        let view = texel_texture(&gpu, row);
        let row = entry(2, BindingResource::TextureView(&view));
        all.extend(answers(
            &gpu,
            "lensbake.wgsl",
            "lensbake(d, hole, r, data)",
            of_one,
            &[row],
        ));
    }
    report("WGSL, row", Errors::of(&rays, &all), F32_BOUND);
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn one_observer() {
    let rays = rays(&[10.0]);
    let answers = answers(
        &gpu(),
        "lensbake_r10.wgsl",
        "lensbake_r10(d, hole)",
        &rays,
        &[],
    );
    report("WGSL, array", Errors::of(&rays, &answers), F32_BOUND);
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn simple() {
    let gpu = gpu();
    let rays = rays(&RADII);
    let view = atlas(&gpu);
    let linear = gpu.device.create_sampler(&SamplerDescriptor {
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        ..SamplerDescriptor::default()
    });
    let resources = [
        entry(2, BindingResource::TextureView(&view)),
        entry(3, BindingResource::Sampler(&linear)),
    ];
    let call = "lensbake_simple(d, hole, r, data, filtering)";
    let answers = answers(&gpu, "lensbake_simple.wgsl", call, &rays, &resources);
    report("WGSL, simple", Errors::of(&rays, &answers), SIMPLE_BOUND);
}

/// The atlas of half floats, from its file.
fn atlas(gpu: &Gpu) -> TextureView {
    const SIZE: [u32; 2] = [64, 128];
    let texels = super::values_and_slopes("tables/simple.exr");
    let values: Vec<f16> = texels
        .iter()
        .step_by(2)
        .map(|&value| f16::from_f32(value))
        .collect();
    let bytes = bytemuck::cast_slice(&values);
    uploaded(gpu, SIZE, TextureFormat::R16Float, bytes)
}
