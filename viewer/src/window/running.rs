//! The open window: what its events come to, and its frames.

use super::app::{Arrival, Options};
use super::input::{Input, Reaction};
use super::keys::Command;
use super::meter::Meter;
use super::motion::{self, ORBIT_DEG_PER_S, ORBIT_SPEEDS};
use super::panel::{Facts, Panel, Wish};
use super::plan::{Plan, scaled};
use super::resolution::{AutoScale, Resolution};
use super::settings::{Comparison, Settings, next};
use super::skies::Skies;
use super::stage::{Shown, Stage};
use super::star_notice::StarNotice;
use super::{WindowError, files, screenshot};
use crate::sky::Sky;
use crate::stars::StarField;
use lensbake_tables::Table;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::dpi::LogicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::{Fullscreen, Window};

/// A day away: the panel's way to say that it need not be painted again.
const NEVER: Duration = Duration::from_secs(86_400);
/// When to try again to show a frame that could not be shown.
const RETRY: Duration = Duration::from_millis(100);
/// Frames a second where the screen does not say how many it shows.
const USUAL_REFRESH_HZ: f64 = 60.0;
/// Where vertical sync does not hold frames back, they are paced a little faster than the screen, so
/// that where it does, the pace is its own.
const PACE: f64 = 0.9;

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
    table: Table,
    table_name: String,
    at_start: Settings,
    settings: Settings,
    input: Input,
    auto: AutoScale,
    title: String,
    intervals: Meter,
    pictures: Meter,
    frames: Meter,
    last_frame: Option<Instant>,
    next_frame: Option<Instant>,
}

impl Running {
    /// Opens the window before `sky`.
    ///
    /// # Errors
    /// [`WindowError`] if there is no window, no GPU for it, or the table does not serve the camera.
    pub fn new(
        events: &ActiveEventLoop,
        options: Options,
        sky: &Sky,
        proxy: EventLoopProxy<Arrival>,
    ) -> Result<Self, WindowError> {
        let size = LogicalSize::new(options.view.width, options.view.height);
        let attributes = Window::default_attributes()
            .with_title("lensbake")
            .with_inner_size(size)
            .with_fullscreen(options.fullscreen.then_some(Fullscreen::Borderless(None)));
        let window = events
            .create_window(attributes)
            .map_err(|e| WindowError::no_screen(&e))?;
        let window = Arc::new(window);
        let settings = Settings::new(options.view, options.step);
        let row = super::row(&settings, &options.table, &options.table_name)?;
        let (stage, on_device) = Stage::new(window.clone(), sky, &row, options.step)?;
        let panel = Panel::new(&window, stage.gpu(), stage.format());
        window.request_redraw();
        let mut running = Running {
            skies: Skies::new(options.sky, on_device, proxy.clone()),
            stars: options.stars,
            stars_everywhere: options.stars_everywhere,
            stars_shown: false,
            star_notice: StarNotice::default(),
            window,
            stage,
            panel,
            proxy,
            table: options.table,
            table_name: options.table_name,
            at_start: settings.clone(),
            settings,
            input: Input::default(),
            auto: AutoScale::default(),
            title: String::new(),
            intervals: Meter::default(),
            pictures: Meter::default(),
            frames: Meter::default(),
            last_frame: None,
            next_frame: None,
        };
        running.show_stars();
        Ok(running)
    }

