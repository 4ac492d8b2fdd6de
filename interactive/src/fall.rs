//! A free fall by proper time: the clock of a camera that has let go.
//!
//! The clock keeps the proper time that is left until the singularity, of which time that passes is subtracted. The
//! radius follows from it, so that r^{3/2} falls at a constant rate whatever the frames are. If keys move the camera on
//! the way, the fall goes on from there.

use lensbake_core::Motion;
use lensbake_core::geodesic::{fall_radius, fall_time};
use lensbake_render::camera::FALL_END;

/// Radius at which the fall ends.
pub const END: f64 = FALL_END;

/// The clock of a fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    start: LetGo,
    run: Run,
    /// Proper time left until the singularity, r_s/c.
    time_left: f64,
    /// The radius that `time_left` belongs to.
    radius: f64,
    /// Proper time since letting go, r_s/c.
    passed: f64,
}

/// Where the camera let go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LetGo {
    /// The radius.
    pub radius: f64,
    /// The motion before.
    pub motion: Motion,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Run {
    /// The next frame is the first: time counts from there.
    First,
    On,
    Stopped,
}

/// What a step of the fall leads to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The new radius.
    pub radius: f64,
    /// Whether the fall has reached its end in this step.
    pub arrives: bool,
}

impl Fall {
    /// A fall that begins with the next frame.
    pub fn new(start: LetGo) -> Self {
        Fall {
            start,
            run: Run::First,
            time_left: fall_time(start.radius),
            radius: start.radius,
            passed: 0.0,
        }
    }

    /// Where the camera let go.
    pub fn start(&self) -> LetGo {
        self.start
    }

    /// Proper time since letting go, r_s/c.
    pub fn passed(&self) -> f64 {
        self.passed
    }

    /// Whether time passes.
    pub fn runs(&self) -> bool {
        self.run != Run::Stopped
    }

    /// Whether it stands at its end.
    pub fn has_ended(&self, radius: f64) -> bool {
        !self.runs() && radius <= END
    }

    /// Stops the clock.
    pub fn stop(&mut self) {
        self.run = Run::Stopped;
    }

    /// Lets the clock run from the next frame on.
    pub fn go_on(&mut self) {
        self.run = Run::First;
    }

    /// Falls from `radius`, where the camera is now, for the proper time `time` since the last frame, r_s/c. Stops at
    /// [`END`]. Nothing happens at a radius that is not positive, which has been typed and is yet to be refused.
    pub fn advance(&mut self, radius: f64, time: f64) -> Step {
        if radius.is_nan() || radius <= 0.0 {
            return Step {
                radius,
                arrives: false,
            };
        }
        if radius != self.radius {
            self.radius = radius;
            self.time_left = fall_time(radius);
        }
        let time = match self.run {
            Run::Stopped => return self.stay(),
            Run::First => 0.0,
            Run::On => time,
        };
        self.run = Run::On;
        if time > 0.0 {
            self.fall(time);
        }
        let arrives = self.radius <= END;
        if arrives {
            self.stop();
        }
        Step {
            radius: self.radius,
            arrives,
        }
    }

    fn stay(&self) -> Step {
        Step {
            radius: self.radius,
            arrives: false,
        }
    }

    fn fall(&mut self, time: f64) {
        let way = (self.time_left - fall_time(END)).max(0.0);
        if time < way {
            self.time_left -= time;
            self.radius = fall_radius(self.time_left);
            self.passed += time;
        } else {
            self.time_left -= way;
            self.radius = self.radius.min(END);
            self.passed += way;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn from(radius: f64) -> Fall {
        Fall::new(LetGo {
            radius,
            motion: Motion::Rest,
        })
    }

    /// Falls in frames of these proper times; returns the radius.
    fn fallen(fall: &mut Fall, mut radius: f64, frames: impl IntoIterator<Item = f64>) -> f64 {
        for time in frames {
            radius = fall.advance(radius, time).radius;
        }
        radius
    }

    #[test]
    fn time_counts_from_the_first_frame() {
        let mut fall = from(3.0);
        let first = fall.advance(3.0, 100.0);
        assert_eq!((first.radius, first.arrives), (3.0, false));
        assert!(fall.advance(3.0, 1.0).radius < 3.0);
        fall.stop();
        let here = fall.radius;
        assert_eq!(fallen(&mut fall, here, [1.0, 1.0]), here);
        fall.go_on();
        assert_eq!(fallen(&mut fall, here, [1.0]), here, "its first frame");
        assert!(fallen(&mut fall, here, [0.1]) < here);
        assert!((fall.passed() - 1.1).abs() < 1e-15);
    }

    #[test]
    fn it_arrives_once_and_at_the_right_time() {
        for radius in [0.02, 1.0, 3.0, 25.0] {
            let time = fall_time(radius) - fall_time(END);
            let mut fall = from(radius);
            let before = fallen(&mut fall, radius, [0.0, time * (1.0 - 1e-9)]);
            assert!(before > END && fall.runs(), "{radius}");
            let step = fall.advance(before, 1e-8 * time);
            assert_eq!((step.radius, step.arrives), (END, true));
            assert!((fall.passed() / time - 1.0).abs() < 1e-14);
            assert!(fall.has_ended(END));
            let after = fall.advance(END, 1.0);
            assert_eq!((after.radius, after.arrives), (END, false));
        }
    }

    #[test]
    fn whoever_lets_go_at_the_end_has_arrived() {
        for radius in [END, 0.5 * END] {
            let step = from(radius).advance(radius, 0.1);
            assert_eq!((step.radius, step.arrives), (radius, true));
        }
    }

    #[test]
    fn it_goes_on_from_where_the_camera_is_moved() {
        let mut fall = from(3.0);
        fallen(&mut fall, 3.0, [0.0, 1.0]);
        let radius = fall.advance(10.0, 2.0).radius;
        assert!((radius.powf(1.5) - (10f64.powf(1.5) - 3.0)).abs() < 1e-12);
        assert!((fall.passed() - 3.0).abs() < 1e-15);
    }

    #[test]
    fn a_radius_that_is_none_does_not_disturb_the_clock() {
        let mut fall = from(3.0);
        fallen(&mut fall, 3.0, [0.0, 1.0]);
        let before = fall;
        for radius in [-161.8, 0.0, f64::NEG_INFINITY, f64::NAN] {
            let step = fall.advance(radius, 0.1);
            assert!(step.radius.to_bits() == radius.to_bits() && !step.arrives);
            assert_eq!(fall, before);
        }
    }

    proptest! {
        #[test]
        fn the_radius_follows_the_law_at_any_frame_rate(
            from_radius in 0.1..2000.0f64,
            part in 0.0..0.999f64,
            cuts in prop::collection::vec(0.0..1.0f64, 1..200),
        ) {
            let time = part * (fall_time(from_radius) - fall_time(END));
            let sum: f64 = cuts.iter().sum::<f64>() + 1e-9;
            let frames = cuts.iter().map(|cut| cut / sum * time);
            let exact = frames.clone().sum::<f64>();
            let mut fall = from(from_radius);
            let radius = fallen(&mut fall, from_radius, std::iter::once(0.0).chain(frames));
            let law = from_radius.powf(1.5) - 1.5 * exact;
            prop_assert!((radius.powf(1.5) - law).abs() < 1e-12 * from_radius.powf(1.5));
        }
    }
}
