//! A session: the state, the skies and the stars to choose from, and the stage that draws them.

use crate::frame_clock::FrameClock;
use crate::input::Input;
use crate::keys::Command;
use crate::meter::Meter;
use crate::panel_info::PanelInfo;
use crate::plan::{Plan, scaled};
use crate::recording::Recording;
use crate::resolution::{AutoScale, Resolution};
use crate::skies::{Selected, Skies};
use crate::stage::Stage;
use crate::star_notice::StarNotice;
use crate::state::{Refusal, State};
use lensbake_render::gpu::{SkyOnDevice, StarsOnDevice};
use lensbake_render::model::Precision;
use lensbake_render::sky::SkySource;
use lensbake_render::stars::StarField;
use std::time::Duration;

/// What is shown, and what it is drawn with.
pub struct Session {
    /// Settings and table.
    pub state: State,
    /// The surface and its frames.
    pub stage: Stage,
    /// Whether the stars are drawn in front of every sky, not only of the sky `stars`.
    pub stars_everywhere: bool,
    /// The scale of the automatic resolution.
    pub auto: AutoScale,
    /// The path of the camera.
    pub recording: Recording,
    skies: Skies,
    stars: Option<StarField>,
    stars_on_device: Option<StarsOnDevice>,
    stars_shown: bool,
    star_notice: StarNotice,
    clock: FrameClock,
    pictures: Meter,
    frames: Meter,
}

impl Session {
    /// A session that shows the sky `source`, which is on the device as `sky`.
    pub fn new(state: State, stage: Stage, source: SkySource, sky: SkyOnDevice) -> Self {
        Session {
            state,
            stage,
            stars_everywhere: false,
            auto: AutoScale::default(),
            recording: Recording::default(),
            skies: Skies::new(source, sky),
            stars: None,
            stars_on_device: None,
            stars_shown: false,
            star_notice: StarNotice::default(),
            clock: FrameClock::default(),
            pictures: Meter::default(),
            frames: Meter::default(),
        }
    }

    /// The skies to choose from.
    pub fn skies(&self) -> &Skies {
        &self.skies
    }

    /// Selects a sky, and shows it if it is on the device.
    pub fn select_sky(&mut self, index: usize) -> Selected {
        let selected = self.skies.select(index);
        if let Selected::Ready(sky) = &selected {
            self.stage.set_sky(sky);
            self.show_stars();
        }
        selected
    }

    /// Keeps a sky that is on the device now. Shows it, and returns true, if the user dropped it or still has it
    /// selected.
    pub fn keep_sky(&mut self, source: &SkySource, sky: SkyOnDevice) -> bool {
        let index = self.skies.keep(source.clone(), sky);
        let shown = !source.is_built_in() || index == self.skies.shown();
        if shown {
            self.select_sky(index);
        }
        shown
    }

    /// As [`Skies::forget`].
    pub fn forget_sky(&mut self, source: &SkySource) {
        self.skies.forget(source);
    }

    /// Whether stars are to be drawn in front of the selected sky.
    pub fn wants_stars(&self) -> bool {
        self.stars_everywhere || self.skies.is_stars()
    }

    /// Whether there are stars to draw.
    pub fn has_stars(&self) -> bool {
        self.stars.is_some()
    }

    /// Sets the stars to draw.
    pub fn set_stars(&mut self, stars: StarField) {
        self.stars = Some(stars);
        self.stars_on_device = None;
        self.stars_shown = false;
        self.show_stars();
    }

    /// Shows or hides the stars, depending on the sky. They are uploaded when they are first shown.
    pub fn show_stars(&mut self) {
        let wanted = self.wants_stars() && self.has_stars();
        if wanted == self.stars_shown {
            return;
        }
        if let (true, None, Some(stars)) = (wanted, &self.stars_on_device, &self.stars) {
            self.stars_on_device = Some(self.stage.upload_stars(stars));
        }
        let stars = self.stars_on_device.clone().filter(|_| wanted);
        self.stage.set_stars(stars);
        self.stars_shown = wanted;
    }

