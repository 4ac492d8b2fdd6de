//! Keys, pointer, wheel and touches.

use super::{Viewer, error, seconds};
use keyboard_types::Code;
use lensbake_film::{FlightPath, PathError};
use lensbake_interactive::input::{self, Button, KeyChange, Reaction};
use lensbake_interactive::keys::{self, BINDINGS, Command, MOUSE};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
impl Viewer {
    /// Handles a key by the name of its place, `KeyboardEvent.code`: `change` is `pressed`, `repeated` or `released`.
    /// Returns what the page has to do: `redraw`, `full-screen`, `screenshot`, `save-path` or `leave`; an empty text if there is nothing
    /// to do, and `None` if the key is not bound to anything.
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
            Reaction::Command(
                command @ (Command::SetKeyframe | Command::TakeKeyframeBack | Command::PlayPath),
            ) => {
                if let Some(said) = self.session.obey_path(command) {
                    self.say(said);
                }
                "redraw"
            }
            Reaction::Command(Command::SavePath) => "save-path",
            Reaction::Command(Command::ToggleFullscreen) => "full-screen",
            Reaction::Command(Command::Screenshot) => "screenshot",
            Reaction::Command(Command::Leave) => "leave",
        };
        Some(does.to_owned())
    }

    /// The path of the camera as JSON, as `viewer film` takes it; nothing before the first keyframe.
    #[wasm_bindgen(getter)]
    pub fn path(&self) -> Option<String> {
        let path = self.session.recording.path();
        (!path.keyframes.is_empty()).then(|| path.to_json())
    }

    /// Plays the path of the camera in the text of a file with this `name`.
    ///
    /// # Errors
    /// A line that names the file and the field that is wrong; then nothing changes.
    #[wasm_bindgen(js_name = takePath)]
    pub fn take_path(&mut self, name: &str, text: &str) -> Result<(), JsError> {
        let path: Result<FlightPath, PathError> = text.parse();
        let taken = path.and_then(|path| self.session.recording.take(path));
        let said = taken.map_err(|problem| error(format!("{name}: {problem}")))?;
        self.say(said);
        Ok(())
    }

    /// Takes back the path of the camera that another viewer had, its [`Viewer::path`], without playing it.
    ///
    /// # Errors
    /// If the text is not a path.
    #[wasm_bindgen(js_name = keepPath)]
    pub fn keep_path(&mut self, text: &str) -> Result<(), JsError> {
        let path: Result<FlightPath, PathError> = text.parse();
        self.session.recording.keep(path.map_err(error)?);
        Ok(())
    }

    /// The keys and what they do, and the same for the pointer: names and descriptions in turn.
    #[wasm_bindgen(js_name = keyBindings)]
    pub fn key_bindings() -> Vec<String> {
        let keys = BINDINGS.iter().map(|one| (one.names, one.does));
        let all = keys.chain(MOUSE.iter().copied());
        all.flat_map(|(names, does)| [names.to_owned(), does.to_owned()])
            .collect()
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
            .press(button, &self.session.state.settings, self.width());
    }

    /// The pointer is released.
    #[wasm_bindgen(js_name = pointerReleased)]
    pub fn pointer_released(&mut self) {
        self.input.release();
    }

    /// The pointer moves to a place in pixels; true if that changed something.
    #[wasm_bindgen(js_name = pointerMoved)]
    pub fn pointer_moved(&mut self, x: f64, y: f64) -> bool {
        let width = self.width();
        let settings = &mut self.session.state.settings;
        self.input.moved([x, y], settings, width) != Reaction::None
    }

    /// The wheel turns by notches; with `zooms` it changes the field of view.
    pub fn wheel(&mut self, notches: f64, zooms: bool) {
        input::wheel(&mut self.session.state.settings.view, notches, zooms);
    }

    /// Two touches go apart by this factor.
    pub fn pinch(&mut self, apart: f64) {
        input::pinch(&mut self.session.state.settings.view, apart);
    }
}

impl Viewer {
    /// Width of the canvas, pixels.
    fn width(&self) -> f64 {
        f64::from(self.session.stage.size()[0])
    }
}
