//! The window's surface (swap chain), and the frames drawn to it.

use super::panel::Paint;
use super::plan::Plan;
use super::render_pass::begin;
use super::{WindowError, screenshot};
use lensbake_render::camera::MAX_SIDE;
use lensbake_render::gpu::{
    Gpu, GpuError, Lap, Pass, Presenter, RealtimeRenderer, Renderer, SkyOnDevice, StarLight,
    StarsOnDevice, Stopwatch, Timed,
};
use lensbake_render::scene::Scene;
use lensbake_render::sky::Sky;
use lensbake_render::stars::StarField;
use pollster::block_on;
use std::sync::Arc;
use wgpu::*;
use winit::window::Window;

/// GPU resources of the window.
pub struct Stage {
    gpu: Gpu,
    window: Arc<Window>,
    surface: Surface<'static>,
    config: SurfaceConfiguration,
    realtime: RealtimeRenderer,
    sky: SkyOnDevice,
    stars: Option<StarsOnDevice>,
    presenter: Presenter,
    stopwatch: Stopwatch,
    drawn: Option<Plan>,
}

/// Largest side of a supersampled picture: half a gigabyte.
const SUPERSAMPLED_SIDE: u32 = 8192;

/// Whether a frame was presented.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// It was presented.
    Presented,
    /// It was not: the window is minimised, covered, or being resized.
    Skipped,
}

impl Stage {
    /// A stage for `window` with this sky, whose picture is drawn in `pass`. Returns the uploaded sky as well.
    ///
    /// # Errors
    /// [`WindowError::Gpu`] if there is no GPU, or it cannot draw to the window.
    pub fn new(
        window: Arc<Window>,
        sky: &Sky,
        pass: Option<Pass>,
    ) -> Result<(Self, SkyOnDevice), WindowError> {
        let (gpu, surface) = block_on(Gpu::open_for(window.clone()))?;
        let capabilities = surface.get_capabilities(gpu.adapter());
        // A format that is not sRGB leaves the encoding to the shader, as egui prefers.
        let plain = capabilities.formats.iter().find(|format| {
            matches!(
                format,
                TextureFormat::Bgra8Unorm | TextureFormat::Rgba8Unorm
            )
        });
        let format = plain.or(capabilities.formats.first());
        let format = *format.ok_or_else(|| GpuError::NoSurface("it has no format".into()))?;
        let [width, height] = pixels(&window, &gpu).unwrap_or([1, 1]);
        let mut config = surface
            .get_default_config(gpu.adapter(), width, height)
            .ok_or_else(|| GpuError::NoSurface("it has no configuration".into()))?;
        config.format = format;
        config.present_mode = PresentMode::AutoVsync;
        surface.configure(&gpu.device, &config);
        let pass = pass.unwrap_or_else(|| Pass::default_on(&gpu));
        let renderer = Renderer::with_pass(&gpu, pass);
        let sky = block_on(renderer.upload_sky(sky))?;
        let realtime = RealtimeRenderer::new(renderer, [1, 1]);
        let stage = Stage {
            presenter: Presenter::new(&gpu, &realtime, format),
            stopwatch: Stopwatch::new(&gpu),
            realtime,
            sky: sky.clone(),
            stars: None,
            gpu,
            window,
            surface,
            config,
            drawn: None,
        };
        Ok((stage, sky))
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The format of the surface.
    pub fn format(&self) -> TextureFormat {
        self.config.format
    }

    /// Configures the surface for the window's size and returns that size in pixels; `None` if the window has no
    /// pixels, as when it is minimised. The whole frame uses this size, because the window's own may change
    /// meanwhile. It is limited to what the device can draw.
    pub fn fit(&mut self) -> Option<[u32; 2]> {
        let [width, height] = pixels(&self.window, &self.gpu)?;
        if !self.fits([width, height]) {
            self.config.width = width;
            self.config.height = height;
            self.configure();
        }
        Some([width, height])
    }

    fn fits(&self, size: [u32; 2]) -> bool {
        size == [self.config.width, self.config.height]
    }

    fn configure(&mut self) {
        self.surface.configure(&self.gpu.device, &self.config);
    }

    /// `scale`, limited to the largest whole number (at least 1) at which no side of the picture exceeds
    /// `SUPERSAMPLED_SIDE`.
    pub fn fitting(&self, scale: f64) -> f64 {
        let side = self.config.width.max(self.config.height);
        scale.min(f64::from((SUPERSAMPLED_SIDE / side).max(1)))
    }

    /// Uploads a sky.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if it does not fit.
    pub fn upload_sky(&self, sky: &Sky) -> Result<SkyOnDevice, GpuError> {
        block_on(self.realtime.renderer().upload_sky(sky))
    }

    /// Uploads stars.
    pub fn upload_stars(&self, field: &StarField) -> StarsOnDevice {
        self.realtime.renderer().upload_stars(field)
    }

    /// Sets the sky of the next frames.
    pub fn set_sky(&mut self, sky: &SkyOnDevice) {
        self.sky = sky.clone();
        self.drawn = None;
    }

    /// Sets the stars of the next frames; `None` for no stars.
    pub fn set_stars(&mut self, stars: Option<StarsOnDevice>) {
        self.stars = stars;
        self.drawn = None;
    }

    /// Makes the textures large enough for pictures of `room` pixels.
    pub fn set_room(&mut self, room: [u32; 2]) {
        if room != self.realtime.room() {
            self.realtime.set_room(room);
            self.presenter.follow(&self.gpu, &self.realtime);
            self.drawn = None;
        }
    }

    /// Draws a plan, and the panel's `paint` over it, and presents the frame. The picture is drawn only if the
    /// plan, the sky or the stars have changed.
    ///
    /// # Errors
    /// [`WindowError`] if the device failed or was lost, or the window has no surface any more.
    pub fn show(&mut self, plan: &Plan, paint: &mut Paint) -> Result<Shown, WindowError> {
        paint.upload(&self.gpu);
        let shown = self.show_uploaded(plan, paint);
        paint.finish();
        shown
    }

    fn show_uploaded(&mut self, plan: &Plan, paint: &mut Paint) -> Result<Shown, WindowError> {
        self.gpu.poll()?;
        let frame = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(frame) => frame,
            CurrentSurfaceTexture::Suboptimal(frame) => {
                // Present it all the same. Redraw only if the window's size has changed: a window larger than the
                // device can draw is always suboptimal.
                if pixels(&self.window, &self.gpu).is_some_and(|size| !self.fits(size)) {
                    self.window.request_redraw();
                }
                frame
            }
            CurrentSurfaceTexture::Outdated => {
                self.configure();
                self.window.request_redraw();
                return Ok(Shown::Skipped);
            }
            CurrentSurfaceTexture::Lost => {
                self.surface = self.gpu.surface(self.window.clone())?;
                self.configure();
                self.window.request_redraw();
                return Ok(Shown::Skipped);
            }
            CurrentSurfaceTexture::Timeout
            | CurrentSurfaceTexture::Occluded
            | CurrentSurfaceTexture::Validation => return Ok(Shown::Skipped),
        };
        let on_screen = [frame.texture.width(), frame.texture.height()];
        if on_screen != [plan.window.width, plan.window.height] {
            return Ok(Shown::Skipped);
        }
        let timed = self.draw(plan);
        let view = frame.texture.create_view(&Default::default());
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let uploads = paint.prepare(&self.gpu, &mut encoder);
        {
            let stamps = timed.as_ref().map(Timed::after_window);
            let mut pass = begin(&mut encoder, &view, stamps).forget_lifetime();
            self.presenter.draw(&mut pass);
            paint.draw(&mut pass);
        }
        if let Some(timed) = &timed {
            timed.resolve(&mut encoder);
        }
        let commands = uploads.into_iter().chain([encoder.finish()]);
        self.gpu.queue.submit(commands);
        if let Some(timed) = timed {
            timed.send_back();
        }
        self.drawn = Some(plan.clone());
        self.window.pre_present_notify();
        self.gpu.queue.present(frame);
        Ok(Shown::Presented)
    }

