//! Finds the chunks of a layer: reads the chunk table after the headers, and the few words before each chunk.

use super::expansion::{self, Extent};
use super::{ExrError, Limits};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{Compression, Vec2};
use std::ops::Range;

const ENTRY: usize = 8;

/// A chunk whose position and size have been checked.
#[derive(Debug, Clone)]
pub(super) struct ChunkLocation {
    /// Its first line, in the coordinates of the file; 0 for a tile.
    pub first_line: i32,
    /// Column and row of the tile; for scan lines, 0 and the index of the block of lines.
    pub tile: Vec2<usize>,
    /// Byte range of its compressed pixels in the file.
    pub data: Range<usize>,
}

/// The chunks of a layer at full resolution. The chunk table starts at `table` and has one entry per chunk, for
/// one layer after the other.
pub(super) fn chunk_locations(
    bytes: &[u8],
    table: usize,
    meta: &MetaData,
    layer: usize,
    limits: &Limits,
) -> Result<Vec<ChunkLocation>, ExrError> {
    let chunks_before = |layers: &[Header]| {
        let mut counts = layers.iter().map(|header| header.chunk_count);
        counts.try_fold(0_usize, usize::checked_add)
    };
    let end_of = |layers: &[Header]| {
        let length = chunks_before(layers)?.checked_mul(ENTRY)?;
        table.checked_add(length)
    };
    let whole = end_of(&meta.headers).ok_or(ExrError::Table)?;
    if whole > bytes.len() {
        return Err(ExrError::Table);
    }
    let start = end_of(&meta.headers[..layer]).ok_or(ExrError::Table)?;
    let header = &meta.headers[layer];
    let grid = Grid::of(header, limits)?;
    // Full resolution is the first level of a layer, so its entries come first.
    let entries = bytes[start..whole].chunks_exact(ENTRY).take(grid.count());
    let reader = Reader {
        bytes,
        part: meta.requirements.has_multiple_layers.then_some(layer),
        header,
        grid,
    };
    let mut seen = vec![false; entries.len()];
    let mut places = Vec::with_capacity(entries.len());
    for (index, entry) in entries.enumerate() {
        let at = entry
            .iter()
            .rev()
            .fold(0, |number, &byte| number << 8 | u64::from(byte));
        let problem = |problem| ExrError::Chunk { index, problem };
        let place = reader.place(at).map_err(problem)?;
        let number = place.tile.y() * grid.count.x() + place.tile.x();
        if std::mem::replace(&mut seen[number], true) {
            return Err(problem("has the place of another"));
        }
        places.push(place);
    }
    if places.len() < grid.count() {
        return Err(ExrError::Table);
    }
    Ok(places)
}

/// The division of the data window into chunks.
#[derive(Debug, Clone, Copy)]
struct Grid {
    /// Size of the data window, pixels.
    size: Vec2<usize>,
    /// Size of a chunk, pixels; the last ones are smaller.
    chunk: Vec2<usize>,
    /// Number of chunks in each direction.
    count: Vec2<usize>,
}

impl Grid {
    fn of(header: &Header, limits: &Limits) -> Result<Self, ExrError> {
        let size = header.layer_size;
        // The parser refuses windows and tiles with a side of 2³⁰ or more, so no product of two sides overflows.
        let pixels = size.width() as u64 * size.height() as u64;
        if pixels > limits.pixels {
            return Err(ExrError::TooLarge {
                width: size.width(),
                height: size.height(),
                max: limits.pixels,
            });
        }
        let chunk = header.max_block_pixel_size();
        let count = Vec2(
            size.width().div_ceil(chunk.width()),
            size.height().div_ceil(chunk.height()),
        );
        let largest = chunk.min(size);
        let found = largest.area() as u64 * header.channels.bytes_per_pixel as u64;
        if found > limits.chunk_bytes {
            let max = limits.chunk_bytes;
            return Err(ExrError::LargeChunk { found, max });
        }
        Ok(Grid { size, chunk, count })
    }

    fn count(&self) -> usize {
        self.count.area()
    }

