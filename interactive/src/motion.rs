//! Movement of the camera by keys, mouse and wheel, by elapsed time.
//!
//! Keys, wheel and sliders stop at the ends of [`radii`], [`FIELDS_OF_VIEW`] and [`PITCHES`]. A flag or a typed
//! number may set a view beyond an end. Such a view stays where it is until it is moved, and then moves only
//! towards the end.

use crate::fall;
use crate::keys::Movement;
use lensbake_core::Motion;
use lensbake_render::camera::View;
use std::ops::RangeInclusive;

/// Farthest radius for keys, wheel and slider: the shadow is about a pixel wide.
const FARTHEST: f64 = 2000.0;
/// Proper times per second to choose from, r_s/c.
pub const CLOCK_RATES: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 16.0];
/// Index of the proper time per second at the start: a fall from r = 3 takes seven seconds.
pub const USUAL_CLOCK_RATE: usize = 1;
/// Orbit speeds to choose from, as multiples of [`ORBIT_DEG_PER_S`].
pub const ORBIT_SPEEDS: [f64; 4] = [0.0, 1.0, 2.0, 4.0];
/// Orbit speed 1×, degrees per second: one orbit in half a minute.
pub const ORBIT_DEG_PER_S: f64 = 12.0;
/// Range of fields of view for keys, wheel and slider, degrees.
pub const FIELDS_OF_VIEW: RangeInclusive<f64> = 1.0..=170.0;
/// Range of pitch, and of latitude, for keys and mouse, degrees.
pub const PITCHES: RangeInclusive<f64> = -90.0..=90.0;

/// Turning speed by keys, fields of view per second.
const TURN_PER_S: f64 = 0.5;
/// Approach speed by keys: the distance of [`approach`] changes by a factor of e to this power per second.
const APPROACH_PER_S: f64 = 0.8;
/// Factor of the distance of [`approach`], or of the field of view, per notch of the wheel or press of a key.
const NOTCH: f64 = 0.9;
const GO_ROUND_DEG_PER_S: f64 = 45.0;

impl Movement {
    /// Moves a view as by a key held for `seconds`.
    pub fn steer(self, view: &mut View, seconds: f64) {
        let turn = TURN_PER_S * view.fov_deg * seconds;
        let go_round = GO_ROUND_DEG_PER_S * seconds;
        match self {
            Movement::LookUp => look(view, 0.0, turn),
            Movement::LookDown => look(view, 0.0, -turn),
            Movement::LookLeft => look(view, -turn, 0.0),
            Movement::LookRight => look(view, turn, 0.0),
            Movement::Nearer => approach(view, APPROACH_PER_S * seconds),
            Movement::Farther => approach(view, -APPROACH_PER_S * seconds),
            Movement::OrbitLeft => orbit(view, -go_round, 0.0),
            Movement::OrbitRight => orbit(view, go_round, 0.0),
        }
    }
}

/// Turns the view to the right and up (yaw and pitch).
pub fn look(view: &mut View, right_deg: f64, up_deg: f64) {
    view.yaw_deg = wrapped(view.yaw_deg + right_deg);
    view.pitch_deg = stopped(view.pitch_deg, view.pitch_deg + up_deg, PITCHES);
}

/// Moves the camera around the hole to the right and up (longitude and latitude).
pub fn orbit(view: &mut View, right_deg: f64, up_deg: f64) {
    view.orbit_deg = wrapped(view.orbit_deg + right_deg);
    view.latitude_deg = stopped(view.latitude_deg, view.latitude_deg + up_deg, PITCHES);
}

/// Range of radii for keys, wheel and slider in the motion of `view`. It ends shortly before the radius at which the
/// motion becomes impossible. Only in free fall does it contain the horizon.
pub fn radii(view: &View) -> RangeInclusive<f64> {
    match view.motion {
        Motion::Orbit => 1.51..=FARTHEST,
        Motion::Fall => fall::END..=FARTHEST,
        // Below the horizon a velocity is relative to another observer.
        Motion::Velocity { .. } if view.radius <= 1.0 => fall::END..=1.0,
        Motion::Rest | Motion::Velocity { .. } => 1.01..=FARTHEST,
    }
}

