//! Screenshots, and how they differ.

use std::fmt;
use std::path::Path;

/// A screenshot: pixels, row-major `[height][width]`, 8-bit sRGB.
#[derive(Clone, PartialEq, Eq)]
pub struct Shot {
    /// Width.
    pub width: u32,
    /// Height.
    pub height: u32,
    /// The pixels.
    pub pixels: Vec<[u8; 3]>,
}

impl fmt::Debug for Shot {
    /// Only the size: the pixels would fill pages.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Shot({}x{})", self.width, self.height)
    }
}

impl Shot {
    /// Reads a picture file.
    ///
    /// # Panics
    /// If it cannot be read as a picture.
    pub fn read(path: &Path) -> Self {
        let picture = image::open(path).unwrap().into_rgb8();
        Shot {
            width: picture.width(),
            height: picture.height(),
            pixels: picture.pixels().map(|p| p.0).collect(),
        }
    }

    /// The largest difference of a channel from another picture; `None` if the sizes differ.
    pub fn distance(&self, other: &Shot) -> Option<u8> {
        if (self.width, self.height) != (other.width, other.height) {
            return None;
        }
        let pairs = self.pixels.iter().zip(&other.pixels);
        pairs
            .flat_map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)))
            .max()
    }

    /// A rectangle of the picture.
    pub fn part(&self, columns: std::ops::Range<u32>, rows: std::ops::Range<u32>) -> Self {
        let (left, right) = (columns.start as usize, columns.end as usize);
        let lines = self.pixels.chunks_exact(self.width as usize);
        let lines = lines.skip(rows.start as usize).take(rows.len());
        Shot {
            width: columns.len() as u32,
            height: rows.len() as u32,
            pixels: lines.flat_map(|line| &line[left..right]).copied().collect(),
        }
    }
}
