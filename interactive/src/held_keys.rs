//! The keys that are held, and for how long.

use crate::keys::Movement;
use keyboard_types::Code;
use std::time::Duration;

/// The keys that are held, and how long each was held since the last call of [`HeldKeys::drain`]. A key pressed
/// and released between two frames counts for the time that it was held.
#[derive(Debug, Clone, Default)]
pub struct HeldKeys {
    keys: Vec<Hold>,
}

#[derive(Debug, Clone, Copy)]
struct Hold {
    key: Code,
    movement: Movement,
    since: Option<Duration>,
    before: Duration,
}

impl HeldKeys {
    /// Records that a key is pressed.
    pub fn press(&mut self, key: Code, movement: Movement, now: Duration) {
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
    pub fn release(&mut self, key: Code, now: Duration) {
        for hold in self.keys.iter_mut().filter(|hold| hold.key == key) {
            if let Some(since) = hold.since.take() {
                hold.before += now.saturating_sub(since);
            }
        }
    }

    /// Records that all keys are released, as when the window loses the focus.
    pub fn release_all(&mut self, now: Duration) {
        for hold in &mut self.keys {
            if let Some(since) = hold.since.take() {
                hold.before += now.saturating_sub(since);
            }
        }
    }

    /// Whether a key is held, or was since the last call of [`HeldKeys::drain`].
    pub fn any(&self) -> bool {
        !self.keys.is_empty()
    }

    /// Calls `f` with every movement and the seconds it was held since the last call.
    pub fn drain(&mut self, now: Duration, mut f: impl FnMut(Movement, f64)) {
        for hold in &mut self.keys {
            let running = hold
                .since
                .map(|since| now.saturating_sub(since))
                .unwrap_or_default();
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

    #[test]
    fn a_key_counts_for_as_long_as_it_was_held() {
        let start = Duration::ZERO;
        let at = |ms| start + Duration::from_millis(ms);
        let mut held = HeldKeys::default();
        let drained = |held: &mut HeldKeys, ms| {
            let mut all = Vec::new();
            held.drain(at(ms), |movement, s| {
                all.push((movement, (1000.0 * s).round() as u64));
            });
            all
        };
        held.press(Code::KeyW, Movement::LookUp, at(0));
        held.press(Code::KeyW, Movement::LookUp, at(5));
        assert_eq!(drained(&mut held, 10), [(Movement::LookUp, 10)]);
        held.release(Code::KeyW, at(13));
        held.press(Code::KeyW, Movement::LookUp, at(14));
        held.release(Code::KeyW, at(18));
        assert!(held.any());
        assert_eq!(drained(&mut held, 30), [(Movement::LookUp, 7)]);
        assert!(!held.any());
        held.press(Code::KeyA, Movement::LookLeft, at(40));
        held.release_all(at(42));
        assert_eq!(drained(&mut held, 50), [(Movement::LookLeft, 2)]);
        assert_eq!(drained(&mut held, 60), []);
    }
}
