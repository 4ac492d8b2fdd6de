//! Reads untrusted OpenEXR files so that no file can end the program.
//!
//! The library `exr` allocates what a file asks for, and a failed allocation aborts the program
//! (`docs/upstream.md` lists the places). The library's own reader is therefore not used. Its parser reads the
//! header; everything after the header is found and checked here, in the bytes of the file: the chunk table, the
//! position and the size of each chunk, and how many pixels a chunk of that size can hold. Only then is a chunk
//! passed to the library's decompressor, and a panic there becomes an error.

mod chunks;
mod error;
mod expansion;

pub use error::ExrError;

use crate::exr_attributes::decode_text;
use crate::panics::caught;
use chunks::ChunkLocation;
use exr::block::UncompressedBlock;
use exr::block::chunk::{
    Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates,
};
use exr::block::lines::LineRef;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{AttributeValue, Compression, SampleType, Text, Vec2, f16};

/// Limits on the files that are read.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Most pixels in the data window.
    pub pixels: u64,
    /// Most bytes in one decoded chunk.
    pub chunk_bytes: u64,
    /// Whether lossy compression is accepted.
    pub lossy: bool,
}

/// An OpenEXR file in which everything except the compressed pixels has been checked.
#[derive(Debug)]
pub struct CheckedExr<'b> {
    bytes: &'b [u8],
    meta: MetaData,
    layer: usize,
    places: Vec<ChunkLocation>,
}

/// The pixels of one chunk.
#[derive(Debug, Clone, PartialEq)]
pub struct RgbBlock {
    /// Column of its left edge in the data window.
    pub column: usize,
    /// Row of its upper edge in the data window.
    pub row: usize,
    /// Width in pixels.
    pub width: usize,
    /// The pixels (R, G, B), row by row from the top.
    pub pixels: Vec<[f32; 3]>,
}

/// Width and height of the display window: the size of the picture according to its header. Nothing after the
/// header is read.
///
/// # Errors
/// [`ExrError`] if the header cannot be read or no layer has the channels R, G and B.
pub fn display_size(bytes: &[u8]) -> Result<(u32, u32), ExrError> {
    let (meta, _) = headers(bytes)?;
    let layer = &meta.headers[rgb_layer(&meta)?];
    let size = layer.shared_attributes.display_window.size;
    // The parser refuses windows with a side of 2³⁰ or more.
    Ok((size.width() as u32, size.height() as u32))
}

/// The text attribute `name` of the first layer, `None` if there is none. Nothing after the headers is read, and `bytes`
/// may end there.
///
/// # Errors
/// [`ExrError`] if the headers cannot be read.
pub fn text_attribute(bytes: &[u8], name: &str) -> Result<Option<String>, ExrError> {
    let (meta, _) = headers(bytes)?;
    let attributes = meta
        .headers
        .first()
        .map(|header| &header.own_attributes.other);
    match attributes.and_then(|attributes| attributes.get(&Text::from(name))) {
        Some(AttributeValue::Text(text)) => Ok(Some(decode_text(text))),
        _ => Ok(None),
    }
}

impl<'b> CheckedExr<'b> {
    /// Checks the first layer in `bytes` that has the channels R, G and B, at full resolution.
    ///
    /// # Errors
    /// [`ExrError`] says what is wrong or exceeds the `limits`. No size stated in the file is trusted: memory use
    /// is proportional to the length of `bytes`.
    pub fn open(bytes: &'b [u8], limits: &Limits) -> Result<Self, ExrError> {
        let (meta, after_header) = headers(bytes)?;
        let layer = rgb_layer(&meta)?;
        check_encoding(meta.headers[layer].compression, limits)?;
        let places = chunks::chunk_locations(bytes, after_header, &meta, layer, limits)?;
        Ok(CheckedExr {
            bytes,
            meta,
            layer,
            places,
        })
    }

    /// The header of the layer.
    pub(crate) fn header(&self) -> &Header {
        &self.meta.headers[self.layer]
    }

    /// Number of layers in the file.
    pub(crate) fn layer_count(&self) -> usize {
        self.meta.headers.len()
    }

    /// Column and row of the data window's upper left corner in the display window; either may be
    /// negative.
    pub fn offset(&self) -> (i64, i64) {
        let display = self.header().shared_attributes.display_window.position;
        let data = self.header().own_attributes.layer_position;
        let between = |data: i32, display: i32| i64::from(data) - i64::from(display);
        (
            between(data.x(), display.x()),
            between(data.y(), display.y()),
        )
    }

    /// Number of chunks in the data window.
    pub fn chunk_count(&self) -> usize {
        self.places.len()
    }

