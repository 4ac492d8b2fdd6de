//! The viewer of one canvas: how it is opened, and its frames. The other files here have what the page asks of it.

mod controls;
mod pictures;
mod settings;
mod sky_and_stars;

pub use sky_and_stars::SkyWriter;

use crate::sky_texels::{built_in, make_sky};
use lensbake_interactive::input::Input;
use lensbake_interactive::plan::Plan;
use lensbake_interactive::resolution::Resolution;
use lensbake_interactive::session::Session;
use lensbake_interactive::settings::Settings;
use lensbake_interactive::skies::{BUILT_IN, Selected};
use lensbake_interactive::stage::{Frame, Stage};
use lensbake_interactive::state::{NamedTable, State};
use lensbake_render::camera::View;
use lensbake_render::gpu::{Gpu, Pass, Renderer};
use lensbake_render::lens::Deflection;
use lensbake_render::sky::SkySource;
use lensbake_tables::default_atlas;
use std::time::Duration;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::HtmlCanvasElement;
use wgpu::{Backends, SurfaceTarget};

/// Texels along the edge of a face of the coarse sky that the first picture shows while a worker makes the whole sky.
const FIRST_SKY_TEXELS: u32 = 192;
/// Time without changes after which the automatic resolution draws at the full resolution of the canvas.
const AT_REST: Duration = Duration::from_millis(250);
/// Longest time between frames that says something about the GPU; a longer one is that of a page that was stopped.
const LONGEST_FRAME: Duration = Duration::from_secs(5);
/// Name of the built-in table.
const ATLAS: &str = "built-in atlas";

/// What is left to do after a frame.
#[wasm_bindgen]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameState {
    /// Nothing: nothing moves.
    Still = 0,
    /// Draw the next frame: something moves.
    Moving = 1,
    /// Draw a frame in a while: a result of the GPU is expected, or the picture has fewer pixels than it should have at
    /// rest.
    Awaiting = 2,
    /// Try again in a while: the frame could not be shown.
    NotShown = 3,
}

/// The viewer of one canvas.
#[wasm_bindgen]
pub struct Viewer {
    session: Session,
    input: Input,
    messages: Vec<String>,
    /// The built-in skies that are to be made.
    wanted_skies: Vec<String>,
    drawn: Option<Plan>,
    last_drawn: Option<Duration>,
    changed: Duration,
}

impl Drop for Viewer {
    /// Frees the memory of the GPU now, which JavaScript would do when it collects garbage.
    fn drop(&mut self) {
        self.session.stage.gpu().device.destroy();
    }
}

fn seconds(milliseconds: f64) -> Duration {
    Duration::try_from_secs_f64(1e-3 * milliseconds).unwrap_or_default()
}

fn error(text: impl ToString) -> JsError {
    JsError::new(&text.to_string())
}

#[wasm_bindgen]
impl Viewer {
    /// Opens a viewer that draws to `canvas`, of this size in pixels, before the built-in sky of this name. `backend` is
    /// `webgpu`, `webgl`, or anything else for the better one that works; `pass` is `compute`, `fragment`, or anything else
    /// for what is usual on the device. `on_failure` is called with the reason if the device fails later.
    ///
    /// # Errors
    /// If there is no such sky, or no GPU can draw to the canvas.
    #[expect(clippy::too_many_arguments, reason = "JavaScript has no structs")]
    pub async fn open(
        canvas: HtmlCanvasElement,
        backend: String,
        pass: String,
        sky: String,
        width: u32,
        height: u32,
        on_failure: js_sys::Function,
    ) -> Result<Viewer, JsError> {
        let backends = match &backend[..] {
            "webgpu" => Backends::BROWSER_WEBGPU,
            "webgl" => Backends::GL,
            _ => Backends::BROWSER_WEBGPU | Backends::GL,
        };
        let source = built_in(&sky).ok_or_else(|| error(format!("there is no sky '{sky}'")))?;
        let settings = Settings {
            resolution: Resolution::Auto,
            ..Settings::new(View::default(), Deflection::DEFAULT_STEP)
        };
        let table = NamedTable::new(default_atlas().clone(), ATLAS);
        let state = State::new(settings, table).map_err(error)?;
        let target = SurfaceTarget::Canvas(canvas);
        let (gpu, surface) = Gpu::open_for_backends(target, backends)
            .await
            .map_err(error)?;
        let failure = gpu.failure();
        spawn_local(async move {
            let reason = failure.await.to_string();
            // The page may be gone.
            let _ = on_failure.call1(&JsValue::NULL, &reason.into());
        });
        let texels = make_sky(&sky, FIRST_SKY_TEXELS)?.into_sky();
        let renderer = match &pass[..] {
            "compute" => Renderer::with_pass(&gpu, Pass::Compute),
            "fragment" => Renderer::with_pass(&gpu, Pass::Fragment),
            _ => Renderer::new(&gpu),
        };
        let stage = Stage::new(renderer, surface, [width, height], &texels).await;
        let (stage, on_device) = stage.map_err(error)?;
        Ok(Viewer {
            wanted_skies: Vec::from_iter(Some(sky).filter(|_| texels.face_texels() > 1)),
            session: Session::new(state, stage, source, on_device),
            input: Input::default(),
            messages: Vec::new(),
            drawn: None,
            last_drawn: None,
            changed: Duration::ZERO,
        })
    }

