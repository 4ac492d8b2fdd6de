//! Key bindings: one table for the event handling, the help and the README.
//!
//! Key bindings use physical key positions, named as on a US keyboard, so that WASD is in the same place on every
//! keyboard layout.

use keyboard_types::Code;

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
    /// The next motion that is possible at this radius.
    NextMotion,
    /// Let go; during the fall pause and go on, at its end fall again.
    LetGo,
    /// Back to where the camera let go.
    BackToLetGo,
    /// Less proper time per second.
    SlowerClock,
    /// More proper time per second.
    FasterClock,
    /// The next orbit speed; in orbit, whether the camera moves by the true period.
    NextOrbitSpeed,
    /// Disc on or off.
    ToggleDisc,
    /// The next kind of frequency shift.
    NextShift,
    /// Automatic exposure on or off.
    ToggleAutoExposure,
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
    /// Set a keyframe of the path.
    SetKeyframe,
    /// Take the last keyframe back.
    TakeKeyframeBack,
    /// Play the path, or stop it.
    PlayPath,
    /// Write the path to a file.
    SavePath,
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
    pub const ALL: [Change; 19] = [
        Change::NextMotion,
        Change::LetGo,
        Change::BackToLetGo,
        Change::SlowerClock,
        Change::FasterClock,
        Change::NextOrbitSpeed,
        Change::ToggleDisc,
        Change::NextShift,
        Change::ToggleAutoExposure,
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
    pub keys: &'static [(Code, KeyAction)],
    /// Names of the keys, for the help.
    pub names: &'static str,
    /// What the keys do, for the help.
    pub does: &'static str,
}

const fn held(key: Code, movement: Movement) -> (Code, KeyAction) {
    (key, KeyAction::Held(movement))
}

const fn changes(key: Code, change: Change) -> (Code, KeyAction) {
    (key, KeyAction::Changes(change))
}

const fn pressed(key: Code, command: Command) -> (Code, KeyAction) {
    (key, KeyAction::Pressed(command))
}

const fn binding(
    keys: &'static [(Code, KeyAction)],
    names: &'static str,
    does: &'static str,
) -> Binding {
    Binding { keys, names, does }
}