    /// Width and height of the chunk `tile` in pixels.
    fn extent(&self, tile: Vec2<usize>) -> Vec2<usize> {
        let side = |size: usize, chunk: usize, index: usize| chunk.min(size - index * chunk);
        Vec2(
            side(self.size.x(), self.chunk.x(), tile.x()),
            side(self.size.y(), self.chunk.y(), tile.y()),
        )
    }
}

struct Reader<'b> {
    bytes: &'b [u8],
    /// The part that each chunk must name, in a file with several parts.
    part: Option<usize>,
    header: &'b Header,
    grid: Grid,
}

impl Reader<'_> {
    fn place(&self, at: u64) -> Result<ChunkLocation, &'static str> {
        let at = usize::try_from(at).map_err(|_| "is beyond the end of the file")?;
        let mut words = WordReader {
            bytes: self.bytes,
            at,
        };
        if let Some(part) = self.part
            && usize::try_from(words.next()?) != Ok(part)
        {
            return Err("is another layer's");
        }
        let (first_line, tile) = match self.header.blocks {
            BlockDescription::ScanLines => self.scan_lines(words.next()?)?,
            BlockDescription::Tiles(_) => (
                0,
                self.tile(
                    [words.next()?, words.next()?],
                    [words.next()?, words.next()?],
                )?,
            ),
        };
        let length = usize::try_from(words.next()?).map_err(|_| "has a negative size")?;
        let end = words.at.checked_add(length);
        let end = end.filter(|&end| end <= self.bytes.len());
        let data = words.at..end.ok_or("ends beyond the end of the file")?;
        self.check_size(&self.bytes[data.clone()], tile)?;
        Ok(ChunkLocation {
            first_line,
            tile,
            data,
        })
    }

    fn scan_lines(&self, line: i32) -> Result<(i32, Vec2<usize>), &'static str> {
        let outside = "is of lines outside of the data window";
        let top = self.header.own_attributes.layer_position.y();
        let row = usize::try_from(i64::from(line) - i64::from(top)).map_err(|_| outside)?;
        let lines = self.grid.chunk.height();
        if row >= self.grid.size.height() || !row.is_multiple_of(lines) {
            return Err(outside);
        }
        Ok((line, Vec2(0, row / lines)))
    }

    fn tile(&self, tile: [i32; 2], level: [i32; 2]) -> Result<Vec2<usize>, &'static str> {
        if level != [0, 0] {
            return Err("is of another resolution");
        }
        let [column, row] = tile.map(usize::try_from);
        match (column, row) {
            (Ok(column), Ok(row)) if column < self.grid.count.x() && row < self.grid.count.y() => {
                Ok(Vec2(column, row))
            }
            _ => Err("is a tile outside of the data window"),
        }
    }

    /// Checks that the compressed bytes `chunk` can hold the pixels of the chunk `tile`.
    fn check_size(&self, chunk: &[u8], tile: Vec2<usize>) -> Result<(), &'static str> {
        let size = self.grid.extent(tile);
        let bytes = size.area() * self.header.channels.bytes_per_pixel;
        // Pixels that compression would not make smaller are stored uncompressed.
        if chunk.len() == bytes {
            return Ok(());
        }
        let compression = self.header.compression;
        if expansion::most_bytes(compression, chunk.len()) < bytes as u64 {
            return Err("is too short for its pixels");
        }
        match compression {
            Compression::Uncompressed => Err("is too long for its pixels"),
            Compression::DWAA(_) | Compression::DWAB(_) => expansion::check_dwa(
                chunk,
                Extent {
                    width: size.width() as u64,
                    height: size.height() as u64,
                    channels: self.header.channels.list.len() as u64,
                    bytes: bytes as u64,
                },
            ),
            _ => Ok(()),
        }
    }
}

/// Little-endian words of four bytes, one after the other.
struct WordReader<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl WordReader<'_> {
    fn next(&mut self) -> Result<i32, &'static str> {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let (word, _) = rest
            .split_first_chunk::<4>()
            .ok_or("is beyond the end of the file")?;
        self.at += 4;
        Ok(i32::from_le_bytes(*word))
    }
}
