//! The window's surface and what is drawn to it.

use super::panel::Paint;
use super::plan::Plan;
use super::{WindowError, screenshot};
use crate::camera::MAX_SIDE;
use crate::gpu::{
    Gpu, GpuError, Lap, Live, Presenter, Renderer, SkyOnDevice, StarLight, Stopwatch, Timed,
};
use crate::sky::Sky;
use crate::stars::StarField;
use lensbake_tables::Row;
use std::sync::Arc;
use wgpu::*;
use winit::window::Window;

/// The GPU's side of the window.
pub struct Stage {
    gpu: Gpu,
    window: Arc<Window>,
    surface: Surface<'static>,
    config: SurfaceConfiguration,
    live: Live,
    presenter: Presenter,
    stopwatch: Stopwatch,
    drawn: Option<Plan>,
}

/// Side of a picture that has more pixels than the window at the most: half a gigabyte.
const SUPERSAMPLED_SIDE: u32 = 8192;

/// What became of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// It is on the screen.
    Yes,
    /// There was nothing to draw on: the window is minimised, covered, or being resized.
    NotNow,
}

impl Stage {
    /// A stage for `window`, before `sky`, with rows of the shape of `row` and a direct integrator of this
    /// step, rad. Returns the sky on the device with it.
    ///
    /// # Errors
    /// [`WindowError::Gpu`] if there is no GPU, or it cannot draw to the window.
    pub fn new(
        window: Arc<Window>,
        sky: &Sky,
        row: &Row,
        step: f64,
    ) -> Result<(Self, SkyOnDevice), WindowError> {
        let (gpu, surface) = Gpu::open_for(window.clone())?;
        let capabilities = surface.get_capabilities(gpu.adapter());
        // A format that leaves the encoding to the shader, as the panel likes it.
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
        let renderer = Renderer::new(&gpu, sky)?;
        let on_device = renderer.sky();
        let live = Live::new(renderer, row, [1, 1], &[step]);
        let stage = Stage {
            presenter: Presenter::new(&gpu, &live, format),
            stopwatch: Stopwatch::new(&gpu),
            live,
            gpu,
            window,
            surface,
            config,
            drawn: None,
        };
        Ok((stage, on_device))
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The format of the surface.
    pub fn format(&self) -> TextureFormat {
        self.config.format
    }

    /// Takes over the window's size and returns it, pixels; none when it has no pixels, as when
    /// minimised. Everything in a frame goes by this size, for the window's own may change meanwhile. Of a
    /// window larger than the device can draw, it is the part that it can.
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

    /// `scale`, or the largest whole one at which a picture of the window is not too large.
    pub fn fitting(&self, scale: f64) -> f64 {
        let side = self.config.width.max(self.config.height);
        scale.min(f64::from((SUPERSAMPLED_SIDE / side).max(1)))
    }

    /// Puts a sky on the device.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if it does not fit.
    pub fn upload(&mut self, sky: &Sky) -> Result<SkyOnDevice, GpuError> {
        self.live.renderer().upload(sky)
    }

    /// Draws before this sky from now on.
    pub fn set_sky(&mut self, sky: &SkyOnDevice) {
        self.live.renderer().set_sky(sky);
        self.drawn = None;
    }

    /// Draws the stars of `field` before the sky from now on, or none.
    pub fn set_stars(&mut self, field: Option<&StarField>) {
        self.live.set_stars(field);
        self.presenter.follow(&self.gpu, &self.live);
        self.drawn = None;
    }

    /// Makes ready for rows of the shape of `row`.
    pub fn set_row_shape(&mut self, row: &Row) {
        if !self.live.takes(row) {
            self.live.set_row_shape(row);
            self.presenter.follow(&self.gpu, &self.live);
            self.drawn = None;
        }
    }

    /// Makes room for pictures of `room` pixels.
    pub fn set_room(&mut self, room: [u32; 2]) {
        if room != self.live.room() {
            self.live.set_room(room);
            self.presenter.follow(&self.gpu, &self.live);
            self.drawn = None;
        }
    }

    /// Shows a plan in the window, and the panel's `paint` over it. The picture is drawn only if it is
    /// not there already.
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
                // Shown as it is. If the window has changed meanwhile, the next one fits; a window larger
                // than the device can draw never does.
                if pixels(&self.window, &self.gpu).is_some_and(|size| !self.fits(size)) {
                    self.window.request_redraw();
                }
                frame
            }
            CurrentSurfaceTexture::Outdated => {
                self.configure();
                self.window.request_redraw();
                return Ok(Shown::NotNow);
            }
            CurrentSurfaceTexture::Lost => {
                self.surface = self.gpu.surface(self.window.clone())?;
                self.configure();
                self.window.request_redraw();
                return Ok(Shown::NotNow);
            }
            CurrentSurfaceTexture::Timeout
            | CurrentSurfaceTexture::Occluded
            | CurrentSurfaceTexture::Validation => return Ok(Shown::NotNow),
        };
        let on_screen = [frame.texture.width(), frame.texture.height()];
        if on_screen != [plan.window.width, plan.window.height] {
            return Ok(Shown::NotNow);
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
        Ok(Shown::Yes)
    }

    /// Draws the picture of a plan unless it is there already, and sets how it is shown.
    fn draw(&mut self, plan: &Plan) -> Option<Timed> {
        self.presenter
            .show(plan.picture(), &plan.window, plan.showing);
        if self.drawn.as_ref() == Some(plan) {
            return None;
        }
        self.live.show(&plan.scene, plan.show);
        self.stopwatch.submit(&self.gpu, &self.live)
    }

    /// The GPU's times of the frames that have come back since the last call.
    pub fn laps(&self) -> impl Iterator<Item = Lap> {
        self.stopwatch.arrived()
    }

    /// Whether the picture has all light of its stars, if that has come back since the last call.
    pub fn star_light(&self) -> Option<StarLight> {
        self.live.star_light()
    }

    /// Whether [`Stage::star_light`] will have something to tell.
    pub fn awaits_star_light(&self) -> bool {
        self.live.awaits_star_light()
    }

    /// Draws a plan without the panel: what the window shows, `[height][width][3]` in 8-bit sRGB.
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

/// Pixels of a window, as far as a device can draw them and a camera has them; none if it has none.
fn pixels(window: &Window, gpu: &Gpu) -> Option<[u32; 2]> {
    let most = gpu.device.limits().max_texture_dimension_2d.min(MAX_SIDE);
    let size = window.inner_size();
    let size = [size.width, size.height].map(|side| side.min(most));
    (size[0] > 0 && size[1] > 0).then_some(size)
}

/// Begins to draw a whole window.
pub(super) fn begin<'a>(
    encoder: &'a mut CommandEncoder,
    view: &TextureView,
    timestamp_writes: Option<RenderPassTimestampWrites>,
) -> RenderPass<'a> {
    encoder.begin_render_pass(&RenderPassDescriptor {
        label: Some("window"),
        color_attachments: &[Some(RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: Operations {
                load: LoadOp::Clear(Color::BLACK),
                store: StoreOp::Store,
            },
        })],
        timestamp_writes,
        ..Default::default()
    })
}
