//! The camera: which way each pixel looks.
//!
//! Three frames, all right-handed with +Y up. In the *sky* frame the hole is at the origin. In the
//! *hole* frame the camera is at the origin and the hole lies along −Z, so that the view angle θ has
//! cos θ = −z and sin θ = √(x² + y²). In the *camera* frame −Z is the middle of the picture.

use glam::{DMat3, DVec2, DVec3};
use lensbake_core::{CoreError, Observer};
use std::f64::consts::PI;
use thiserror::Error;

/// The largest side of a picture, in pixels.
pub const MAX_SIDE: u32 = 16_384;

/// A camera that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CameraError {
    /// The radius.
    #[error("{0}")]
    Radius(#[from] CoreError),
    /// The observer at infinity sees the hole as a point.
    #[error("radius {0} is too far: a camera's radius must be at most {MAX_RADIUS:e}")]
    TooFar(f64),
    /// The field of view.
    #[error("field of view {0} is not between 0 and 180 degrees (both excluded)")]
    FieldOfView(f64),
    /// An angle that is no number.
    #[error("{what} {degrees} is not an angle in degrees")]
    Angle {
        /// Which angle.
        what: &'static str,
        /// What was given.
        degrees: f64,
    },
    /// The size.
    #[error("picture size {width}x{height} is not from 1x1 to {MAX_SIDE}x{MAX_SIDE} pixels")]
    Size {
        /// Width given.
        width: u32,
        /// Height given.
        height: u32,
    },
}

/// The greatest radius of a camera: there the shadow is 2.6e-6 rad wide and f32 still resolves it.
pub const MAX_RADIUS: f64 = 1e6;

/// Where the camera is and how it looks. Angles in degrees, as a person gives them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Radius in units of r_s, above 1.
    pub radius: f64,
    /// Longitude of the camera about the hole; at 0 it looks along −Z of the sky at the hole.
    pub orbit_deg: f64,
    /// Latitude of the camera about the hole.
    pub latitude_deg: f64,
    /// Turned right, away from the hole.
    pub yaw_deg: f64,
    /// Turned up, away from the hole.
    pub pitch_deg: f64,
    /// Rolled clockwise.
    pub roll_deg: f64,
    /// Field of view across the picture.
    pub fov_deg: f64,
    /// Width of the picture, pixels.
    pub width: u32,
    /// Height of the picture, pixels.
    pub height: u32,
}

impl Default for View {
    /// The view that the 2022 report starts with: r = 25, 90° across, at the hole.
    fn default() -> Self {
        View {
            radius: 25.0,
            orbit_deg: 0.0,
            latitude_deg: 0.0,
            yaw_deg: 0.0,
            pitch_deg: 0.0,
            roll_deg: 0.0,
            fov_deg: 90.0,
            width: 1920,
            height: 1080,
        }
    }
}

/// A camera: a view, checked and made into vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The static observer that the camera is.
    pub observer: Observer,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Step of the view direction from one pixel to the next on the right, in the hole frame.
    pub right: DVec3,
    /// Step of the view direction from one pixel to the next below.
    pub down: DVec3,
    /// View direction of the picture's middle, length 1.
    pub forward: DVec3,
    /// From the hole frame to the sky frame.
    pub sky_from_hole: DMat3,
}

