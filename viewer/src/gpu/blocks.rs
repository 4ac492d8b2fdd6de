//! The lists of blocks of a filtered picture: each block of pixels goes to the least program that will
//! do. A GPU waits for the slowest pixel of a group, and a software one runs through every branch; so
//! the few pixels that take much are kept apart from the many that take one tap.

use super::Tile;
use crate::filtered::{Need, Pixels};
use glam::DVec2;
use rayon::prelude::*;

/// Side of a block, pixels: a workgroup of the shaders.
pub const BLOCK: u32 = 8;
/// Blocks to a row of workgroups, as `shaders/filtered.wgsl` has it.
pub const LIST_WIDTH: u32 = 64;
/// No block of any picture: fills up the last row.
const NONE: u32 = u32::MAX;

/// A list in the blocks of a canvas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct List {
    /// Index of its first block.
    pub first: u32,
    /// How many rows of [`LIST_WIDTH`] blocks it has.
    pub rows: u32,
}

/// Appends the blocks of a tile to `blocks`, column and row of blocks in 16 bits each: one list for each
/// [`Need`], in that order. The sky has `face_texels`.
pub fn append_lists(
    blocks: &mut Vec<u32>,
    pixels: &Pixels,
    tile: Tile,
    face_texels: u32,
) -> [List; 3] {
    let [columns, rows] = tile.count.map(|n| n.div_ceil(BLOCK));
    let needs: Vec<Need> = (0..columns * rows)
        .into_par_iter()
        .map(|i| {
            let corner = DVec2::new(
                f64::from(tile.first[0] + i % columns * BLOCK),
                f64::from(tile.first[1] + i / columns * BLOCK),
            );
            pixels.need_of_square(corner, BLOCK.into(), face_texels.into())
        })
        .collect();
    Need::ALL.map(|need| {
        let first = blocks.len() as u32;
        let listed = (0..).zip(&needs).filter(|&(_, &n)| n == need);
        blocks.extend(listed.map(|(i, _): (u32, _)| (i % columns) | ((i / columns) << 16)));
        let rows = (blocks.len() as u32 - first).div_ceil(LIST_WIDTH);
        blocks.resize((first + rows * LIST_WIDTH) as usize, NONE);
        List { first, rows }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::scene::{Method, Scene};
    use lensbake_tables::default_atlas;

    #[test]
    fn each_block_is_in_one_list_once() {
        let view = View {
            width: 203,
            height: 101,
            ..View::default()
        };
        let scene = Scene::new(Camera::new(&view).unwrap(), default_atlas(), Method::Lut).unwrap();
        let tile = Tile {
            first: [3, 40],
            count: [200, 61],
        };
        let mut blocks = vec![7; 10];
        let lists = append_lists(&mut blocks, &Pixels::new(&scene), tile, 64);
        assert_eq!(
            (lists[0].first, lists[1].first),
            (10, 10 + 64 * lists[0].rows)
        );
        assert!(lists.iter().all(|list| list.rows > 0), "{lists:?}");
        let mut listed: Vec<u32> = blocks[10..]
            .iter()
            .copied()
            .filter(|&b| b != NONE)
            .collect();
        listed.sort_unstable();
        let expected: Vec<u32> = (0..8)
            .flat_map(|y| (0..25).map(move |x| x | y << 16))
            .collect();
        assert_eq!(listed, expected);
    }
}
