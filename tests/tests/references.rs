//! WGSL functions of patches, footprints, the shadow and the stars' kernels against their references: the Rust
//! functions in f64 that draw the CPU's pictures. The two agree to the errors stated here, not to the last bits.

use glam::{DVec2, DVec3, Vec3};
use lensbake_render::camera::ViewAngle;
use lensbake_render::footprint::{Footprint, Patch};
use lensbake_render::gpu::Gpu;
use lensbake_render::lens::Deflected;
use lensbake_render::shaders;
use lensbake_render::shadow::Shadow;
use lensbake_render::stars::kernel::{REACHES, weight};
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};

const FACE_TEXELS: f64 = 512.0;
const MAX_TAPS: u32 = 16;
/// The derivative 1 − dΔ/dθ of the deflection in each question.
const RADIAL: f64 = 0.75;

/// A direction and the sides of a patch about it; the sky angle and the patch's width, rad; the index of a kernel.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Question {
    d: [f32; 3],
    angle: f32,
    right: [f32; 3],
    px: f32,
    down: [f32; 3],
    kernel: u32,
}

/// What the probe answers.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Answer {
    distance: f32,
    part: [f32; 3],
    level: f32,
    count: f32,
    step: f32,
    along: [f32; 3],
    gradient: f32,
    share: f32,
    patch_right: [f32; 2],
    patch_down: [f32; 2],
    sky: [[f32; 3]; 3],
}

const PROBE: &str = "
struct Question { d: vec3<f32>, angle: f32, right: vec3<f32>, px: f32, down: vec3<f32>, kernel: u32 }
@group(0) @binding(0) var<storage, read> questions: array<Question>;
@group(0) @binding(1) var<storage, read_write> answers: array<array<f32, 25>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&questions) { return; }
    let q = questions[id.x];
    let half_edge = vec2(cos(0.5), sin(0.5));
    let distance = shadow_distance(cos(q.angle), sin(q.angle), half_edge);
    let part = sky_part(distance, q.px, half_edge);
    let t = taps(Footprint(q.d, q.right, q.down), 512.0, 16.0);
    let seen = patch_of(q.d, q.right, q.down);
    let deflected = Deflected(ESCAPES, cos(q.angle), sin(q.angle), 0.75);
    let sky = footprint(moved(seen, 0.01 * q.px, 0.5), deflected);
    let share = kernel_factor(q.kernel) * kernel_share(q.d.xy * reach_of(q.kernel), q.kernel);
    answers[id.x] = array(distance, part.covered, part.shift, part.extent, t.level, t.count, t.step,
        t.along.x, t.along.y, t.along.z, gradient(seen), share,
        seen.right.x, seen.right.y, seen.down.x, seen.down.y,
        sky.d.x, sky.d.y, sky.d.z, sky.right.x, sky.right.y, sky.right.z, sky.down.x, sky.down.y, sky.down.z);
}";

fn ask(gpu: &Gpu, questions: &[Question]) -> Vec<Answer> {
    let source = shaders::wgsl(&["footprint", "shadow", "kernel"]) + PROBE;
    let bindings = Bindings {
        questions: 0,
        answers: 1,
    };
    probe::probe(gpu, source, bindings, questions, None)
}

