//! The lists of blocks of a filtered picture: `shaders/sort_blocks.wgsl` puts each block of pixels into the
//! list of the least program that will do, and says how many workgroups each list takes.

use super::bindings::{bind_group, block_of};
use super::shader::sort_source;
use super::step;
use super::{Frame, Tile};
use crate::scene::Method;
use lensbake_tables::Interpolation;
use wgpu::*;

/// Side of a block, pixels: a workgroup of the shaders.
pub const BLOCK: u32 = 8;
/// Invocations of a workgroup that sorts, a block each.
const SORTED: u32 = 64;
/// Room in a list for blocks of no picture, as `shaders/blocks.wgsl` has it.
const SPARE: u32 = 64;
/// Lists of a tile: one for each [`crate::filtered::Need`].
const LISTS: u32 = 3;
/// Bytes of a list, as `shaders/sort_blocks.wgsl` has it; a dispatch is at its head.
const LIST: u64 = 16;

/// What sorts blocks.
#[derive(Debug)]
pub(super) struct Sorter {
    sort: ComputePipeline,
    close: ComputePipeline,
}

/// The lists of the tiles of a canvas.
#[derive(Debug)]
pub(super) struct BlockLists {
    lists: Buffer,
    blocks: Buffer,
    group: BindGroup,
}

impl Sorter {
    /// For pictures by `method` with rows of so many texels; its bind groups have the layouts `groups`.
    pub(super) fn new(
        device: &Device,
        groups: &[&BindGroupLayout],
        method: Method,
        texels: u32,
        interpolation: Interpolation,
    ) -> Self {
        let source = sort_source(method, texels, interpolation);
        let module = step::module(device, "sort_blocks", source);
        let pipeline = |entry_point| step::pipeline(device, entry_point, groups, &module);
        Sorter {
            sort: pipeline("sort_blocks"),
            close: pipeline("close_lists"),
        }
    }
}

impl BlockLists {
    /// Room for the lists of `tiles`, to be sorted by a group of this `layout`.
    pub(super) fn new(
        device: &Device,
        layout: &BindGroupLayout,
        frames: &Buffer,
        row: &TextureView,
        tiles: &[Tile],
    ) -> Self {
        let buffer = |label, size: u64, usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | BufferUsages::STORAGE | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let tile_count = tiles.len().max(1) as u64;
        let usage = BufferUsages::INDIRECT | BufferUsages::COPY_SRC;
        let lists = buffer("lists", tile_count * tile_bytes(), usage);
        let size = 4 * u64::from(block_count(tiles).max(1));
        let blocks = buffer("blocks", size, BufferUsages::COPY_SRC);
        let resources = [
            block_of::<Frame>(frames),
            BindingResource::TextureView(row),
            lists.as_entire_binding(),
            blocks.as_entire_binding(),
        ];
        BlockLists {
            group: bind_group(device, "sort_blocks", layout, resources),
            lists,
            blocks,
        }
    }

    /// Whether the lists of `tiles` fit in.
    pub(super) fn holds(&self, tiles: &[Tile]) -> bool {
        let bytes = 4 * u64::from(block_count(tiles));
        bytes <= self.blocks.size() && tiles.len() as u64 * tile_bytes() <= self.lists.size()
    }

    /// The blocks in their lists.
    pub(super) fn blocks(&self) -> &Buffer {
        &self.blocks
    }

    /// Encodes what must come before the pass in which tile `index` is sorted.
    pub(super) fn clear(&self, encoder: &mut CommandEncoder, index: usize) {
        let offset = index as u64 * tile_bytes();
        encoder.clear_buffer(&self.lists, offset, Some(tile_bytes()));
    }

    /// Encodes the sorting of a `tile` whose frame has this `offset`, before `sky`.
    pub(super) fn sort(
        &self,
        pass: &mut ComputePass,
        sorter: &Sorter,
        sky: &BindGroup,
        tile: Tile,
        offset: u32,
    ) {
        pass.set_bind_group(0, &self.group, &[offset]);
        pass.set_bind_group(1, sky, &[]);
        pass.set_pipeline(&sorter.sort);
        pass.dispatch_workgroups(blocks_of(&tile).div_ceil(SORTED), 1, 1);
        pass.set_pipeline(&sorter.close);
        pass.dispatch_workgroups(LISTS, 1, 1);
    }

    /// Encodes the drawing of one of the lists of tile `index`.
    pub(super) fn draw(&self, pass: &mut ComputePass, index: usize, list: usize) {
        let offset = index as u64 * tile_bytes() + list as u64 * LIST;
        pass.dispatch_workgroups_indirect(&self.lists, offset);
    }
}

/// Index of the first list and of the first block of each of `tiles`.
pub(super) fn places(tiles: &[Tile]) -> impl Iterator<Item = (u32, u32)> {
    (0..)
        .step_by(LISTS as usize)
        .zip(tiles.iter().scan(0, |next, tile| {
            Some(std::mem::replace(next, *next + room(tile)))
        }))
}

fn block_count(tiles: &[Tile]) -> u32 {
    tiles.iter().map(room).sum()
}

/// Blocks that the lists of a tile have room for.
fn room(tile: &Tile) -> u32 {
    LISTS * (blocks_of(tile) + SPARE)
}

fn blocks_of(tile: &Tile) -> u32 {
    let [across, down] = tile.count.map(|n| n.div_ceil(BLOCK));
    across * down
}

