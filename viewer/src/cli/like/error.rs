//! Why the options of a picture cannot be used.

use super::HEADER_BYTES;
use crate::cli::recorded::{ATTRIBUTE, PROGRAM};
use lensbake_tables::exr_guard::ExrError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

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
