//! Key bindings: one table for the event handling, the help and the README.
//!
//! Key bindings use physical key positions, named as on a US keyboard, so that WASD is in the same place on every
//! keyboard layout.

use std::time::{Duration, Instant};
use winit::keyboard::KeyCode;

/// Movement of the camera while a key is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Movement {
    /// Look up.
    LookUp,
    /// Look down.
    LookDown,
    /// Look left.
    LookLeft,
    /// Look right.
    LookRight,
    /// Move towards the hole.
    Nearer,
    /// Move away from the hole.
    Farther,
    /// Orbit the hole to the left.
    OrbitLeft,
    /// Orbit the hole to the right.
    OrbitRight,
}

/// Change of the settings when a key is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// The next orbit speed.
    NextOrbitSpeed,
    /// Deflection on or off.
    ToggleDeflection,
    /// Filtered pixels or one ray per pixel.
    ToggleFilter,
    /// The next comparison of table and direct integration.
    NextComparison,
    /// The next resolution scale.
    NextResolution,
    /// A smaller field of view.
    ZoomIn,
    /// A larger field of view.
    ZoomOut,
    /// Stronger amplification of the difference.
    MoreGain,
    /// Weaker amplification of the difference.
    LessGain,
    /// Panel on or off.
    TogglePanel,
    /// Help on or off.
    ToggleHelp,
}

/// Command to the window when a key is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// The next built-in sky.
    NextSky,
    /// Reset to the start.
    Reset,
    /// Full screen on or off.
    ToggleFullscreen,
    /// Write a screenshot to a file.
    Screenshot,
    /// Leave the help, else full screen, else the program.
    Leave,
}

/// Action of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyAction {
    /// Movement while the key is held.
    Held(Movement),
    /// Change of the settings when the key is pressed.
    Changes(Change),
    /// Command to the window when the key is pressed.
    Pressed(Command),
}

impl Change {
    /// All changes.
    pub const ALL: [Change; 11] = [
        Change::NextOrbitSpeed,
        Change::ToggleDeflection,
        Change::ToggleFilter,
        Change::NextComparison,
        Change::NextResolution,
        Change::ZoomIn,
        Change::ZoomOut,
        Change::MoreGain,
        Change::LessGain,
        Change::TogglePanel,
        Change::ToggleHelp,
    ];
}

/// A key binding: one or more keys and their description.
#[derive(Debug, Clone, Copy)]
pub struct Binding {
    /// The keys and their actions.
    pub keys: &'static [(KeyCode, KeyAction)],
    /// Names of the keys, for the help.
    pub names: &'static str,
    /// What the keys do, for the help.
    pub does: &'static str,
}

const fn held(key: KeyCode, movement: Movement) -> (KeyCode, KeyAction) {
    (key, KeyAction::Held(movement))
}

const fn changes(key: KeyCode, change: Change) -> (KeyCode, KeyAction) {
    (key, KeyAction::Changes(change))
}

const fn pressed(key: KeyCode, command: Command) -> (KeyCode, KeyAction) {
    (key, KeyAction::Pressed(command))
}

const fn binding(
    keys: &'static [(KeyCode, KeyAction)],
    names: &'static str,
    does: &'static str,
) -> Binding {
    Binding { keys, names, does }
}

/// All key bindings.
pub const BINDINGS: &[Binding] = &[
    binding(
        &[
            held(KeyCode::KeyW, Movement::LookUp),
            held(KeyCode::KeyA, Movement::LookLeft),
            held(KeyCode::KeyS, Movement::LookDown),
            held(KeyCode::KeyD, Movement::LookRight),
        ],
        "W A S D",
        "look away from the hole",
    ),
    binding(
        &[
            held(KeyCode::ArrowUp, Movement::Nearer),
            held(KeyCode::ArrowDown, Movement::Farther),
        ],
        "Up, Down",
        "nearer, farther; slower when near",
    ),
    binding(
        &[
            held(KeyCode::ArrowLeft, Movement::OrbitLeft),
            held(KeyCode::ArrowRight, Movement::OrbitRight),
        ],
        "Left, Right",
        "go round the hole",
    ),
    binding(
        &[changes(KeyCode::KeyR, Change::NextOrbitSpeed)],
        "R",
        "orbit speed: 0×, 1×, 2×, 4×",
    ),
    binding(
        &[pressed(KeyCode::KeyZ, Command::NextSky)],
        "Z",
        "next sky: nebula, starmap, grid, stars",
    ),
    binding(
        &[changes(KeyCode::KeyL, Change::ToggleDeflection)],
        "L",
        "deflection on or off",
    ),
    binding(
        &[changes(KeyCode::KeyV, Change::ToggleFilter)],
        "V",
        "the mean over each pixel, or one ray per pixel",
    ),
    binding(
        &[changes(KeyCode::KeyM, Change::NextComparison)],
        "M",
        "table, direct integration, both side by side, difference",
    ),
    binding(
        &[
            changes(KeyCode::BracketLeft, Change::LessGain),
            changes(KeyCode::BracketRight, Change::MoreGain),
        ],
        "[, ]",
        "weaker, stronger difference",
    ),
    binding(
        &[changes(KeyCode::KeyX, Change::NextResolution)],
        "X",
        "resolution: 1, 2×2, automatic, 1/4, 1/2",
    ),
    binding(
        &[
            changes(KeyCode::Equal, Change::ZoomIn),
            changes(KeyCode::NumpadAdd, Change::ZoomIn),
            changes(KeyCode::Minus, Change::ZoomOut),
            changes(KeyCode::NumpadSubtract, Change::ZoomOut),
        ],
        "+, −",
        "smaller, larger field of view",
    ),
    binding(
        &[
            pressed(KeyCode::Home, Command::Reset),
            pressed(KeyCode::Backspace, Command::Reset),
        ],
        "Home, Backspace",
        "reset",
    ),
    binding(
        &[
            pressed(KeyCode::KeyF, Command::ToggleFullscreen),
            pressed(KeyCode::F11, Command::ToggleFullscreen),
        ],
        "F, F11",
        "full screen",
    ),
    binding(
        &[
            pressed(KeyCode::KeyP, Command::Screenshot),
            pressed(KeyCode::F12, Command::Screenshot),
        ],
        "P, F12",
        "screenshot to the current folder",
    ),
    binding(
        &[changes(KeyCode::Tab, Change::TogglePanel)],
        "Tab",
        "panel on or off",
    ),
    binding(
        &[
            changes(KeyCode::KeyH, Change::ToggleHelp),
            changes(KeyCode::F1, Change::ToggleHelp),
        ],
        "H, F1",
        "this help",
    ),
    binding(
        &[pressed(KeyCode::Escape, Command::Leave)],
        "Esc",
        "leave the help, full screen, or the program",
    ),
];

