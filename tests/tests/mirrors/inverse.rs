//! The lookup in an inverse row.

use lensbake_core::Observer;
use lensbake_render::gpu::Gpu;
use lensbake_tables::inverse::{self, GpuInverseRow, exp_arsinh};
use lensbake_tables::{InverseRow, default_atlas, lookup, mirror};
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};
use std::f32::consts::PI;

/// Reads sky angles, and writes the result of each function.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read> angles: array<f32>;
@group(0) @binding(2) var<storage, read_write> probes: array<array<f32, 5>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&angles) { return; }
    let a = angles[id.x];
    let seen = image(a, INVERSE);
    let t = cos_sin(a);
    probes[id.x] = array(seen.cos_sin.x, seen.cos_sin.y, seen.radial_magnification, magnification(seen, a, abs(t.y)),
        exp_arsinh(a));
}";

fn probe(gpu: &Gpu, row: &GpuInverseRow, angles: &[f32]) -> Vec<[f32; 5]> {
    let at = row.inverse;
    let constants = format!(
        "const INVERSE = Inverse({:e}, {:e}, {:e}, {:e}, {:e}, {:e});\n",
        at.edge, at.centre, at.scale, at.first_angle, at.first, at.texels_per_v
    );
    let source = [
        &inverse::wgsl_row(0, 1),
        lookup::WGSL_MODULES[0].1,
        inverse::WGSL,
        &constants,
        PROBE,
    ]
    .join("\n");
    let bindings = Bindings {
        questions: 0,
        answers: 2,
    };
    let texture = probe::texel_texture(gpu, &row.texels);
    probe::probe(gpu, source, bindings, angles, Some((1, texture)))
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_inverse_lookup_has_its_mirror() {
    let gpu = gpu();
    // From straight away to beyond the first texel, concentrated at the axis in front and behind.
    let even = (0..4000).map(|i| PI - 6.0 * PI * i as f32 / 4000.0);
    let crowd = (0..300).flat_map(|i| {
        let offset = 10f32.powf(-(i as f32) / 60.0);
        [
            offset,
            -offset,
            PI - offset,
            offset - PI,
            -2.0 * PI - offset,
        ]
    });
    let angles: Vec<f32> = even.chain(crowd).collect();
    let mut compared = 0;
    let at_rest = [1.01, 1.3, 2.0, 5.0, 25.0, 1000.0, 1e5].map(|r| Observer::at(r).unwrap());
    let falling = [10.0, 3.0, 1.0, 0.1].map(|r| Observer::falling(r).unwrap());
    for observer in at_rest.into_iter().chain(falling) {
        let r = observer.radius();
        let row = InverseRow::new(&default_atlas().row(observer).unwrap()).unwrap();
        let row = GpuInverseRow::new(&row);
        for (&angle, found) in angles.iter().zip(probe(&gpu, &row, &angles)) {
            let at = format!("r {r}, {angle}: {found:?}");
            let [cos, sin, radial_magnification, magnification, grown] = found;
            let ours = row.image(angle);
            assert!(
                (cos - ours.cos_sin[0]).hypot(sin - ours.cos_sin[1]) < 1.5e-6,
                "{at} {ours:?}"
            );
            assert!(
                (radial_magnification / ours.radial_magnification - 1.0).abs() < 5e-5,
                "{at} {ours:?}"
            );
            let [_, s] = mirror::cos_sin(angle);
            let expected = ours.magnification(angle, s.abs());
            // Near the axis, rounding dominates the sine.
            let rounding = 1e-6 / s.abs().max(1e-6);
            assert!(
                (magnification / expected - 1.0).abs() < 2e-4 + rounding,
                "{at}: {expected}"
            );
            assert!((grown / exp_arsinh(angle) - 1.0).abs() < 1e-6, "{at}");
            compared += 1;
        }
    }
    assert!(compared > 30_000, "{compared}");
}
