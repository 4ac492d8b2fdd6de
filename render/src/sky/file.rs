//! A picture file: its bytes, its format and the size that its header declares.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use image::{ImageFormat, ImageReader};
use lensbake_tables::exr_guard;
use lensbake_tables::panics::caught;

use super::SkyError;

/// Largest picture file, bytes: the largest picture allowed with four floats per pixel takes 2 GiB.
const MAX_BYTES: u64 = 4 << 30;
/// Number of bytes that suffice to recognise a format.
const SIGNATURE: u64 = 16;

/// A picture file in memory.
pub(super) struct PictureFile {
    path: PathBuf,
    format: ImageFormat,
    bytes: Vec<u8>,
}

impl PictureFile {
    /// Reads the file at `path`. Stops after the first bytes if they are not those of a known picture format.
    pub(super) fn read(path: &Path) -> Result<Self, SkyError> {
        let unreadable = |cause| SkyError::Unreadable {
            path: path.to_owned(),
            cause,
        };
        let mut file = File::open(path).map_err(unreadable)?;
        let mut bytes = Vec::new();
        let mut read = |most| (&mut file).take(most).read_to_end(&mut bytes);
        read(SIGNATURE).map_err(unreadable)?;
        format(path, &bytes)?;
        // A regular file has a length, which is reserved at once. If that fails, reading reports the error.
        if let Ok(metadata) = file.metadata() {
            let length = metadata.len().min(MAX_BYTES) as usize;
            let _ = bytes.try_reserve_exact(length.saturating_sub(bytes.len()));
        }
        let mut read = |most| (&mut file).take(most).read_to_end(&mut bytes);
        read(MAX_BYTES + 1 - SIGNATURE).map_err(unreadable)?;
        Self::of(path, bytes)
    }

    /// The picture file with these bytes. Errors name `path`, which is not opened.
    pub(super) fn of(path: &Path, bytes: Vec<u8>) -> Result<Self, SkyError> {
        let format = format(path, &bytes)?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(not_a_picture(path, "it is longer than 4 GiB"));
        }
        Ok(PictureFile {
            path: path.to_owned(),
            format,
            bytes,
        })
    }

    /// The path that errors name.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Width and height in pixels that its header declares. Of a PNG only the first chunk is read: a colour
    /// profile in a later one may take any amount of memory.
    pub(super) fn size(&self) -> Result<(u32, u32), SkyError> {
        match self.format {
            ImageFormat::OpenExr => {
                exr_guard::display_size(&self.bytes).map_err(|error| self.unusable(error))
            }
            ImageFormat::Png => {
                png_size(&self.bytes).ok_or_else(|| self.unusable("its header is damaged"))
            }
            _ => self.caught(|| self.reader().into_dimensions()),
        }
    }

    /// Its format, recognised by content.
    pub(super) fn format(&self) -> ImageFormat {
        self.format
    }

    /// Its bytes.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// A reader of the `image` library at the first byte, without limits.
    pub(super) fn reader(&self) -> ImageReader<Cursor<&[u8]>> {
        let mut reader = ImageReader::with_format(Cursor::new(self.bytes.as_slice()), self.format);
        reader.no_limits();
        reader
    }

    /// Runs `decode` and returns its result, or this file's error if it fails or panics.
    pub(super) fn caught<T, E: ToString>(
        &self,
        decode: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, SkyError> {
        match caught(decode) {
            Some(result) => result.map_err(|error| self.unusable(error)),
            None => Err(self.unusable("it is damaged")),
        }
    }

    /// The error that this file is not usable, with its `cause`.
    pub(super) fn unusable(&self, cause: impl ToString) -> SkyError {
        not_a_picture(&self.path, cause)
    }
}

fn format(path: &Path, bytes: &[u8]) -> Result<ImageFormat, SkyError> {
    image::guess_format(bytes).map_err(|error| not_a_picture(path, error))
}

/// Width and height in a PNG's first chunk: signature, chunk length and name, then two big-endian words.
fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let header = bytes.get(8..24)?;
    let word = |at: usize| Some(u32::from_be_bytes(header.get(at..at + 4)?.try_into().ok()?));
    (header[4..8] == *b"IHDR").then_some(())?;
    Some((word(8)?, word(12)?))
}

fn not_a_picture(path: &Path, cause: impl ToString) -> SkyError {
    let cause = cause.to_string();
    SkyError::NotAPicture {
        path: path.to_owned(),
        cause: cause.split_whitespace().collect::<Vec<_>>().join(" "),
    }
}
