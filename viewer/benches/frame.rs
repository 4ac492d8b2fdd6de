//! What a frame of the window costs on the CPU: from the settings to all that is sent to the GPU before
//! the dispatches, with a new radius and so a new row in every frame.

use criterion::{Criterion, criterion_group, criterion_main};
use lensbake_tables::default_atlas;
use std::time::{Duration, Instant};
use viewer::camera::View;
use viewer::gpu::{Gpu, Live, Presenter, Renderer};
use viewer::scene::Method;
use viewer::sky;
use viewer::stars::{StarField, hipparcos};
use viewer::window::plan::Plan;
use viewer::window::settings::Settings;

const WINDOW: [u32; 2] = [1920, 1080];

fn preparation(c: &mut Criterion) {
    let gpu = Gpu::open().unwrap();
    let renderer = Renderer::new(&gpu, &sky::grid(64)).unwrap();
    let stars = StarField::new(&hipparcos(), 0.0);
    prepare(c, "prepare a frame with a new radius", renderer.clone());
    let with_stars = renderer.with_stars(&stars);
    prepare(c, "the same with 117,955 stars", with_stars);
}

fn prepare(c: &mut Criterion, name: &str, renderer: Renderer) {
    let gpu = renderer.gpu().clone();
    let mut settings = Settings::new(View::default(), Method::DEFAULT_STEP);
    let plan = Plan::new(&settings, default_atlas(), WINDOW, 1.0).unwrap();
    let mut live = Live::new(renderer, &plan.scene.row, WINDOW, &[settings.step]);
    let format = wgpu::TextureFormat::Bgra8Unorm;
    let mut presenter = Presenter::new(&gpu, &live, format);
    c.bench_function(name, |b| {
        b.iter_custom(|frames| {
            let mut sum = Duration::ZERO;
            for i in 0..frames {
                settings.view.radius = 2.5 + 35.0 * (i % 1000) as f64 / 1000.0;
                let started = Instant::now();
                let plan = Plan::new(&settings, default_atlas(), WINDOW, 1.0).unwrap();
                live.show(&plan.scene, plan.show);
                presenter.show(plan.picture(), &plan.window, plan.showing);
                sum += started.elapsed();
                // Sends what was written, so that it does not pile up.
                gpu.queue.submit([]);
                gpu.wait().unwrap();
            }
            sum
        });
    });
}

criterion_group!(benches, preparation);
criterion_main!(benches);
