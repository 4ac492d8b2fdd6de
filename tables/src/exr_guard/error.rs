use thiserror::Error;

/// Why an OpenEXR file is not read. Each message is one line, written to follow the name of the file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ExrError {
    /// The error message of the library `exr`.
    #[error("{0}")]
    Decoder(String),
    /// The library `exr` panicked, as it does on some damage.
    #[error("it is damaged")]
    Panic,
    /// No layer has the channels R, G and B.
    #[error("no layer has the channels R, G and B; save it as RGB")]
    NoRgb,
    /// The library does not support the compression.
    #[error("it is compressed with HTJ2K, which is not read here; save it with ZIP compression")]
    Unknown,
    /// The compression is lossy, and only lossless compression is accepted.
    #[error("it is compressed with {0}, which changes the values; save it with ZIP compression")]
    Lossy(String),
    /// The data window has more pixels than the limit.
    #[error("its data window has {width} x {height} pixels; at most {max} pixels are read")]
    TooLarge {
        /// Width in pixels.
        width: usize,
        /// Height in pixels.
        height: usize,
        /// Most pixels allowed.
        max: u64,
    },
    /// A chunk has more bytes of pixels than the limit.
    #[error(
        "one of its chunks has {found} bytes of pixels; at most {max} are read, so save it as scan \
         lines or with smaller tiles"
    )]
    LargeChunk {
        /// Bytes according to the header.
        found: u64,
        /// Most bytes allowed.
        max: u64,
    },
    /// The file ends before its chunk table does.
    #[error("it ends inside its table of chunks: truncated")]
    Table,
    /// The position or the content of a chunk contradicts the file.
    #[error("its chunk {index} {problem}: truncated or damaged")]
    Chunk {
        /// Index of the chunk in the chunk table.
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
