//! The WGSL of the inverse row against its Rust twin, function for function, on whatever adapter is there.

use lensbake_core::Observer;
use lensbake_tables::inverse::{self, GpuInverseRow, exp_arsinh};
use lensbake_tables::{InverseRow, default_atlas, lookup};
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};
use std::f32::consts::PI;
use viewer::gpu::Gpu;

/// Reads a sky angle each, and writes what each function makes of it.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read> angles: array<f32>;
@group(0) @binding(2) var<storage, read_write> probes: array<array<f32, 6>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&angles) { return; }
    let a = angles[id.x];
    let seen = image(a, INVERSE);
    let t = cos_sin(a);
    probes[id.x] = array(seen.cos_sin.x, seen.cos_sin.y, seen.stretch, magnification(seen, a, abs(t.y)),
        exp_arsinh(a), angle(t.x, abs(t.y)));
}";

fn probe(gpu: &Gpu, row: &GpuInverseRow, angles: &[f32]) -> Vec<[f32; 6]> {
    let at = row.inverse;
    let constants = format!(
        "const INVERSE = Inverse({:e}, {:e}, {:e}, {:e}, {:e});\n",
        at.edge, at.scale, at.first_angle, at.first, at.texels_per_v
    );
    let source = [
        &inverse::wgsl_row(0, 1),
        lookup::ARITHMETIC_WGSL,
        inverse::WGSL,
        &constants,
        PROBE,
    ]
    .join("\n");
    let bindings = Bindings {
        questions: 0,
        answers: 2,
    };
    probe::probe(gpu, source, bindings, angles, Some((1, &row.texels)))
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_finds_the_images_that_its_rust_twin_finds() {
    let gpu = gpu();
    // From straight away to beyond the first texel, crowding the axis before and behind.
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
    for r in [1.01, 1.3, 2.0, 5.0, 25.0, 1000.0, 1e5] {
        let observer = Observer::at(r).unwrap();
        let row = InverseRow::new(&default_atlas().row(observer).unwrap()).unwrap();
        let row = GpuInverseRow::new(&row);
        for (&angle, found) in angles.iter().zip(probe(&gpu, &row, &angles)) {
            let at = format!("r {r}, {angle}: {found:?}");
            let [cos, sin, stretch, magnification, grown, angle_found] = found;
            let twin = row.image(angle);
            assert!(
                (cos - twin.cos_sin[0]).hypot(sin - twin.cos_sin[1]) < 1.5e-6,
                "{at} {twin:?}"
            );
            assert!((stretch / twin.stretch - 1.0).abs() < 5e-5, "{at} {twin:?}");
            let [c, s] = lookup::cos_sin(angle);
            let expected = twin.magnification(angle, s.abs());
            // Beside the axis the sine itself is rounding.
            let rounding = 1e-6 / s.abs().max(1e-6);
            assert!(
                (magnification / expected - 1.0).abs() < 2e-4 + rounding,
                "{at}: {expected}"
            );
            assert!((grown / exp_arsinh(angle) - 1.0).abs() < 1e-6, "{at}");
            assert!(
                (angle_found - lookup::angle(c, s.abs())).abs() < 1e-6,
                "{at}"
            );
            compared += 1;
        }
    }
    assert!(compared > 30_000, "{compared}");
}