/// Divides the distance by e to the `power`, so that the camera is slower when near: the distance from the horizon,
/// r − 1, or, for a camera in free fall or below the horizon, r.
pub fn approach(view: &mut View, power: f64) {
    let centre = match view.motion {
        Motion::Fall => 0.0,
        Motion::Velocity { .. } if view.radius <= 1.0 => 0.0,
        Motion::Rest | Motion::Orbit | Motion::Velocity { .. } => 1.0,
    };
    let moved = centre + (view.radius - centre) * (-power).exp();
    // Near the horizon a small step outwards would be lost in rounding, and the camera could never leave.
    let moved = match power < 0.0 {
        true => moved.max(view.radius.next_up()),
        false => moved,
    };
    view.radius = stopped(view.radius, moved, radii(view));
}

/// Moves towards the hole by notches of the wheel.
pub fn scroll(view: &mut View, notches: f64) {
    approach(view, -notches * NOTCH.ln());
}

/// Zooms in by notches: makes the field of view smaller.
pub fn zoom(view: &mut View, notches: f64) {
    let zoomed = view.fov_deg * NOTCH.powf(notches);
    view.fov_deg = stopped(view.fov_deg, zoomed, FIELDS_OF_VIEW);
}

/// The same view with its angles wrapped to −180° … 180°.
pub fn unwound(view: &View) -> View {
    View {
        heading_deg: wrapped(view.heading_deg),
        orbit_deg: wrapped(view.orbit_deg),
        latitude_deg: wrapped(view.latitude_deg),
        yaw_deg: wrapped(view.yaw_deg),
        pitch_deg: wrapped(view.pitch_deg),
        roll_deg: wrapped(view.roll_deg),
        ..*view
    }
}

/// Clamps a movement from `before` to `after` to `range`. If it began beyond an end, it goes no farther out.
fn stopped(before: f64, after: f64, range: RangeInclusive<f64>) -> f64 {
    after.clamp(range.start().min(before), range.end().max(before))
}

