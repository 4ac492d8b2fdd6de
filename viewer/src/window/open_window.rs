//! The open window: handles its events and draws its frames.

use super::controls::PanelAction;
use super::event::AppEvent;
use super::input::{Input, Reaction};
use super::keys::Command;
use super::meter::Meter;
use super::pace::{AfterFrame, Pace};
use super::panel::Panel;
use super::panel_info::PanelInfo;
use super::plan::{Plan, scaled};
use super::resolution::{AutoScale, Resolution};
use super::skies::Skies;
use super::stage::{Shown, Stage};
use super::star_notice::StarNotice;
use super::state::{NamedTable, State};
use super::{WindowError, files, screenshot, title};
use lensbake_program::message;
use lensbake_render::gpu::{Pass, StarsOnDevice};
use lensbake_render::model::Precision;
use lensbake_render::sky::{Sky, SkySource};
use lensbake_render::stars::StarField;
use std::sync::Arc;
use std::time::Instant;
use winit::dpi::LogicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::{Fullscreen, Window};

/// Initial state of the window, checked and with its sky loaded.
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
    pub sky: Sky,
    /// Source of the sky.
    pub source: SkySource,
    /// The stars.
    pub stars: StarField,
    /// Whether the stars are drawn in front of every sky, not only of the sky `stars`.
    pub stars_everywhere: bool,
}

