//! The view angle.

use glam::DVec3;
use std::f64::consts::PI;

/// The view angle θ, between a direction and the direction of the hole, as its cosine and sine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewAngle {
    /// cos θ.
    pub cos: f64,
    /// sin θ, at least 0.
    pub sin: f64,
}

impl ViewAngle {
    /// The view angle of a unit direction in the hole frame. sin θ is computed from x and y: √(1 − cos² θ) would
    /// lose precision near 0 and π.
    pub fn of(direction: DVec3) -> Self {
        ViewAngle {
            cos: -direction.z,
            sin: direction.truncate().length(),
        }
    }

    /// θ, rad.
    pub fn radians(&self) -> f64 {
        self.sin.atan2(self.cos).clamp(0.0, PI)
    }

    /// Rotates `direction`, whose view angle is `self`, to the view angle `to`, in the plane through it and the
    /// hole.
    pub fn turn(&self, direction: DVec3, to: ViewAngle) -> DVec3 {
        let scale = to.sin / self.sin.max(1e-300);
        DVec3::new(direction.x * scale, direction.y * scale, -to.cos)
    }
}
