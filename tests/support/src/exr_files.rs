//! Small OpenEXR pictures in every encoding, and the offsets of their fields, for tests that damage them.

use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::LineOrder;
use exr::prelude::{Blocks, Compression, LayerAttributes, Vec2, WritableImage, f16};
use std::io::Cursor;

/// Width of each picture in pixels.
pub const WIDTH: usize = 32;
/// Height of each picture in pixels.
pub const HEIGHT: usize = 16;

/// Every compression that the decoder supports.
pub const COMPRESSIONS: [Compression; 10] = [
    Compression::Uncompressed,
    Compression::RLE,
    Compression::ZIP1,
    Compression::ZIP16,
    Compression::PIZ,
    Compression::PXR24,
    Compression::B44,
    Compression::B44A,
    Compression::DWAA(None),
    Compression::DWAB(None),
];

/// How the samples of a channel are stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Samples {
    /// 16-bit floats.
    Half,
    /// 32-bit floats.
    Float,
    /// 32-bit integers.
    Uint,
}

/// The value of channel `channel` (0 blue, 1 green, 2 red, as the file sorts them) at a pixel.
pub fn value(channel: usize, index: usize) -> f32 {
    let (x, y) = (index % WIDTH, index / WIDTH);
    // Far enough from 0 that the error of a lossy encoding makes no negative light.
    (8 + (x * (channel + 1) + 3 * y) % 29) as f32
}

/// A picture of 32 x 16 pixels in this encoding, as a file's bytes.
///
/// # Panics
/// If it cannot be encoded.
pub fn picture(compression: Compression, blocks: Blocks, samples: Samples) -> Vec<u8> {
    let values = |channel| (0..WIDTH * HEIGHT).map(move |index| value(channel, index));
    let channel = |name: &str, channel: usize| {
        AnyChannel::new(
            name,
            match samples {
                Samples::Half => FlatSamples::F16(values(channel).map(f16::from_f32).collect()),
                Samples::Float => FlatSamples::F32(values(channel).collect()),
                Samples::Uint => FlatSamples::U32(values(channel).map(|v| v as u32).collect()),
            },
        )
    };
    let channels = vec![channel("B", 0), channel("G", 1), channel("R", 2)];
    let channels = AnyChannels::sort(channels.into());
    let encoding = Encoding {
        compression,
        blocks,
        line_order: LineOrder::Increasing,
    };
    let attributes = LayerAttributes::named("sky");
    let layer = Layer::new(Vec2(WIDTH, HEIGHT), attributes, encoding, channels);
    let mut file = Cursor::new(Vec::new());
    let image = Image::from_layer(layer);
    image.write().non_parallel().to_buffered(&mut file).unwrap();
    file.into_inner()
}

/// Offset of the value of an attribute.
///
/// # Panics
/// If the file has no such attribute.
pub fn attribute(file: &[u8], name: &str) -> usize {
    let (_, at) = attributes(file)
        .into_iter()
        .find(|(found, _)| found == name)
        .unwrap();
    at
}

/// Offset of the first chunk, from the first entry of the table of chunks after the header.
///
/// # Panics
/// If the file ends before it.
pub fn first_chunk(file: &[u8]) -> usize {
    let table = table_of_chunks(file);
    u64::from_le_bytes(file[table..table + 8].try_into().unwrap()) as usize
}

/// Offset of the table of chunks.
///
/// # Panics
/// If the file ends before it.
pub fn table_of_chunks(file: &[u8]) -> usize {
    let (_, last) = attributes(file).pop().unwrap();
    last + 1
}

/// Names of the attributes and offsets of their values; the last entry is the end of the header.
fn attributes(file: &[u8]) -> Vec<(String, usize)> {
    let text_end = |from: usize| from + file[from..].iter().position(|&b| b == 0).unwrap();
    let mut found = Vec::new();
    let mut at = 8;
    while file[at] != 0 {
        let name_end = text_end(at);
        let size_at = text_end(name_end + 1) + 1;
        let size = u32::from_le_bytes(file[size_at..size_at + 4].try_into().unwrap()) as usize;
        let name = String::from_utf8(file[at..name_end].to_vec()).unwrap();
        found.push((name, size_at + 4));
        at = size_at + 4 + size;
    }
    found.push((String::new(), at));
    found
}

/// The file with `bytes` in place of its own at `at`.
///
/// # Panics
/// If it is too short.
pub fn with(mut file: Vec<u8>, at: usize, bytes: &[u8]) -> Vec<u8> {
    file[at..at + bytes.len()].copy_from_slice(bytes);
    file
}