fn tile_bytes() -> u64 {
    u64::from(LISTS) * LIST
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::filtered::{Need, Pixels};
    use crate::gpu::{Canvas, Gpu, Output, Renderer, Store};
    use crate::scene::{Sampling, Scene};
    use crate::sky::Sky;
    use glam::Vec3;
    use lensbake_tables::default_atlas;

    const NEEDS: [Need; LISTS as usize] = [Need::OneTap, Need::OneRay, Need::ManyRays];

    /// The blocks of each list of each of `tiles`, as the GPU sorts them.
    fn sorted(renderer: &Renderer, scene: &Scene, tiles: &[Tile]) -> Vec<Vec<u32>> {
        let Gpu { device, queue, .. } = &renderer.gpu;
        let pixels = tiles.iter().map(|tile| tile.count[0] * tile.count[1]).max();
        let most = u64::from(pixels.unwrap());
        let mut canvas = Canvas::on_buffer(renderer, &scene.row, most, 1);
        canvas.show(scene, tiles.iter().copied(), 1.0);
        let program = renderer.program(
            scene.method,
            scene.sampling,
            Output::Picture,
            Store::Buffer,
            &scene.row,
        );
        for index in 0..tiles.len() {
            let mut encoder = device.create_command_encoder(&Default::default());
            let sky = &renderer.sky.bind_group;
            canvas.encode(&mut encoder, sky, &program, index, None);
            queue.submit([encoder.finish()]);
        }
        let read = |buffer: &Buffer| renderer.gpu.copy_back::<u32>(buffer, buffer.size());
        let lists = read(&canvas.block_lists().lists).unwrap();
        let blocks = read(&canvas.block_lists().blocks).unwrap();
        let counts = lists.chunks((LIST / 4) as usize).map(|list| list[3]);
        let firsts = places(tiles).zip(tiles).flat_map(|((_, first), tile)| {
            (0..LISTS).map(move |list| first + list * room(tile) / LISTS)
        });
        firsts
            .zip(counts)
            .map(|(first, count)| blocks[first as usize..(first + count) as usize].to_vec())
            .collect()
    }

    fn renderer(gpu: &Gpu, face_texels: u32) -> Renderer {
        Renderer::new(gpu, &Sky::from_fn(face_texels, |_| Vec3::ONE)).unwrap()
    }

    #[test]
    #[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
    fn each_block_is_in_one_list_of_its_tile_once() {
        let view = View {
            width: 203,
            height: 101,
            ..View::default()
        };
        let scene = Scene::new(Camera::new(&view).unwrap(), default_atlas(), Method::Lut).unwrap();
        let scene = scene.sampled(Sampling::Filtered);
        let tiles =
            [([0, 0], [203, 40]), ([3, 40], [200, 61])].map(|(first, count)| Tile { first, count });
        let gpu = Gpu::open().unwrap();
        let lists = sorted(&renderer(&gpu, 64), &scene, &tiles);
        for (lists, (across, down)) in lists.chunks(3).zip([(26, 5), (25, 8)]) {
            assert!(lists.iter().all(|list| !list.is_empty()), "{lists:?}");
            let mut listed = lists.concat();
            listed.sort_unstable();
            let all = (0..down).flat_map(|y| (0..across).map(move |x| x | y << 16));
            assert_eq!(listed, all.collect::<Vec<u32>>());
        }
    }

    #[test]
    #[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
    fn a_block_takes_what_any_of_its_pixels_does() {
        let gpu = Gpu::open().unwrap();
        let mut seen = [0; 3];
        for (radius, yaw_deg, fov_deg, width) in [
            (25.0, 0.0, 90.0, 240),
            (1.2, 140.0, 90.0, 240),
            (1.5, 180.0, 120.0, 160),
            (3.0, 40.0, 175.0, 160),
            (1000.0, 3.0, 20.0, 240),
            (1e6, 0.01, 0.1, 160),
        ] {
            let view = View {
                radius,
                yaw_deg,
                pitch_deg: 7.0 * fov_deg / 90.0,
                fov_deg,
                width,
                height: width / 2,
                ..View::default()
            };
            // About one texel a pixel, where it matters.
            let texels = 1.2 * f64::from(width) / (0.5 * fov_deg.to_radians()).tan();
            let texels = texels.min(512.0) as u32;
            let renderer = renderer(&gpu, texels);
            let whole = Tile {
                first: [0, 0],
                count: [width, width / 2],
            };
            for method in [Method::Lut, Method::Flat] {
                let scene = Scene::new(Camera::new(&view).unwrap(), default_atlas(), method);
                let scene = scene.unwrap().sampled(Sampling::Filtered);
                let lists = sorted(&renderer, &scene, &[whole]);
                let pixels = Pixels::new(&scene);
                for (need, list) in NEEDS.iter().zip(&lists) {
                    for (block, i) in list.iter().flat_map(|b| (0..64).map(move |i| (b, i))) {
                        let column = BLOCK * (block & 0xffff) + i % BLOCK;
                        let row = BLOCK * (block >> 16) + i / BLOCK;
                        if row < width / 2 {
                            let pixel = pixels.need(column, row, texels.into());
                            assert!(
                                *need >= pixel,
                                "{view:?} {method:?} ({column}, {row}): {need:?} {pixel:?}"
                            );
                            seen[*need as usize] += 1;
                        }
                    }
                }
            }
        }
        assert!(seen.iter().all(|&n| n > 2000), "{seen:?}");
    }
}