    /// Moves the camera at the beginning of a frame, by the keys that `input` holds and by itself, for the time since the
    /// last frame. Returns whether something keeps moving, and a message if there is one.
    pub fn advance(&mut self, input: &mut Input, now: Duration) -> (bool, Option<String>) {
        let settings = &mut self.state.settings;
        let held = input.steer(&mut settings.view, now);
        let moving = held || settings.moves() || self.recording.plays();
        let seconds = self.clock.begin(now, moving).as_secs_f64();
        let plays = self.recording.plays();
        let said = self.recording.advance(settings, seconds);
        let said = match plays {
            true => said,
            false => settings.advance(seconds),
        };
        (moving, said)
    }

    /// Runs a command of the path of the camera, apart from saving it. Returns a message, `None` for other commands.
    pub fn obey_path(&mut self, command: Command) -> Option<String> {
        let recording = &mut self.recording;
        match command {
            Command::SetKeyframe => {
                let set = recording.set_keyframe(&self.state.settings);
                Some(set.unwrap_or_else(|problem| problem))
            }
            Command::TakeKeyframeBack => Some(recording.take_back()),
            Command::PlayPath => Some(recording.play_or_stop()),
            _ => None,
        }
    }

    /// Whether something moved in the last frame.
    pub fn moves(&self) -> bool {
        self.clock.runs()
    }

    /// Lets no time pass until the next frame, after a pause in which none were drawn.
    pub fn pause(&mut self) {
        self.clock.pause();
    }

    /// The plan of the next frame, for a window of this size in pixels; `None` if it has no pixels. With `at_rest` the
    /// automatic resolution is the window's.
    ///
    /// # Errors
    /// [`Refusal`] if the settings cannot be drawn at this size.
    pub fn plan(&mut self, size: [u32; 2], at_rest: bool) -> Result<Option<Plan>, Refusal> {
        let Some(window) = self.stage.fit(size) else {
            return Ok(None);
        };
        let scale = match self.state.settings.resolution {
            Resolution::Auto if at_rest => 1.0,
            resolution => resolution.scale(&self.auto),
        };
        let scale = self.stage.fitting(scale);
        // The textures have room for the whole window, so that dynamic resolution does not reallocate them.
        self.stage.set_room(scaled(window, scale.max(1.0)));
        self.state.plan(window, scale).map(Some)
    }

    /// Records the GPU times of earlier frames, for the panel and for the automatic resolution.
    pub fn record_gpu_times(&mut self) {
        for lap in self.stage.laps() {
            self.pictures.add(lap.picture);
            self.frames.add(lap.frame);
            let settings = &self.state.settings;
            if settings.resolution == Resolution::Auto {
                self.auto.learn(lap.frame, settings.target());
            }
        }
    }

    /// The notice to show at the time `now` if stars are missing in the picture, once while they are.
    pub fn lost_stars(&mut self, now: Duration) -> Option<&'static str> {
        let light = self.stage.star_light();
        light.and_then(|light| self.star_notice.of(light, now))
    }

    /// What the panel shows about a frame.
    pub fn info(&self, plan: &Plan) -> PanelInfo {
        let table = self.state.table();
        PanelInfo {
            skies: (self.skies.names().collect(), self.skies.shown()),
            interval: self.clock.interval(),
            picture_time: self.pictures.mean(),
            frame_time: self.frames.mean(),
            picture: plan.picture(),
            table: table.short_name(),
            table_error: table.error_at(self.state.settings.view.radius),
            rounding_px: Precision::F32.rounding_px(&plan.window),
            path: (self.recording.summary(), self.recording.plays()),
            held_radius: self.state.held_radius(),
            adapter: self.stage.gpu().name(),
        }
    }
}
