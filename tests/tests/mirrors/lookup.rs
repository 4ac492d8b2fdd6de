//! The lookup of the deflection angle (bending) in a row, and its arithmetic.

use lensbake_core::{Observer, RayOutcome};
use lensbake_render::gpu::Gpu;
use lensbake_tables::interpolation::{chord, cubic};
use lensbake_tables::lookup::GpuRow;
use lensbake_tables::mirror::{self, Bending};
use lensbake_tables::{ChannelRanges, Interpolation, RowFormat, default_atlas};
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};

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
    footprint_bend: f32,
    footprint_slope: f32,
    angle: f32,
    chord: [f32; 2],
    cubic: [f32; 2],
}

/// Reads a direction's (cos θ, sin θ), an angle and a position between two texels, and writes the result of each
/// function.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> probes: array<array<f32, 15>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&inputs) { return; }
    let in = inputs[id.x];
    let bent = bending(in.x, in.y, EDGE);
    let trig = cos_sin(in.z);
    let sky = turned(in.x, in.y, bent.bend);
    let of_footprint = bending_for_footprint(in.x, in.y, EDGE);
    let line = chord(in.xy, in.yz, in.w);
    let curve = cubic(in.xy, in.yz, in.w);
    probes[id.x] = array(row_coordinate(in.x, in.y, EDGE), f32(bent.captured), bent.bend, bent.slope,
        trig.x, trig.y, sky.x, sky.y, of_footprint.bend, of_footprint.slope, angle(in.x, in.y),
        line.x, line.y, curve.x, curve.y);
}";

fn probe(gpu: &Gpu, row: &GpuRow, inputs: &[[f32; 4]]) -> Vec<Probe> {
    let constants = probe::shadow_edge(row.edge);
    let shape = row.shape();
    let source = [&shape.wgsl(0, 1), shape.lookup_wgsl(), &constants, PROBE].join("\n");
    let bindings = Bindings {
        questions: 0,
        answers: 2,
    };
    let texture = probe::row_texture(gpu, row);
    probe::probe(gpu, source, bindings, inputs, Some((1, texture)))
}

/// Directions all around, concentrated at the shadow's edge from both sides and at the direction away from the
/// hole; angles up to ten turns; positions between two texels.
pub(super) fn inputs(observer: &Observer) -> Vec<[f32; 4]> {
    let edge = observer.shadow_angle();
    let round = (0..=2000).map(|i| f64::from(i) / 2000.0 * std::f64::consts::PI);
    let crowd = (0..600).flat_map(|i| {
        let offset = 10f64.powf(-f64::from(i) / 100.0);
        [edge + offset, edge - offset]
    });
    let away = (0..100).map(|i| std::f64::consts::PI - 10f64.powf(-f64::from(i) / 20.0));
    round
        .chain(crowd)
        .chain(away)
        .filter(|theta| (0.0..=std::f64::consts::PI).contains(theta))
        .enumerate()
        .map(|(i, theta)| {
            let (sin, cos) = theta.sin_cos();
            [
                cos as f32,
                sin.abs() as f32,
                (i as f32 - 1000.0) * 0.06,
                (i % 101) as f32 / 100.0,
            ]
        })
        .collect()
}

