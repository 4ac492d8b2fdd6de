//! Decodes OpenEXR pictures to linear light.

use image::Rgb32FImage;
use lensbake_tables::exr_guard::{CheckedExr, ExrError, Limits, RgbBlock, display_size};
use rayon::prelude::*;

use super::memory::zeros;

/// The largest allowed ratio of the data window's area to that of the display window.
const MAX_OVERSCAN: u64 = 4;
/// Largest chunk, bytes: a tile of 8192 x 8192 pixels with four floats each.
const MAX_CHUNK_BYTES: u64 = 1 << 30;

/// The picture in the display window, black where the file has no data. The caller must have checked its size.
pub(super) fn decode(bytes: &[u8]) -> Result<Rgb32FImage, Box<dyn std::error::Error>> {
    let (width, height) = display_size(bytes)?;
    let limits = Limits {
        pixels: MAX_OVERSCAN * u64::from(width) * u64::from(height),
        chunk_bytes: MAX_CHUNK_BYTES,
        lossy: true,
    };
    let file = CheckedExr::open(bytes, &limits)?;
    let samples = zeros(3 * width as usize * height as usize)?;
    let mut image = Rgb32FImage::from_raw(width, height, samples).ok_or("it is too large")?;
    let chunks: Vec<usize> = (0..file.chunk_count()).collect();
    // One chunk per thread at a time, since the pixels of these chunks are in memory twice.
    for some in chunks.chunks(rayon::current_num_threads()) {
        let decoded = some.par_iter().map(|&index| file.rgb_block(index));
        let blocks: Vec<RgbBlock> = decoded.collect::<Result<_, ExrError>>()?;
        for block in &blocks {
            put(&mut image, block, file.offset());
        }
    }
    Ok(image)
}

/// Copies a block to its position in the picture and drops pixels outside the picture.
fn put(image: &mut Rgb32FImage, block: &RgbBlock, offset: (i64, i64)) {
    let (width, height) = (i64::from(image.width()), i64::from(image.height()));
    let left = offset.0 + block.column as i64;
    let top = offset.1 + block.row as i64;
    let samples = image.as_mut();
    for (row, pixels) in (top..).zip(block.pixels.chunks_exact(block.width)) {
        if !(0..height).contains(&row) {
            continue;
        }
        let from = (-left).clamp(0, pixels.len() as i64) as usize;
        let to = (width - left).clamp(from as i64, pixels.len() as i64) as usize;
        let start = (3 * (row * width + left + from as i64)) as usize;
        for (index, pixel) in pixels[from..to].iter().enumerate() {
            samples[start + 3 * index..][..3].copy_from_slice(pixel);
        }
    }
}
