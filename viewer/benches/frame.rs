//! CPU cost of a frame of the window: from the settings to the uploads to the GPU, without the dispatches. Each
//! frame has a new radius and therefore a new row of the table.

use criterion::{Criterion, criterion_group, criterion_main};
use lensbake_core::Motion;
use lensbake_interactive::plan::Plan;
use lensbake_interactive::settings::Settings;
use lensbake_render::camera::View;
use lensbake_render::gpu::{Gpu, Presenter, RealtimeRenderer, Renderer, StarsOnDevice};
use lensbake_render::lens::Deflection;
use lensbake_render::scene::Scene;
use lensbake_render::sky;
use lensbake_render::stars::{StarField, hipparcos};
use lensbake_tables::default_atlas;
use pollster::block_on;
use std::time::{Duration, Instant};

const WINDOW: [u32; 2] = [1920, 1080];

fn preparation(c: &mut Criterion) {
    let renderer = Renderer::new(&block_on(Gpu::open()).unwrap());
    let stars = StarField::new(&hipparcos(), 0.0);
    let settings = Settings::new(View::default(), Deflection::DEFAULT_STEP);
    let view = View {
        motion: Motion::Fall,
        ..View::default()
    };
    let falling = Settings::new(view, Deflection::DEFAULT_STEP);
    let name = "prepare a frame with a new radius";
    prepare(c, name, &renderer, settings.clone(), None);
    prepare(c, "the same in free fall", &renderer, falling, None);
    let stars = renderer.upload_stars(&stars);
    let name = "the same at rest with 117,955 stars";
    prepare(c, name, &renderer, settings, Some(stars));
}

fn prepare(
    c: &mut Criterion,
    name: &str,
    renderer: &Renderer,
    mut settings: Settings,
    stars: Option<StarsOnDevice>,
) {
    let gpu = renderer.gpu().clone();
    let sky = block_on(renderer.upload_sky(&sky::grid(64))).unwrap();
    let mut realtime = RealtimeRenderer::new(renderer.clone(), WINDOW);
    let format = wgpu::TextureFormat::Bgra8Unorm;
    let mut presenter = Presenter::new(&gpu, &realtime, format);
    c.bench_function(name, |b| {
        b.iter_custom(|frames| {
            let mut sum = Duration::ZERO;
            for i in 0..frames {
                settings.view.radius = 2.5 + 35.0 * (i % 1000) as f64 / 1000.0;
                let started = Instant::now();
                let plan = Plan::new(&settings, default_atlas(), WINDOW, 1.0).unwrap();
                let scene = Scene {
                    lens: plan.lens.clone(),
                    sampling: plan.sampling,
                    sky: sky.clone(),
                    stars: stars.clone(),
                    rendition: plan.rendition,
                    disc: None,
                };
                realtime.show(&scene, plan.show);
                presenter.show(plan.picture(), &plan.window, plan.presentation);
                sum += started.elapsed();
                // Submits the pending writes, so that they do not accumulate.
                gpu.queue.submit([]);
                block_on(gpu.wait()).unwrap();
            }
            sum
        });
    });
}

criterion_group!(benches, preparation);
criterion_main!(benches);