    /// Names of the built-in skies.
    #[wasm_bindgen(js_name = builtInSkies)]
    pub fn built_in_skies() -> Vec<String> {
        BUILT_IN.iter().map(SkySource::name).collect()
    }

    /// Name of the adapter and its backend.
    #[wasm_bindgen(getter)]
    pub fn adapter(&self) -> String {
        self.session.stage.gpu().name()
    }

    /// The backend: `webgpu` or `webgl`.
    #[wasm_bindgen(getter)]
    pub fn backend(&self) -> String {
        match self.session.stage.gpu().backend() {
            wgpu::Backend::BrowserWebGpu => "webgpu",
            _ => "webgl",
        }
        .to_owned()
    }

    /// Draws a frame to the canvas, of this size in pixels, at the time `now`, which was requested at the time `requested`;
    /// both in milliseconds.
    ///
    /// # Errors
    /// If the device failed, or the size cannot be drawn.
    pub fn frame(
        &mut self,
        now: f64,
        requested: f64,
        width: u32,
        height: u32,
    ) -> Result<FrameState, JsError> {
        let now = seconds(now);
        let (moving, said) = self.session.advance(&mut self.input, now);
        if let Some(said) = said {
            self.say(said);
        }
        if moving {
            self.changed = now;
        }
        self.settle();
        let at_rest = now.saturating_sub(self.changed) >= AT_REST;
        let plan = self.session.plan([width, height], at_rest);
        let Some(plan) = plan.map_err(error)? else {
            return Ok(FrameState::NotShown);
        };
        if self
            .drawn
            .as_ref()
            .is_none_or(|drawn| drawn.window != plan.window)
        {
            self.changed = self.changed.max(now);
        }
        match self.session.stage.draw(&plan, &mut ()).map_err(error)? {
            Frame::Drawn(frame) => self.session.stage.present(frame),
            Frame::Skipped | Frame::Outdated | Frame::Lost => return Ok(FrameState::NotShown),
        }
        self.learn(now, seconds(requested));
        if let Some(notice) = self.session.lost_stars(now) {
            self.say(notice);
        }
        let coarse = plan.picture() < [width, height] && !at_rest;
        let coarse = coarse && self.session.state.settings.resolution == Resolution::Auto;
        self.drawn = Some(plan);
        Ok(if moving {
            FrameState::Moving
        } else if coarse || self.session.stage.awaits_star_light() {
            FrameState::Awaiting
        } else {
            FrameState::Still
        })
    }

    /// Adjusts the automatic resolution: to the GPU's times, or without them to the time since the last frame, or since this
    /// one was requested if that was later. A browser starts a frame late while the GPU has not finished the last one.
    fn learn(&mut self, now: Duration, requested: Duration) {
        self.session.record_gpu_times();
        let timed = self.session.stage.gpu().has_timestamps();
        let since = self
            .last_drawn
            .map(|last| now.saturating_sub(last.max(requested)));
        self.last_drawn = Some(now);
        let settings = &self.session.state.settings;
        if let (false, Some(since), Resolution::Auto) = (timed, since, settings.resolution)
            && since < LONGEST_FRAME
        {
            self.session
                .auto
                .learn_from_interval(since, settings.target());
        }
    }

    /// Forgets the time of the last frame, after a pause in which no frames were drawn, and releases the keys.
    pub fn pause(&mut self, now: f64) {
        self.input.release_all(seconds(now));
        self.session.pause();
        self.last_drawn = None;
    }

    /// The messages since the last call.
    #[wasm_bindgen(js_name = takeMessages)]
    pub fn take_messages(&mut self) -> Vec<String> {
        std::mem::take(&mut self.messages)
    }
}

impl Viewer {
    fn select(&mut self, index: usize) {
        if let Selected::Load(source) = self.session.select_sky(index) {
            self.wanted_skies.push(source.name());
        }
    }

    fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        if self.messages.last() != Some(&text) {
            self.messages.push(text);
        }
    }
}