/// The rows to compare: the one of the atlas as it is, resampled as the least models use it, and in other formats
/// (in 16-bit integers if the device has them).
fn rows(observer: Observer, unorm16: bool) -> Vec<GpuRow> {
    let row = default_atlas().row(observer).unwrap();
    let thinned = |texels, by| GpuRow::new(&row.resampled(texels, by).unwrap());
    let whole = GpuRow::new(&row);
    let ranges = ChannelRanges::of(&whole.texels);
    let linear = row.resampled(64, Interpolation::Linear).unwrap();
    let mut rows = vec![
        whole,
        thinned(64, Interpolation::Linear),
        thinned(4, Interpolation::Linear),
        thinned(8, Interpolation::Hermite),
        // Longer than any device's textures are wide.
        thinned(20_000, Interpolation::Hermite),
        GpuRow::new(&linear.in_format(RowFormat::Coefficients)),
    ];
    let unorm16 = unorm16.then_some(RowFormat::Unorm16(ranges));
    let formats = [RowFormat::Float16, RowFormat::Coefficients];
    let formats = formats.into_iter().chain(unorm16);
    rows.extend(formats.map(|format| GpuRow::new(&row.clone().in_format(format))));
    rows
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_lookup_has_its_mirror() {
    let gpu = gpu();
    let mut compared = 0;
    let at_rest = [1.01, 1.2, 1.5, 2.0, 5.0, 25.0, 1000.0].map(|r| Observer::at(r).unwrap());
    let falling = [10.0, 1.001, 1.0, 0.5, 0.1, 0.01].map(|r| Observer::falling(r).unwrap());
    for observer in at_rest.into_iter().chain(falling) {
        let inputs = inputs(&observer);
        for row in rows(observer, gpu.has_unorm16()) {
            let probes = probe(&gpu, &row, &inputs);
            for (input, probe) in inputs.iter().zip(&probes) {
                compare(&observer, &row, input, probe);
                compared += 1;
            }
        }
    }
    assert!(compared > 80_000, "{compared}");
}

fn compare(observer: &Observer, row: &GpuRow, input: &[f32; 4], probe: &Probe) {
    let &[c, p, _, _] = input;
    let at = format!(
        "r {}, {} texels {:?} {:?}, cos {c}, sin {p}: {probe:?}",
        observer.radius(),
        row.texels.len(),
        row.interpolation,
        row.format
    );
    compare_arithmetic(input, probe, &at);
    let x = mirror::row_coordinate(c, p, row.edge, row.side);
    let off = 4e-7 * row.edge.scale;
    assert!((probe.x - x).abs() <= off * x || x > 1e6, "{at}: x {x}");
    // One rounding of x changes the bending by about ε/(1−x), the slope of its logarithm. Below the horizon the weight of
    // the logarithm grows, and x is a quotient of differences.
    let rounding = 1e-6 * row.edge.scale * row.edge.log_weight.abs().max(1.0) / (1.0 - x).abs();
    let RayOutcome::Escapes(bending) = row.bending(c, p) else {
        assert!(probe.captured == 1.0 || x < 1.0 + off, "{at}");
        return;
    };
    assert!(probe.captured == 0.0 || x > 1.0 - off, "{at}");
    if rounding > 1e-2 {
        return;
    }
    let hermite = row.interpolation == Interpolation::Hermite;
    // With linear interpolation the slope jumps at a texel, and rounding may put x on either side.
    let slopes = hermite || !beside_texel(row, x);
    let agree = |found: [f32; 2], ours: Bending, slopes: bool| {
        let bend = (found[0] - ours.bend).abs() < 2e-6 + rounding;
        let slope = (found[1] - ours.slope).abs();
        bend && (!slopes || slope < (1e-4 + 30.0 * rounding) * (1.0 + ours.slope.abs()))
    };
    // Straight away from the hole, within STRAIGHT_AWAY of lookup.wgsl, only the slope for footprints is accurate. The other
    // is a quotient of rounding errors there, which differ between GPUs.
    let straight_away = c < 0.0 && p.max(x) < 1e-3;
    assert!(
        agree([probe.bend, probe.slope], bending, slopes && !straight_away),
        "{at}: {bending:?}"
    );
    let RayOutcome::Escapes(of_footprint) = row.bending_for_footprint(c, p) else {
        panic!("{at}: captured as a footprint")
    };
    assert!(
        agree(
            [probe.footprint_bend, probe.footprint_slope],
            of_footprint,
            slopes
        ),
        "{at}: {of_footprint:?}"
    );
    let [cos_sky, sin_sky] = mirror::turned(c, p, bending.bend);
    let off = (probe.cos_sky - cos_sky).hypot(probe.sin_sky - sin_sky);
    assert!(off < 3e-6 + rounding, "{at}: {cos_sky} {sin_sky}");
}

/// Compares the arithmetic of the lookup; the numbers of the input also serve as two texels.
fn compare_arithmetic(&[c, p, angle, t]: &[f32; 4], probe: &Probe, at: &str) {
    let agree = |ours: [f32; 2], found: [f32; 2], size: f32| {
        let off = (ours[0] - found[0]).abs().max((ours[1] - found[1]).abs());
        assert!(off < 3e-7 * size, "{at}: {ours:?} {found:?}");
    };
    agree(mirror::cos_sin(angle), [probe.cos, probe.sin], 1.0);
    let size = 10.0 + 10.0 * angle.abs();
    agree(chord([c, p], [p, angle], t), probe.chord, size);
    agree(cubic([c, p], [p, angle], t), probe.cubic, size);
    let angle = mirror::angle(c, p);
    assert!((probe.angle - angle).abs() < 1e-6, "{at}: {angle}");
}

/// Whether x falls within 1e-3 of a texel.
fn beside_texel(row: &GpuRow, x: f32) -> bool {
    let position =
        mirror::row_position(1.0 - x, x.sqrt(), row.side) * (row.texels.len() - 1) as f32;
    (position - position.round()).abs() < 1e-3
}
