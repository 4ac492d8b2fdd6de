//! Why a film cannot be made.

use lensbake_film::{
    ClockError, FrameNamesError, FrameRangeError, PathError, PathFileError, ReadyPathError,
    ShutterError,
};
use std::path::PathBuf;
use thiserror::Error;

/// Why a film cannot be made.
#[derive(Debug, Error)]
pub enum FilmError {
    /// The file of the path is wrong.
    #[error(transparent)]
    File(#[from] PathFileError),
    /// The ready path cannot have this radius.
    #[error("--radius: {0}")]
    Radius(#[from] ReadyPathError),
    /// The ready path is wrong.
    #[error("--path: {0}")]
    ReadyPath(#[from] PathError),
    /// The film cannot have this length.
    #[error("--seconds: {0}")]
    Seconds(#[from] ClockError),
    /// The path has no length.
    #[error("{}: the path has only the time 0; add a keyframe, or give --seconds", _0.display())]
    NoLength(PathBuf),
    /// The range is not in the film.
    #[error("--frames: {0}")]
    Frames(#[from] FrameRangeError),
    /// The shutter is not valid.
    #[error("--shutter: {0}")]
    Shutter(#[from] ShutterError),
    /// The output names no frames.
    #[error("{0}; or name a video: .mp4, .mkv or .webm")]
    Names(#[from] FrameNamesError),
    /// The video exists.
    #[error("{}: exists already; --overwrite draws it anew", _0.display())]
    VideoExists(PathBuf),
    /// The size has no half.
    #[error("--size {0}x{1}: a video needs an even width and height")]
    OddSize(u32, u32),
    /// ffmpeg is not installed.
    #[error(
        "{}: a video needs the program ffmpeg, which is not installed: get it from https://ffmpeg.org or with your \
         system's packages (apt install ffmpeg), or draw frames: -o %05d.png",
        _0.display()
    )]
    NoFfmpeg(PathBuf),
    /// ffmpeg failed.
    #[error("{}: ffmpeg failed: {message}", video.display())]
    Ffmpeg {
        /// The video.
        video: PathBuf,
        /// Its last message.
        message: String,
    },
}
