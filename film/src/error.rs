//! What can be wrong with a path. Every message is one line and names the keyframe and the field.

use crate::KeyframeMotion;
use lensbake_core::CoreError;
use lensbake_render::camera::{FALL_END, MAX_RADIUS};
use thiserror::Error;

/// Why a path cannot be flown.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PathError {
    /// The text is not the JSON of a path, where no field is to blame.
    #[error("{0}")]
    Json(String),
    /// A field of the JSON is unknown or has a value of a wrong type.
    #[error("{field}: {problem}")]
    Field {
        /// The field, such as `keyframes[2].radius`.
        field: String,
        /// What is wrong.
        problem: String,
    },
    /// There are no keyframes.
    #[error("keyframes: the path has none")]
    NoKeyframes,
    /// The times do not grow.
    #[error(
        "keyframes[{index}].time: {time} is not after {before}, the time of the keyframe before"
    )]
    TimeNotAfter {
        /// Index of the keyframe.
        index: usize,
        /// Its time, s.
        time: f64,
        /// The time of the keyframe before, s.
        before: f64,
    },
    /// Two keyframes have the same time.
    #[error("keyframes[{index}].time: two keyframes are at {time}")]
    SameTime {
        /// Index of the later keyframe.
        index: usize,
        /// The time, s.
        time: f64,
    },
    /// A time is negative or too large.
    #[error("keyframes[{index}].time: {time} is not from 0 to {MAX_TIME} seconds")]
    Time {
        /// Index of the keyframe.
        index: usize,
        /// Its time.
        time: f64,
    },
    /// A value of a keyframe is not possible.
    #[error("keyframes[{index}].{field}: {problem}")]
    Keyframe {
        /// Index of the keyframe.
        index: usize,
        /// The field.
        field: &'static str,
        /// What is wrong.
        problem: KeyframeError,
    },
}

/// Largest time of a keyframe, s.
pub(crate) const MAX_TIME: f64 = 1e6;

/// What is wrong with a value of a keyframe.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum KeyframeError {
    /// Not a finite number.
    #[error("{0} is not a finite number")]
    NotFinite(f64),
    /// Out of range.
    #[error("{value} is not from {least} to {most}")]
    Range {
        /// The value.
        value: f64,
        /// The least possible one.
        least: f64,
        /// The largest possible one.
        most: f64,
    },
    /// The field of view is not between 0° and 180°.
    #[error("{0} is not between 0 and 180 degrees (both excluded)")]
    FieldOfView(f64),
    /// The radius is too large for a camera.
    #[error("{0} is too far: the radius must be at most {MAX_RADIUS:e}")]
    TooFar(f64),
    /// The radius is below that at which a fall ends.
    #[error("{0} is below {FALL_END}, where a fall ends")]
    BelowTheFall(f64),
    /// The motion is not possible at this radius.
    #[error(transparent)]
    Impossible(#[from] CoreError),
    /// The value follows from physics.
    #[error(
        "leave it out: it follows from the motion {} of keyframes[{since}]; or name a motion as well, to start anew",
        motion.name()
    )]
    FollowsFromMotion {
        /// The motion.
        motion: KeyframeMotion,
        /// Index of the keyframe that named it.
        since: usize,
    },
    /// The camera arrives here at a radius at which the motion is not possible.
    #[error("the camera gets here at the radius {radius:.4}, where the motion {} is not possible; name a radius as well", motion.name())]
    ArrivesTooLow {
        /// The radius.
        radius: f64,
        /// The motion.
        motion: KeyframeMotion,
    },
}
