//! The WGSL of the filter against its Rust twins, function for function, on whatever adapter is there.

use glam::{DVec3, Vec3};
use lensbake_tables::Interpolation;
use lensbake_tests::gpu;
use lensbake_tests::probe::{self, Bindings};
use viewer::camera::Sight;
use viewer::footprint::Footprint;
use viewer::gpu::{Gpu, Output, Store, shader_source};
use viewer::scene::{Method, Sampling};
use viewer::shadow::Shadow;
use viewer::tone_map::{self, tone_map};

const FACE_TEXELS: f64 = 512.0;
const MOST_TAPS: u32 = 16;

/// Three directions, and a number: what each function is asked.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Question {
    d: [f32; 3],
    angle: f32,
    right: [f32; 3],
    px: f32,
    down: [f32; 3],
    exposure: f32,
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
    shown: [f32; 3],
}

const PROBE: &str = "
struct Question { d: vec3<f32>, angle: f32, right: vec3<f32>, px: f32, down: vec3<f32>, exposure: f32 }
@group(0) @binding(4) var<storage, read> questions: array<Question>;
@group(0) @binding(5) var<storage, read_write> answers: array<array<f32, 13>>;
@compute @workgroup_size(64)
fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&questions) { return; }
    let q = questions[id.x];
    let half_edge = vec2(cos(0.5), sin(0.5));
    let distance = shadow_distance(cos(q.angle), sin(q.angle), half_edge);
    let part = sky_part(distance, q.px, half_edge);
    let t = taps(Footprint(q.d, q.right, q.down), 512.0, 16.0);
    let shown = tone_map(abs(q.right) * 3.0, q.exposure);
    answers[id.x] = array(distance, part.covered, part.shift, part.extent, t.level, t.count, t.step,
        t.along.x, t.along.y, t.along.z, shown.x, shown.y, shown.z);
}";

fn ask(gpu: &Gpu, questions: &[Question]) -> Vec<Answer> {
    let filter = shader_source(
        Method::Flat,
        Sampling::Filtered,
        Output::Picture,
        Store::Buffer,
        64,
        Interpolation::Hermite,
        false,
    );
    let source = [&filter, tone_map::WGSL, PROBE].join("\n");
    let bindings = Bindings {
        questions: 4,
        answers: 5,
    };
    probe::probe(gpu, source, bindings, questions, None)
}

/// Footprints from a thousandth of a texel to many times round the sky, angles on both sides of the
/// edge at 1 rad, patches of all sizes.
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
                exposure: (i % 13) as f32 - 6.0,
            }
        })
        .collect()
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_gpu_filters_by_the_same_functions() {
    let questions = questions();
    let answers = ask(&gpu(), &questions);
    let mut taps_compared = 0;
    for (question, answer) in questions.iter().zip(&answers) {
        let at = format!("{question:?}: {answer:?}");
        compare_shadow(question, answer, &at);
        taps_compared += u32::from(compare_taps(question, answer, &at));
        let light = Vec3::from(question.right).abs() * 3.0;
        let shown = tone_map(light, question.exposure);
        let off = (shown - Vec3::from(answer.shown)).abs().max_element();
        assert!(off < 1e-5, "{at}: {shown}");
    }
    assert!(taps_compared > 1000, "{taps_compared}");
}

fn compare_shadow(question: &Question, answer: &Answer, at: &str) {
    let shadow = Shadow {
        half_cos: 0.5f64.cos(),
        half_sin: 0.5f64.sin(),
    };
    let (sin, cos) = f64::from(question.angle).sin_cos();
    let distance = shadow.distance(Sight { cos, sin });
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

/// Whether there was more than one tap to be compared.
fn compare_taps(question: &Question, answer: &Answer, at: &str) -> bool {
    let vector = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    let footprint = Footprint {
        direction: vector(question.d),
        right: vector(question.right),
        down: vector(question.down),
    };
    let taps = footprint.taps(FACE_TEXELS, MOST_TAPS);
    assert!(
        (taps.level - f64::from(answer.level)).abs() < 1e-3,
        "{at}: {taps:?}"
    );
    // Where the count rounds up on one side only, the taps lie otherwise.
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
