//! Tile classification: `shaders/classify_tiles.wgsl` puts each tile of a filtered picture into the work queue of
//! the simplest program that can draw it, and writes the arguments of each queue's indirect dispatch.

use super::Region;
use super::bindings::{bind_group, block_of};
use super::camera_block::RegionBlock;
use super::compute;
use super::layouts::{ComputeLayouts, Layouts};
use super::source::PipelineKey;
use crate::filter::TileClass;
use crate::shaders::{PADDING, TILE};
use wgpu::*;

/// Invocations per workgroup of the classification, one for each tile.
const CLASSIFIED: u32 = 64;
/// Work queues of a region: one for each [`TileClass`].
const QUEUES: u32 = TileClass::ALL.len() as u32;
/// Bytes of the struct `Queue` in `shaders/classify_tiles.wgsl`, which begins with the arguments of an indirect
/// dispatch.
const QUEUE: u64 = 16;

/// The pipelines that classify tiles.
#[derive(Debug)]
pub(super) struct TileClassifier {
    classify: ComputePipeline,
    close: ComputePipeline,
}

/// The work queues of the regions of a picture.
#[derive(Debug)]
pub(super) struct WorkQueues {
    queues: Buffer,
    tiles: Buffer,
    group: BindGroup,
}

/// Resources that all programs of a picture read.
pub(super) struct PassInputs<'a> {
    pub(super) camera: &'a Buffer,
    pub(super) regions: &'a Buffer,
    pub(super) row: &'a TextureView,
}

/// The rows of a tile that one invocation draws. A software adapter (llvmpipe, Mesa 22.3) takes as long to start an
/// invocation and to look up its tile as a third of a picture of one ray per pixel. But it ends the loops of an invocation
/// after 65,535 iterations of all of them together, which direct integration of a few pixels may take.
pub(super) fn rows_per_invocation(on_software: bool, integrates: bool) -> u32 {
    if on_software && !integrates { TILE } else { 1 }
}

