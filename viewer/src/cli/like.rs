//! The options that the picture of `viewer render --like` records.

use super::recorded::{ATTRIBUTE, PROGRAM, RecordVersion, RecordedOptions, VERSION};
use super::values;
use clap::ArgMatches;
use lensbake_render::picture::PictureFormat;
use lensbake_render::sky::SkySource;
use lensbake_tables::exr_guard::{ExrError, text_attribute};
use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Most bytes that are read of a picture. The header of those that `viewer render` writes takes two thousand.
const HEADER_BYTES: u64 = 1 << 20;
/// The first bytes of an OpenEXR file.
const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// Why a picture cannot be drawn like another. Each message is one line.
#[derive(Debug, Error)]
pub enum LikeError {
    /// The file cannot be opened or read.
    #[error("--like {}: cannot be read ({cause}); check the path and its permissions", file.display())]
    Unreadable {
        /// The picture.
        file: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// The file is no OpenEXR picture, or its header is damaged.
    #[error("--like {}: not a readable OpenEXR picture ({cause})", file.display())]
    NotAPicture {
        /// The picture.
        file: PathBuf,
        /// What is wrong.
        cause: ExrError,
    },
    /// The header does not end where it should.
    #[error("--like {}: its header is damaged, or longer than {HEADER_BYTES} bytes", file.display())]
    Header {
        /// The picture.
        file: PathBuf,
    },
    /// The picture has no record of options.
    #[error(
        "--like {}: records no options (attribute {ATTRIBUTE}); name an .exr as `viewer render` has written it",
        file.display()
    )]
    NoRecord {
        /// The picture.
        file: PathBuf,
    },
    /// The record cannot be decoded.
    #[error("--like {}: its options (attribute {ATTRIBUTE}) are damaged: {cause}", file.display())]
    Damaged {
        /// The picture.
        file: PathBuf,
        /// What is wrong.
        cause: serde_json::Error,
    },
    /// The record is of a newer version.
    #[error(
        "--like {}: written by viewer {}, whose record of options viewer {PROGRAM} cannot read; use that version",
        file.display(), program.escape_debug()
    )]
    Newer {
        /// The picture.
        file: PathBuf,
        /// Version of the program that wrote it.
        program: String,
    },
    /// The record has an option that this program does not have.
    #[error(
        "--like {}: drawn with --{} by viewer {}; viewer {PROGRAM} has no such option",
        file.display(), option.escape_debug(), program.escape_debug()
    )]
    Unknown {
        /// The picture.
        file: PathBuf,
        /// Name of the option.
        option: String,
        /// Version of the program that wrote it.
        program: String,
    },
    /// A file that the picture was drawn with is not there.
    #[error(
        "--like {}: drawn with --{option} {}, which is not there; name another with --{option}",
        file.display(), value.escape_debug()
    )]
    Missing {
        /// The picture.
        file: PathBuf,
        /// Name of the option.
        option: &'static str,
        /// Its value.
        value: String,
    },
    /// The recorded options cannot be used.
    #[error("--like {}: {line}", file.display())]
    Options {
        /// The picture.
        file: PathBuf,
        /// What is wrong with which option.
        line: String,
    },
}

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
    let file = file.to_owned();
    match text_attribute(&bytes, ATTRIBUTE) {
        Ok(Some(record)) => Ok(record),
        Ok(None) => Err(LikeError::NoRecord { file }),
        Err(_) if bytes.len() as u64 == HEADER_BYTES && bytes.starts_with(&MAGIC) => {
            Err(LikeError::Header { file })
        }
        Err(cause) => Err(LikeError::NotAPicture { file, cause }),
    }
}