impl Camera {
    /// The camera of a view.
    ///
    /// # Errors
    /// [`CameraError`] says which value makes no camera, and why.
    pub fn new(view: &View) -> Result<Self, CameraError> {
        let observer = Observer::at(view.radius)?;
        if view.radius > MAX_RADIUS {
            return Err(CameraError::TooFar(view.radius));
        }
        if !(view.fov_deg > 0.0 && view.fov_deg < 180.0) {
            return Err(CameraError::FieldOfView(view.fov_deg));
        }
        let (width, height) = (view.width, view.height);
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
            return Err(CameraError::Size { width, height });
        }
        let angle = |what, degrees: f64| {
            if degrees.is_finite() {
                Ok(degrees.to_radians())
            } else {
                Err(CameraError::Angle { what, degrees })
            }
        };
        let hole_from_camera = DMat3::from_rotation_y(-angle("yaw", view.yaw_deg)?)
            * DMat3::from_rotation_x(angle("pitch", view.pitch_deg)?)
            * DMat3::from_rotation_z(-angle("roll", view.roll_deg)?);
        let sky_from_hole = DMat3::from_rotation_y(angle("orbit", view.orbit_deg)?)
            * DMat3::from_rotation_x(-angle("latitude", view.latitude_deg)?);
        let pixel = 2.0 * (0.5 * view.fov_deg.to_radians()).tan() / f64::from(width);
        Ok(Camera {
            observer,
            width,
            height,
            right: hole_from_camera.x_axis * pixel,
            down: -hole_from_camera.y_axis * pixel,
            forward: -hole_from_camera.z_axis,
            sky_from_hole,
        })
    }

    /// The same camera with each pixel cut into `side` × `side`.
    pub fn refined(&self, side: u32) -> Self {
        let part = 1.0 / f64::from(side);
        Camera {
            width: self.width * side,
            height: self.height * side,
            right: self.right * part,
            down: self.down * part,
            ..*self
        }
    }

    /// Number of pixels.
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// The middle of pixel (column, row), row 0 at the top, in pixels from the middle of the picture.
    pub fn position(&self, column: u32, row: u32) -> DVec2 {
        DVec2::new(
            f64::from(column) + 0.5 - 0.5 * f64::from(self.width),
            f64::from(row) + 0.5 - 0.5 * f64::from(self.height),
        )
    }

    /// The direction that is `at` pixels from the middle of the picture, in the hole frame, not
    /// normalised.
    pub fn ray(&self, at: DVec2) -> DVec3 {
        self.forward + self.right * at.x + self.down * at.y
    }

    /// The unit direction of the middle of pixel (column, row), row 0 at the top, in the hole frame.
    pub fn direction(&self, column: u32, row: u32) -> DVec3 {
        self.ray(self.position(column, row)).normalize()
    }

    /// Where in the picture `direction` in the hole frame is seen, in pixels from the top left corner, or
    /// beyond its edges; `None` behind the camera.
    pub fn project(&self, direction: DVec3) -> Option<DVec2> {
        let ahead = direction.dot(self.forward);
        let along = |step: DVec3, side: u32| {
            direction.dot(step) / (ahead * step.length_squared()) + 0.5 * f64::from(side)
        };
        (ahead > 0.0)
            .then(|| DVec2::new(along(self.right, self.width), along(self.down, self.height)))
    }

    /// The pixel (column, row) that `direction` in the hole frame falls into, if the picture has it.
    pub fn pixel(&self, direction: DVec3) -> Option<(u32, u32)> {
        let position = self.project(direction)?;
        let size = DVec2::new(self.width.into(), self.height.into());
        let inside = position.cmpge(DVec2::ZERO).all() && position.cmplt(size).all();
        inside.then_some((position.x as u32, position.y as u32))
    }

    /// |dθ/d pixel| at pixel (column, row), rad: the steepest change of the view angle.
    pub fn view_angle_gradient(&self, column: u32, row: u32) -> f64 {
        let ray = self.ray(self.position(column, row));
        let direction = ray.normalize();
        let sight = Sight::of(direction);
        if sight.sin == 0.0 {
            return self.right.length();
        }
        // The unit vector along which θ grows: away from the hole.
        let away = (direction.truncate() * (sight.cos / sight.sin)).extend(sight.sin);
        (self.right.dot(away) / ray.length()).hypot(self.down.dot(away) / ray.length())
    }
}

/// A view direction as the bending sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// cos θ, θ from the direction of the hole.
    pub cos: f64,
    /// sin θ ≥ 0.
    pub sin: f64,
}

impl Sight {
    /// Of a unit direction in the hole frame. sin θ is taken from its own components, not from cos θ.
    pub fn of(direction: DVec3) -> Self {
        Sight {
            cos: -direction.z,
            sin: direction.x.hypot(direction.y),
        }
    }

    /// θ, rad.
    pub fn angle(&self) -> f64 {
        self.sin.atan2(self.cos).clamp(0.0, PI)
    }

