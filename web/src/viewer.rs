//! The viewer of one canvas.

use crate::panel;
use crate::sky_texels::{built_in, make_sky};
use js_sys::{Promise, Uint8Array};
use keyboard_types::Code;
use lensbake_interactive::input::{self, Button, Input, KeyChange, Reaction};
use lensbake_interactive::keys::{self, BINDINGS, Command, MOUSE};
use lensbake_interactive::meter::Meter;
use lensbake_interactive::parameters::ParameterError;
use lensbake_interactive::plan::Plan;
use lensbake_interactive::resolution::Resolution;
use lensbake_interactive::session::Session;
use lensbake_interactive::settings::Settings;
use lensbake_interactive::skies::Selected;
use lensbake_interactive::stage::{Frame, Stage};
use lensbake_interactive::state::{NamedTable, State};
use lensbake_render::camera::View;
use lensbake_render::gpu::{Gpu, Pass, Renderer, SkyUpload};
use lensbake_render::lens::Deflection;
use lensbake_render::sky::SkySource;
use lensbake_render::stars::{StarField, catalogue_from_bytes};
use lensbake_tables::{container, default_atlas};
use std::path::PathBuf;
use std::time::Duration;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{future_to_promise, spawn_local};
use web_sys::HtmlCanvasElement;
use wgpu::{Backends, SurfaceTarget};

/// Texels along the edge of a face of the sky of the first picture, which is made before the page waits for the whole
/// sky.
const FIRST_SKY_TEXELS: u32 = 192;
/// Time after the last change from which on the automatic resolution is the canvas' own.
const AT_REST: Duration = Duration::from_millis(250);
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

/// A sky that is being written to the device.
#[wasm_bindgen]
pub struct SkyWriter {
    source: SkySource,
    upload: SkyUpload,
}

#[wasm_bindgen]
impl SkyWriter {
    /// Writes a face of a mip level: the bytes that `SkyTexels.face` gives.
    ///
    /// # Errors
    /// If the sky has no such face.
    pub fn write(&self, level: u32, face: u32, texels: &[u8]) -> Result<(), JsError> {
        let written = self.upload.write(level, face, texels);
        written
            .then_some(())
            .ok_or_else(|| error("the sky has no such face"))
    }
}

