use std::io;
use std::path::PathBuf;

/// Why a sky cannot be made from the given pictures. Each message is one line.
#[derive(Debug, thiserror::Error)]
pub enum SkyError {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read ({cause}); check the path and its permissions", path.display())]
    Unreadable {
        /// The picture file.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// The content is not a picture of a known format, or is damaged.
    #[error(
        "{}: not a usable picture ({cause}); give an undamaged PNG, JPEG, Radiance HDR or OpenEXR \
         file",
        path.display()
    )]
    NotAPicture {
        /// The picture file.
        path: PathBuf,
        /// What the decoder said, in one line.
        cause: String,
    },
    /// A panorama that is not twice as wide as high.
    #[error(
        "{}: the panorama has {width}x{height} pixels; it must be twice as wide as high, so crop \
         or scale it",
        path.display()
    )]
    NotTwoToOne {
        /// The picture file.
        path: PathBuf,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// A picture with too few pixels.
    #[error(
        "{}: the picture has {width}x{height} pixels; give one of at least \
         {min_width}x{min_height}",
        path.display()
    )]
    TooSmall {
        /// The picture file.
        path: PathBuf,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Smallest width allowed.
        min_width: u32,
        /// Smallest height allowed.
        min_height: u32,
    },
    /// A picture with too many pixels to hold in memory.
    #[error(
        "{}: the picture has {width}x{height} pixels; scale it down to at most \
         {max_width}x{max_height}",
        path.display()
    )]
    TooLarge {
        /// The picture file.
        path: PathBuf,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Largest width allowed.
        max_width: u32,
        /// Largest height allowed.
        max_height: u32,
    },
    /// A cube face that is not square.
    #[error(
        "{}: the cube face has {width}x{height} pixels; crop or scale it to a square",
        path.display()
    )]
    NotSquare {
        /// The picture file.
        path: PathBuf,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// A cube face whose size differs from that of the first one.
    #[error(
        "{}: the cube face is {size} pixels wide but the first face, {}, is {first_size}; scale \
         all six to one size",
        path.display(),
        first.display()
    )]
    UnequalFaces {
        /// The face that differs.
        path: PathBuf,
        /// Its width in pixels.
        size: u32,
        /// The first of the six files.
        first: PathBuf,
        /// Width of the first face in pixels.
        first_size: u32,
    },
    /// A floating-point sample that is not an amount of light: NaN, infinite or negative.
    #[error(
        "{}: the pixel in column {column}, row {row} holds the value {value}; light must be finite \
         and not negative, so clean the picture",
        path.display()
    )]
    NotLight {
        /// The picture file.
        path: PathBuf,
        /// Column from the left, from 0.
        column: u32,
        /// Row from the top, from 0.
        row: u32,
        /// The sample.
        value: f32,
    },
}
