//! The open window: handles its events and draws its frames.

use super::coming::Coming;
use super::controls::PanelAction;
use super::event::AppEvent;
use super::input::WindowInput;
use super::pace::{AfterFrame, Pace};
use super::panel::Panel;
use super::{WindowError, files, path, saved};
use lensbake_film::FlightPath;
use lensbake_interactive::input::Reaction;
use lensbake_interactive::keys::Command;
use lensbake_interactive::plan::Plan;
use lensbake_interactive::session::Session;
use lensbake_interactive::skies::Selected;
use lensbake_interactive::stage::{Frame, Stage, drawable_size};
use lensbake_interactive::state::{NamedTable, State};
use lensbake_interactive::title;
use lensbake_program::message;
use lensbake_render::gpu::{Gpu, Pass, Renderer};
use lensbake_render::sky::{self, Sky, SkyError, SkySource};
use lensbake_render::stars::StarField;
use pollster::block_on;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::dpi::LogicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::{Fullscreen, Window};

/// Initial state of the window, checked; its sky and stars may still be in the making.
pub struct Start {
    /// Settings and table.
    pub state: State,
    /// Size of the window in logical pixels.
    pub size: [u32; 2],
    /// Whether the window fills the screen.
    pub fullscreen: bool,
    /// The kind of passes that draw the picture; `None` for the device's default.
    pub pass: Option<Pass>,
    /// The sky.
    pub sky: Coming<Result<Sky, SkyError>>,
    /// Source of the sky.
    pub source: SkySource,
    /// The stars.
    pub stars: Coming<StarField>,
    /// Whether the stars are drawn in front of every sky, not only of the sky `stars`.
    pub stars_everywhere: bool,
    /// A path of the camera, which plays at once.
    pub path: Option<FlightPath>,
}

/// The window while it is open.
pub struct OpenWindow {
    window: Arc<Window>,
    session: Session,
    panel: Panel,
    proxy: EventLoopProxy<AppEvent>,
    input: WindowInput,
    /// When the window was opened.
    opened: Instant,
    title: String,
    pace: Pace,
}

impl OpenWindow {
    /// Opens the window.
    ///
    /// # Errors
    /// [`WindowError`] if the window cannot be created, or no GPU can draw to it.
    pub fn new(
        events: &ActiveEventLoop,
        start: Start,
        proxy: EventLoopProxy<AppEvent>,
    ) -> Result<Self, WindowError> {
        let [width, height] = start.size;
        let attributes = Window::default_attributes()
            .with_title("lensbake")
            .with_inner_size(LogicalSize::new(width, height))
            .with_fullscreen(start.fullscreen.then_some(Fullscreen::Borderless(None)));
        let window = events
            .create_window(attributes)
            .map_err(|e| WindowError::no_screen(&e))?;
        let window = Arc::new(window);
        let (gpu, surface) = block_on(Gpu::open_for(window.clone()))?;
        let renderer = match start.pass {
            Some(pass) => Renderer::with_pass(&gpu, pass),
            None => Renderer::new(&gpu),
        };
        let size = window.inner_size();
        let size = [size.width, size.height];
        let sky = start.sky.wait()?;
        let (stage, on_device) = block_on(Stage::new(renderer, surface, size, &sky))?;
        drop(sky);
        let panel = Panel::new(&window, stage.gpu(), stage.format());
        let mut session = Session::new(start.state, stage, start.source, on_device);
        session.stars_everywhere = start.stars_everywhere;
        session.set_stars(start.stars.wait());
        window.request_redraw();
        let mut open = OpenWindow {
            window,
            session,
            panel,
            proxy,
            input: WindowInput::default(),
            opened: Instant::now(),
            title: String::new(),
            pace: Pace::default(),
        };
        if let Some(path) = start.path {
            open.take_path(path, "the path");
        }
        Ok(open)
    }

    /// When the next frame is due, if one is.
    pub fn next_frame(&self) -> Option<Instant> {
        self.pace.next()
    }

    /// Requests a redraw.
    pub fn redraw(&self) {
        self.window.request_redraw();
    }

