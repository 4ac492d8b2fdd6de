//! Input handling: translates keyboard and mouse events into changes of the settings.

use super::held_keys::HeldKeys;
use super::keys::{Command, KeyAction, key_action};
use super::motion;
use super::settings::Settings;
use lensbake_render::camera::View;
use std::time::Instant;
use winit::dpi::PhysicalPosition;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{ModifiersState, PhysicalKey};

/// What a pressed mouse button drags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Drag {
    Look,
    Orbit,
    Divider,
}

/// Distance from the divider within which the pointer can drag it, pixels.
const GRAB: f64 = 10.0;
/// Pixels of touchpad scrolling that count as one notch of a mouse wheel.
const PIXELS_A_NOTCH: f64 = 50.0;
/// Orbit angle for a drag across the whole window, degrees.
const ORBIT_DRAG_DEG: f64 = 180.0;

/// Current state of keys and mouse.
#[derive(Debug, Default)]
pub struct Input {
    held: HeldKeys,
    modifiers: ModifiersState,
    pointer: PhysicalPosition<f64>,
    drag: Option<Drag>,
}

/// What the window must do after an event.
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
    /// Handles an event of a window that is `width` pixels wide.
    pub fn take(&mut self, event: &WindowEvent, settings: &mut Settings, width: u32) -> Reaction {
        let width = f64::from(width.max(1));
        match event {
            WindowEvent::Focused(false) => {
                self.held.release_all(Instant::now());
                self.drag = None;
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
            } => self.key(event, settings),
            WindowEvent::MouseInput { state, button, .. } => {
                self.button(*state, *button, settings, width);
                Reaction::None
            }
            WindowEvent::CursorMoved { position, .. } => self.moved(*position, settings, width),
            WindowEvent::MouseWheel { delta, .. } => {
                self.wheel(*delta, &mut settings.view);
                Reaction::Changed
            }
            _ => Reaction::None,
        }
    }

    /// Moves the view by the keys that were held since the last call; true if one still is.
    pub fn steer(&mut self, view: &mut View, now: Instant) -> bool {
        self.held
            .drain(now, |movement, seconds| movement.steer(view, seconds));
        self.held.any()
    }

    fn key(&mut self, key: &KeyEvent, settings: &mut Settings) -> Reaction {
        let PhysicalKey::Code(code) = key.physical_key else {
            return Reaction::None;
        };
        let now = Instant::now();
        match (key_action(code), key.state) {
            (Some(KeyAction::Held(movement)), ElementState::Pressed) => {
                self.held.press(code, movement, now);
                Reaction::Changed
            }
            (Some(KeyAction::Held(_)), ElementState::Released) => {
                self.held.release(code, now);
                Reaction::Changed
            }
            _ if key.repeat => Reaction::None,
            // Movement up to now comes before the change or command.
            (Some(KeyAction::Changes(change)), ElementState::Pressed) => {
                self.steer(&mut settings.view, now);
                settings.change(change);
                Reaction::Changed
            }
            (Some(KeyAction::Pressed(command)), ElementState::Pressed) => {
                self.steer(&mut settings.view, now);
                Reaction::Command(command)
            }
            _ => Reaction::None,
        }
    }

    fn button(&mut self, state: ElementState, button: MouseButton, now: &Settings, width: f64) {
        let at_divider = (self.pointer.x - now.divider * width).abs() < GRAB;
        self.drag = match (state, button) {
            (ElementState::Released, _) => None,
            (_, MouseButton::Left) if now.is_split() && at_divider => Some(Drag::Divider),
            (_, MouseButton::Left) => Some(Drag::Look),
            (_, MouseButton::Right) => Some(Drag::Orbit),
            _ => self.drag,
        };
    }

    fn moved(
        &mut self,
        to: PhysicalPosition<f64>,
        settings: &mut Settings,
        width: f64,
    ) -> Reaction {
        let (right, down) = (to.x - self.pointer.x, to.y - self.pointer.y);
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
            Some(Drag::Divider) => settings.divider = (to.x / width).clamp(0.0, 1.0),
        }
        Reaction::Changed
    }

    fn wheel(&self, delta: MouseScrollDelta, view: &mut View) {
        let notches = match delta {
            MouseScrollDelta::LineDelta(_, y) => f64::from(y),
            MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_A_NOTCH,
        };
        if self.modifiers.control_key() {
            motion::zoom(view, notches);
        } else {
            motion::scroll(view, notches);
        }
    }
}
