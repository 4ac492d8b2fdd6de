//! Random rays through the 32-bit lookup, in Rust and on the GPU: `rays [MILLIONS [MILLIONS_ON_GPU]]`.
//!
//! The radii are from 1 + 1e-6 to 1e6, a fifth of them concentrated at the horizon. Half of the rays are spread by
//! decades about the shadow's edge (the critical curve), a quarter about the two poles, and the rest evenly.
//!
//! The example counts results that are not finite, and rays with the wrong ray outcome, that is with x on the
//! other side of 1 than in f64. Of the latter, those within one f32 step of the edge are counted separately:
//! there, moving cos θ, sin θ and x (by 2⁻²³) by one step at most changes the outcome. The exit code is 1 if any
//! result is not finite, or any outcome is wrong beyond one step.

use fastrand::Rng;
use lensbake_core::{Observer, RayOutcome};
use lensbake_program::{Printer, message};
use lensbake_render::gpu::Gpu;
use lensbake_tables::default_atlas;
use lensbake_tables::lookup::GpuRow;
use lensbake_tests::probe::{self, Bindings};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::process::ExitCode;

/// Rays per observer in Rust.
const BATCH: usize = 100_000;
const MILLION: usize = 1_000_000;

/// A view direction as the lookup takes it: cos θ and sin θ.
type Direction = [f32; 2];

/// The result of the lookup for a ray.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Answer {
    /// 1 for captured, 0 for a ray from the sky.
    captured: f32,
    bend: f32,
    slope: f32,
}

/// Counts over all rays.
#[derive(Debug, Clone, Copy, Default)]
struct Count {
    rays: u64,
    captured: u64,
    not_finite: u64,
    /// Rays with the wrong outcome within one f32 step of the edge.
    at_edge: u64,
    /// Rays with the wrong outcome beyond that.
    wrong: u64,
    /// The largest |1 − x| of a wrong outcome, in f32 steps.
    farthest: f64,
}

impl Count {
    fn and(self, other: Count) -> Count {
        Count {
            rays: self.rays + other.rays,
            captured: self.captured + other.captured,
            not_finite: self.not_finite + other.not_finite,
            at_edge: self.at_edge + other.at_edge,
            wrong: self.wrong + other.wrong,
            farthest: self.farthest.max(other.farthest),
        }
    }

    fn of(observer: &Observer, rays: &[Direction], answers: &[Answer]) -> Count {
        let tan_half = observer.tan_half_shadow();
        let mut count = Count::default();
        for (&ray, answer) in rays.iter().zip(answers) {
            let captured = answer.captured == 1.0;
            count.rays += 1;
            count.captured += u64::from(captured);
            count.not_finite += u64::from(!(answer.bend.is_finite() && answer.slope.is_finite()));
            let x = shadow_coordinate(tan_half, ray);
            if captured != (x >= 1.0) {
                count.farthest = count
                    .farthest
                    .max((1.0 - x).abs() / f64::from(f32::EPSILON));
                let at_edge = is_at_edge(tan_half, ray);
                count.at_edge += u64::from(at_edge);
                count.wrong += u64::from(!at_edge);
            }
        }
        count
    }

    fn line(&self, name: &str) -> String {
        format!(
            "{name}: {} rays, {} captured; not finite: {}; wrong within one f32 step of the edge: {}, \
             beyond: {}; the farthest at |1 - x| = {:.2} steps\n",
            self.rays, self.captured, self.not_finite, self.at_edge, self.wrong, self.farthest
        )
    }

    fn is_good(&self) -> bool {
        self.rays > 0 && self.not_finite == 0 && self.wrong == 0
    }
}

/// x = tan(θ_c/2) cot(θ/2) of a direction, in f64.
fn shadow_coordinate(tan_half: f64, [c, p]: Direction) -> f64 {
    let (c, p) = (f64::from(c), f64::from(p));
    let cot_half = if c >= 0.0 {
        (1.0 + c) / p
    } else {
        p / (1.0 - c)
    };
    tan_half * cot_half
}

/// Whether a direction is within one f32 step of the edge: x can be 1 if cos θ, sin θ and x are each moved by
/// at most one step.
fn is_at_edge(tan_half: f64, [c, p]: Direction) -> bool {
    let about = |number: f32| [number.next_down(), number, number.next_up()];
    let step = f64::from(f32::EPSILON);
    let near = about(c)
        .into_iter()
        .flat_map(|c| about(p).map(|p| shadow_coordinate(tan_half, [c, p.max(0.0)])));
    let (least, most) = near.fold((f64::INFINITY, 0.0_f64), |(least, most), x| {
        (least.min(x), most.max(x))
    });
    least - step <= 1.0 && 1.0 <= most + step
}