/// All key bindings.
pub const BINDINGS: &[Binding] = &[
    binding(
        &[
            held(Code::KeyW, Movement::LookUp),
            held(Code::KeyA, Movement::LookLeft),
            held(Code::KeyS, Movement::LookDown),
            held(Code::KeyD, Movement::LookRight),
        ],
        "W A S D",
        "look away from the hole",
    ),
    binding(
        &[
            held(Code::ArrowUp, Movement::Nearer),
            held(Code::ArrowDown, Movement::Farther),
        ],
        "Up, Down",
        "nearer, farther; slower when near",
    ),
    binding(
        &[
            held(Code::ArrowLeft, Movement::OrbitLeft),
            held(Code::ArrowRight, Movement::OrbitRight),
        ],
        "Left, Right",
        "go round the hole",
    ),
    binding(
        &[changes(Code::KeyO, Change::NextMotion)],
        "O",
        "motion: at rest, free fall, circular orbit",
    ),
    binding(
        &[
            changes(Code::KeyG, Change::LetGo),
            changes(Code::KeyT, Change::BackToLetGo),
        ],
        "G, T",
        "let go (fall by proper time), pause, go on; go back",
    ),
    binding(
        &[
            changes(Code::Comma, Change::SlowerClock),
            changes(Code::Period, Change::FasterClock),
        ],
        "Comma, Period",
        "less, more proper time per second",
    ),
    binding(
        &[changes(Code::KeyR, Change::NextOrbitSpeed)],
        "R",
        "orbit speed: 0×, 1×, 2×, 4×; in orbit: the true period",
    ),
    binding(
        &[pressed(Code::KeyZ, Command::NextSky)],
        "Z",
        "next sky: nebula, starmap, grid, stars",
    ),
    binding(
        &[changes(Code::KeyB, Change::ToggleDisc)],
        "B",
        "disc of matter around the hole, on or off",
    ),
    binding(
        &[
            changes(Code::KeyC, Change::NextShift),
            changes(Code::KeyE, Change::ToggleAutoExposure),
        ],
        "C, E",
        "frequency shift: off, brightness, colour; auto exposure",
    ),
    binding(
        &[changes(Code::KeyL, Change::ToggleDeflection)],
        "L",
        "deflection on or off",
    ),
    binding(
        &[changes(Code::KeyV, Change::ToggleFilter)],
        "V",
        "the mean over each pixel, the same by the GPU's filter, or one ray",
    ),
    binding(
        &[changes(Code::KeyM, Change::NextComparison)],
        "M",
        "table, direct integration, both side by side, difference",
    ),
    binding(
        &[
            changes(Code::BracketLeft, Change::LessGain),
            changes(Code::BracketRight, Change::MoreGain),
        ],
        "[, ]",
        "weaker, stronger difference",
    ),
    binding(
        &[changes(Code::KeyX, Change::NextResolution)],
        "X",
        "resolution: 1, 2×2, automatic, 1/4, 1/2",
    ),
    binding(
        &[
            changes(Code::Equal, Change::ZoomIn),
            changes(Code::NumpadAdd, Change::ZoomIn),
            changes(Code::Minus, Change::ZoomOut),
            changes(Code::NumpadSubtract, Change::ZoomOut),
        ],
        "+, −",
        "smaller, larger field of view",
    ),
    binding(
        &[
            pressed(Code::Home, Command::Reset),
            pressed(Code::Backspace, Command::Reset),
        ],
        "Home, Backspace",
        "reset",
    ),
    binding(
        &[
            pressed(Code::KeyF, Command::ToggleFullscreen),
            pressed(Code::F11, Command::ToggleFullscreen),
        ],
        "F, F11",
        "full screen",
    ),
    binding(
        &[
            pressed(Code::KeyP, Command::Screenshot),
            pressed(Code::F12, Command::Screenshot),
        ],
        "P, F12",
        "screenshot to the current folder",
    ),
    binding(
        &[
            pressed(Code::KeyK, Command::SetKeyframe),
            pressed(Code::KeyU, Command::TakeKeyframeBack),
        ],
        "K, U",
        "set a keyframe of a path; take the last one back",
    ),
    binding(
        &[
            pressed(Code::KeyJ, Command::PlayPath),
            pressed(Code::KeyN, Command::SavePath),
        ],
        "J, N",
        "play the path, or stop; save it for `viewer film`",
    ),
    binding(
        &[changes(Code::Tab, Change::TogglePanel)],
        "Tab",
        "panel on or off",
    ),
    binding(
        &[
            changes(Code::KeyH, Change::ToggleHelp),
            changes(Code::F1, Change::ToggleHelp),
        ],
        "H, F1",
        "this help",
    ),
    binding(
        &[pressed(Code::Escape, Command::Leave)],
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
    ("drop a file", "a panorama, a bending table or a path"),
];

/// The action bound to a key, if any.
pub fn key_action(key: Code) -> Option<KeyAction> {
    let mut all = BINDINGS.iter().flat_map(|binding| binding.keys);
    all.find(|(k, _)| *k == key).map(|(_, action)| *action)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn no_key_does_two_things() {
        let all: Vec<Code> = BINDINGS
            .iter()
            .flat_map(|b| b.keys)
            .map(|(k, _)| *k)
            .collect();
        assert_eq!(all.iter().collect::<HashSet<_>>().len(), all.len());
        assert_eq!(
            key_action(Code::KeyL),
            Some(KeyAction::Changes(Change::ToggleDeflection))
        );
        assert_eq!(key_action(Code::KeyQ), None);
    }

    #[test]
    fn the_readme_lists_every_key() {
        let readme = include_str!("../../README.md");
        let mouse = MOUSE.iter().map(|&(names, does)| (names, does));
        for (names, does) in BINDINGS.iter().map(|b| (b.names, b.does)).chain(mouse) {
            let line = format!("| {names} | {does} |");
            assert!(readme.contains(&line), "the README lacks: {line}");
        }
    }
}
