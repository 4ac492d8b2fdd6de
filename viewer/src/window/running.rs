//! The open window: what its events come to, and its frames.

use super::app::{Arrival, Start};
use super::controls::{Facts, Wish};
use super::input::{Input, Reaction};
use super::keys::Command;
use super::meter::Meter;
use super::motion::{self, ORBIT_DEG_PER_S};
use super::pace::{Left, Pace};
use super::panel::Panel;
use super::plan::{Plan, scaled};
use super::resolution::{AutoScale, Resolution};
use super::skies::Skies;
use super::stage::{Shown, Stage};
use super::star_notice::StarNotice;
use super::state::{NamedTable, State};
use super::{WindowError, files, screenshot, title};
use crate::model::Precision;
use crate::sky::{Sky, SkySource};
use crate::stars::StarField;
use lensbake_report::message;
use std::sync::Arc;
use std::time::Instant;
use winit::dpi::LogicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::{Fullscreen, Window};

/// The window while it is open.
pub struct Running {
    window: Arc<Window>,
    stage: Stage,
    panel: Panel,
    skies: Skies,
    stars: StarField,
    stars_everywhere: bool,
    stars_shown: bool,
    star_notice: StarNotice,
    proxy: EventLoopProxy<Arrival>,
    state: State,
    input: Input,
    auto: AutoScale,
    title: String,
    pictures: Meter,
    frames: Meter,
    pace: Pace,
}

impl Running {
    /// Opens the window.
    ///
    /// # Errors
    /// [`WindowError`] if there is no window, or no GPU for it.
    pub fn new(
        events: &ActiveEventLoop,
        start: Start,
        proxy: EventLoopProxy<Arrival>,
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
        let row = state.plan([1, 1], 1.0)?.scene.row;
        let (stage, on_device) = Stage::new(window.clone(), &start.sky, &row, state.settings.step)?;
        let panel = Panel::new(&window, stage.gpu(), stage.format());
        window.request_redraw();
        let mut running = Running {
            skies: Skies::new(start.source, on_device, proxy.clone()),
            stars: start.stars,
            stars_everywhere: start.stars_everywhere,
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
        running.show_stars();
        Ok(running)
    }

    /// When the next frame is due, if one is.
    pub fn next_frame(&self) -> Option<Instant> {
        self.pace.next()
    }

    /// Asks for a frame.
    pub fn redraw(&self) {
        self.window.request_redraw();
    }

    /// Takes an event.
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

    /// Takes what a thread brings.
    pub fn arrival(&mut self, arrival: Arrival) {
        match arrival {
            Arrival::Sky(source, Ok(sky)) => self.take_sky(&source, &sky),
            Arrival::Sky(_, Err(error)) => self.refuse(error.to_string()),
            Arrival::Table(path, table) => {
                let table = NamedTable::new(*table, path.display().to_string());
                match self.state.take_table(table) {
                    Ok(said) => {
                        self.panel.say(said);
                    }
                    Err(refusal) => self.refuse(refusal.to_string()),
                }
            }
            Arrival::Refused(why) => self.refuse(why),
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

    /// Puts a sky on the device, and looks at it if it was brought or is still wanted.
    fn take_sky(&mut self, source: &SkySource, sky: &Sky) {
        let on_device = match self.stage.upload(sky) {
            Ok(on_device) => on_device,
            Err(error) => return self.refuse(format!("{}: {error}", source.name())),
        };
        let index = self.skies.keep(source.clone(), on_device);
        // What the user brought is looked at now; a built-in sky only if it still is.
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

    /// Puts the stars before the sky, or takes them away.
    fn show_stars(&mut self) {
        let wanted = self.stars_everywhere || self.skies.is_stars();
        if wanted != self.stars_shown {
            self.stage.set_stars(wanted.then_some(&self.stars));
            self.stars_shown = wanted;
        }
    }

    fn refuse(&mut self, why: String) {
        message!("viewer: {why}");
        self.panel.say(why);
    }

    /// Takes over what of the settings can be drawn; true if there is something new to say of the rest.
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
        self.name_window();
        let facts = self.facts(&plan);
        let drawn = self.state.settings.clone();
        let size = [plan.window.width, plan.window.height];
        let settings = &mut self.state.settings;
        let (mut paint, wish, again) = self.panel.lay_out(&self.window, size, settings, &facts);
        let shown = self.stage.show(&plan, &mut paint)?;
        self.fulfil(wish);
        let said = self.settle();
        self.learn();
        self.notice_lost_stars(now);
        let left = match shown {
            Shown::NotNow => Left::NotShown,
            Shown::Yes if moving || said || self.state.settings != drawn => Left::Unrest,
            // The picture is not drawn again for this.
            Shown::Yes if self.stage.awaits_star_light() => Left::Awaiting(again),
            Shown::Yes => Left::Rest(again),
        };
        self.pace.end(now, left, &self.window);
        Ok(())
    }

    /// Moves by the time since the last frame; true if something moves on.
    fn advance(&mut self, now: Instant) -> bool {
        let settings = &mut self.state.settings;
        let held = self.input.steer(&mut settings.view, now);
        let speed = settings.orbit_speed();
        let moving = held || speed != 0.0;
        let since = self.pace.begin(now, moving);
        let right = speed * ORBIT_DEG_PER_S * since.as_secs_f64();
        motion::orbit(&mut settings.view, right, 0.0);
        moving
    }

    /// What the next frame draws; nothing while there is no window to draw on.
    fn plan(&mut self) -> Result<Option<Plan>, WindowError> {
        let Some(window) = self.stage.fit() else {
            return Ok(None);
        };
        let scale = self.state.settings.resolution.scale(&self.auto);
        let scale = self.stage.fitting(scale);
        // The room for a scale that changes stays the same: no frame makes a texture.
        self.stage.set_room(scaled(window, scale.max(1.0)));
        let plan = self.state.plan(window, scale)?;
        self.stage.set_row_shape(&plan.scene.row);
        Ok(Some(plan))
    }

    fn fulfil(&mut self, wish: Wish) {
        if let Some(index) = wish.sky {
            self.look_at_sky(index);
            self.redraw();
        }
        if wish.reset {
            self.reset();
            self.redraw();
        }
    }

    /// Takes in what the frames before have cost.
    fn learn(&mut self) {
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

    fn facts(&self, plan: &Plan) -> Facts {
        let table = self.state.table();
        let measured = table.table().header().measured;
        Facts {
            skies: (self.skies.names().collect(), self.skies.shown()),
            interval: self.pace.interval(),
            picture_time: self.pictures.mean(),
            frame_time: self.frames.mean(),
            picture: plan.picture(),
            table: table.short_name(),
            table_error: (measured.rays > 0).then_some(measured.max_error),
            rounding_px: Precision::F32.rounding_px(&plan.window),
            held_radius: self.state.held_radius(),
            adapter: self.stage.gpu().name(),
        }
    }

    /// Says in the title bar what is seen.
    fn name_window(&mut self) {
        let title = title::title(&self.skies.name(), &self.state.settings);
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }
}