fn random_observer(rng: &mut Rng) -> Observer {
    let r = match rng.u32(0..5) {
        0 => 1.0 + 10f64.powf(-6.0 * rng.f64()),
        1 => 10f64.powf(6.0 * rng.f64()).max(1.0 + 1e-6),
        2 => 1.5 + 1e-3 * (rng.f64() - 0.5),
        _ => return Observer::at_chi(1e-3 + rng.f64() * (FRAC_PI_2 - 2e-3)),
    };
    Observer::at(r).unwrap_or_else(|_| Observer::at_chi(1.0))
}

fn random_directions(observer: &Observer, rng: &mut Rng, count: usize) -> Vec<Direction> {
    let edge = observer.shadow_angle();
    (0..count)
        .map(|_| {
            let decades = |rng: &mut Rng, most: f64| 10f64.powf(-most * rng.f64());
            let theta = match rng.u32(0..8) {
                0 | 1 => edge * (1.0 + decades(rng, 9.0)),
                2 | 3 => edge * (1.0 - decades(rng, 9.0)),
                4 => PI - decades(rng, 40.0),
                5 => decades(rng, 40.0),
                _ => rng.f64() * PI,
            };
            let (sin, cos) = theta.clamp(0.0, PI).sin_cos();
            // sin π is not 0 in floating point.
            let sin = if theta >= PI { 0.0 } else { sin };
            [cos as f32, sin as f32]
        })
        .collect()
}

/// An observer, its row of the atlas, and random rays.
fn batch(seed: u64, count: usize) -> (Observer, GpuRow, Vec<Direction>) {
    let mut rng = Rng::with_seed(seed);
    let observer = random_observer(&mut rng);
    let row = default_atlas()
        .row(observer)
        .expect("an atlas has all rows");
    let rays = random_directions(&observer, &mut rng, count);
    (observer, GpuRow::new(&row), rays)
}

fn in_rust(rays: usize) -> Count {
    (0..rays.div_ceil(BATCH) as u64)
        .into_par_iter()
        .map(|seed| {
            let (observer, row, rays) = batch(seed, BATCH);
            let answers: Vec<Answer> = rays.iter().map(|&[c, p]| answer(&row, c, p)).collect();
            Count::of(&observer, &rays, &answers)
        })
        .reduce(Count::default, Count::and)
}

fn answer(row: &GpuRow, c: f32, p: f32) -> Answer {
    match row.bending(c, p) {
        RayOutcome::Captured => Answer {
            captured: 1.0,
            bend: 0.0,
            slope: 0.0,
        },
        RayOutcome::Escapes(bending) => Answer {
            captured: 0.0,
            bend: bending.bend,
            slope: bending.slope,
        },
    }
}

const PROBE: &str = "
@group(0) @binding(0) var<storage, read> rays: array<vec2<f32>>;
@group(0) @binding(2) var<storage, read_write> answers: array<array<f32, 3>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&rays) { return; }
    let bent = bending(rays[id.x].x, rays[id.x].y, EDGE);
    answers[id.x] = array(f32(bent.captured), bent.bend, bent.slope);
}";

fn on_gpu(gpu: &Gpu, rays: usize) -> Count {
    let mut all = Count::default();
    for seed in 0..rays.div_ceil(MILLION) as u64 {
        let (observer, row, rays) = batch(1 << 40 | seed, MILLION);
        let constants = probe::shadow_edge(row.edge);
        let shape = row.shape();
        let source = [&shape.wgsl(0, 1), shape.lookup_wgsl(), &constants, PROBE].join("\n");
        let bindings = Bindings {
            questions: 0,
            answers: 2,
        };
        let answers: Vec<Answer> = probe::probe(
            gpu,
            source,
            bindings,
            &rays,
            Some((1, probe::row_texture(gpu, &row))),
        );
        all = all.and(Count::of(&observer, &rays, &answers));
    }
    all
}

fn main() -> ExitCode {
    let mut millions = std::env::args().skip(1).map(|text| text.parse::<usize>());
    let (Ok(rust), Ok(gpu_rays)) = (
        millions.next().unwrap_or(Ok(1000)),
        millions.next().unwrap_or(Ok(100)),
    ) else {
        message!("rays: give the millions of rays in Rust, then on the GPU");
        return ExitCode::from(2);
    };
    let mut printer = Printer::new(false);
    let mut counts = vec![in_rust(rust * MILLION)];
    printer.print(&counts[0].line("in Rust"));
    if gpu_rays > 0 {
        let gpu = lensbake_tests::gpu();
        counts.push(on_gpu(&gpu, gpu_rays * MILLION));
        printer.print(&counts[1].line(&gpu.name()));
    }
    if counts.iter().all(Count::is_good) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