/// The viewer of one canvas.
#[wasm_bindgen]
pub struct Viewer {
    session: Session,
    input: Input,
    start: Settings,
    messages: Vec<String>,
    /// The built-in sky that is to be made.
    wanted_sky: Option<String>,
    width: f64,
    drawn: Option<Plan>,
    /// When the last frame began in which something moved.
    last: Option<Duration>,
    last_drawn: Option<Duration>,
    changed: Duration,
    intervals: Meter,
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
        let state = State::new(settings.clone(), table).map_err(error)?;
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
            wanted_sky: Some(sky).filter(|_| texels.face_texels() > 1),
            session: Session::new(state, stage, source, on_device),
            input: Input::default(),
            start: settings,
            messages: Vec::new(),
            width: f64::from(width.max(1)),
            drawn: None,
            last: None,
            last_drawn: None,
            changed: Duration::ZERO,
            intervals: Meter::default(),
        })
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

    /// Draws a frame to the canvas, of this size in pixels, at a time in milliseconds.
    ///
    /// # Errors
    /// If the device failed, or the size cannot be drawn.
    pub fn frame(&mut self, now: f64, width: u32, height: u32) -> Result<FrameState, JsError> {
        let now = seconds(now);
        self.width = f64::from(width.max(1));
        let moving = self.advance(now);
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
        self.learn(now);
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

    /// Moves the camera by the time since the last frame; true if something keeps moving.
    fn advance(&mut self, now: Duration) -> bool {
        let settings = &mut self.session.state.settings;
        let held = self.input.steer(&mut settings.view, now);
        let moving = held || settings.moves();
        let since = self.last.map(|last| now.saturating_sub(last));
        match since {
            Some(since) => self.intervals.add(since),
            None => self.intervals.clear(),
        }
        self.last = moving.then_some(now);
        let since = since.unwrap_or_default();
        if let Some(said) = settings.advance(since.as_secs_f64()) {
            self.say(said);
        }
        moving
    }

    /// Adjusts the automatic resolution: to the GPU's times, or without them to the time between frames.
    fn learn(&mut self, now: Duration) {
        self.session.record_gpu_times();
        let timed = self.session.stage.gpu().has_timestamps();
        let since = self.last_drawn.map(|last| now.saturating_sub(last));
        self.last_drawn = Some(now);
        let settings = &self.session.state.settings;
        if let (false, Some(since), Resolution::Auto) = (timed, since, settings.resolution)
            && since < AT_REST
        {
            self.session
                .auto
                .learn_from_interval(since, settings.target());
        }
    }

    /// Forgets the time of the last frame, after a pause in which no frames were drawn, and releases the keys.
    pub fn pause(&mut self, now: f64) {
        self.input.release_all(seconds(now));
        self.last = None;
        self.last_drawn = None;
    }

    /// Handles a key by the name of its place, `KeyboardEvent.code`: `change` is `pressed`, `repeated` or `released`.
    /// Returns what the page has to do: nothing, `redraw`, or `full-screen`, `screenshot` or `leave`. Nothing at all,
    /// not even an empty text, means that the key is not used.
    pub fn key(&mut self, code: &str, change: &str, now: f64) -> Option<String> {
        let code: Code = code.parse().ok()?;
        let change = match change {
            "released" => KeyChange::Released,
            "repeated" => KeyChange::Repeated,
            _ => KeyChange::Pressed,
        };
        keys::key_action(code)?;
        let settings = &mut self.session.state.settings;
        let does = match self.input.key(code, change, settings, seconds(now)) {
            Reaction::None => "",
            Reaction::Changed => "redraw",
            Reaction::Command(Command::NextSky) => {
                let next = self.session.skies().next();
                self.select(next);
                "redraw"
            }
            Reaction::Command(Command::Reset) => {
                self.reset();
                "redraw"
            }
            Reaction::Command(Command::ToggleFullscreen) => "full-screen",
            Reaction::Command(Command::Screenshot) => "screenshot",
            Reaction::Command(Command::Leave) => "leave",
        };
        Some(does.to_owned())
    }

    /// Resets the settings to the start.
    pub fn reset(&mut self) {
        if let Some(said) = self.session.state.reset() {
            self.say(said);
        }
    }

    /// Lets go, pauses the fall, goes on, or falls again.
    #[wasm_bindgen(js_name = letGo)]
    pub fn let_go(&mut self) {
        self.session.state.settings.let_go();
    }

    /// Goes back to where the camera let go.
    #[wasm_bindgen(js_name = backToLetGo)]
    pub fn back_to_let_go(&mut self) {
        self.session.state.settings.back_to_let_go();
    }

    /// Stops what moves by itself.
    #[wasm_bindgen(js_name = stopMoving)]
    pub fn stop_moving(&mut self) {
        let settings = &mut self.session.state.settings;
        settings.orbit_speed = 0;
        settings.true_period = false;
        settings.stop_falling();
    }

    /// The pointer jumps to a place in pixels, without dragging.
    #[wasm_bindgen(js_name = pointerAt)]
    pub fn pointer_at(&mut self, x: f64, y: f64) {
        self.input.place([x, y]);
    }

    /// The pointer is pressed: it drags the view, or with `orbits` the camera round the hole.
    #[wasm_bindgen(js_name = pointerPressed)]
    pub fn pointer_pressed(&mut self, orbits: bool) {
        let button = if orbits { Button::Orbit } else { Button::Look };
        self.input
            .press(button, &self.session.state.settings, self.width);
    }

    /// The pointer is released.
    #[wasm_bindgen(js_name = pointerReleased)]
    pub fn pointer_released(&mut self) {
        self.input.release();
    }

    /// The pointer moves to a place in pixels; true if that changed something.
    #[wasm_bindgen(js_name = pointerMoved)]
    pub fn pointer_moved(&mut self, x: f64, y: f64) -> bool {
        let settings = &mut self.session.state.settings;
        self.input.moved([x, y], settings, self.width) != Reaction::None
    }

    /// The wheel turns by notches; with `zooms` it changes the field of view.
    pub fn wheel(&mut self, notches: f64, zooms: bool) {
        input::wheel(&mut self.session.state.settings.view, notches, zooms);
    }

    /// Two touches go apart by this factor.
    pub fn pinch(&mut self, apart: f64) {
        input::pinch(&mut self.session.state.settings.view, apart);
    }

    /// The value of a setting, or nothing if there is no such setting.
    pub fn get(&self, name: &str) -> Option<String> {
        match name {
            "sky" => Some(self.session.skies().name()),
            "stars" => Some(panel::switch(self.session.stars_everywhere).to_owned()),
            _ => self.session.state.settings.parameter(name),
        }
    }

    /// Sets a setting.
    ///
    /// # Errors
    /// If there is no such setting, or `text` is no value of it. [`Viewer::settle`] checks whether it can be drawn, because
    /// several settings may be possible only together.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), JsError> {
        match name {
            "sky" => {
                let index = self.session.skies().names().position(|one| one == text);
                let names: Vec<String> = self.session.skies().names().collect();
                let index = index.ok_or_else(|| {
                    error(format!("sky is '{text}', but must be {}", names.join(", ")))
                })?;
                self.select(index);
            }
            "stars" => {
                self.session.stars_everywhere = panel::switched(text)
                    .ok_or_else(|| error(format!("stars is '{text}', but must be on or off")))?;
                self.session.show_stars();
            }
            _ => {
                let settings = &mut self.session.state.settings;
                settings.set_parameter(name, text).map_err(|e| match e {
                    ParameterError::Unknown(_) => error(format!("{e}, sky, stars")),
                    ParameterError::NoValue { .. } => error(e),
                })?;
            }
        }
        Ok(())
    }

    /// Keeps the settings that can be drawn and reverts the others, with a message.
    pub fn settle(&mut self) {
        if let Some(why) = self.session.state.settle() {
            self.say(why);
        }
    }

    /// The settings that differ from those of a page without any, as names and values in turn.
    #[wasm_bindgen(js_name = changedSettings)]
    pub fn changed_settings(&self) -> Vec<String> {
        let settings = &self.session.state.settings;
        let changed = settings.changed_parameters(&self.start);
        let mut all: Vec<String> = changed
            .into_iter()
            .flat_map(|(name, text)| [name.to_owned(), text])
            .collect();
        let skies = self.session.skies();
        let sky = skies.name();
        if sky != SkySource::Nebula.name() && built_in(&sky).is_some() {
            all.extend(["sky".to_owned(), sky]);
        }
        if self.session.stars_everywhere {
            all.extend(["stars".to_owned(), "on".to_owned()]);
        }
        all
    }

    /// The keys and what they do, and the same for the pointer: names and descriptions in turn.
    #[wasm_bindgen(js_name = keyBindings)]
    pub fn key_bindings() -> Vec<String> {
        let keys = BINDINGS.iter().map(|one| (one.names, one.does));
        let all = keys.chain(MOUSE.iter().copied());
        all.flat_map(|(names, does)| [names.to_owned(), does.to_owned()])
            .collect()
    }

    /// The messages since the last call.
    #[wasm_bindgen(js_name = takeMessages)]
    pub fn take_messages(&mut self) -> Vec<String> {
        std::mem::take(&mut self.messages)
    }

    /// What the panel shows, as JSON.
    pub fn panel(&self) -> String {
        let info = self.drawn.as_ref().map(|plan| {
            let interval = self.intervals.mean().filter(|_| self.last.is_some());
            self.session.info(plan, interval)
        });
        panel::json(&self.session.state.settings, info.as_ref()).to_string()
    }

    /// The built-in sky that is to be made now by `makeSky`, once.
    #[wasm_bindgen(js_name = takeWantedSky)]
    pub fn take_wanted_sky(&mut self) -> Option<String> {
        self.wanted_sky.take()
    }

    /// Whether a catalogue of stars is wanted and missing.
    #[wasm_bindgen(getter, js_name = wantsStars)]
    pub fn wants_stars(&self) -> bool {
        self.session.wants_stars() && !self.session.has_stars()
    }

    /// Whether a built-in sky is to be made that [`Viewer::take_wanted_sky`] has not yet given.
    #[wasm_bindgen(getter, js_name = wantsSky)]
    pub fn wants_sky(&self) -> bool {
        self.wanted_sky.is_some()
    }

    /// Whether the device can draw stars as points.
    #[wasm_bindgen(getter, js_name = drawsStars)]
    pub fn draws_stars(&self) -> bool {
        self.session.stage.renderer().draws_stars()
    }

    /// Takes a catalogue of stars: the bytes of a file.
    ///
    /// # Errors
    /// If they are no catalogue.
    #[wasm_bindgen(js_name = takeStars)]
    pub fn take_stars(&mut self, bytes: &[u8]) -> Result<(), JsError> {
        let catalogue = catalogue_from_bytes(bytes).map_err(error)?;
        self.session.set_stars(StarField::new(&catalogue, 0.0));
        Ok(())
    }

    /// Takes a bending table: the bytes of a file. Returns false if they are no table.
    ///
    /// # Errors
    /// If they are a table that cannot be used.
    #[wasm_bindgen(js_name = takeTable)]
    pub fn take_table(&mut self, name: &str, bytes: &[u8]) -> Result<bool, JsError> {
        let table = match container::from_bytes(bytes) {
            Ok(table) => table,
            Err(problem) if problem.is_no_table() => return Ok(false),
            Err(problem) => return Err(error(format!("{name}: {problem}"))),
        };
        let said = self.session.state.take_table(NamedTable::new(table, name));
        self.say(said.map_err(error)?);
        Ok(true)
    }

    /// Makes room for a sky with this many texels along the edge of a face: a promise of its writer. A name that is not
    /// of a built-in sky is that of a file.
    #[wasm_bindgen(js_name = beginSky)]
    pub fn begin_sky(&self, name: &str, face_texels: u32) -> Promise {
        let source = built_in(name).unwrap_or_else(|| SkySource::Panorama(PathBuf::from(name)));
        let renderer = self.session.stage.renderer().clone();
        future_to_promise(async move {
            let upload = renderer.begin_sky(face_texels).await;
            let upload = upload.map_err(|e| error(format!("{}: {e}", source.name())))?;
            Ok(SkyWriter { source, upload }.into())
        })
    }

    /// Shows the sky whose faces have been written, unless another was selected meanwhile.
    #[wasm_bindgen(js_name = endSky)]
    pub fn end_sky(&mut self, writer: SkyWriter) {
        let SkyWriter { source, upload } = writer;
        if self.session.keep_sky(&source, upload.finish()) && !source.is_built_in() {
            self.say(format!("sky: {}", source.name()));
        }
    }

    /// The picture without the panel, at the size of the canvas: a promise of the bytes of a PNG file.
    pub fn screenshot(&mut self, width: u32, height: u32) -> Result<Promise, JsError> {
        self.settle();
        let plan = self.session.plan([width, height], true).map_err(error)?;
        let plan = plan.ok_or_else(|| error("the canvas has no pixels"))?;
        let screenshot = self.session.stage.screenshot(&plan);
        Ok(future_to_promise(async move {
            let [width, height] = screenshot.size();
            let pixels = screenshot.read().await.map_err(error)?;
            let png =
                lensbake_render::picture::encode_png(width, height, &pixels).map_err(error)?;
            Ok(Uint8Array::from(&png[..]).into())
        }))
    }

    /// Draws the picture `count` times at the size of the canvas, without showing it: a promise that it is done, to be
    /// timed.
    #[wasm_bindgen(js_name = drawPictures)]
    pub fn draw_pictures(
        &mut self,
        width: u32,
        height: u32,
        count: u32,
    ) -> Result<Promise, JsError> {
        self.settle();
        let plan = self.session.plan([width, height], true).map_err(error)?;
        let plan = plan.ok_or_else(|| error("the canvas has no pixels"))?;
        self.session.stage.submit_pictures(&plan, count);
        let gpu = self.session.stage.gpu().clone();
        Ok(future_to_promise(async move {
            gpu.wait().await.map_err(error)?;
            Ok(JsValue::UNDEFINED)
        }))
    }

    fn select(&mut self, index: usize) {
        if let Selected::Load(source) = self.session.select_sky(index) {
            self.wanted_sky = Some(source.name());
        }
    }

    fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        if self.messages.last() != Some(&text) {
            self.messages.push(text);
        }
    }
}