/// Wraps an angle to −180° … 180°.
pub(crate) fn wrapped(degrees: f64) -> f64 {
    match (-180.0..=180.0).contains(&degrees) {
        true => degrees,
        false => (degrees + 180.0).rem_euclid(360.0) - 180.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn held_keys_move_by_time_and_not_by_frames() {
        for movement in [
            Movement::Nearer,
            Movement::Farther,
            Movement::LookLeft,
            Movement::OrbitRight,
        ] {
            let mut once = View::default();
            let mut often = View::default();
            movement.steer(&mut once, 0.5);
            for _ in 0..50 {
                movement.steer(&mut often, 0.01);
            }
            assert_ne!(once, View::default());
            assert!((once.radius - often.radius).abs() < 1e-9, "{movement:?}");
            assert!((once.yaw_deg - often.yaw_deg).abs() < 1e-9, "{movement:?}");
            assert!(
                (once.orbit_deg - often.orbit_deg).abs() < 1e-9,
                "{movement:?}"
            );
        }
    }

    #[test]
    fn nearer_is_slower_when_near() {
        let step = |radius| {
            let mut view = View {
                radius,
                ..View::default()
            };
            Movement::Nearer.steer(&mut view, 0.1);
            radius - view.radius
        };
        assert!(step(2.0) < 0.1 * step(25.0));
    }

    #[test]
    fn what_a_flag_has_set_beyond_an_end_moves_inwards_only() {
        let far = View {
            radius: 5000.0,
            fov_deg: 0.01,
            pitch_deg: 120.0,
            ..View::default()
        };
        let mut view = far;
        Movement::Farther.steer(&mut view, 1.0);
        zoom(&mut view, 3.0);
        look(&mut view, 0.0, 10.0);
        assert_eq!(view, far);
        Movement::Nearer.steer(&mut view, 0.1);
        zoom(&mut view, -1.0);
        look(&mut view, 0.0, -10.0);
        assert!((4000.0..5000.0).contains(&view.radius), "{view:?}");
        assert!((0.01..0.02).contains(&view.fov_deg), "{view:?}");
        assert_eq!(view.pitch_deg, 110.0);
        // A step smaller than the rounding of r still moves the camera away from the horizon.
        view.radius = 1.0f64.next_up();
        for _ in 0..10_000 {
            Movement::Farther.steer(&mut view, 0.016);
        }
        assert_eq!(view.radius, FARTHEST);
    }

    fn at(radius: f64, motion: Motion) -> View {
        View {
            radius,
            motion,
            ..View::default()
        }
    }

    const VELOCITY: Motion = Motion::Velocity {
        radial: -0.3,
        tangential: 0.5,
    };

    #[test]
    fn each_motion_has_its_nearest_radius() {
        for (radius, motion, nearest) in [
            (25.0, Motion::Rest, 1.01),
            (25.0, Motion::Orbit, 1.51),
            (25.0, Motion::Fall, 0.01),
            (25.0, VELOCITY, 1.01),
            (0.5, VELOCITY, 0.01),
        ] {
            let mut view = at(radius, motion);
            for _ in 0..100 {
                Movement::Nearer.steer(&mut view, 0.2);
            }
            assert_eq!(view.radius, nearest, "{motion}");
        }
    }

    #[test]
    fn the_camera_in_free_fall_passes_the_horizon_both_ways() {
        let mut view = at(1.5, Motion::Fall);
        Movement::Nearer.steer(&mut view, 1.0);
        assert!((0.5..1.0).contains(&view.radius), "{}", view.radius);
        Movement::Farther.steer(&mut view, 1.0);
        assert!((view.radius - 1.5).abs() < 1e-12, "{}", view.radius);
        let mut inside = at(0.9, VELOCITY);
        Movement::Farther.steer(&mut inside, 1.0);
        assert_eq!(inside.radius, 1.0, "its velocity is relative to the fall");
    }

    #[test]
    fn unwinding_changes_no_angle_that_is_wound_off() {
        let wound = View {
            yaw_deg: 380.0,
            pitch_deg: -190.0,
            roll_deg: 0.1,
            ..View::default()
        };
        let view = unwound(&wound);
        assert_eq!(
            (view.yaw_deg, view.pitch_deg, view.roll_deg),
            (20.0, 170.0, 0.1)
        );
    }

    fn any_motion() -> impl Strategy<Value = (f64, Motion)> {
        prop_oneof![
            (1.001..2500.0).prop_map(|radius| (radius, Motion::Rest)),
            (1.501..2500.0).prop_map(|radius| (radius, Motion::Orbit)),
            (0.005..2500.0).prop_map(|radius| (radius, Motion::Fall)),
            (0.005..2500.0).prop_map(|radius| (radius, VELOCITY)),
        ]
    }

    proptest! {
        #[test]
        fn no_motion_makes_a_view_without_a_camera(
            (radius, motion) in any_motion(),
            actions in prop::collection::vec((0..10usize, -1e4..1e4f64), 1..50),
        ) {
            let mut view = at(radius, motion);
            for (action, amount) in actions {
                let before = view;
                match action {
                    0 => look(&mut view, amount, 0.3 * amount),
                    1 => orbit(&mut view, amount, 0.3 * amount),
                    2 => scroll(&mut view, amount),
                    3 => zoom(&mut view, amount),
                    4 => Movement::Nearer.steer(&mut view, amount.abs()),
                    5 => Movement::Farther.steer(&mut view, amount.abs()),
                    6 => Movement::LookUp.steer(&mut view, amount.abs()),
                    _ => approach(&mut view, 1e-3 * amount),
                }
                prop_assert!(lensbake_render::camera::Camera::new(&view).is_ok(), "{view:?}");
                let (least, most) = radii(&before).into_inner();
                let allowed = least.min(before.radius)..=most.max(before.radius);
                prop_assert!(allowed.contains(&view.radius), "{view:?}");
            }
        }
    }
}
