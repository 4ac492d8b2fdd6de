//! The options that the picture of `viewer render --like` records.

mod error;
#[cfg(test)]
mod tests;

pub use error::LikeError;

use super::recorded::{ATTRIBUTE, RecordVersion, RecordedOptions, VERSION};
use super::values;
use clap::ArgMatches;
use clap::parser::ValueSource;
use lensbake_render::picture::PictureFormat;
use lensbake_render::sky::SkySource;
use lensbake_tables::exr_guard::text_attribute;
use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Most bytes that are read of a picture. The header of those that `viewer render` writes takes two thousand.
const HEADER_BYTES: u64 = 1 << 20;
/// The first bytes of an OpenEXR file.
const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The options of an earlier picture.
#[derive(Debug)]
pub struct Inherited {
    file: PathBuf,
    recorded: RecordedOptions,
}

impl Inherited {
    /// The options that the picture `file` records.
    ///
    /// # Errors
    /// [`LikeError`] if it records none that this program can read.
    pub fn read(file: &Path) -> Result<Self, LikeError> {
        let record = record(file)?;
        let damaged = |cause| LikeError::Damaged {
            file: file.to_owned(),
            cause,
        };
        let RecordVersion { version, program } = serde_json::from_str(&record).map_err(damaged)?;
        if version > VERSION {
            let file = file.to_owned();
            return Err(LikeError::Newer { file, program });
        }
        Ok(Inherited {
            file: file.to_owned(),
            recorded: serde_json::from_str(&record).map_err(damaged)?,
        })
    }

    /// The arguments for the options that `given` neither sets nor excludes.
    ///
    /// # Errors
    /// [`LikeError::Unknown`], and [`LikeError::Missing`] for a file among their values that is not there.
    pub fn beside(mut self, given: &ArgMatches) -> Result<Vec<OsString>, LikeError> {
        // Only an .exr has layers, and who asks for another format by name wants the picture alone.
        let output = given.get_one::<PathBuf>("output");
        let is_exr = output.is_some_and(|output| {
            PictureFormat::of(output, PictureFormat::ALL).ok() == Some(PictureFormat::OpenExr)
        });
        if !is_exr {
            self.recorded.options.remove("aov");
        }
        // The kind of passes is for the recorded device; the CPU has none.
        if given.value_source("device") == Some(ValueSource::CommandLine) {
            self.recorded.options.remove("pass");
        }
        // Another projection has another shape and another field of view.
        if given.value_source("projection") == Some(ValueSource::CommandLine) {
            for option in ["size", "fov", "tilt"] {
                self.recorded.options.remove(option);
            }
        }
        let arguments = self.recorded.arguments(given);
        let arguments = arguments.map_err(|option| LikeError::Unknown {
            file: self.file.clone(),
            option,
            program: self.recorded.program.clone(),
        })?;
        self.check_files(&arguments)?;
        Ok(arguments)
    }

    /// Checks that the files that `arguments` name are there.
    fn check_files(&self, arguments: &[OsString]) -> Result<(), LikeError> {
        for (option, is_there) in FILE_OPTIONS {
            let prefix = format!("--{option}=");
            let values = arguments.iter().filter_map(|argument| argument.to_str());
            for value in values.filter_map(|argument| argument.strip_prefix(&prefix)) {
                if !is_there(value) {
                    return Err(LikeError::Missing {
                        file: self.file.clone(),
                        option,
                        value: value.to_owned(),
                    });
                }
            }
        }
        Ok(())
    }
}

/// Whether what a value of an option names is there.
type IsThere = fn(&str) -> bool;

/// The options whose values name files.
const FILE_OPTIONS: [(&str, IsThere); 3] = [
    ("table", |path| Path::new(path).exists()),
    ("sky", |sky| {
        let files = |sky: SkySource| sky.files().iter().all(|file| file.exists());
        values::sky(sky.into()).is_ok_and(files)
    }),
    ("stars", |stars| values::stars(stars.into()).is_ok()),
];

/// The record of options in the header of the picture `file`.
fn record(file: &Path) -> Result<String, LikeError> {
    let mut bytes = Vec::new();
    File::open(file)
        .and_then(|opened| opened.take(HEADER_BYTES).read_to_end(&mut bytes))
        .map_err(|cause| LikeError::Unreadable {
            file: file.to_owned(),
            cause,
        })?;
    record_in(file.to_owned(), &bytes)
}

/// The record in the first `bytes` of the picture `file`.
fn record_in(file: PathBuf, bytes: &[u8]) -> Result<String, LikeError> {
    match text_attribute(bytes, ATTRIBUTE) {
        Ok(Some(record)) => Ok(record),
        Ok(None) => Err(LikeError::NoRecord { file }),
        Err(_) if bytes.len() as u64 == HEADER_BYTES && bytes.starts_with(&MAGIC) => {
            Err(LikeError::Header { file })
        }
        Err(cause) => Err(LikeError::NotAPicture { file, cause }),
    }
}