/// Mouse bindings: input and effect.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "look; drags the divider in the split view"),
    ("right drag", "go round the hole"),
    ("scroll", "nearer, farther"),
    ("Ctrl + scroll", "smaller, larger field of view"),
    ("drop a file", "a panorama or a bending table"),
];

/// The action bound to a key, if any.
pub fn key_action(key: KeyCode) -> Option<KeyAction> {
    let mut all = BINDINGS.iter().flat_map(|binding| binding.keys);
    all.find(|(k, _)| *k == key).map(|(_, action)| *action)
}

/// The keys that are held, and how long each was held since the last call of [`HeldKeys::drain`]. A key pressed
/// and released between two frames counts for the time that it was held.
#[derive(Debug, Clone, Default)]
pub struct HeldKeys {
    keys: Vec<Hold>,
}

#[derive(Debug, Clone, Copy)]
struct Hold {
    key: KeyCode,
    movement: Movement,
    since: Option<Instant>,
    before: Duration,
}

impl HeldKeys {
    /// Records that a key is pressed.
    pub fn press(&mut self, key: KeyCode, movement: Movement, now: Instant) {
        match self.keys.iter_mut().find(|hold| hold.key == key) {
            Some(hold) => hold.since = hold.since.or(Some(now)),
            None => self.keys.push(Hold {
                key,
                movement,
                since: Some(now),
                before: Duration::ZERO,
            }),
        }
    }

    /// Records that a key is released.
    pub fn release(&mut self, key: KeyCode, now: Instant) {
        for hold in self.keys.iter_mut().filter(|hold| hold.key == key) {
            if let Some(since) = hold.since.take() {
                hold.before += now - since;
            }
        }
    }

    /// Records that all keys are released, as when the window loses the focus.
    pub fn release_all(&mut self, now: Instant) {
        for hold in &mut self.keys {
            if let Some(since) = hold.since.take() {
                hold.before += now - since;
            }
        }
    }

    /// Whether a key is held, or was since the last call of [`HeldKeys::drain`].
    pub fn any(&self) -> bool {
        !self.keys.is_empty()
    }

    /// Calls `f` with every movement and the seconds it was held since the last call.
    pub fn drain(&mut self, now: Instant, mut f: impl FnMut(Movement, f64)) {
        for hold in &mut self.keys {
            let running = hold.since.map(|since| now - since).unwrap_or_default();
            hold.since = hold.since.map(|_| now);
            f(hold.movement, (hold.before + running).as_secs_f64());
            hold.before = Duration::ZERO;
        }
        self.keys.retain(|hold| hold.since.is_some());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn no_key_does_two_things() {
        let all: Vec<KeyCode> = BINDINGS
            .iter()
            .flat_map(|b| b.keys)
            .map(|(k, _)| *k)
            .collect();
        assert_eq!(all.iter().collect::<HashSet<_>>().len(), all.len());
        assert_eq!(
            key_action(KeyCode::KeyL),
            Some(KeyAction::Changes(Change::ToggleDeflection))
        );
        assert_eq!(key_action(KeyCode::KeyQ), None);
    }

    #[test]
    fn the_readme_lists_every_key() {
        let readme = include_str!("../../../README.md");
        let mouse = MOUSE.iter().map(|&(names, does)| (names, does));
        for (names, does) in BINDINGS.iter().map(|b| (b.names, b.does)).chain(mouse) {
            let line = format!("| {names} | {does} |");
            assert!(readme.contains(&line), "the README lacks: {line}");
        }
    }

    #[test]
    fn a_key_counts_for_as_long_as_it_was_held() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut held = HeldKeys::default();
        let drained = |held: &mut HeldKeys, ms| {
            let mut all = Vec::new();
            held.drain(at(ms), |movement, s| {
                all.push((movement, (1000.0 * s).round() as u64));
            });
            all
        };
        held.press(KeyCode::KeyW, Movement::LookUp, at(0));
        held.press(KeyCode::KeyW, Movement::LookUp, at(5));
        assert_eq!(drained(&mut held, 10), [(Movement::LookUp, 10)]);
        held.release(KeyCode::KeyW, at(13));
        held.press(KeyCode::KeyW, Movement::LookUp, at(14));
        held.release(KeyCode::KeyW, at(18));
        assert!(held.any());
        assert_eq!(drained(&mut held, 30), [(Movement::LookUp, 7)]);
        assert!(!held.any());
        held.press(KeyCode::KeyA, Movement::LookLeft, at(40));
        held.release_all(at(42));
        assert_eq!(drained(&mut held, 50), [(Movement::LookLeft, 2)]);
        assert_eq!(drained(&mut held, 60), []);
    }
}
