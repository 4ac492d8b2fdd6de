//! What the kit's texts in WGSL cost on this machine's GPU: `kit_speed [ROUNDS]`, with 15 rounds by default.
//!
//! A compute shader turns the view direction of each pixel of a picture (1920 × 1080, 90° across, r = 10) by each text and
//! adds the result up, so that little else is measured. All texts take turns in rounds; the median counts.

use half::f16;
use lensbake_core::Observer;
use lensbake_program::{Printer, message};
use lensbake_render::gpu::Gpu;
use lensbake_tables::default_atlas;
use lensbake_test_support::workspace;
use lensbake_tests::probe::uploaded;
use pollster::block_on;
use std::process::ExitCode;
use std::time::Instant;
use wgpu::*;

const SIZE: [u32; 2] = [1920, 1080];
/// Dispatches for each time that is taken.
const REPEATS: u32 = 5;

const SHADER: &str = "
@group(0) @binding(0) var<storage, read_write> sums: array<f32>;
@group(0) @binding(1) var data: texture_2d<f32>;
@group(0) @binding(2) var filtering: sampler;
@compute @workgroup_size(8, 8)
fn turn(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = (2.0 * vec2<f32>(id.xy) + 1.0 - vec2<f32>(WIDTH, HEIGHT)) / WIDTH;
    let d = normalize(vec3(at, -1.0));
    let hole = vec3(0.0, 0.0, -1.0);
    let seen = CALL;
    sums[id.y * u32(WIDTH) + id.x] = seen.x + seen.y + seen.z;
}";

/// A text, the call, and whether it reads a texture and a sampler.
struct Text {
    name: &'static str,
    file: Option<&'static str>,
    call: &'static str,
    texture: Option<TextureView>,
    sampler: Option<Sampler>,
}

/// A text ready to run.
struct Program {
    pipeline: ComputePipeline,
    group: BindGroup,
}

fn row(gpu: &Gpu) -> TextureView {
    let row = default_atlas().row(Observer::at(10.0).unwrap()).unwrap();
    let texels = row.gpu_texels();
    uploaded(
        gpu,
        [64, 1],
        TextureFormat::Rg32Float,
        bytemuck::cast_slice(&texels),
    )
}

fn atlas(gpu: &Gpu) -> TextureView {
    let values = default_atlas().texels()[..64 * 128]
        .iter()
        .map(|texel| f16::from_f32(texel[0]));
    let values: Vec<f16> = values.collect();
    uploaded(
        gpu,
        [64, 128],
        TextureFormat::R16Float,
        bytemuck::cast_slice(&values),
    )
}

fn program(gpu: &Gpu, text: &Text, sums: &Buffer) -> Program {
    let file = text
        .file
        .map(|file| workspace().join("kit/wgsl").join(file));
    let functions = file.map_or(String::new(), |file| std::fs::read_to_string(file).unwrap());
    let shader = SHADER
        .replace("CALL", text.call)
        .replace("WIDTH", &format!("{}.0", SIZE[0]))
        .replace("HEIGHT", &format!("{}.0", SIZE[1]));
    let module = gpu.device.create_shader_module(ShaderModuleDescriptor {
        label: Some(text.name),
        source: ShaderSource::Wgsl((functions + &shader).into()),
    });
    let pipeline = gpu
        .device
        .create_compute_pipeline(&ComputePipelineDescriptor {
            label: Some(text.name),
            layout: None,
            module: &module,
            entry_point: Some("turn"),
            compilation_options: PipelineCompilationOptions::default(),
            cache: None,
        });
    let entry = |binding, resource| BindGroupEntry { binding, resource };
    let mut entries = vec![entry(0, sums.as_entire_binding())];
    entries.extend(
        text.texture
            .as_ref()
            .map(|view| entry(1, BindingResource::TextureView(view))),
    );
    entries.extend(
        text.sampler
            .as_ref()
            .map(|sampler| entry(2, BindingResource::Sampler(sampler))),
    );
    let group = gpu.device.create_bind_group(&BindGroupDescriptor {
        label: Some(text.name),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    Program { pipeline, group }
}

/// Nanoseconds for each pixel.
fn time(gpu: &Gpu, program: &Program) -> f64 {
    let mut encoder = gpu
        .device
        .create_command_encoder(&CommandEncoderDescriptor::default());
    for _ in 0..REPEATS {
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor::default());
        pass.set_pipeline(&program.pipeline);
        pass.set_bind_group(0, &program.group, &[]);
        pass.dispatch_workgroups(SIZE[0] / 8, SIZE[1] / 8, 1);
    }
    let started = Instant::now();
    gpu.queue.submit([encoder.finish()]);
    block_on(gpu.wait()).unwrap();
    started.elapsed().as_secs_f64() * 1e9 / f64::from(REPEATS * SIZE[0] * SIZE[1])
}

fn main() -> ExitCode {
    let rounds = match std::env::args().nth(1).map(|text| text.parse::<usize>()) {
        None => 15,
        Some(Ok(rounds)) if rounds > 0 => rounds,
        Some(_) => {
            message!("usage: kit_speed [ROUNDS]");
            return ExitCode::from(2);
        }
    };
    let gpu = lensbake_tests::gpu();
    let sums = gpu.device.create_buffer(&BufferDescriptor {
        label: Some("sums"),
        size: u64::from(SIZE[0] * SIZE[1]) * 4,
        usage: BufferUsages::STORAGE,
        mapped_at_creation: false,
    });
    let linear = gpu.device.create_sampler(&SamplerDescriptor {
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        ..SamplerDescriptor::default()
    });
    let text = |name, file, call, texture, sampler| Text {
        name,
        file,
        call,
        texture,
        sampler,
    };
    let texts = [
        text("undeflected", None, "d", None, None),
        text(
            "row",
            Some("lensbake.wgsl"),
            "lensbake(d, hole, 10.0, data)",
            Some(row(&gpu)),
            None,
        ),
        text(
            "one observer",
            Some("lensbake_r10.wgsl"),
            "lensbake_r10(d, hole)",
            None,
            None,
        ),
        text(
            "simple",
            Some("lensbake_simple.wgsl"),
            "lensbake_simple(d, hole, 10.0, data, filtering)",
            Some(atlas(&gpu)),
            Some(linear),
        ),
    ];
    let programs: Vec<_> = texts
        .iter()
        .map(|text| program(&gpu, text, &sums))
        .collect();
    let mut times = vec![Vec::new(); texts.len()];
    for round in 0..=rounds {
        for (program, times) in programs.iter().zip(&mut times) {
            let ns = time(&gpu, program);
            // The first round warms up.
            if round > 0 {
                times.push(ns);
            }
        }
    }
    let mut lines = format!(
        "{}, {} x {}, {rounds} rounds\n",
        gpu.name(),
        SIZE[0],
        SIZE[1]
    );
    for (text, mut times) in texts.iter().zip(times) {
        times.sort_by(f64::total_cmp);
        lines += &format!(
            "{:14} {:6.2} ns a ray (from {:.2})\n",
            text.name,
            times[times.len() / 2],
            times[0]
        );
    }
    let mut printer = Printer::new(false);
    printer.print(&lines);
    match printer.finish() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            message!("{error}");
            ExitCode::from(2)
        }
    }
}
