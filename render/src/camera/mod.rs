//! The camera: the view direction of each pixel.
//!
//! Three coordinate systems, all right-handed with +Y up. In the *sky* frame the hole is at the origin. In the *hole* frame
//! the camera is at the origin and the hole lies along −Z, so that the view angle θ of a unit direction, measured
//! from the hole, has cos θ = −z and sin θ = √(x² + y²). In the *camera* frame −Z is the centre of the picture.
//!
//! A moving camera has the axes of the hole frame, carried along by its boost. A radial motion is part of the observer;
//! any other motion is a boost relative to that observer, and view directions are mapped by the aberration first
//! ([`Camera::unboosted`]).

mod great_circle;
mod projection;
mod view;
mod view_angle;

pub use great_circle::Place;
pub use projection::{CubeFace, Mapping, Projection, ViewRay};
pub use view::{CameraError, FALL_END, MAX_FALL_ROW_RADIUS, MAX_RADIUS, MAX_SIDE, View};
pub use view_angle::ViewAngle;

use glam::{DMat3, DVec2, DVec3};
use lensbake_core::{Boost, Motion, MovingFrame, Observer};
use std::f64::consts::PI;

/// A camera: a checked [`View`] as vectors.
///
/// ```
/// use lensbake_render::camera::{Camera, View, ViewAngle};
///
/// let camera = Camera::new(&View { radius: 10.0, ..View::default() }).unwrap();
/// // The picture's centre looks at the hole.
/// assert!(ViewAngle::of(camera.forward).sin < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The observer at the camera's position, at rest or in radial motion.
    pub observer: Observer,
    /// The camera's boost relative to that observer, its direction in the hole frame.
    pub boost: Option<Boost>,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// How view directions are mapped to the picture.
    pub mapping: Mapping,
    /// Change of the view direction in the centre of the picture from one pixel to the next on its right, in the hole
    /// frame.
    pub right: DVec3,
    /// The same from one pixel to the next below.
    pub down: DVec3,
    /// View direction of the picture's centre in the hole frame, length 1.
    pub forward: DVec3,
    /// Rotation from the hole frame to the sky frame.
    pub sky_from_hole: DMat3,
}

impl Camera {
    /// The camera of a view.
    ///
    /// # Errors
    /// [`CameraError`] if a value of the view is out of range.
    pub fn new(view: &View) -> Result<Self, CameraError> {
        let frame = MovingFrame::new(view.radius, view.motion)?;
        let has_row = match view.motion {
            Motion::Fall => view.radius <= MAX_FALL_ROW_RADIUS,
            Motion::Rest | Motion::Orbit | Motion::Velocity { .. } => false,
        };
        let frame = if has_row { frame } else { frame.as_boost() };
        Camera::in_frame(&frame, view)
    }

    /// The camera of a view whose motion is that of `frame`, which must be at the view's radius.
    ///
    /// # Errors
    /// As [`Camera::new`].
    pub fn in_frame(frame: &MovingFrame, view: &View) -> Result<Self, CameraError> {
        if view.radius > MAX_RADIUS {
            return Err(CameraError::TooFar(view.radius));
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
            * DMat3::from_rotation_z(-angle("roll", view.roll_deg)?)
            * view.projection.turn()?;
        let sky_from_hole = DMat3::from_rotation_y(angle("orbit", view.orbit_deg)?)
            * DMat3::from_rotation_x(-angle("latitude", view.latitude_deg)?);
        let (north, east) = angle("heading", view.heading_deg)?.sin_cos();
        let boost = frame.boost().map(|boost| {
            let [towards, along, _] = boost.direction;
            Boost {
                direction: [along * east, along * north, -towards],
                ..boost
            }
        });
        let pixel = view.projection.pixel(view)?;
        Ok(Camera {
            observer: *frame.observer(),
            boost,
            width,
            height,
            mapping: view.projection.mapping(),
            right: hole_from_camera.x_axis * pixel,
            down: -hole_from_camera.y_axis * pixel,
            forward: -hole_from_camera.z_axis,
            sky_from_hole,
        })
    }

    /// The same camera with each pixel divided into `side` × `side` pixels.
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

    /// The centre of pixel (column, row), row 0 at the top, in pixels from the centre of the picture.
    pub fn position(&self, column: u32, row: u32) -> DVec2 {
        DVec2::new(
            f64::from(column) + 0.5 - 0.5 * f64::from(self.width),
            f64::from(row) + 0.5 - 0.5 * f64::from(self.height),
        )
    }

    /// Maps a unit view direction of the camera to that in which [`Camera::observer`] sees the same light, and returns
    /// the ratio of the frequencies, camera over observer: the map scales small angles by it.
    pub fn unboosted(&self, direction: DVec3) -> (DVec3, f64) {
        let Some(boost) = self.boost else {
            return (direction, 1.0);
        };
        let (direction, doppler) = boost.unboosted(direction.to_array());
        (direction.into(), doppler)
    }

    /// The inverse of [`Camera::unboosted`], with the same ratio of the frequencies, camera over observer.
    pub fn boosted(&self, direction: DVec3) -> (DVec3, f64) {
        let Some(boost) = self.boost else {
            return (direction, 1.0);
        };
        let (direction, scale) = boost.inverse().unboosted(direction.to_array());
        (direction.into(), 1.0 / scale)
    }

    /// Bounds on the ratio of the frequencies, camera over observer, of light from within `radius` (rad) of the unit
    /// `direction` in which [`Camera::observer`] sees it: (lowest, highest).
    pub fn doppler_bounds(&self, direction: DVec3, radius: f64) -> (f64, f64) {
        let Some(boost) = self.boost else {
            return (1.0, 1.0);
        };
        let from_motion = direction.angle_between(boost.direction.into());
        // ν_camera/ν_observer = ((1 + cos α) k + (1 − cos α)/k) / 2 falls with the angle α from the motion.
        let ratio = |angle: f64| {
            let cos = angle.clamp(0.0, PI).cos();
            0.5 * ((1.0 + cos) * boost.doppler + (1.0 - cos) / boost.doppler)
        };
        let (near, far) = (ratio(from_motion - radius), ratio(from_motion + radius));
        (near.min(far), near.max(far))
    }

    /// The view direction at `at`, in pixels from the centre of the picture; in the hole frame, not normalised.
    pub fn ray(&self, at: DVec2) -> DVec3 {
        self.view_ray(at).direction
    }

    /// The unit view direction of the centre of pixel (column, row), row 0 at the top, in the hole frame.
    pub fn direction(&self, column: u32, row: u32) -> DVec3 {
        self.ray(self.position(column, row)).normalize()
    }

    /// The pixel (column, row) that contains `direction`, in the hole frame; `None` outside the picture.
    pub fn pixel(&self, direction: DVec3) -> Option<(u32, u32)> {
        let position = self.project(direction)?;
        let size = DVec2::new(self.width.into(), self.height.into());
        let inside = position.cmpge(DVec2::ZERO).all() && position.cmplt(size).all();
        inside.then_some((position.x as u32, position.y as u32))
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
        // Seen from the hole, the camera lies along +Z of the hole frame.
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
