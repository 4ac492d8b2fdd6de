//! From the window system's events to changes of the settings.

use super::keys::{Command, Deed, HeldKeys, deed};
use super::motion;
use super::settings::Settings;
use crate::camera::View;
use std::time::Instant;
use winit::dpi::PhysicalPosition;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{ModifiersState, PhysicalKey};

/// What a pressed mouse button drags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Drag {
    Look,
    GoRound,
    Divider,
}

/// How near to the divider the pointer must be to drag it, pixels.
const GRAB: f64 = 10.0;
/// Pixels that a touchpad scrolls for a notch of a wheel.
const PIXELS_A_NOTCH: f64 = 50.0;
/// Degrees that a drag across the window goes round the hole.
const GO_ROUND_DEG: f64 = 180.0;

/// Keys and mouse as they are now.
#[derive(Debug, Default)]
pub struct Input {
    held: HeldKeys,
    modifiers: ModifiersState,
    pointer: PhysicalPosition<f64>,
    drag: Option<Drag>,
}

/// What an event comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reaction {
    /// Nothing to be seen.
    None,
    /// The settings have changed, or a key is held that changes them.
    Changed,
    /// A key asks for something.
    Command(Command),
}

impl Input {
    /// Takes an event, in a window of `width` pixels across.
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
            // A key that was held when the window was entered was pressed for another.
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
            .drain(now, |drive, seconds| drive.steer(view, seconds));
        self.held.any()
    }

    fn key(&mut self, key: &KeyEvent, settings: &mut Settings) -> Reaction {
        let PhysicalKey::Code(code) = key.physical_key else {
            return Reaction::None;
        };
        let now = Instant::now();
        match (deed(code), key.state) {
            (Some(Deed::Held(drive)), ElementState::Pressed) => {
                self.held.press(code, drive, now);
                Reaction::Changed
            }
            (Some(Deed::Held(_)), ElementState::Released) => {
                self.held.release(code, now);
                Reaction::Changed
            }
            _ if key.repeat => Reaction::None,
            // What was held before another key was pressed counts before it.
            (Some(Deed::Changes(change)), ElementState::Pressed) => {
                self.steer(&mut settings.view, now);
                settings.change(change);
                Reaction::Changed
            }
            (Some(Deed::Pressed(command)), ElementState::Pressed) => {
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
            (_, MouseButton::Right) => Some(Drag::GoRound),
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
        // The sky goes with the pointer.
        match self.drag {
            None => return Reaction::None,
            Some(Drag::Look) => {
                let degrees = view.fov_deg / width;
                motion::look(view, -right * degrees, down * degrees);
            }
            Some(Drag::GoRound) => {
                let degrees = GO_ROUND_DEG / width;
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