/// The values of the overridable constants of `shaders/work_queues.wgsl` and `shaders/compute_tiles.wgsl`.
pub(super) fn constants(rows: u32, class: TileClass) -> [(&'static str, f64); 2] {
    [("ROWS", rows.into()), ("CLASS", f64::from(class as u32))]
}

impl TileClassifier {
    /// The pipelines of `key`, for invocations that draw this many rows.
    pub(super) fn new(device: &Device, layouts: &Layouts, key: PipelineKey, rows: u32) -> Self {
        let module = compute::module(device, "classify_tiles", key.classifier_source());
        let mut groups = vec![&layouts.compute().classify, &layouts.sky];
        groups.extend(key.disc.then_some(&layouts.disc));
        let pipeline = |entry_point| {
            let constants = [("ROWS", rows.into())];
            compute::specialised_pipeline(device, entry_point, &groups, &module, &constants)
        };
        TileClassifier {
            classify: pipeline(key.classifier_entry_point()),
            close: pipeline("close_queues"),
        }
    }
}

impl WorkQueues {
    /// Work queues with room for `regions`.
    pub(super) fn new(
        device: &Device,
        layouts: &ComputeLayouts,
        inputs: &PassInputs,
        regions: &[Region],
    ) -> Self {
        let buffer = |label, size: u64, usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | BufferUsages::STORAGE | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let region_count = regions.len().max(1) as u64;
        let usage = BufferUsages::INDIRECT | BufferUsages::COPY_SRC;
        let queues = buffer("work queues", region_count * region_bytes(), usage);
        let size = 4 * u64::from(entries(regions).max(1));
        let tiles = buffer("tiles", size, BufferUsages::COPY_SRC);
        let resources = [
            inputs.camera.as_entire_binding(),
            block_of::<RegionBlock>(inputs.regions),
            BindingResource::TextureView(inputs.row),
            queues.as_entire_binding(),
            tiles.as_entire_binding(),
        ];
        WorkQueues {
            group: bind_group(device, "classify_tiles", &layouts.classify, resources),
            queues,
            tiles,
        }
    }

    /// Whether there is room for the tiles of `regions`.
    pub(super) fn holds(&self, regions: &[Region]) -> bool {
        let bytes = 4 * u64::from(entries(regions));
        bytes <= self.tiles.size() && regions.len() as u64 * region_bytes() <= self.queues.size()
    }

    /// The entries of all queues: the tiles.
    pub(super) fn tiles(&self) -> &Buffer {
        &self.tiles
    }

    /// Encodes the clearing of the queues of region `index`, before the pass in which it is classified.
    pub(super) fn clear(&self, encoder: &mut CommandEncoder, index: usize) {
        let offset = index as u64 * region_bytes();
        encoder.clear_buffer(&self.queues, offset, Some(region_bytes()));
    }

    /// Encodes the classification of `region`, whose uniform block is at `offset`, in front of `sky` and behind `disc`.
    pub(super) fn classify(
        &self,
        pass: &mut ComputePass,
        classifier: &TileClassifier,
        (sky, disc): (&BindGroup, Option<&BindGroup>),
        region: Region,
        offset: u32,
    ) {
        pass.set_bind_group(0, &self.group, &[offset]);
        pass.set_bind_group(1, sky, &[]);
        if let Some(disc) = disc {
            pass.set_bind_group(2, disc, &[]);
        }
        pass.set_pipeline(&classifier.classify);
        pass.dispatch_workgroups(tiles_of(&region).div_ceil(CLASSIFIED), 1, 1);
        pass.set_pipeline(&classifier.close);
        pass.dispatch_workgroups(QUEUES, 1, 1);
    }

    /// Encodes the indirect dispatch that draws one of the queues of region `index`.
    pub(super) fn draw(&self, pass: &mut ComputePass, index: usize, queue: usize) {
        let offset = index as u64 * region_bytes() + queue as u64 * QUEUE;
        pass.dispatch_workgroups_indirect(&self.queues, offset);
    }
}

/// For each of `regions`, the index of its first queue and that of its first entry.
pub(super) fn offsets(regions: &[Region]) -> impl Iterator<Item = (u32, u32)> {
    (0..)
        .step_by(QUEUES as usize)
        .zip(regions.iter().scan(0, |next, region| {
            Some(std::mem::replace(next, *next + room(region)))
        }))
}

fn entries(regions: &[Region]) -> u32 {
    regions.iter().map(room).sum()
}

/// Number of entries that the queues of a region have room for.
fn room(region: &Region) -> u32 {
    QUEUES * (tiles_of(region) + PADDING)
}

fn tiles_of(region: &Region) -> u32 {
    let [across, down] = region.count.map(|n| n.div_ceil(TILE));
    across * down
}

fn region_bytes() -> u64 {
    u64::from(QUEUES) * QUEUE
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::filter::FilteredPixels;
    use crate::gpu::frame_resources::FrameResources;
    use crate::gpu::source::{Output, Store};
    use crate::gpu::target::Target;
    use crate::gpu::{Gpu, Renderer, SkyOnDevice};
    use crate::lens::{Deflection, Lens};
    use crate::scene::Sampling;
    use crate::shift::{Rendition, Shift};
    use crate::sky::Sky;
    use glam::Vec3;
    use lensbake_core::Motion;
    use lensbake_tables::default_atlas;
    use pollster::block_on;

    /// The tiles in each queue of each of `regions`, as the GPU classifies them.
    fn classified(
        renderer: &Renderer,
        lens: &Lens,
        sky: &SkyOnDevice,
        regions: &[Region],
    ) -> Vec<Vec<u32>> {
        let Gpu { device, queue, .. } = renderer.gpu();
        let pixels = regions
            .iter()
            .map(|region| region.count[0] * region.count[1])
            .max();
        let most = pixels.unwrap();
        let output = Output::Picture(Sampling::Filtered);
        let target = Target::regions(renderer, output, [most, 1]);
        let mut resources = FrameResources::new(renderer, target);
        resources.show(
            lens,
            (Sampling::Filtered, renderer.pass(output)),
            Rendition::default(),
            regions.iter().copied(),
            1.0,
        );
        let program = renderer.program(PipelineKey::of(
            lens,
            output,
            Store::Buffer,
            false,
            Shift::Off,
        ));
        for index in 0..regions.len() {
            let mut encoder = device.create_command_encoder(&Default::default());
            resources.encode(&mut encoder, Some(sky), &program, index, None);
            queue.submit([encoder.finish()]);
        }
        let read =
            |buffer: &Buffer| block_on(renderer.gpu().copy_back::<u32>(buffer, buffer.size()));
        let queues = read(&resources.work_queues().unwrap().queues).unwrap();
        let tiles = read(&resources.work_queues().unwrap().tiles).unwrap();
        let counts = queues.chunks((QUEUE / 4) as usize).map(|queue| queue[3]);
        let firsts = offsets(regions)
            .zip(regions)
            .flat_map(|((_, first), region)| {
                (0..QUEUES).map(move |queue| first + queue * room(region) / QUEUES)
            });
        firsts
            .zip(counts)
            .map(|(first, count)| tiles[first as usize..(first + count) as usize].to_vec())
            .collect()
    }

    fn sky(renderer: &Renderer, face_texels: u32) -> SkyOnDevice {
        let sky = Sky::from_fn(face_texels, |_| Vec3::ONE);
        block_on(renderer.upload_sky(&sky)).unwrap()
    }

    #[test]
    #[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
    fn each_tile_is_in_one_queue_of_its_region_once() {
        let view = View {
            radius: 5.0,
            width: 203,
            height: 101,
            ..View::default()
        };
        let camera = Camera::new(&view).unwrap();
        let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
        let regions = [([0, 0], [203, 40]), ([3, 40], [200, 61])]
            .map(|(first, count)| Region { first, count });
        let renderer = Renderer::new(&block_on(Gpu::open()).unwrap());
        let queues = classified(&renderer, &lens, &sky(&renderer, 64), &regions);
        for (queues, (across, down)) in queues.chunks(QUEUES as usize).zip([(26, 5), (25, 8)]) {
            assert!(queues.iter().all(|queue| !queue.is_empty()), "{queues:?}");
            let mut queued = queues.concat();
            queued.sort_unstable();
            let all = (0..down).flat_map(|y| (0..across).map(move |x| x | y << 16));
            assert_eq!(queued, all.collect::<Vec<u32>>());
        }
    }

    #[test]
    #[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
    fn a_tile_has_at_least_the_class_of_each_of_its_pixels() {
        let renderer = Renderer::new(&block_on(Gpu::open()).unwrap());
        let mut seen = [0; QUEUES as usize];
        let velocity = |radial, tangential| Motion::Velocity { radial, tangential };
        for (radius, motion, yaw_deg, fov_deg, width) in [
            (25.0, Motion::Rest, 0.0, 90.0, 240),
            (1.2, Motion::Rest, 140.0, 90.0, 240),
            (1.5, Motion::Rest, 180.0, 120.0, 160),
            (3.0, Motion::Rest, 40.0, 175.0, 160),
            (1000.0, Motion::Rest, 3.0, 20.0, 240),
            (1e6, Motion::Rest, 0.01, 0.1, 160),
            (1.0, Motion::Fall, 40.0, 90.0, 240),
            (0.1, Motion::Fall, 110.0, 120.0, 160),
            (3.0, Motion::Orbit, 60.0, 120.0, 240),
            (2.0, velocity(-0.9, 0.3), 0.0, 120.0, 160),
            (10.0, velocity(0.0, 0.99995), 80.0, 120.0, 160),
            (10.0, velocity(0.0, 0.99995), -60.0, 120.0, 160),
            (0.5, velocity(0.4, 0.5), 60.0, 100.0, 160),
        ] {
            let view = View {
                radius,
                motion,
                yaw_deg,
                pitch_deg: 7.0 * fov_deg / 90.0,
                fov_deg,
                width,
                height: width / 2,
                ..View::default()
            };
            // Above one texel per pixel and below, at most 512 on a side of a face.
            let texels = [1.2, 0.7].map(|per_pixel| {
                let texels = per_pixel * f64::from(width) / (0.5 * fov_deg.to_radians()).tan();
                texels.min(512.0) as u32
            });
            let skies = texels.map(|texels| (texels, sky(&renderer, texels)));
            let whole = Region::whole([width, width / 2]);
            let deflections = [Deflection::Lut, Deflection::Flat];
            let drawn = skies
                .iter()
                .flat_map(|sky| deflections.map(|deflection| (sky, deflection)));
            for ((texels, sky), deflection) in drawn {
                let camera = Camera::new(&view).unwrap();
                let lens = Lens::new(camera, default_atlas(), deflection).unwrap();
                let queues = classified(&renderer, &lens, sky, &[whole]);
                let pixels = FilteredPixels::new(&lens, Rendition::default());
                for (class, queue) in TileClass::ALL.iter().zip(&queues) {
                    for (tile, i) in queue.iter().flat_map(|t| (0..64).map(move |i| (t, i))) {
                        let column = TILE * (tile & 0xffff) + i % TILE;
                        let row = TILE * (tile >> 16) + i / TILE;
                        if row < width / 2 {
                            let pixel = pixels.class_of(column, row, (*texels).into());
                            assert!(
                                *class >= pixel,
                                "{view:?} {deflection:?} ({column}, {row}): {class:?} {pixel:?}"
                            );
                            seen[*class as usize] += 1;
                        }
                    }
                }
            }
        }
        assert!(seen.iter().all(|&n| n > 2000), "{seen:?}");
    }
}
