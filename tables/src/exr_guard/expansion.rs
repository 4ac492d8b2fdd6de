//! Upper bounds on the size of decompressed data. Only damaged files claim more.

use exr::prelude::Compression;

/// Most bytes of pixels that a chunk of `length` bytes can hold.
pub(super) fn most_bytes(compression: Compression, length: usize) -> u64 {
    use Compression::*;
    let a_byte = match compression {
        Uncompressed => 1,
        // Two bytes encode up to 128.
        RLE => 64,
        // Deflate: two bits encode up to 258 bytes.
        ZIP1 | ZIP16 => 1032,
        // Deflate, and three bytes encode a float of four.
        PXR24 => 1032 * 4 / 3,
        // Huffman: one bit and a count of eight bits encode up to 255 samples of two bytes.
        PIZ => 255 * 2 * 8 / 9 + 1,
        // Three bytes encode 16 samples of two bytes.
        B44 | B44A => 11,
        // Deflate, and one coefficient of two bytes encodes a block of 8 x 8 samples of four bytes.
        DWAA(_) | DWAB(_) => 1032 * 128,
        HTJ2K32 | HTJ2K256 => 0,
    };
    length as u64 * a_byte
}

/// The size of the pixels of a chunk.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// Width in pixels.
    pub width: u64,
    /// Height in pixels.
    pub height: u64,
    /// Number of channels.
    pub channels: u64,
    /// Size of the pixels in bytes.
    pub bytes: u64,
}

const DWA_COUNTERS: usize = 11;
const DWA_VERSION: u64 = 2;

/// Checks the eleven counters at the start of a DWA chunk against what a chunk of this extent can need. Each is a
/// little-endian integer of eight bytes: version; raw and compressed size of the deflated channels; compressed
/// sizes of the AC coefficients, the DC coefficients and the run lengths; size of the run lengths and of the data
/// that they encode; number of AC and of DC coefficients; coding of the AC coefficients.
pub(super) fn check_dwa(chunk: &[u8], extent: Extent) -> Result<(), &'static str> {
    let counters = chunk
        .get(..8 * DWA_COUNTERS)
        .ok_or("is shorter than its counters")?;
    let counter = |index: usize| {
        let eight = &counters[8 * index..8 * index + 8];
        eight
            .iter()
            .rev()
            .fold(0, |number, &byte| number << 8 | u64::from(byte))
    };
    let blocks = extent.width.div_ceil(8) * extent.height.div_ceil(8) * extent.channels;
    let length = chunk.len() as u64;
    // For short runs, the run lengths take up to half as much again as the data that they encode.
    let run_lengths = 2 * extent.bytes;
    let most = [
        DWA_VERSION,
        extent.bytes,
        length,
        length,
        length,
        length,
        run_lengths,
        extent.bytes,
        63 * blocks,
        blocks,
        1,
    ];
    for (index, most) in most.into_iter().enumerate() {
        if counter(index) > most {
            return Err("counts more than its pixels need");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXTENT: Extent = Extent {
        width: 20,
        height: 32,
        channels: 3,
        bytes: 20 * 32 * 6,
    };

    fn chunk(counters: [u64; 11]) -> Vec<u8> {
        let bytes = counters.map(u64::to_le_bytes).concat();
        [bytes, vec![0; 200]].concat()
    }

    #[test]
    fn the_counters_that_a_chunk_needs_are_let_through_and_no_more() {
        // 3 x 4 blocks per channel.
        let most = [2, 3840, 288, 288, 288, 288, 7680, 3840, 63 * 36, 36, 1];
        assert_eq!(check_dwa(&chunk(most), EXTENT), Ok(()));
        assert_eq!(check_dwa(&chunk([0; 11]), EXTENT), Ok(()));
        for index in 0..11 {
            let mut more = most;
            more[index] += 1;
            assert!(check_dwa(&chunk(more), EXTENT).is_err(), "counter {index}");
            more[index] = u64::MAX;
            assert!(check_dwa(&chunk(more), EXTENT).is_err(), "counter {index}");
        }
        assert!(check_dwa(&chunk(most)[..87], EXTENT).is_err());
    }
}