    /// When the next frame is due, if one is.
    pub fn next_frame(&self) -> Option<Instant> {
        self.next_frame
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
                match self.input.take(&event, &mut self.settings, width) {
                    Reaction::None => (),
                    Reaction::Changed => self.redraw(),
                    Reaction::Command(command) => {
                        // What was held before the command counts before it.
                        self.input.steer(&mut self.settings.view, Instant::now());
                        self.obey(events, command)?;
                        self.redraw();
                    }
                }
            }
        }
        Ok(())
    }

    /// Takes what a thread brings.
    ///
    /// # Errors
    /// [`WindowError::Gpu`] if a sky does not fit on the device.
    pub fn arrival(&mut self, arrival: Arrival) -> Result<(), WindowError> {
        match arrival {
            Arrival::Sky(source, Ok(sky)) => {
                let on_device = self.stage.upload(&sky)?;
                let index = self.skies.keep(source.clone(), on_device);
                // What the user brought is looked at now; a built-in sky only if it still is.
                if !source.is_built_in() || index == self.skies.shown() {
                    self.look_at_sky(index);
                    self.panel.say(format!("sky: {}", source.name()));
                }
            }
            Arrival::Sky(_, Err(error)) => self.refuse(error.to_string()),
            Arrival::Table(path, table) => self.take_table(&path, *table),
            Arrival::Refused(why) => self.refuse(why),
        }
        self.redraw();
        Ok(())
    }

    fn obey(&mut self, events: &ActiveEventLoop, command: Command) -> Result<(), WindowError> {
        let settings = &mut self.settings;
        match command {
            Command::NextSky => self.look_at_sky(self.skies.next()),
            Command::NextOrbitSpeed => {
                settings.orbit_speed = (settings.orbit_speed + 1) % ORBIT_SPEEDS.len();
            }
            Command::ToggleDeflection => settings.deflection ^= true,
            Command::ToggleFilter => settings.toggle_filter(),
            Command::NextComparison => {
                settings.comparison = next(&Comparison::ALL, settings.comparison);
            }
            Command::NextResolution => {
                settings.resolution = next(&Resolution::ALL, settings.resolution);
            }
            Command::ZoomIn => motion::zoom(&mut settings.view, 1.0),
            Command::ZoomOut => motion::zoom(&mut settings.view, -1.0),
            Command::MoreGain => settings.amplify(4.0),
            Command::LessGain => settings.amplify(0.25),
            Command::Reset => self.reset(),
            Command::ToggleFullscreen => self.toggle_fullscreen(),
            Command::Screenshot => self.screenshot()?,
            Command::TogglePanel => settings.panel ^= true,
            Command::ToggleHelp => settings.help ^= true,
            Command::Leave if settings.help => settings.help = false,
            Command::Leave if self.window.fullscreen().is_some() => self.toggle_fullscreen(),
            Command::Leave => events.exit(),
        }
        Ok(())
    }

    fn reset(&mut self) {
        self.settings = Settings {
            panel: self.settings.panel,
            help: self.settings.help,
            ..self.at_start.clone()
        };
    }

    fn toggle_fullscreen(&self) {
        let next = match self.window.fullscreen() {
            Some(_) => None,
            None => Some(Fullscreen::Borderless(None)),
        };
        self.window.set_fullscreen(next);
    }

    fn screenshot(&mut self) -> Result<(), WindowError> {
        let Some(plan) = self.plan() else {
            return Ok(());
        };
        let pixels = self.stage.screenshot(&plan)?;
        let size = [plan.window.width, plan.window.height];
        match screenshot::write(size, &pixels) {
            Ok(path) => self.panel.say(format!("wrote {}", path.display())),
            Err(error) => self.refuse(error.to_string()),
        }
        Ok(())
    }

    fn look_at_sky(&mut self, index: usize) {
        match self.skies.choose(index) {
            Some(sky) => {
                self.stage.set_sky(&sky);
                self.show_stars();
            }
            None => self
                .panel
                .say(format!("making the sky {} …", self.skies.name())),
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

    /// Draws with another table, if it serves this camera.
    fn take_table(&mut self, path: &Path, table: Table) {
        let name = PathBuf::from(path.file_name().unwrap_or(path.as_os_str()));
        match super::row(&self.settings, &table, &path.display().to_string()) {
            Err(error) => self.refuse(error.to_string()),
            Ok(row) => {
                self.stage.set_row_shape(&row);
                self.table = table;
                self.table_name = name.display().to_string();
                self.panel.say(format!("table: {}", path.display()));
            }
        }
    }

    fn refuse(&mut self, why: String) {
        eprintln!("viewer: {why}");
        self.panel.say(why);
    }

    fn frame(&mut self) -> Result<(), WindowError> {
        let now = Instant::now();
        let moving = self.advance(now);
        self.next_frame = None;
        let Some(plan) = self.plan() else {
            return Ok(());
        };
        self.name_window();
        let facts = self.facts(&plan);
        let before = self.settings.clone();
        let size = [plan.window.width, plan.window.height];
        let laid_out = self
            .panel
            .lay_out(&self.window, size, &mut self.settings, &facts);
        let (mut paint, wish, again) = laid_out;
        let shown = self.stage.show(&plan, &mut paint)?;
        self.fulfil(wish);
        self.learn();
        self.notice_lost_stars(now);
        let wait = match shown {
            // A covered or minimised window: look again now and then.
            Shown::NotNow => RETRY,
            Shown::Yes if moving || before != self.settings => Duration::ZERO,
            // The picture is not drawn again for this.
            Shown::Yes if self.stage.awaits_star_light() => RETRY.min(again),
            Shown::Yes => again,
        };
        self.next_frame = (wait < NEVER).then(|| now + wait.max(self.pace()));
        Ok(())
    }

    /// Moves by the time since the last frame; true if something moves on.
    fn advance(&mut self, now: Instant) -> bool {
        let held = self.input.steer(&mut self.settings.view, now);
        let speed = self.settings.orbit_speed();
        match self.last_frame {
            Some(last) => {
                let right = speed * ORBIT_DEG_PER_S * (now - last).as_secs_f64();
                motion::orbit(&mut self.settings.view, right, 0.0);
                self.intervals.add(now - last);
            }
            None => self.intervals.clear(),
        }
        let moving = held || speed != 0.0;
        self.last_frame = moving.then_some(now);
        moving
    }

    /// What the next frame draws; nothing while there is no window to draw on.
    fn plan(&mut self) -> Option<Plan> {
        let window = self.stage.fit()?;
        let scale = self
            .stage
            .fitting(self.settings.resolution.scale(&self.auto));
        // The room for a scale that changes stays the same: no frame makes a texture.
        self.stage.set_room(scaled(window, scale.max(1.0)));
        match Plan::new(&self.settings, &self.table, window, scale) {
            Ok(plan) => Some(plan),
            Err(problem) => {
                // A table of one row serves one radius.
                self.settings.view.radius = self.at_start.view.radius;
                self.panel.say(problem.to_string());
                Plan::new(&self.settings, &self.table, window, scale).ok()
            }
        }
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
            if self.settings.resolution == Resolution::Auto {
                self.auto.learn(lap.frame, self.settings.target());
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

    /// The least time from frame to frame.
    fn pace(&self) -> Duration {
        let monitor = self.window.current_monitor();
        let hz = monitor.and_then(|monitor| monitor.refresh_rate_millihertz());
        let hz = hz.map_or(USUAL_REFRESH_HZ, |millihertz| 1e-3 * f64::from(millihertz));
        Duration::from_secs_f64(PACE / hz.max(1.0))
    }

    fn facts(&self, plan: &Plan) -> Facts {
        Facts {
            skies: (self.skies.names().collect(), self.skies.shown()),
            interval: self.intervals.mean(),
            picture_time: self.pictures.mean(),
            frame_time: self.frames.mean(),
            picture: plan.picture(),
            table: self.table_name.clone(),
            table_error: self.table.header().measured.max_error,
            adapter: self.stage.gpu().name(),
        }
    }

    /// Says in the title bar what is seen.
    fn name_window(&mut self) {
        let settings = &self.settings;
        let who = match settings.deflection {
            true => settings.comparison.name(),
            false => "no deflection",
        };
        let title = format!(
            "lensbake – {} – {who} – r = {:.2} – orbit {}×",
            self.skies.name(),
            settings.view.radius,
            settings.orbit_speed(),
        );
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }
}
