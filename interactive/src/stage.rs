//! The surface (swap chain) of a window or a canvas, and the frames drawn to it.

use crate::plan::Plan;
use crate::render_pass::begin;
use crate::screenshot::Screenshot;
use lensbake_render::camera::MAX_SIDE;
use lensbake_render::gpu::{
    Gpu, GpuError, Lap, Presenter, RealtimeRenderer, Renderer, SkyOnDevice, StarLight,
    StarsOnDevice, Stopwatch, Timed,
};
use lensbake_render::scene::Scene;
use lensbake_render::sky::Sky;
use lensbake_render::stars::StarField;
use wgpu::*;

/// GPU resources of a surface.
pub struct Stage {
    gpu: Gpu,
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

/// What is drawn over the picture, such as a panel.
pub trait Overlay {
    /// Uploads what drawing needs. Returns command buffers to submit before `encoder`.
    fn prepare(&mut self, gpu: &Gpu, encoder: &mut CommandEncoder) -> Vec<CommandBuffer>;

    /// Records the draw calls.
    fn draw(&self, pass: &mut RenderPass<'static>);
}

/// Nothing is drawn over the picture.
impl Overlay for () {
    fn prepare(&mut self, _: &Gpu, _: &mut CommandEncoder) -> Vec<CommandBuffer> {
        Vec::new()
    }

    fn draw(&self, _: &mut RenderPass<'static>) {}
}

/// What became of a frame.
#[derive(Debug)]
pub enum Frame {
    /// It is drawn; [`Stage::present`] shows it.
    Drawn(SurfaceTexture),
    /// It is not drawn: the window is minimised, covered, or being resized.
    Skipped,
    /// It is not drawn because the surface was outdated. Draw again.
    Outdated,
    /// It is not drawn because the surface is lost. [`Stage::replace_surface`] needs another.
    Lost,
}

/// `size` (width and height in pixels), limited to what the device and a camera support; `None` if it has no pixels.
pub fn drawable_size(gpu: &Gpu, size: [u32; 2]) -> Option<[u32; 2]> {
    let most = gpu.device.limits().max_texture_dimension_2d.min(MAX_SIDE);
    let size = size.map(|side| side.min(most));
    (size[0] > 0 && size[1] > 0).then_some(size)
}

impl Stage {
    /// A stage for a surface of the renderer's device with this size in pixels, and with this sky. Returns the uploaded
    /// sky as well.
    ///
    /// # Errors
    /// [`GpuError`] if the GPU cannot draw to the surface, or the sky does not fit.
    pub async fn new(
        renderer: Renderer,
        surface: Surface<'static>,
        size: [u32; 2],
        sky: &Sky,
    ) -> Result<(Self, SkyOnDevice), GpuError> {
        let gpu = renderer.gpu().clone();
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
        let [width, height] = drawable_size(&gpu, size).unwrap_or([1, 1]);
        let mut config = surface
            .get_default_config(gpu.adapter(), width, height)
            .ok_or_else(|| GpuError::NoSurface("it has no configuration".into()))?;
        config.format = format;
        config.present_mode = PresentMode::AutoVsync;
        surface.configure(&gpu.device, &config);
        let sky = renderer.upload_sky(sky).await?;
        let realtime = RealtimeRenderer::new(renderer, [1, 1]);
        let stage = Stage {
            presenter: Presenter::new(&gpu, &realtime, format),
            stopwatch: Stopwatch::new(&gpu),
            realtime,
            sky: sky.clone(),
            stars: None,
            gpu,
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

    /// The renderer, which also uploads skies and stars.
    pub fn renderer(&self) -> &Renderer {
        self.realtime.renderer()
    }

    /// The format of the surface.
    pub fn format(&self) -> TextureFormat {
        self.config.format
    }

    /// Width and height that the surface is configured for, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Configures the surface for this size, unless it is. The whole frame uses the returned size, because that of the
    /// window may change meanwhile. It is limited to what the device can draw; `None` if it has no pixels, as when the
    /// window is minimised.
    pub fn fit(&mut self, size: [u32; 2]) -> Option<[u32; 2]> {
        let size = drawable_size(&self.gpu, size)?;
        if size != self.size() {
            [self.config.width, self.config.height] = size;
            self.configure();
        }
        Some(size)
    }

    fn configure(&mut self) {
        self.surface.configure(&self.gpu.device, &self.config);
    }

    /// Draws to another surface of the same window from now on.
    pub fn replace_surface(&mut self, surface: Surface<'static>) {
        self.surface = surface;
        self.configure();
    }

    /// `scale`, limited to the largest whole number (at least 1) at which no side of the picture exceeds
    /// `SUPERSAMPLED_SIDE` or what the device can draw.
    pub fn fitting(&self, scale: f64) -> f64 {
        let side = self.config.width.max(self.config.height);
        let most = self.gpu.device.limits().max_texture_dimension_2d;
        scale.min(f64::from((SUPERSAMPLED_SIDE.min(most) / side).max(1)))
    }

    /// Uploads stars.
    pub fn upload_stars(&self, field: &StarField) -> StarsOnDevice {
        self.renderer().upload_stars(field)
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

    /// Draws a plan, and `overlay` over it. The picture is drawn only if the plan, the sky or the stars have changed.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device failed or was lost.
    pub fn draw(&mut self, plan: &Plan, overlay: &mut impl Overlay) -> Result<Frame, GpuError> {
        self.gpu.poll()?;
        let frame = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(frame) | CurrentSurfaceTexture::Suboptimal(frame) => {
                frame
            }
            CurrentSurfaceTexture::Outdated => {
                self.configure();
                return Ok(Frame::Outdated);
            }
            CurrentSurfaceTexture::Lost => return Ok(Frame::Lost),
            CurrentSurfaceTexture::Timeout
            | CurrentSurfaceTexture::Occluded
            | CurrentSurfaceTexture::Validation => return Ok(Frame::Skipped),
        };
        let on_screen = [frame.texture.width(), frame.texture.height()];
        if on_screen != [plan.window.width, plan.window.height] {
            return Ok(Frame::Skipped);
        }
        let timed = self.draw_picture(plan);
        let view = frame.texture.create_view(&Default::default());
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let uploads = overlay.prepare(&self.gpu, &mut encoder);
        {
            let stamps = timed.as_ref().map(Timed::after_window);
            let mut pass = begin(&mut encoder, &view, stamps).forget_lifetime();
            self.presenter.draw(&mut pass);
            overlay.draw(&mut pass);
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
        Ok(Frame::Drawn(frame))
    }

    /// Shows a frame that is drawn.
    pub fn present(&self, frame: SurfaceTexture) {
        self.gpu.queue.present(frame);
    }

    /// Draws the picture of a plan if it has changed, and updates the presenter.
    fn draw_picture(&mut self, plan: &Plan) -> Option<Timed> {
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
            disc: plan.disc,
        };
        self.realtime.show(&scene, plan.show);
        self.stopwatch.submit(&self.gpu, &self.realtime)
    }

    /// Submits the picture of a plan `count` times, to be timed.
    pub fn submit_pictures(&mut self, plan: &Plan, count: u32) {
        for _ in 0..count {
            self.drawn = None;
            let _untimed = self.draw_picture(plan);
        }
        self.drawn = Some(plan.clone());
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

    /// Draws a plan without the overlay, to be read back.
    pub fn screenshot(&mut self, plan: &Plan) -> Screenshot {
        let _untimed = self.draw_picture(plan);
        self.drawn = Some(plan.clone());
        let size = [plan.window.width, plan.window.height];
        Screenshot::submit(&self.gpu, &self.presenter, self.config.format, size)
    }
}