    /// Draws the picture of a plan if it has changed, and updates the presenter.
    fn draw(&mut self, plan: &Plan) -> Option<Timed> {
        self.presenter
            .show(plan.picture(), &plan.window, plan.presentation);
        if self.drawn.as_ref() == Some(plan) {
            return None;
        }
        let scene = Scene {
            lens: plan.lens.clone(),
            sampling: plan.sampling,
            sky: self.sky.clone(),
            stars: self.stars.clone(),
            rendition: plan.rendition,
        };
        self.realtime.show(&scene, plan.show);
        self.stopwatch.submit(&self.gpu, &self.realtime)
    }

    /// GPU times of the frames, as far as they have arrived since the last call.
    pub fn laps(&self) -> impl Iterator<Item = Lap> {
        self.stopwatch.arrived()
    }

    /// Whether the picture has the light of all its stars, if the GPU has reported that since the last call.
    pub fn star_light(&self) -> Option<StarLight> {
        self.realtime.star_light()
    }

    /// Whether the GPU has still to report to [`Stage::star_light`].
    pub fn awaits_star_light(&self) -> bool {
        self.realtime.awaits_star_light()
    }

    /// Draws a plan without the panel and reads back what the window shows: `[height][width][3]`, 8-bit sRGB.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device does.
    pub fn screenshot(&mut self, plan: &Plan) -> Result<Vec<u8>, GpuError> {
        let _untimed = self.draw(plan);
        self.drawn = Some(plan.clone());
        let size = [plan.window.width, plan.window.height];
        screenshot::take(&self.gpu, &self.presenter, self.config.format, size)
    }
}

/// Size of a window in pixels, limited to what the device and a camera support; `None` if it has no pixels.
fn pixels(window: &Window, gpu: &Gpu) -> Option<[u32; 2]> {
    let most = gpu.device.limits().max_texture_dimension_2d.min(MAX_SIDE);
    let size = window.inner_size();
    let size = [size.width, size.height].map(|side| side.min(most));
    (size[0] > 0 && size[1] > 0).then_some(size)
}
