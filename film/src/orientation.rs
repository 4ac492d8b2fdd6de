//! The orientation of a camera whose picture stays with its direction of motion.

use glam::{DMat3, EulerRot};
use lensbake_render::camera::View;

/// Yaw, pitch and roll of a camera, degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orientation {
    /// Rotation to the right, away from the hole.
    pub yaw_deg: f64,
    /// Rotation upwards, away from the hole.
    pub pitch_deg: f64,
    /// Clockwise roll.
    pub roll_deg: f64,
}

impl Orientation {
    /// The orientation of a view.
    pub fn of(view: &View) -> Self {
        Orientation {
            yaw_deg: view.yaw_deg,
            pitch_deg: view.pitch_deg,
            roll_deg: view.roll_deg,
        }
    }

    /// The orientation turned by `turn_deg` around the direction of the hole, from east towards north.
    pub fn turned(self, turn_deg: f64) -> Self {
        if turn_deg == 0.0 {
            return self;
        }
        let (yaw, pitch, roll) =
            (DMat3::from_rotation_z(turn_deg.to_radians()) * self.matrix()).to_euler(EulerRot::YXZ);
        Orientation {
            yaw_deg: -yaw.to_degrees(),
            pitch_deg: pitch.to_degrees(),
            roll_deg: -roll.to_degrees(),
        }
    }

    /// The rotation from the camera frame to the hole frame, as in `lensbake_render::camera`.
    fn matrix(self) -> DMat3 {
        DMat3::from_euler(
            EulerRot::YXZ,
            -self.yaw_deg.to_radians(),
            self.pitch_deg.to_radians(),
            -self.roll_deg.to_radians(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use lensbake_render::camera::Camera;
    use proptest::prelude::*;

    fn camera(orientation: Orientation) -> Camera {
        Camera::new(&View {
            yaw_deg: orientation.yaw_deg,
            pitch_deg: orientation.pitch_deg,
            roll_deg: orientation.roll_deg,
            ..View::default()
        })
        .unwrap()
    }

    proptest! {
        #[test]
        fn the_camera_turns_as_a_whole(
            yaw_deg in -400.0..400.0f64,
            pitch_deg in -100.0..100.0f64,
            roll_deg in -200.0..200.0f64,
            turn in -400.0..400.0f64,
        ) {
            let before = Orientation { yaw_deg, pitch_deg, roll_deg };
            let (sin, cos) = turn.to_radians().sin_cos();
            let turn_vector = |v: DVec3| DVec3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z);
            let (before, after) = (camera(before), camera(before.turned(turn)));
            prop_assert!((turn_vector(before.forward) - after.forward).length() < 1e-9);
            prop_assert!((turn_vector(before.right) - after.right).length() < 1e-9);
        }
    }
}