    /// `direction`, whose sight this is, turned in its plane through the hole so that its own sight is
    /// `turned`.
    pub fn turn(&self, direction: DVec3, turned: Sight) -> DVec3 {
        let scale = turned.sin / self.sin.max(1e-300);
        DVec3::new(direction.x * scale, direction.y * scale, -turned.cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(change: impl FnOnce(&mut View)) -> Camera {
        let mut view = View {
            width: 101,
            height: 51,
            ..View::default()
        };
        change(&mut view);
        Camera::new(&view).unwrap()
    }

    #[test]
    fn the_middle_looks_at_the_hole_and_the_corners_span_the_field_of_view() {
        let camera = camera(|_| ());
        assert!((camera.direction(50, 25) - DVec3::NEG_Z).length() < 1e-15);
        let left = camera.ray(camera.position(0, 25)) - camera.right * 0.5;
        assert!((left.normalize().dot(DVec3::NEG_Z).acos() - PI / 4.0).abs() < 1e-12);
        assert!(camera.direction(100, 25).x > 0.0, "right is +X");
        assert!(camera.direction(50, 0).y > 0.0, "the top is +Y");
    }

    #[test]
    fn a_pixel_is_found_again_by_its_direction() {
        let camera = camera(|v| {
            v.yaw_deg = 100.0;
            v.pitch_deg = 20.0;
            v.roll_deg = 30.0;
        });
        for (column, row) in [(0, 0), (100, 0), (3, 50), (50, 25)] {
            let direction = camera.direction(column, row);
            assert_eq!(camera.pixel(direction), Some((column, row)));
            assert_eq!(camera.pixel(-direction), None);
        }
        assert_eq!(camera.pixel(DVec3::NEG_Z), None, "the hole is behind");
    }

    #[test]
    fn yaw_turns_right_and_pitch_turns_up() {
        let right = camera(|v| v.yaw_deg = 90.0).direction(50, 25);
        assert!((right - DVec3::X).length() < 1e-12, "{right}");
        let up = camera(|v| v.pitch_deg = 90.0).direction(50, 25);
        assert!((up - DVec3::Y).length() < 1e-12, "{up}");
    }

    #[test]
    fn the_hole_stays_ahead_wherever_the_camera_orbits() {
        let camera = camera(|v| {
            v.orbit_deg = 70.0;
            v.latitude_deg = 30.0;
        });
        // The camera's place, seen from the hole, is +Z of the hole frame.
        let place = camera.sky_from_hole * DVec3::Z;
        let (orbit, latitude) = (70f64.to_radians(), 30f64.to_radians());
        let expected = DVec3::new(
            latitude.cos() * orbit.sin(),
            latitude.sin(),
            latitude.cos() * orbit.cos(),
        );
        assert!((place - expected).length() < 1e-12);
    }

    #[test]
    fn the_gradient_of_the_view_angle_is_its_difference() {
        let camera = camera(|v| {
            v.yaw_deg = 20.0;
            v.pitch_deg = -10.0;
            v.width = 4001;
            v.height = 2001;
        });
        let angle = |c, r| Sight::of(camera.direction(c, r)).angle();
        for (c, r) in [(100, 100), (3000, 500), (2000, 1999), (50, 1500)] {
            let across = 0.5 * (angle(c + 1, r) - angle(c - 1, r));
            let along = 0.5 * (angle(c, r + 1) - angle(c, r - 1));
            let gradient = camera.view_angle_gradient(c, r);
            assert!((gradient / across.hypot(along) - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn what_is_no_camera_is_refused() {
        let refused = |change: fn(&mut View)| {
            let mut view = View::default();
            change(&mut view);
            Camera::new(&view).unwrap_err()
        };
        assert!(matches!(
            refused(|v| v.radius = 1.0),
            CameraError::Radius(_)
        ));
        assert!(matches!(
            refused(|v| v.radius = f64::NAN),
            CameraError::Radius(_)
        ));
        assert!(matches!(
            refused(|v| v.radius = 1e7),
            CameraError::TooFar(_)
        ));
        assert!(matches!(
            refused(|v| v.fov_deg = 0.0),
            CameraError::FieldOfView(_)
        ));
        assert!(matches!(
            refused(|v| v.fov_deg = 180.0),
            CameraError::FieldOfView(_)
        ));
        assert!(matches!(
            refused(|v| v.fov_deg = f64::NAN),
            CameraError::FieldOfView(_)
        ));
        assert!(matches!(refused(|v| v.width = 0), CameraError::Size { .. }));
        assert!(matches!(
            refused(|v| v.height = 1 << 20),
            CameraError::Size { .. }
        ));
        assert!(matches!(
            refused(|v| v.yaw_deg = f64::INFINITY),
            CameraError::Angle { .. }
        ));
    }
}