/// The window while it is open.
pub struct OpenWindow {
    window: Arc<Window>,
    stage: Stage,
    panel: Panel,
    skies: Skies,
    stars: StarField,
    stars_everywhere: bool,
    stars_on_device: Option<StarsOnDevice>,
    stars_shown: bool,
    star_notice: StarNotice,
    proxy: EventLoopProxy<AppEvent>,
    state: State,
    input: Input,
    auto: AutoScale,
    title: String,
    pictures: Meter,
    frames: Meter,
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
        let state = start.state;
        let (stage, on_device) = Stage::new(window.clone(), &start.sky, start.pass)?;
        let panel = Panel::new(&window, stage.gpu(), stage.format());
        window.request_redraw();
        let mut open = OpenWindow {
            skies: Skies::new(start.source, on_device, proxy.clone()),
            stars: start.stars,
            stars_everywhere: start.stars_everywhere,
            stars_on_device: None,
            stars_shown: false,
            star_notice: StarNotice::default(),
            window,
            stage,
            panel,
            proxy,
            state,
            input: Input::default(),
            auto: AutoScale::default(),
            title: String::new(),
            pictures: Meter::default(),
            frames: Meter::default(),
            pace: Pace::default(),
        };
        open.show_stars();
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
                match self.input.take(&event, &mut self.state.settings, width) {
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
                match self.state.take_table(table) {
                    Ok(said) => {
                        self.panel.say(said);
                    }
                    Err(refusal) => self.refuse(refusal.to_string()),
                }
            }
            AppEvent::Refused(why) => self.refuse(why),
        }
        self.redraw();
    }

    fn obey(&mut self, events: &ActiveEventLoop, command: Command) -> Result<(), WindowError> {
        match command {
            Command::NextSky => self.look_at_sky(self.skies.next()),
            Command::Reset => self.reset(),
            Command::ToggleFullscreen => self.toggle_fullscreen(),
            Command::Screenshot => self.screenshot()?,
            Command::Leave if self.state.settings.help => self.state.settings.help = false,
            Command::Leave if self.window.fullscreen().is_some() => self.toggle_fullscreen(),
            Command::Leave => events.exit(),
        }
        Ok(())
    }

    fn reset(&mut self) {
        if let Some(said) = self.state.reset() {
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
        let pixels = self.stage.screenshot(&plan)?;
        let size = [plan.window.width, plan.window.height];
        match screenshot::write(size, &pixels) {
            Ok(path) => {
                self.panel.say(format!("wrote {}", path.display()));
            }
            Err(error) => self.refuse(error.to_string()),
        }
        Ok(())
    }

    /// Uploads a sky, and shows it if the user dropped it or still has it selected.
    fn take_sky(&mut self, source: &SkySource, sky: &Sky) {
        let on_device = match self.stage.upload_sky(sky) {
            Ok(on_device) => on_device,
            Err(error) => return self.refuse(format!("{}: {error}", source.name())),
        };
        let index = self.skies.keep(source.clone(), on_device);
        // A dropped sky is shown now; a built-in one only if it is still selected.
        if !source.is_built_in() || index == self.skies.shown() {
            self.look_at_sky(index);
            self.panel.say(format!("sky: {}", source.name()));
        }
    }

    fn look_at_sky(&mut self, index: usize) {
        match self.skies.choose(index) {
            Some(sky) => {
                self.stage.set_sky(&sky);
                self.show_stars();
            }
            None => {
                let name = self.skies.name();
                self.panel.say(format!("making the sky {name} …"));
            }
        }
    }

    /// Shows or hides the stars, depending on the sky.
    fn show_stars(&mut self) {
        let wanted = self.stars_everywhere || self.skies.is_stars();
        if wanted != self.stars_shown {
            let upload = || self.stage.upload_stars(&self.stars);
            let stars = wanted.then(|| self.stars_on_device.get_or_insert_with(upload).clone());
            self.stage.set_stars(stars);
            self.stars_shown = wanted;
        }
    }

    fn refuse(&mut self, why: String) {
        message!("viewer: {why}");
        self.panel.say(why);
    }

    /// Keeps the settings that can be drawn and reverts the others; true if that gives a new message.
    fn settle(&mut self) -> bool {
        let refused = self.state.settle();
        refused.is_some_and(|why| self.panel.say(why))
    }

    fn frame(&mut self) -> Result<(), WindowError> {
        let now = Instant::now();
        let moving = self.advance(now);
        self.settle();
        let Some(plan) = self.plan()? else {
            return Ok(());
        };
        self.update_title();
        let facts = self.facts(&plan);
        let drawn = self.state.settings.clone();
        let size = [plan.window.width, plan.window.height];
        let settings = &mut self.state.settings;
        let (mut paint, action, again) = self.panel.lay_out(&self.window, size, settings, &facts);
        let shown = self.stage.show(&plan, &mut paint)?;
        self.apply_panel_action(action);
        let said = self.settle();
        self.record_gpu_times();
        self.notice_lost_stars(now);
        let left = match shown {
            Shown::Skipped => AfterFrame::NotShown,
            Shown::Presented if moving || said || self.state.settings != drawn => {
                AfterFrame::Moving
            }
            // Waiting for the GPU's report does not draw the picture again.
            Shown::Presented if self.stage.awaits_star_light() => AfterFrame::Awaiting(again),
            Shown::Presented => AfterFrame::Idle(again),
        };
        self.pace.end(now, left, &self.window);
        Ok(())
    }

    /// Moves the camera by the time since the last frame; true if something keeps moving.
    fn advance(&mut self, now: Instant) -> bool {
        let settings = &mut self.state.settings;
        let held = self.input.steer(&mut settings.view, now);
        let moving = held || settings.moves();
        let since = self.pace.begin(now, moving);
        if let Some(said) = settings.advance(since.as_secs_f64()) {
            self.panel.say(said);
        }
        moving
    }

    /// The plan of the next frame; `None` while the window has no pixels.
    fn plan(&mut self) -> Result<Option<Plan>, WindowError> {
        let Some(window) = self.stage.fit() else {
            return Ok(None);
        };
        let scale = self.state.settings.resolution.scale(&self.auto);
        let scale = self.stage.fitting(scale);
        // The textures have room for the whole window, so that dynamic resolution does not reallocate them.
        self.stage.set_room(scaled(window, scale.max(1.0)));
        let plan = self.state.plan(window, scale)?;
        Ok(Some(plan))
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
    }

    /// Records the GPU times of earlier frames, for the panel and for the dynamic resolution.
    fn record_gpu_times(&mut self) {
        for lap in self.stage.laps() {
            self.pictures.add(lap.picture);
            self.frames.add(lap.frame);
            let settings = &self.state.settings;
            if settings.resolution == Resolution::Auto {
                self.auto.learn(lap.frame, settings.target());
            }
        }
    }

    fn notice_lost_stars(&mut self, now: Instant) {
        let light = self.stage.star_light();
        if let Some(notice) = light.and_then(|light| self.star_notice.of(light, now)) {
            self.refuse(notice.into());
            self.redraw();
        }
    }

    fn facts(&self, plan: &Plan) -> PanelInfo {
        let table = self.state.table();
        PanelInfo {
            skies: (self.skies.names().collect(), self.skies.shown()),
            interval: self.pace.interval(),
            picture_time: self.pictures.mean(),
            frame_time: self.frames.mean(),
            picture: plan.picture(),
            table: table.short_name(),
            table_error: table.error_at(self.state.settings.view.radius),
            rounding_px: Precision::F32.rounding_px(&plan.window),
            held_radius: self.state.held_radius(),
            adapter: self.stage.gpu().name(),
        }
    }

    /// Updates the title bar.
    fn update_title(&mut self) {
        let title = title::title(&self.skies.name(), &self.state.settings);
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }
}
