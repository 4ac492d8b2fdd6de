//! A video, which ffmpeg encodes: frames go to its standard input.

use super::super::CommandError;
use super::{FilmError, spare_inputs};
use crate::cli::FilmArgs;
use lensbake_film::FrameRate;
use lensbake_program::output::{Output, Staged};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};

/// The program that encodes.
const FFMPEG: &str = "ffmpeg";

/// A container of videos.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum VideoFormat {
    Mp4,
    Matroska,
    WebM,
}

impl VideoFormat {
    /// The format of the file extension of `path`, if it is that of a video.
    pub(super) fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "mp4" => Some(VideoFormat::Mp4),
            "mkv" => Some(VideoFormat::Matroska),
            "webm" => Some(VideoFormat::WebM),
            _ => None,
        }
    }

    /// Options of ffmpeg for its codec.
    fn codec(self) -> &'static [&'static str] {
        match self {
            VideoFormat::Mp4 => &["-c:v", "libx264", "-crf", "17", "-movflags", "+faststart"],
            VideoFormat::Matroska => &["-c:v", "libx264", "-crf", "17"],
            VideoFormat::WebM => &["-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"],
        }
    }
}

/// Colours as players expect them: those of high-definition video, which are also those of sRGB.
const COLOUR: [&str; 10] = [
    "-vf",
    "scale=out_color_matrix=bt709:out_range=tv",
    "-pix_fmt",
    "yuv420p",
    "-colorspace",
    "bt709",
    "-color_primaries",
    "bt709",
    "-color_trc",
    "bt709",
];

/// A video that is being encoded, into a temporary file until it is finished.
pub(super) struct Video {
    path: PathBuf,
    running: Mutex<Option<Running>>,
}

struct Running {
    ffmpeg: Child,
    frames: ChildStdin,
    messages: JoinHandle<String>,
    staged: Staged,
}

impl Video {
    /// Starts ffmpeg for the video at `path`.
    pub(super) fn new(
        path: &Path,
        format: VideoFormat,
        rate: FrameRate,
        args: &FilmArgs,
    ) -> Result<Self, CommandError> {
        let (width, height) = args.size();
        if width % 2 != 0 || height % 2 != 0 {
            return Err(FilmError::OddSize(width, height).into());
        }
        if path.exists() && !args.overwrite {
            return Err(FilmError::VideoExists(path.to_owned()).into());
        }
        let output = Output::new(path)?;
        spare_inputs(&output, args)?;
        let staged = output.stage()?;
        let mut command = Command::new(FFMPEG);
        command
            .args([
                "-hide_banner",
                "-loglevel",
                "error",
                "-y",
                "-f",
                "rawvideo",
                "-pix_fmt",
                "rgb24",
                "-video_size",
            ])
            .arg(format!("{width}x{height}"))
            .args(["-framerate", &rate.to_string(), "-i", "-", "-an"])
            .args(format.codec())
            .args(COLOUR)
            .arg(staged.path());
        let running = Running::start(command, staged).map_err(|error| match error.kind() {
            ErrorKind::NotFound => FilmError::NoFfmpeg(path.to_owned()),
            _ => FilmError::Ffmpeg {
                video: path.to_owned(),
                message: error.to_string(),
            },
        })?;
        Ok(Video {
            path: path.to_owned(),
            running: Mutex::new(Some(running)),
        })
    }

    pub(super) fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// Appends a frame.
    pub(super) fn write(&self, pixels: &[[u8; 3]]) -> Result<(), FilmError> {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        let written = match running.as_mut() {
            Some(running) => running.frames.write_all(pixels.as_flattened()),
            None => Err(ErrorKind::BrokenPipe.into()),
        };
        written.map_err(|error| {
            // If ffmpeg has ended, it has said why.
            let said = running.take().and_then(|running| running.end().err());
            self.failed(said.unwrap_or_else(|| error.to_string()))
        })
    }

    /// Waits for ffmpeg, and lets the video take its place.
    pub(super) fn finish(&self) -> Result<(), CommandError> {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(running) = running.take() else {
            return Ok(());
        };
        let staged = running.end().map_err(|message| self.failed(message))?;
        Ok(staged.commit()?)
    }

    fn failed(&self, message: String) -> FilmError {
        FilmError::Ffmpeg {
            video: self.path.clone(),
            message,
        }
    }
}

impl Drop for Video {
    /// Ends ffmpeg if the film was not finished; its temporary file is removed.
    fn drop(&mut self) {
        let running = self
            .running
            .get_mut()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(mut running) = running.take() {
            // It may have ended by itself.
            let _ = running.ffmpeg.kill();
            let _ = running.ffmpeg.wait();
        }
    }
}

impl Running {
    fn start(mut command: Command, staged: Staged) -> std::io::Result<Self> {
        let command = command
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        let mut ffmpeg = command.spawn()?;
        let frames = ffmpeg.stdin.take().ok_or(ErrorKind::BrokenPipe)?;
        let mut errors = ffmpeg.stderr.take().ok_or(ErrorKind::BrokenPipe)?;
        let messages = thread::spawn(move || {
            let mut text = Vec::new();
            // What could not be read is not reported either.
            let _ = errors.read_to_end(&mut text);
            String::from_utf8_lossy(&text).into_owned()
        });
        Ok(Running {
            ffmpeg,
            frames,
            messages,
            staged,
        })
    }

    /// Closes the input and waits. Returns the file, or the last message if ffmpeg failed.
    fn end(self) -> Result<Staged, String> {
        let Running {
            mut ffmpeg,
            frames,
            messages,
            staged,
        } = self;
        drop(frames);
        let status = ffmpeg.wait().map_err(|error| error.to_string())?;
        let said = messages.join().unwrap_or_default();
        if status.success() {
            return Ok(staged);
        }
        let last = said.lines().map(str::trim).rfind(|line| !line.is_empty());
        Err(last.map_or_else(|| status.to_string(), str::to_owned))
    }
}
