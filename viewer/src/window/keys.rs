//! The keys: one table, which the window obeys and the help overlay and the README show.
//!
//! Keys are told apart by their place, named as on a US keyboard, so that WASD lies where it should on
//! every other.

use std::time::{Duration, Instant};
use winit::keyboard::KeyCode;

/// What a key does as long as it is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// Look up.
    LookUp,
    /// Look down.
    LookDown,
    /// Look left.
    LookLeft,
    /// Look right.
    LookRight,
    /// Approach the hole.
    Nearer,
    /// Go away from the hole.
    Farther,
    /// Go round the hole to the left.
    OrbitLeft,
    /// Go round the hole to the right.
    OrbitRight,
}

/// What a key changes in the settings when it is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// The next orbit speed.
    NextOrbitSpeed,
    /// Deflection on or off.
    ToggleDeflection,
    /// Filtered or one ray a pixel.
    ToggleFilter,
    /// The next comparison of table and direct integration.
    NextComparison,
    /// The next resolution scale.
    NextResolution,
    /// A smaller field of view.
    ZoomIn,
    /// A larger field of view.
    ZoomOut,
    /// A stronger difference.
    MoreGain,
    /// A weaker difference.
    LessGain,
    /// The panel or not.
    TogglePanel,
    /// The help or not.
    ToggleHelp,
}

/// What a key asks of the window when it is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// The next built-in sky.
    NextSky,
    /// Everything as at the start.
    Reset,
    /// Full screen or not.
    ToggleFullscreen,
    /// A picture to a file.
    Screenshot,
    /// Out of the help, of full screen, or of the program.
    Leave,
}

/// What a key is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deed {
    /// While held.
    Held(Drive),
    /// When pressed, in the settings.
    Changes(Change),
    /// When pressed, with the window.
    Pressed(Command),
}

impl Change {
    /// All of them.
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

/// Keys that do something, or a pair of them.
#[derive(Debug, Clone, Copy)]
pub struct Binding {
    /// The keys and their deeds.
    pub keys: &'static [(KeyCode, Deed)],
    /// What is printed on them.
    pub names: &'static str,
    /// What they do.
    pub does: &'static str,
}

const fn held(key: KeyCode, drive: Drive) -> (KeyCode, Deed) {
    (key, Deed::Held(drive))
}

const fn changes(key: KeyCode, change: Change) -> (KeyCode, Deed) {
    (key, Deed::Changes(change))
}

const fn pressed(key: KeyCode, command: Command) -> (KeyCode, Deed) {
    (key, Deed::Pressed(command))
}

const fn binding(
    keys: &'static [(KeyCode, Deed)],
    names: &'static str,
    does: &'static str,
) -> Binding {
    Binding { keys, names, does }
}

/// All keys.
pub const BINDINGS: &[Binding] = &[
    binding(
        &[
            held(KeyCode::KeyW, Drive::LookUp),
            held(KeyCode::KeyA, Drive::LookLeft),
            held(KeyCode::KeyS, Drive::LookDown),
            held(KeyCode::KeyD, Drive::LookRight),
        ],
        "W A S D",
        "look away from the hole",
    ),
    binding(
        &[
            held(KeyCode::ArrowUp, Drive::Nearer),
            held(KeyCode::ArrowDown, Drive::Farther),
        ],
        "Up, Down",
        "nearer, farther; slower when near",
    ),
    binding(
        &[
            held(KeyCode::ArrowLeft, Drive::OrbitLeft),
            held(KeyCode::ArrowRight, Drive::OrbitRight),
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
        "the mean over each pixel, or one ray a pixel",
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

/// What the mouse does.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "look; drags the divider in the split view"),
    ("right drag", "go round the hole"),
    ("scroll", "nearer, farther"),
    ("Ctrl + scroll", "smaller, larger field of view"),
    ("drop a file", "a panorama or a bending table"),
];

/// What a key is for.
pub fn deed(key: KeyCode) -> Option<Deed> {
    let mut all = BINDINGS.iter().flat_map(|binding| binding.keys);
    all.find(|(k, _)| *k == key).map(|(_, deed)| *deed)
}

/// Which keys are held, and how long since it was asked last: a tap between two frames counts for as
/// long as it took.
#[derive(Debug, Clone, Default)]
pub struct HeldKeys {
    keys: Vec<Hold>,
}

#[derive(Debug, Clone, Copy)]
struct Hold {
    key: KeyCode,
    drive: Drive,
    since: Option<Instant>,
    before: Duration,
}

impl HeldKeys {
    /// A key goes down.
    pub fn press(&mut self, key: KeyCode, drive: Drive, now: Instant) {
        match self.keys.iter_mut().find(|hold| hold.key == key) {
            Some(hold) => hold.since = hold.since.or(Some(now)),
            None => self.keys.push(Hold {
                key,
                drive,
                since: Some(now),
                before: Duration::ZERO,
            }),
        }
    }

    /// A key goes up.
    pub fn release(&mut self, key: KeyCode, now: Instant) {
        for hold in self.keys.iter_mut().filter(|hold| hold.key == key) {
            if let Some(since) = hold.since.take() {
                hold.before += now - since;
            }
        }
    }

    /// All keys go up, as when the window is left.
    pub fn release_all(&mut self, now: Instant) {
        for hold in &mut self.keys {
            if let Some(since) = hold.since.take() {
                hold.before += now - since;
            }
        }
    }

    /// Whether one is held, or was since it was asked last.
    pub fn any(&self) -> bool {
        !self.keys.is_empty()
    }

    /// Calls `f` with every drive and the seconds it was held since the last call.
    pub fn drain(&mut self, now: Instant, mut f: impl FnMut(Drive, f64)) {
        for hold in &mut self.keys {
            let running = hold.since.map(|since| now - since).unwrap_or_default();
            hold.since = hold.since.map(|_| now);
            f(hold.drive, (hold.before + running).as_secs_f64());
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
            deed(KeyCode::KeyL),
            Some(Deed::Changes(Change::ToggleDeflection))
        );
        assert_eq!(deed(KeyCode::KeyQ), None);
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
            held.drain(at(ms), |drive, s| {
                all.push((drive, (1000.0 * s).round() as u64));
            });
            all
        };
        held.press(KeyCode::KeyW, Drive::LookUp, at(0));
        held.press(KeyCode::KeyW, Drive::LookUp, at(5));
        assert_eq!(drained(&mut held, 10), [(Drive::LookUp, 10)]);
        held.release(KeyCode::KeyW, at(13));
        held.press(KeyCode::KeyW, Drive::LookUp, at(14));
        held.release(KeyCode::KeyW, at(18));
        assert!(held.any());
        assert_eq!(drained(&mut held, 30), [(Drive::LookUp, 7)]);
        assert!(!held.any());
        held.press(KeyCode::KeyA, Drive::LookLeft, at(40));
        held.release_all(at(42));
        assert_eq!(drained(&mut held, 50), [(Drive::LookLeft, 2)]);
        assert_eq!(drained(&mut held, 60), []);
    }
}
