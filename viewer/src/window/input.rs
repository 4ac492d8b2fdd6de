//! Passes events of the window to the [`Input`] that knows no window system.

use keyboard_types::Code;
use lensbake_interactive::input::{self, Button, Input, KeyChange, Reaction};
use lensbake_interactive::settings::Settings;
use std::time::Duration;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{KeyCode, ModifiersState, PhysicalKey};

/// Pixels of touchpad scrolling that count as one notch of a mouse wheel.
const PIXELS_A_NOTCH: f64 = 50.0;

/// The input of one window.
#[derive(Debug, Default)]
pub struct WindowInput {
    input: Input,
    modifiers: ModifiersState,
}

impl AsMut<Input> for WindowInput {
    fn as_mut(&mut self) -> &mut Input {
        &mut self.input
    }
}

impl WindowInput {
    /// Handles an event of a window that is `width` pixels wide, at the time `now`.
    pub fn take(
        &mut self,
        event: &WindowEvent,
        settings: &mut Settings,
        width: u32,
        now: Duration,
    ) -> Reaction {
        let width = f64::from(width.max(1));
        match event {
            WindowEvent::Focused(false) => {
                self.input.release_all(now);
                Reaction::Changed
            }
            WindowEvent::ModifiersChanged(modifiers) => {
                self.modifiers = modifiers.state();
                Reaction::None
            }
            // Synthetic events report keys that were already held when the window got the focus: they were pressed
            // for another window.
            WindowEvent::KeyboardInput {
                event,
                is_synthetic: false,
                ..
            } => self.key(event, settings, now),
            WindowEvent::MouseInput { state, button, .. } => {
                match (state, button) {
                    (ElementState::Released, _) => self.input.release(),
                    (_, MouseButton::Left) => self.input.press(Button::Look, settings, width),
                    (_, MouseButton::Right) => self.input.press(Button::Orbit, settings, width),
                    _ => (),
                }
                Reaction::None
            }
            WindowEvent::CursorMoved { position, .. } => {
                self.input.moved([position.x, position.y], settings, width)
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let zooms = self.modifiers.control_key();
                input::wheel(&mut settings.view, notches(*delta), zooms);
                Reaction::Changed
            }
            _ => Reaction::None,
        }
    }

    fn key(&mut self, key: &KeyEvent, settings: &mut Settings, now: Duration) -> Reaction {
        let PhysicalKey::Code(code) = key.physical_key else {
            return Reaction::None;
        };
        let change = match key.state {
            ElementState::Released => KeyChange::Released,
            ElementState::Pressed if key.repeat => KeyChange::Repeated,
            ElementState::Pressed => KeyChange::Pressed,
        };
        key_code(code).map_or(Reaction::None, |code| {
            self.input.key(code, change, settings, now)
        })
    }
}

/// The key by its name in the W3C's standard, which both types are named after; winit serialises to that name.
fn key_code(key: KeyCode) -> Option<Code> {
    let name = serde_json::to_value(key).ok()?;
    name.as_str()?.parse().ok()
}

fn notches(delta: MouseScrollDelta) -> f64 {
    match delta {
        MouseScrollDelta::LineDelta(_, y) => f64::from(y),
        MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_A_NOTCH,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_interactive::keys::BINDINGS;

    #[test]
    fn every_key_that_does_something_has_the_same_name_in_winit() {
        for (code, _) in BINDINGS.iter().flat_map(|binding| binding.keys) {
            let key: KeyCode = serde_json::from_value(code.to_string().into()).unwrap();
            assert_eq!(key_code(key), Some(*code));
        }
    }
}
