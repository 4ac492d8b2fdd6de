//! The WGSL lookup against its Rust twin, function for function, on whatever adapter is there.

use lensbake_core::{Fate, Observer};
use lensbake_tables::lookup::{self, GpuRow, wgsl_row};
use lensbake_tables::{Interpolation, default_atlas};
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};
use viewer::gpu::Gpu;

/// What the probe writes for each direction.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Probe {
    x: f32,
    captured: f32,
    bend: f32,
    slope: f32,
    cos: f32,
    sin: f32,
    cos_sky: f32,
    sin_sky: f32,
}

/// The probe reads a direction's (cos θ, sin θ) and an angle, and writes what each function makes of it.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> probes: array<array<f32, 8>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&inputs) { return; }
    let in = inputs[id.x];
    let edge = Edge(EDGE_TAN_HALF, EDGE_LOG_WEIGHT, EDGE_AWAY_SLOPE);
    let bent = bending(in.x, in.y, edge);
    let trig = cos_sin(in.z);
    let sky = turned(in.x, in.y, bent.bend);
    probes[id.x] = array(edge_coordinate(in.x, in.y, edge), f32(bent.captured), bent.bend, bent.slope,
        trig.x, trig.y, sky.x, sky.y);
}";

fn probe(gpu: &Gpu, row: &GpuRow, inputs: &[[f32; 4]]) -> Vec<Probe> {
    let (edge, texels) = (row.edge, row.texels.as_slice());
    let constants = format!(
        "const EDGE_TAN_HALF: f32 = {:e};\nconst EDGE_LOG_WEIGHT: f32 = {:e};\n\
         const EDGE_AWAY_SLOPE: f32 = {:e};\n",
        edge.tan_half, edge.log_weight, edge.away_slope
    );
    let source = [
        &wgsl_row(texels.len() as u32, row.interpolation, 0, 1),
        lookup::WGSL,
        &constants,
        PROBE,
    ]
    .join("\n");
    let bindings = Bindings {
        questions: 0,
        answers: 2,
    };
    probe::probe(gpu, source, bindings, inputs, Some((1, texels)))
}

/// Directions all round, crowding the edge from both sides, and angles up to three turns.
fn inputs(observer: &Observer) -> Vec<[f32; 4]> {
    let edge = observer.edge_angle();
    let round = (0..=2000).map(|i| f64::from(i) / 2000.0 * std::f64::consts::PI);
    let crowd = (0..600).flat_map(|i| {
        let offset = 10f64.powf(-f64::from(i) / 100.0);
        [edge + offset, edge - offset]
    });
    round
        .chain(crowd)
        .filter(|theta| (0.0..=std::f64::consts::PI).contains(theta))
        .enumerate()
        .map(|(i, theta)| {
            let (sin, cos) = theta.sin_cos();
            [
                cos as f32,
                sin.abs() as f32,
                (i as f32 - 1000.0) * 0.02,
                0.0,
            ]
        })
        .collect()
}

/// The rows that are compared: of the atlas as it is, and read as the least models read it.
fn rows(observer: Observer) -> [GpuRow; 5] {
    let row = default_atlas().row(observer).unwrap();
    let thinned = |texels, by| GpuRow::new(&row.resampled(texels, by).unwrap());
    [
        GpuRow::new(&row),
        thinned(64, Interpolation::Linear),
        thinned(4, Interpolation::Linear),
        thinned(8, Interpolation::Hermite),
        // Longer than a line of any device's texture.
        thinned(20_000, Interpolation::Hermite),
    ]
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_finds_what_its_rust_twin_finds() {
    let gpu = gpu();
    let mut compared = 0;
    for r in [1.01, 1.2, 1.5, 2.0, 5.0, 25.0, 1000.0] {
        let observer = Observer::at(r).unwrap();
        let inputs = inputs(&observer);
        for row in rows(observer) {
            let probes = probe(&gpu, &row, &inputs);
            for (input, probe) in inputs.iter().zip(&probes) {
                compare(r, &row, input, probe);
                compared += 1;
            }
        }
    }
    assert!(compared > 40_000, "{compared}");
}

fn compare(r: f64, row: &GpuRow, &[c, p, angle, _]: &[f32; 4], probe: &Probe) {
    let at = format!(
        "r {r}, {} texels {:?}, cos {c}, sin {p}: {probe:?}",
        row.texels.len(),
        row.interpolation
    );
    let [cos, sin] = lookup::cos_sin(angle);
    assert!(
        (probe.cos - cos).abs() < 3e-7 && (probe.sin - sin).abs() < 3e-7,
        "{at}"
    );
    let x = lookup::edge_coordinate(c, p, row.edge);
    assert!((probe.x - x).abs() <= 4e-7 * x || x > 1e6, "{at}: x {x}");
    // One rounding of x moves the bending by its slope there: ε/(1−x) of a logarithm.
    let rounding = 1e-6 / (1.0 - x).abs();
    let Fate::Escapes(twin) = row.bending(c, p) else {
        assert!(probe.captured == 1.0 || x < 1.0 + 1e-6, "{at}");
        return;
    };
    assert!(probe.captured == 0.0 || x > 1.0 - 1e-6, "{at}");
    if rounding > 1e-2 {
        return;
    }
    assert!(
        (probe.bend - twin.bend).abs() < 2e-6 + rounding,
        "{at}: {twin:?}"
    );
    // The slope of chords jumps at a texel, which rounding may put on either side.
    if row.interpolation == Interpolation::Hermite || !beside_texel(row, x) {
        let slope = (probe.slope - twin.slope).abs();
        assert!(
            slope < (1e-4 + 30.0 * rounding) * (1.0 + twin.slope.abs()),
            "{at}: {twin:?}"
        );
    }
    let [cos_sky, sin_sky] = lookup::turned(c, p, twin.bend);
    let off = (probe.cos_sky - cos_sky).hypot(probe.sin_sky - sin_sky);
    assert!(off < 3e-6 + rounding, "{at}: {cos_sky} {sin_sky}");
}

/// Whether x falls within 1e-3 of a texel.
fn beside_texel(row: &GpuRow, x: f32) -> bool {
    let position = ((1.0 - x) / (1.0 + x.sqrt())).sqrt() * (row.texels.len() - 1) as f32;
    (position - position.round()).abs() < 1e-3
}
