//! The settings, by their names, and what the panel shows of them.

use super::{Viewer, error};
use crate::panel;
use crate::sky_texels::built_in;
use lensbake_interactive::panel_info::PanelInfo;
use lensbake_interactive::parameters::{ParameterError, switch, switch_name};
use lensbake_render::sky::SkySource;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// The value of a setting, or nothing if there is no such setting.
    pub fn get(&self, name: &str) -> Option<String> {
        match name {
            "sky" => Some(self.session.skies().name()),
            "stars" => Some(switch_name(self.session.stars_everywhere)),
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
                self.session.stars_everywhere = switch(text)
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
        let changed = settings.changed_parameters(self.session.state.start());
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

    /// What the panel shows, as JSON.
    pub fn panel(&self) -> String {
        let info = self.drawn.as_ref().map(|plan| {
            let info = self.session.info(plan);
            PanelInfo {
                interval: info.interval.filter(|_| self.session.moves()),
                ..info
            }
        });
        panel::json(&self.session.state.settings, info.as_ref()).to_string()
    }

    /// Resets the settings to the start.
    pub fn reset(&mut self) {
        if let Some(said) = self.session.state.reset() {
            self.say(said);
        }
    }

    /// Starts the free fall; pauses it, resumes it, or at its end restarts it.
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
}
