//! Rectangles of pixels that one dispatch draws.

use crate::lens::Deflection;
use crate::shaders::TILE;
use std::f64::consts::PI;

/// Largest number of integration steps in a dispatch of direct integration: a fraction of a second on a small GPU.
/// A driver resets a GPU that is busy for seconds.
const DISPATCH_STEPS: f64 = 1e8;

/// A rectangle of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// Column and row of its first pixel.
    pub first: [u32; 2],
    /// Its width and height, pixels.
    pub count: [u32; 2],
}

impl Region {
    /// The region of a whole picture of this width and height.
    pub fn whole(count: [u32; 2]) -> Self {
        Region {
            first: [0, 0],
            count,
        }
    }

    /// Divides the region into bands of whole rows, each with at most `pixels` pixels but at least one row. Bands of at least
    /// 8 rows begin where a tile of the region does.
    pub fn bands(self, pixels: u32) -> impl Iterator<Item = Region> {
        let ([column, row], [width, height]) = (self.first, self.count);
        let most = (pixels / width.max(1)).max(1);
        let of_tiles = most - most % TILE;
        let rows = if of_tiles > 0 { of_tiles } else { most };
        (0..height).step_by(rows as usize).map(move |y| Region {
            first: [column, row + y],
            count: [width, rows.min(height - y)],
        })
    }
}

/// Largest number of pixels that a dispatch may draw by `deflection`.
pub fn dispatch_pixels(deflection: Deflection) -> u32 {
    match deflection {
        // A ray turns by about π; few turn more.
        Deflection::Direct { step } => (DISPATCH_STEPS * step / PI) as u32,
        Deflection::Lut | Deflection::Flat => u32::MAX,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_cover_a_region_once_from_the_top_down() {
        for (width, height, pixels) in [
            (7, 10, 21),
            (7, 11, 21),
            (7, 10, 1),
            (7, 10, 1000),
            (7, 50, 150),
        ] {
            let region = Region {
                first: [3, 5],
                count: [width, height],
            };
            let mut next = 5;
            for band in region.bands(pixels) {
                assert_eq!((band.first, band.count[0]), ([3, next], width));
                assert!(band.count[1] == 1 || width * band.count[1] <= pixels);
                assert!(pixels < width * TILE || (band.first[1] - 5) % TILE == 0);
                next += band.count[1];
            }
            assert_eq!(next, 5 + height);
        }
        assert_eq!(Region::whole([0, 4]).bands(8).count(), 1);
    }
}