    /// Decompresses the pixels of a chunk. Integer samples are converted without scaling; alpha and other channels
    /// are ignored.
    ///
    /// # Errors
    /// [`ExrError`] if the compressed pixels are damaged.
    ///
    /// # Panics
    /// If `index` is not below [`CheckedExr::chunk_count`].
    pub fn rgb_block(&self, index: usize) -> Result<RgbBlock, ExrError> {
        let chunk = self.chunk(&self.places[index]);
        caught(|| {
            let block = UncompressedBlock::decompress_chunk(chunk, &self.meta, false)?;
            rgb(&block, self.header())
        })
        .unwrap_or(Err(ExrError::Panic))
    }

    fn chunk(&self, place: &ChunkLocation) -> Chunk {
        let compressed_pixels_le = self.bytes[place.data.clone()].to_vec();
        let compressed_block = match self.header().blocks {
            BlockDescription::ScanLines => CompressedBlock::ScanLine(CompressedScanLineBlock {
                y_coordinate: place.first_line,
                compressed_pixels_le,
            }),
            BlockDescription::Tiles(_) => CompressedBlock::Tile(CompressedTileBlock {
                coordinates: TileCoordinates {
                    tile_index: place.tile,
                    level_index: Vec2(0, 0),
                },
                compressed_pixels_le,
            }),
        };
        Chunk {
            layer_index: self.layer,
            compressed_block,
        }
    }
}

/// The headers, and the offset in the file at which they end.
fn headers(bytes: &[u8]) -> Result<(MetaData, usize), ExrError> {
    caught(|| {
        let mut rest = bytes;
        let meta = MetaData::read_from_buffered(&mut rest, false)?;
        MetaData::validate(&meta.headers, false)?;
        Ok((meta, bytes.len() - rest.len()))
    })
    .unwrap_or(Err(ExrError::Panic))
}

/// Index of the first layer with the channels R, G and B.
fn rgb_layer(meta: &MetaData) -> Result<usize, ExrError> {
    let has = |header: &Header, name: &str| {
        let found = header.channels.find_index_of_channel(&Text::from(name));
        found.is_some()
    };
    let is_rgb = |header: &Header| ["R", "G", "B"].iter().all(|name| has(header, name));
    meta.headers.iter().position(is_rgb).ok_or(ExrError::NoRgb)
}

fn check_encoding(compression: Compression, limits: &Limits) -> Result<(), ExrError> {
    match compression {
        Compression::HTJ2K32 | Compression::HTJ2K256 => Err(ExrError::Unknown),
        _ if compression.may_loose_data() && !limits.lossy => {
            Err(ExrError::Lossy(compression.to_string()))
        }
        _ => Ok(()),
    }
}

/// R, G and B of a decompressed chunk.
fn rgb(block: &UncompressedBlock, header: &Header) -> Result<RgbBlock, ExrError> {
    let channels = &header.channels;
    let place = |name| channels.find_index_of_channel(&Text::from(name));
    let places = ["R", "G", "B"].map(place);
    let (width, height) = (block.index.pixel_size.x(), block.index.pixel_size.y());
    let mut pixels = vec![[0.0; 3]; width * height];
    for line in block.lines(channels) {
        let index = line.location.channel;
        let Some(colour) = places.iter().position(|&place| place == Some(index)) else {
            continue;
        };
        let start = (line.location.position.y() - block.index.pixel_position.y()) * width;
        let pixels = pixels[start..start + width].iter_mut();
        let into = pixels.map(|pixel| &mut pixel[colour]);
        read_line(&line, channels.list[index].sample_type, into)?;
    }
    Ok(RgbBlock {
        column: block.index.pixel_position.x(),
        row: block.index.pixel_position.y(),
        width,
        pixels,
    })
}

fn read_line<'p>(
    line: &LineRef<'_>,
    samples: SampleType,
    into: impl Iterator<Item = &'p mut f32>,
) -> Result<(), ExrError> {
    match samples {
        SampleType::F16 => fill(into, line.read_samples::<f16>(), f16::to_f32),
        SampleType::F32 => fill(into, line.read_samples::<f32>(), |sample| sample),
        SampleType::U32 => fill(into, line.read_samples::<u32>(), |sample| sample as f32),
    }
}

fn fill<'p, T>(
    into: impl Iterator<Item = &'p mut f32>,
    samples: impl Iterator<Item = exr::error::Result<T>>,
    to_float: impl Fn(T) -> f32,
) -> Result<(), ExrError> {
    for (value, sample) in into.zip(samples) {
        *value = to_float(sample?);
    }
    Ok(())
}
