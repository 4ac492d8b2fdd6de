//! A view as a user gives it.

use super::Projection;
use lensbake_core::{CoreError, Motion};
use thiserror::Error;

/// Largest width and height of a picture, pixels.
pub const MAX_SIDE: u32 = 16_384;

/// Why a [`View`] makes no [`Camera`](super::Camera).
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CameraError {
    /// No observer can move so at this radius, or the radius is out of range.
    #[error("{0}")]
    Radius(#[from] CoreError),
    /// The radius is above [`MAX_RADIUS`]. An observer at infinity would see the hole as a point.
    #[error("radius {0} is too far: a camera's radius must be at most {MAX_RADIUS:e}")]
    TooFar(f64),
    /// The field of view is not between 0° and 180°.
    #[error("field of view {0} is not between 0 and 180 degrees (both excluded)")]
    FieldOfView(f64),
    /// The field of view of a disc is not above 0° and at most 360°.
    #[error("field of view {0} is not above 0 and at most 360 degrees")]
    DiscFieldOfView(f64),
    /// The tilt of a dome is not from 0° to 90°.
    #[error("tilt {0} is not from 0 to 90 degrees")]
    Tilt(f64),
    /// The projection has no picture of this shape.
    #[error("picture size {width}x{height}: {what}")]
    Shape {
        /// The shape of its pictures.
        what: &'static str,
        /// The given width, pixels.
        width: u32,
        /// The given height, pixels.
        height: u32,
    },
    /// An angle is not finite.
    #[error("{what} {degrees} is not an angle in degrees")]
    Angle {
        /// Name of the angle.
        what: &'static str,
        /// The given value, degrees.
        degrees: f64,
    },
    /// The picture size is out of range.
    #[error("picture size {width}x{height} is not from 1x1 to {MAX_SIDE}x{MAX_SIDE} pixels")]
    Size {
        /// The given width, pixels.
        width: u32,
        /// The given height, pixels.
        height: u32,
    },
}

/// Largest radius of a camera, units of r_s: the shadow's angular radius is 2.6e-6 rad there, which f32 still
/// resolves.
pub const MAX_RADIUS: f64 = 1e6;

/// Largest radius at which the row of an observer in free fall is drawn with. Farther out its texels cannot resolve the
/// aberration near the hole, and the fall is a boost in the shader: at this radius the row is off by 7e-7 rad.
pub const MAX_FALL_ROW_RADIUS: f64 = 100.0;

/// Radius at which a camera that falls stops, units of r_s: the smallest in the built-in atlas.
pub const FALL_END: f64 = 0.01;

/// Position, motion, orientation and picture size of a camera as a user gives them. Angles are in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Radius in units of r_s: above 1 at rest, above 1.5 in orbit, any in free fall.
    pub radius: f64,
    /// Motion of the camera.
    pub motion: Motion,
    /// Heading of the tangential part of the motion, from east (growing longitude) towards north.
    pub heading_deg: f64,
    /// Longitude of the camera around the hole. At 0 the direction to the hole is −Z of the sky frame.
    pub orbit_deg: f64,
    /// Latitude of the camera around the hole.
    pub latitude_deg: f64,
    /// Rotation of the view to the right, away from the hole.
    pub yaw_deg: f64,
    /// Rotation of the view upwards, away from the hole.
    pub pitch_deg: f64,
    /// Clockwise roll of the camera.
    pub roll_deg: f64,
    /// What the picture shows of all directions.
    pub projection: Projection,
    /// Horizontal field of view.
    pub fov_deg: f64,
    /// Width of the picture, pixels.
    pub width: u32,
    /// Height of the picture, pixels.
    pub height: u32,
}

impl Default for View {
    /// The first view of the 2022 report (bholetrace): r = 25, field of view 90°, looking at the hole.
    fn default() -> Self {
        View {
            radius: 25.0,
            motion: Motion::Rest,
            heading_deg: 0.0,
            orbit_deg: 0.0,
            latitude_deg: 0.0,
            yaw_deg: 0.0,
            pitch_deg: 0.0,
            roll_deg: 0.0,
            projection: Projection::Perspective,
            fov_deg: 90.0,
            width: 1920,
            height: 1080,
        }
    }
}
