//! How the camera moves: all by elapsed time.

use super::keys::Drive;
use crate::camera::{MAX_RADIUS, View};

/// The nearest that the window goes to the horizon.
pub const MIN_RADIUS: f64 = 1.01;
/// The farthest: the shadow is then a pixel or so.
pub const MAX_WINDOW_RADIUS: f64 = 2000.0;
/// Orbit speeds to choose from, as multiples of [`ORBIT_DEG_PER_S`].
pub const ORBIT_SPEEDS: [f64; 4] = [0.0, 1.0, 2.0, 4.0];
/// Orbit speed 1×, degrees a second: once round in half a minute.
pub const ORBIT_DEG_PER_S: f64 = 12.0;
/// Fields of view that the window goes to, degrees.
pub const FIELDS_OF_VIEW: std::ops::RangeInclusive<f64> = 1.0..=170.0;

/// Turning by keys, in fields of view a second.
const TURN_PER_S: f64 = 0.5;
/// By keys r − 1 changes by this power of e a second: slower when near, and never through the horizon.
const APPROACH_PER_S: f64 = 0.8;
/// Factor of r − 1, or of the field of view, for one notch of the wheel or one press.
const NOTCH: f64 = 0.9;
const GO_ROUND_DEG_PER_S: f64 = 45.0;

const _: () = assert!(MAX_WINDOW_RADIUS <= MAX_RADIUS);

impl Drive {
    /// Moves a view as the key does that is held for `seconds`.
    pub fn steer(self, view: &mut View, seconds: f64) {
        let turn = TURN_PER_S * view.fov_deg * seconds;
        let go_round = GO_ROUND_DEG_PER_S * seconds;
        match self {
            Drive::LookUp => look(view, 0.0, turn),
            Drive::LookDown => look(view, 0.0, -turn),
            Drive::LookLeft => look(view, -turn, 0.0),
            Drive::LookRight => look(view, turn, 0.0),
            Drive::Nearer => approach(view, APPROACH_PER_S * seconds),
            Drive::Farther => approach(view, -APPROACH_PER_S * seconds),
            Drive::OrbitLeft => orbit(view, -go_round, 0.0),
            Drive::OrbitRight => orbit(view, go_round, 0.0),
        }
    }
}

/// Turns the view to the right and up, away from the hole.
pub fn look(view: &mut View, right_deg: f64, up_deg: f64) {
    view.yaw_deg = wrapped(view.yaw_deg + right_deg);
    view.pitch_deg = (view.pitch_deg + up_deg).clamp(-90.0, 90.0);
}

/// Moves the camera round the hole to the right and up.
pub fn orbit(view: &mut View, right_deg: f64, up_deg: f64) {
    view.orbit_deg = wrapped(view.orbit_deg + right_deg);
    view.latitude_deg = (view.latitude_deg + up_deg).clamp(-90.0, 90.0);
}

/// Divides r − 1 by e to the `power`.
pub fn approach(view: &mut View, power: f64) {
    let above_horizon = (view.radius - 1.0) * (-power).exp();
    view.radius = (1.0 + above_horizon).clamp(MIN_RADIUS, MAX_WINDOW_RADIUS);
}

/// Approaches by notches of the wheel.
pub fn scroll(view: &mut View, notches: f64) {
    approach(view, -notches * NOTCH.ln());
}

/// Makes the field of view smaller by notches.
pub fn zoom(view: &mut View, notches: f64) {
    let (least, most) = (*FIELDS_OF_VIEW.start(), *FIELDS_OF_VIEW.end());
    view.fov_deg = (view.fov_deg * NOTCH.powf(notches)).clamp(least, most);
}

/// To −180 … 180.
fn wrapped(degrees: f64) -> f64 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn held_keys_move_by_time_and_not_by_frames() {
        for drive in [
            Drive::Nearer,
            Drive::Farther,
            Drive::LookLeft,
            Drive::OrbitRight,
        ] {
            let mut once = View::default();
            let mut often = View::default();
            drive.steer(&mut once, 0.5);
            for _ in 0..50 {
                drive.steer(&mut often, 0.01);
            }
            assert_ne!(once, View::default());
            assert!((once.radius - often.radius).abs() < 1e-9, "{drive:?}");
            assert!((once.yaw_deg - often.yaw_deg).abs() < 1e-9, "{drive:?}");
            assert!((once.orbit_deg - often.orbit_deg).abs() < 1e-9, "{drive:?}");
        }
    }

    #[test]
    fn nearer_is_slower_when_near() {
        let step = |radius| {
            let mut view = View {
                radius,
                ..View::default()
            };
            Drive::Nearer.steer(&mut view, 0.1);
            radius - view.radius
        };
        assert!(step(2.0) < 0.1 * step(25.0));
    }

    proptest! {
        #[test]
        fn no_motion_makes_a_view_without_a_camera(
            deeds in prop::collection::vec((0..10usize, -1e4..1e4f64), 1..50)
        ) {
            let mut view = View::default();
            for (deed, amount) in deeds {
                match deed {
                    0 => look(&mut view, amount, 0.3 * amount),
                    1 => orbit(&mut view, amount, 0.3 * amount),
                    2 => scroll(&mut view, amount),
                    3 => zoom(&mut view, amount),
                    4 => Drive::Nearer.steer(&mut view, amount.abs()),
                    5 => Drive::Farther.steer(&mut view, amount.abs()),
                    6 => Drive::LookUp.steer(&mut view, amount.abs()),
                    _ => approach(&mut view, 1e-3 * amount),
                }
                prop_assert!(crate::camera::Camera::new(&view).is_ok(), "{view:?}");
                prop_assert!(view.radius >= MIN_RADIUS);
            }
        }
    }
}
