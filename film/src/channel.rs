//! What a keyframe can name, apart from time and motion.

use crate::{Keyframe, KeyframeError, KeyframeMotion};
use lensbake_core::MovingFrame;
use lensbake_render::camera::{FALL_END, MAX_RADIUS, View};
use lensbake_render::tone_map::EXPOSURES;

/// A number of the camera that is interpolated through the keyframes that name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channel {
    /// Radius.
    Radius,
    /// Longitude.
    Orbit,
    /// Latitude.
    Latitude,
    /// Heading of an orbit.
    Heading,
    /// Yaw.
    Yaw,
    /// Pitch.
    Pitch,
    /// Roll.
    Roll,
    /// Horizontal field of view.
    Fov,
    /// Exposure.
    Exposure,
    /// Turn of the sky.
    SkyTurn,
    /// Proper time per second.
    ClockRate,
}

/// Largest proper time per second, r_s/c.
const MAX_CLOCK_RATE: f64 = 1e6;
/// Proper time per second where no keyframe has named one, r_s/c.
const CLOCK_RATE: f64 = 1.0;

impl Channel {
    /// All channels, in the order of the keyframe's fields.
    pub const ALL: [Channel; 11] = [
        Channel::Radius,
        Channel::Orbit,
        Channel::Latitude,
        Channel::Heading,
        Channel::Yaw,
        Channel::Pitch,
        Channel::Roll,
        Channel::Fov,
        Channel::Exposure,
        Channel::SkyTurn,
        Channel::ClockRate,
    ];

    /// Those that say where the camera is. The motions `orbit` and `fall` take them from physics.
    pub const PLACE: [Channel; 4] = [
        Channel::Radius,
        Channel::Orbit,
        Channel::Latitude,
        Channel::Heading,
    ];

    /// Name of the keyframe's field in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Channel::Radius => "radius",
            Channel::Orbit => "orbit",
            Channel::Latitude => "latitude",
            Channel::Heading => "heading",
            Channel::Yaw => "yaw",
            Channel::Pitch => "pitch",
            Channel::Roll => "roll",
            Channel::Fov => "fov",
            Channel::Exposure => "exposure",
            Channel::SkyTurn => "sky_turn",
            Channel::ClockRate => "clock_rate",
        }
    }

    /// The value that `keyframe` names.
    pub fn of(self, keyframe: &Keyframe) -> Option<f64> {
        *self.field(&mut { *keyframe })
    }

    /// Makes `keyframe` name a value.
    pub fn set(self, keyframe: &mut Keyframe, value: f64) {
        *self.field(keyframe) = Some(value);
    }

    fn field(self, keyframe: &mut Keyframe) -> &mut Option<f64> {
        match self {
            Channel::Radius => &mut keyframe.radius,
            Channel::Orbit => &mut keyframe.orbit,
            Channel::Latitude => &mut keyframe.latitude,
            Channel::Heading => &mut keyframe.heading,
            Channel::Yaw => &mut keyframe.yaw,
            Channel::Pitch => &mut keyframe.pitch,
            Channel::Roll => &mut keyframe.roll,
            Channel::Fov => &mut keyframe.fov,
            Channel::Exposure => &mut keyframe.exposure,
            Channel::SkyTurn => &mut keyframe.sky_turn,
            Channel::ClockRate => &mut keyframe.clock_rate,
        }
    }

    /// The value before any keyframe names one: that of the default view.
    pub fn default_value(self) -> f64 {
        let view = View::default();
        match self {
            Channel::Radius => view.radius,
            Channel::Fov => view.fov_deg,
            Channel::ClockRate => CLOCK_RATE,
            Channel::Orbit
            | Channel::Latitude
            | Channel::Heading
            | Channel::Yaw
            | Channel::Pitch
            | Channel::Roll
            | Channel::Exposure
            | Channel::SkyTurn => 0.0,
        }
    }

    /// Checks a value that a keyframe names, except that of the radius, which depends on the motion.
    pub(crate) fn check(self, value: f64) -> Result<(), KeyframeError> {
        let (least, most) = match self {
            Channel::Fov if !(value > 0.0 && value < 180.0) => {
                return Err(KeyframeError::FieldOfView(value));
            }
            Channel::Exposure => (f64::from(*EXPOSURES.start()), f64::from(*EXPOSURES.end())),
            Channel::ClockRate => (0.0, MAX_CLOCK_RATE),
            _ => (f64::MIN, f64::MAX),
        };
        match value {
            _ if !value.is_finite() => Err(KeyframeError::NotFinite(value)),
            _ if (least..=most).contains(&value) => Ok(()),
            _ => Err(KeyframeError::Range { value, least, most }),
        }
    }
}

/// Checks that `motion` is possible at `radius`.
pub(crate) fn check_radius(radius: f64, motion: KeyframeMotion) -> Result<(), KeyframeError> {
    if !radius.is_finite() {
        return Err(KeyframeError::NotFinite(radius));
    }
    if radius > MAX_RADIUS {
        return Err(KeyframeError::TooFar(radius));
    }
    if motion == KeyframeMotion::Fall && radius < FALL_END {
        return Err(KeyframeError::BelowTheFall(radius));
    }
    MovingFrame::new(radius, motion.into())?;
    Ok(())
}