    /// Handles an event.
    ///
    /// # Errors
    /// [`WindowError`] if a frame cannot be drawn.
    pub fn event(
        &mut self,
        events: &ActiveEventLoop,
        event: WindowEvent,
    ) -> Result<(), WindowError> {
        if event == WindowEvent::RedrawRequested {
            return self.frame();
        }
        if self.panel.takes(&self.window, &event) {
            return Ok(());
        }
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => self.redraw(),
            WindowEvent::DroppedFile(path) => {
                self.panel.say(format!("reading {} …", path.display()));
                files::read(path, self.proxy.clone());
                self.redraw();
            }
            event => {
                let width = self.window.inner_size().width;
                let now = self.opened.elapsed();
                match self
                    .input
                    .take(&event, &mut self.session.state.settings, width, now)
                {
                    Reaction::None => (),
                    Reaction::Changed => self.redraw(),
                    Reaction::Command(command) => {
                        self.obey(events, command)?;
                        self.redraw();
                    }
                }
            }
        }
        Ok(())
    }

    /// Handles the result of a thread.
    pub fn app_event(&mut self, app_event: AppEvent) {
        match app_event {
            AppEvent::Sky(source, Ok(sky)) => self.take_sky(&source, &sky),
            AppEvent::Sky(_, Err(error)) => self.refuse(error.to_string()),
            AppEvent::Table(path, table) => {
                let table = NamedTable::new(*table, path.display().to_string());
                match self.session.state.take_table(table) {
                    Ok(said) => {
                        self.panel.say(said);
                    }
                    Err(refusal) => self.refuse(refusal.to_string()),
                }
            }
            AppEvent::Path(file, path) => self.take_path(path, &file.display().to_string()),
            AppEvent::Refused(why) => self.refuse(why),
        }
        self.redraw();
    }

    fn obey(&mut self, events: &ActiveEventLoop, command: Command) -> Result<(), WindowError> {
        match command {
            Command::NextSky => self.look_at_sky(self.session.skies().next()),
            Command::Reset => self.reset(),
            Command::ToggleFullscreen => self.toggle_fullscreen(),
            Command::Screenshot => self.screenshot()?,
            Command::SetKeyframe
            | Command::TakeKeyframeBack
            | Command::PlayPath
            | Command::SavePath => self.obey_path(command),
            Command::Leave if self.session.state.settings.help => {
                self.session.state.settings.help = false
            }
            Command::Leave if self.window.fullscreen().is_some() => self.toggle_fullscreen(),
            Command::Leave => events.exit(),
        }
        Ok(())
    }

    fn reset(&mut self) {
        if let Some(said) = self.session.state.reset() {
            self.panel.say(said);
        }
    }

    fn toggle_fullscreen(&self) {
        let next = match self.window.fullscreen() {
            Some(_) => None,
            None => Some(Fullscreen::Borderless(None)),
        };
        self.window.set_fullscreen(next);
    }

    fn screenshot(&mut self) -> Result<(), WindowError> {
        self.settle();
        let Some(plan) = self.plan()? else {
            return Ok(());
        };
        let screenshot = self.session.stage.screenshot(&plan);
        let pixels = block_on(screenshot.read())?;
        match saved::screenshot(screenshot.size(), &pixels) {
            Ok(path) => {
                self.panel.say(format!("wrote {}", path.display()));
            }
            Err(error) => self.refuse(error.to_string()),
        }
        Ok(())
    }

    /// Runs a command of the path of the camera.
    fn obey_path(&mut self, command: Command) {
        match path::obey(&mut self.session, command) {
            Ok(said) => {
                self.panel.say(said);
            }
            Err(error) => self.refuse(error.to_string()),
        }
    }

    /// Replaces the path of the camera and plays it.
    fn take_path(&mut self, path: FlightPath, name: &str) {
        match self.session.recording.take(path) {
            Ok(said) => {
                self.panel.say(said);
            }
            Err(problem) => self.refuse(format!("{name}: {problem}")),
        }
    }

    /// Uploads a sky, and shows it if the user dropped it or still has it selected.
    fn take_sky(&mut self, source: &SkySource, sky: &Sky) {
        let on_device = match block_on(self.session.stage.renderer().upload_sky(sky)) {
            Ok(on_device) => on_device,
            Err(error) => return self.refuse(format!("{}: {error}", source.name())),
        };
        if self.session.keep_sky(source, on_device) {
            self.panel.say(format!("sky: {}", source.name()));
        }
    }

    /// Shows a sky. A thread loads it first if it was never shown, so that the window does not freeze.
    fn look_at_sky(&mut self, index: usize) {
        let selected = self.session.select_sky(index);
        if matches!(selected, Selected::Ready(_)) {
            return;
        }
        let name = self.session.skies().name();
        self.panel.say(format!("making the sky {name} …"));
        if let Selected::Load(source) = selected {
            let proxy = self.proxy.clone();
            std::thread::spawn(move || {
                let sky = sky::load(&source).map(Box::new);
                // The window may have closed meanwhile.
                let _ = proxy.send_event(AppEvent::Sky(source, sky));
            });
        }
    }

    fn refuse(&mut self, why: String) {
        message!("viewer: {why}");
        self.panel.say(why);
    }

    /// Keeps the settings that can be drawn and reverts the others; true if that gives a new message.
    fn settle(&mut self) -> bool {
        let refused = self.session.state.settle();
        refused.is_some_and(|why| self.panel.say(why))
    }

    fn frame(&mut self) -> Result<(), WindowError> {
        let now = Instant::now();
        let moving = self.advance(now);
        self.settle();
        let Some(plan) = self.plan()? else {
            self.session.pause();
            return Ok(());
        };
        self.update_title();
        let facts = self.session.info(&plan);
        let drawn = self.session.state.settings.clone();
        let size = [plan.window.width, plan.window.height];
        let settings = &mut self.session.state.settings;
        let (mut paint, action, again) = self.panel.lay_out(&self.window, size, settings, &facts);
        paint.upload(self.session.stage.gpu());
        let frame = self.session.stage.draw(&plan, &mut paint);
        paint.finish();
        let presented = self.present(frame?)?;
        self.apply_panel_action(action);
        let said = self.settle();
        self.session.record_gpu_times();
        self.notice_lost_stars(now - self.opened);
        let left = match presented {
            false => AfterFrame::NotShown,
            true if moving || said || self.session.state.settings != drawn => AfterFrame::Moving,
            // Waiting for the GPU's report does not draw the picture again.
            true if self.session.stage.awaits_star_light() => AfterFrame::Awaiting(again),
            true => AfterFrame::Idle(again),
        };
        self.pace.end(now, left, &self.window);
        Ok(())
    }

    /// Shows a frame; false if there is none to show.
    fn present(&mut self, frame: Frame) -> Result<bool, WindowError> {
        match frame {
            Frame::Drawn(frame) => {
                self.window.pre_present_notify();
                self.session.stage.present(frame);
                // A window may have been resized while its frame was drawn.
                if self
                    .size()
                    .is_some_and(|size| size != self.session.stage.size())
                {
                    self.redraw();
                }
                return Ok(true);
            }
            Frame::Skipped => (),
            Frame::Outdated => self.redraw(),
            Frame::Lost => {
                let surface = self.session.stage.gpu().surface(self.window.clone())?;
                self.session.stage.replace_surface(surface);
                self.redraw();
            }
        }
        Ok(false)
    }

    /// Size of the window in pixels, limited to what can be drawn; `None` if it has no pixels.
    fn size(&self) -> Option<[u32; 2]> {
        let size = self.window.inner_size();
        drawable_size(self.session.stage.gpu(), [size.width, size.height])
    }

    /// Moves the camera by the time since the last frame; true if something keeps moving.
    fn advance(&mut self, now: Instant) -> bool {
        self.pace.begin();
        let input = self.input.as_mut();
        let (moving, said) = self.session.advance(input, now - self.opened);
        if let Some(said) = said {
            self.panel.say(said);
        }
        moving
    }

    fn plan(&mut self) -> Result<Option<Plan>, WindowError> {
        let size = self.window.inner_size();
        Ok(self.session.plan([size.width, size.height], false)?)
    }

    fn apply_panel_action(&mut self, action: PanelAction) {
        if let Some(index) = action.sky {
            self.look_at_sky(index);
            self.redraw();
        }
        if action.reset {
            self.reset();
            self.redraw();
        }
        if let Some(command) = action.path {
            self.obey_path(command);
            self.redraw();
        }
    }

    fn notice_lost_stars(&mut self, now: Duration) {
        if let Some(notice) = self.session.lost_stars(now) {
            let way_out = "start again with a lower --star-exposure or fewer stars";
            self.refuse(format!("{notice}; {way_out}"));
            self.redraw();
        }
    }

    /// Updates the title bar.
    fn update_title(&mut self) {
        let title = title::title(&self.session.skies().name(), &self.session.state.settings);
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }
}
