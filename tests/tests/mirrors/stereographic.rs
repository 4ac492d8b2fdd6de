//! The lookup of the direction on the sky in a row of stereographic coordinates.

use super::lookup::inputs;
use lensbake_core::{Observer, RayOutcome};
use lensbake_render::gpu::Gpu;
use lensbake_tables::{StereographicRow, default_atlas, mirror};
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};
use wgpu::TextureFormat;

/// What the probe writes for each direction.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Probe {
    x: f32,
    captured: f32,
    cos_sin: [f32; 2],
    radial: f32,
}

/// Reads a direction's (cos θ, sin θ), and writes the result of each function.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> probes: array<array<f32, 5>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&inputs) { return; }
    let in = inputs[id.x];
    let sky = sky_direction(in.x, in.y, EDGE);
    probes[id.x] = array(row_coordinate(in.x, in.y, EDGE), f32(sky.captured), sky.cos_sin.x, sky.cos_sin.y, sky.radial);
}";

fn probe(gpu: &Gpu, row: &StereographicRow, inputs: &[[f32; 4]]) -> Vec<Probe> {
    let source = [
        &StereographicRow::wgsl(0, 1),
        row.lookup_wgsl(),
        &probe::shadow_edge(row.edge),
        PROBE,
    ]
    .join("\n");
    let bindings = Bindings {
        questions: 0,
        answers: 2,
    };
    let (size, format) = (StereographicRow::TEXTURE_SIZE, TextureFormat::Rgba32Float);
    let texture = probe::uploaded(gpu, size, format, &row.texture_bytes());
    probe::probe(gpu, source, bindings, inputs, Some((1, texture)))
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_stereographic_lookup_has_its_mirror() {
    let gpu = gpu();
    let at_rest = [1.01, 1.2, 1.5, 2.0, 5.0, 25.0, 1000.0].map(|r| Observer::at(r).unwrap());
    let falling = [10.0, 1.001, 1.0, 0.5, 0.1, 0.01].map(|r| Observer::falling(r).unwrap());
    let mut compared = 0;
    for observer in at_rest.into_iter().chain(falling) {
        let row = StereographicRow::new(&default_atlas().row(observer).unwrap());
        let inputs = inputs(&observer);
        for (&[c, p, ..], probe) in inputs.iter().zip(probe(&gpu, &row, &inputs)) {
            let at = format!("r {}, cos {c}, sin {p}: {probe:?}", observer.radius());
            compared += usize::from(compare(&row, [c, p], probe, &at));
        }
    }
    assert!(compared > 20_000, "{compared}");
}

/// Compares a probe with the mirror. Returns `false`, and compares only whether the ray is captured, for rays so near the
/// shadow's edge that one rounding of X turns the direction by more than 0.01 rad.
fn compare(row: &StereographicRow, [c, p]: [f32; 2], probe: Probe, at: &str) -> bool {
    let x = mirror::row_coordinate(c, p, row.edge, row.side);
    let off = 4e-7 * row.edge.scale;
    assert!((probe.x - x).abs() <= off * x || x > 1e6, "{at}: x {x}");
    let RayOutcome::Escapes(sky) = row.sky_direction(c, p) else {
        assert!(probe.captured == 1.0 || x < 1.0 + off, "{at}");
        return false;
    };
    assert!(probe.captured == 0.0 || x > 1.0 - off, "{at}");
    let rounding = 1e-6 * row.edge.scale * row.edge.log_weight.abs().max(1.0) / (1.0 - x).abs();
    if rounding > 1e-2 {
        return false;
    }
    // The factor of a vector is near 1, and another in the next interval.
    let [[cos, sin], [found_cos, found_sin]] = [sky.cos_sin, probe.cos_sin].map(|[cos, sin]| {
        let size = cos.hypot(sin);
        assert!((size - 1.0).abs() < 0.1, "{at}: {sky:?}");
        [cos / size, sin / size]
    });
    let off = (found_cos - cos).hypot(found_sin - sin);
    assert!(off < 1e-6 + rounding, "{at}: {sky:?}");
    let off = (probe.radial / sky.radial - 1.0).abs();
    assert!(off < 1e-4 + 30.0 * rounding, "{at}: {sky:?}");
    true
}
