//! Input: turns keys, pointer, wheel and touches into changes of the settings.

use crate::held_keys::HeldKeys;
use crate::keys::{Command, KeyAction, key_action};
use crate::motion;
use crate::settings::Settings;
use keyboard_types::Code;
use lensbake_render::camera::View;
use std::time::Duration;

/// Distance from the divider within which the pointer can drag it, pixels.
const GRAB: f64 = 10.0;
/// Orbit angle for a drag across the whole picture, degrees.
const ORBIT_DRAG_DEG: f64 = 180.0;
/// Factor by which the distance between two touches grows for the effect of one notch of the wheel.
const PINCH_NOTCH: f64 = 1.1;

/// What the pointer drags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Drag {
    Look,
    Orbit,
    Divider,
}

/// The button with which the pointer is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Button {
    /// The main button, or one touch: looks, or drags the divider.
    Look,
    /// The secondary button, or two touches: goes round the hole.
    Orbit,
}

/// How a key changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyChange {
    /// It was pressed.
    Pressed,
    /// It is held, and the system repeats it.
    Repeated,
    /// It was released.
    Released,
}

/// Current state of keys and pointer.
#[derive(Debug, Default)]
pub struct Input {
    held: HeldKeys,
    pointer: [f64; 2],
    drag: Option<Drag>,
}

/// What the caller must do after an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reaction {
    /// Nothing: the picture stays the same.
    None,
    /// The settings have changed, or a key is held that changes them.
    Changed,
    /// Run the command of a key.
    Command(Command),
}

impl Input {
    /// Releases all keys and the pointer, as when the focus is lost.
    pub fn release_all(&mut self, now: Duration) {
        self.held.release_all(now);
        self.drag = None;
    }

    /// Moves the view by the keys that were held since the last call; true if one still is.
    pub fn steer(&mut self, view: &mut View, now: Duration) -> bool {
        self.held
            .drain(now, |movement, seconds| movement.steer(view, seconds));
        self.held.any()
    }

    /// Handles a key.
    pub fn key(
        &mut self,
        code: Code,
        change: KeyChange,
        settings: &mut Settings,
        now: Duration,
    ) -> Reaction {
        match (key_action(code), change) {
            (Some(KeyAction::Held(movement)), KeyChange::Pressed | KeyChange::Repeated) => {
                self.held.press(code, movement, now);
                Reaction::Changed
            }
            (Some(KeyAction::Held(_)), KeyChange::Released) => {
                self.held.release(code, now);
                Reaction::Changed
            }
            // Movement up to now comes before the change or command.
            (Some(KeyAction::Changes(change)), KeyChange::Pressed) => {
                self.steer(&mut settings.view, now);
                settings.change(change);
                Reaction::Changed
            }
            (Some(KeyAction::Pressed(command)), KeyChange::Pressed) => {
                self.steer(&mut settings.view, now);
                Reaction::Command(command)
            }
            _ => Reaction::None,
        }
    }

    /// The pointer is pressed where it is, in a picture that is `width` pixels wide.
    pub fn press(&mut self, button: Button, settings: &Settings, width: f64) {
        let at_divider = (self.pointer[0] - settings.divider * width).abs() < GRAB;
        self.drag = Some(match button {
            Button::Look if settings.is_split() && at_divider => Drag::Divider,
            Button::Look => Drag::Look,
            Button::Orbit => Drag::Orbit,
        });
    }

    /// The pointer is released.
    pub fn release(&mut self) {
        self.drag = None;
    }

    /// Sets the position of the pointer, in pixels of the picture, without dragging.
    pub fn place(&mut self, to: [f64; 2]) {
        self.pointer = to;
    }

    /// The pointer moves to a place, in pixels of a picture that is `width` pixels wide.
    pub fn moved(&mut self, to: [f64; 2], settings: &mut Settings, width: f64) -> Reaction {
        let [right, down] = [to[0] - self.pointer[0], to[1] - self.pointer[1]];
        self.pointer = to;
        let view = &mut settings.view;
        // The sky follows the pointer.
        match self.drag {
            None => return Reaction::None,
            Some(Drag::Look) => {
                let degrees = view.fov_deg / width;
                motion::look(view, -right * degrees, down * degrees);
            }
            Some(Drag::Orbit) => {
                let degrees = ORBIT_DRAG_DEG / width;
                motion::orbit(view, -right * degrees, down * degrees);
            }
            Some(Drag::Divider) => settings.divider = (to[0] / width).clamp(0.0, 1.0),
        }
        Reaction::Changed
    }
}

/// Moves nearer by this many notches of the wheel; with `zooms`, makes the field of view smaller instead.
pub fn wheel(view: &mut View, notches: f64, zooms: bool) {
    match zooms {
        true => motion::zoom(view, notches),
        false => motion::scroll(view, notches),
    }
}

/// Moves nearer after a pinch in which the distance between two touches grew by the factor `apart`.
pub fn pinch(view: &mut View, apart: f64) {
    if apart.is_finite() && apart > 0.0 {
        motion::scroll(view, apart.ln() / PINCH_NOTCH.ln());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Comparison;

    fn settings() -> Settings {
        Settings::new(View::default(), 0.05)
    }

    #[test]
    fn the_sky_follows_the_pointer_by_the_field_of_view() {
        let (mut input, mut settings) = (Input::default(), settings());
        assert_eq!(
            input.moved([100.0, 50.0], &mut settings, 900.0),
            Reaction::None
        );
        input.press(Button::Look, &settings, 900.0);
        input.moved([0.0, 50.0], &mut settings, 900.0);
        let across = settings.view.fov_deg / 9.0;
        assert!((settings.view.yaw_deg - across).abs() < 1e-12);
        input.release();
        input.place([10.0, 10.0]);
        input.press(Button::Orbit, &settings, 900.0);
        input.moved([10.0, 100.0], &mut settings, 900.0);
        assert!((settings.view.latitude_deg - 18.0).abs() < 1e-12);
    }

    #[test]
    fn the_divider_is_dragged_only_where_it_is() {
        let (mut input, mut settings) = (Input::default(), settings());
        settings.comparison = Comparison::Split;
        input.place([455.0, 10.0]);
        input.press(Button::Look, &settings, 900.0);
        input.moved([90.0, 10.0], &mut settings, 900.0);
        assert_eq!(settings.divider, 0.1);
        input.place([455.0, 10.0]);
        input.press(Button::Look, &settings, 900.0);
        input.moved([454.0, 10.0], &mut settings, 900.0);
        assert!(settings.divider == 0.1 && settings.view.yaw_deg != 0.0);
    }

    #[test]
    fn touches_that_go_apart_and_back_lead_back() {
        let mut view = View::default();
        pinch(&mut view, 2.0);
        assert!(view.radius < View::default().radius);
        pinch(&mut view, 0.5);
        assert!((view.radius - View::default().radius).abs() < 1e-9);
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let before = view;
            pinch(&mut view, bad);
            assert_eq!(view, before);
        }
    }
}