/// Footprints from a thousandth of a texel to many times around the sky, angles on both sides of the shadow's edge
/// at 1 rad, patches of all sizes.
fn questions() -> Vec<Question> {
    let mut random = fastrand::Rng::with_seed(5);
    let mut vector = |size: f64| {
        let mut unit = || 2.0 * random.f64() - 1.0;
        DVec3::new(unit(), unit(), unit()) * size
    };
    (0..4000)
        .map(|i| {
            let sizes = 10f64.powf(-6.0 + 8.0 * f64::from(i) / 4000.0);
            let d = vector(1.0).normalize();
            let across = |step: DVec3| (step - d * step.dot(d)).as_vec3().to_array();
            let px = 10f32.powf(-4.0 + 5.0 * (i % 40) as f32 / 40.0);
            Question {
                d: d.as_vec3().to_array(),
                angle: (1.0 + px * ((i % 17) as f32 - 8.0) * 0.15).clamp(0.0, 3.1),
                right: across(vector(sizes)),
                px,
                down: across(vector(sizes * 10f64.powi(i % 4 - 3))),
                kernel: i as u32 % REACHES.len() as u32,
            }
        })
        .collect()
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_filter_agrees_with_its_reference() {
    let questions = questions();
    let answers = ask(&gpu(), &questions);
    let mut taps_compared = 0;
    for (question, answer) in questions.iter().zip(&answers) {
        let at = format!("{question:?}: {answer:?}");
        compare_shadow(question, answer, &at);
        taps_compared += u32::from(compare_taps(question, answer, &at));
        compare_patch(question, answer, &at);
        compare_kernel(question, answer, &at);
    }
    assert!(taps_compared > 1000, "{taps_compared}");
}

fn compare_shadow(question: &Question, answer: &Answer, at: &str) {
    let shadow = Shadow {
        half_cos: 0.5f64.cos(),
        half_sin: 0.5f64.sin(),
    };
    let (sin, cos) = f64::from(question.angle).sin_cos();
    let distance = shadow.distance(ViewAngle { cos, sin });
    assert!(
        (distance - f64::from(answer.distance)).abs() < 3e-6,
        "{at}: {distance}"
    );
    let px = f64::from(question.px);
    let part = shadow.sky_part(distance, px);
    for (rust, wgsl) in [part.covered, part.shift, part.extent]
        .into_iter()
        .zip(answer.part)
    {
        assert!(
            (rust - f64::from(wgsl)).abs() < 1e-5 + 4e-6 / px,
            "{at}: {part:?}"
        );
    }
}

/// Compares the patch, and its footprint after it was moved and deflected.
fn compare_patch(question: &Question, answer: &Answer, at: &str) {
    let vector = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    let (right, down) = (vector(question.right), vector(question.down));
    let patch = Patch::new(vector(question.d), right, down);
    let size = right.length() + down.length();
    let gradient = patch.gradient() - f64::from(answer.gradient);
    assert!(gradient.abs() < 1e-6 * size, "{at}: {patch:?}");
    for (ours, found) in [
        (patch.right, answer.patch_right),
        (patch.down, answer.patch_down),
    ] {
        let off = ours - DVec2::from(found.map(f64::from));
        assert!(off.length() < 2e-6 * size, "{at}: {patch:?}");
    }
    let (sin, cos) = f64::from(question.angle).sin_cos();
    let moved = patch.moved(0.01 * f64::from(question.px), 0.5);
    let print = moved.footprint(Deflected {
        bend: moved.view_angle.radians() - f64::from(question.angle),
        sky: ViewAngle { cos, sin },
        radial: RADIAL,
    });
    // Near the axis through the hole, rounding dominates the radial directions.
    let rounding = 2e-6 + 2e-6 / moved.view_angle.sin;
    for (ours, found, size) in [
        (print.direction, answer.sky[0], 1.0),
        (print.right, answer.sky[1], size),
        (print.down, answer.sky[2], size),
    ] {
        // Turning about the axis enlarges the sides by sin θ′/sin θ.
        let size = size * (1.0 + sin / moved.view_angle.sin);
        let off = (ours - vector(found)).length();
        assert!(off < rounding * size, "{at}: {print:?} off by {off:e}");
    }
}

fn compare_kernel(question: &Question, answer: &Answer, at: &str) {
    let reach = REACHES[question.kernel as usize];
    let offset = Vec3::from(question.d).as_dvec3().truncate() * reach;
    let share = weight(offset, reach);
    let off = (share - f64::from(answer.share)).abs();
    assert!(off < 2e-6 * weight(DVec2::ZERO, reach), "{at}: {share}");
}

/// Compares the taps; returns whether there was more than one to compare.
fn compare_taps(question: &Question, answer: &Answer, at: &str) -> bool {
    let vector = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    let footprint = Footprint {
        direction: vector(question.d),
        right: vector(question.right),
        down: vector(question.down),
    };
    let taps = footprint.taps(FACE_TEXELS, MAX_TAPS);
    assert!(
        (taps.level - f64::from(answer.level)).abs() < 1e-3,
        "{at}: {taps:?}"
    );
    // If the count rounds up on one side only, the taps are at other places.
    if f64::from(answer.count) != f64::from(taps.count) {
        assert!(
            (f64::from(answer.count) - f64::from(taps.count)).abs() < 1.5,
            "{at}: {taps:?}"
        );
        return false;
    }
    if taps.count == 1 {
        return false;
    }
    let step = f64::from(answer.step);
    assert!(
        (step - taps.step).abs() < 2e-3 * taps.step,
        "{at}: {taps:?}"
    );
    let parallel = taps.along.dot(vector(answer.along)).abs();
    assert!(parallel > 1.0 - 1e-3, "{at}: {taps:?}");
    true
}
