use thiserror::Error;

/// Why an OpenEXR file is not read. Each message is one line, to follow the file's name.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ExrError {
    /// What the library `exr` said.
    #[error("{0}")]
    Decoder(String),
    /// The library `exr` panicked, as it does on some damage.
    #[error("it is damaged")]
    Panic,
    /// No layer to read.
    #[error("no layer has the channels R, G and B; save it as RGB")]
    NoRgb,
    /// An encoding that the library does not have.
    #[error("it is compressed with HTJ2K, which is not read here; save it with ZIP compression")]
    Unknown,
    /// An encoding that changes the pixels, where that does not do.
    #[error("it is compressed with {0}, which changes the values; save it with ZIP compression")]
    Lossy(String),
    /// More pixels than are read.
    #[error("its data window has {width} x {height} pixels; at most {max} pixels are read")]
    TooLarge {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// The most pixels allowed.
        max: u64,
    },
    /// More bytes in one chunk than are read.
    #[error(
        "one of its chunks has {found} bytes of pixels; at most {max} are read, so save it as scan \
         lines or with smaller tiles"
    )]
    LargeChunk {
        /// By the header.
        found: u64,
        /// The most allowed.
        max: u64,
    },
    /// The file ends before its table of chunks does.
    #[error("it ends inside its table of chunks: truncated")]
    Table,
    /// A chunk that cannot be where or what the file says.
    #[error("its chunk {index} {problem}: truncated or damaged")]
    Chunk {
        /// Which one, in the order of the table.
        index: usize,
        /// What is wrong with it.
        problem: &'static str,
    },
}

impl From<exr::error::Error> for ExrError {
    fn from(error: exr::error::Error) -> Self {
        let line: Vec<_> = error
            .to_string()
            .split_whitespace()
            .map(str::to_owned)
            .collect();
        ExrError::Decoder(line.join(" "))
    }
}
