//! The GPU resources that are kept from frame to frame: camera, row, regions, star lists and the target of the
//! picture. The next scene is written into the same resources; they are created anew only for another size of
//! picture or another shape of row.

use super::bindings::{bind_group, block_of, uniform_buffer};
use super::camera_block::{CameraBlock, RegionBlock};
use super::layouts::TEXTURE_FORMAT;
use super::pipelines::{Pipelines, Program};
use super::renderer::Renderer;
use super::row_texture::RowTexture;
use super::source::Store;
use super::stars::{StarLight, StarLists, StarsOnDevice};
use super::texture::texture;
use super::tile_queues::{self, ClassifierInputs, WorkQueues};
use super::{Gpu, GpuError, Region, SkyOnDevice};
use crate::lens::Lens;
use crate::scene::Sampling;
use crate::shaders::TILE;
use crate::shadow::Shadow;
use crate::shift::Rendition;
use lensbake_tables::lookup::{HorizonSide, RowShape};
use lensbake_tables::{Interpolation, RowFormat};
use std::sync::Arc;
use wgpu::*;

/// Bytes of a pixel in a [`Store::Buffer`].
const PIXEL: u64 = size_of::<[f32; 4]>() as u64;

/// What a picture is written to.
#[derive(Debug)]
pub(super) enum Target {
    /// Each region in turn, `[rows][columns][4]` of f32.
    Buffer(Buffer),
    /// The whole picture.
    Texture(TextureView),
}

impl Target {
    fn binding(&self) -> BindingResource<'_> {
        match self {
            Target::Buffer(buffer) => buffer.as_entire_binding(),
            Target::Texture(view) => BindingResource::TextureView(view),
        }
    }

    fn store(&self) -> Store {
        match self {
            Target::Buffer(_) => Store::Buffer,
            Target::Texture(_) => Store::Texture,
        }
    }
}

/// The resources of pictures of one size.
#[derive(Debug)]
pub(super) struct FrameResources {
    gpu: Gpu,
    pipelines: Arc<Pipelines>,
    target: Target,
    camera: Buffer,
    row: RowTexture,
    regions: Vec<Region>,
    region_blocks: Buffer,
    /// The blocks in that buffer.
    uploaded_regions: Vec<RegionBlock>,
    region_stride: u64,
    queues: WorkQueues,
    bind_group: BindGroup,
    stars: Option<StarLists>,
}

impl FrameResources {
    /// Resources for pictures in a texture of `size` pixels.
    pub(super) fn on_texture(renderer: &Renderer, size: [u32; 2]) -> Self {
        let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
        let device = &renderer.gpu().device;
        let texture = texture(device, "picture", size, TEXTURE_FORMAT, usage);
        let view = texture.create_view(&Default::default());
        FrameResources::new(renderer, Target::Texture(view))
    }

    /// Resources for pictures whose regions of at most `pixels` pixels are all written to the same buffer.
    pub(super) fn on_buffer(renderer: &Renderer, pixels: u64) -> Self {
        let buffer = renderer.gpu().device.create_buffer(&BufferDescriptor {
            label: Some("pixels"),
            size: pixels * PIXEL,
            usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        FrameResources::new(renderer, Target::Buffer(buffer))
    }

    fn new(renderer: &Renderer, target: Target) -> Self {
        let gpu = renderer.gpu().clone();
        let pipelines = renderer.pipelines().clone();
        let device = &gpu.device;
        let alignment = device.limits().min_uniform_buffer_offset_alignment;
        let region_stride = (size_of::<RegionBlock>() as u64).next_multiple_of(alignment.into());
        let camera = uniform_buffer(device, "camera", size_of::<CameraBlock>() as u64);
        let region_blocks = uniform_buffer(device, "regions", region_stride);
        // Replaced when the first row is shown.
        let row = RowTexture::new(
            device,
            RowShape {
                texels: 4,
                interpolation: Interpolation::Hermite,
                side: HorizonSide::Above,
                format: RowFormat::Float32,
            },
        );
        let inputs = ClassifierInputs {
            camera: &camera,
            regions: &region_blocks,
            row: row.view(),
        };
        let queues = WorkQueues::new(device, &pipelines.layouts, &inputs, &[]);
        let bind_group = draw_group(device, &pipelines, &inputs, &target, &queues);
        FrameResources {
            gpu,
            pipelines,
            target,
            camera,
            row,
            regions: Vec::new(),
            region_blocks,
            uploaded_regions: Vec::new(),
            region_stride,
            queues,
            bind_group,
            stars: None,
        }
    }

    /// What the picture is written to.
    pub(super) fn target(&self) -> &Target {
        &self.target
    }

    /// The regions that were set last.
    pub(super) fn regions(&self) -> &[Region] {
        &self.regions
    }

    #[cfg(test)]
    pub(super) fn work_queues(&self) -> &WorkQueues {
        &self.queues
    }

    /// Sets what the next dispatches draw: the view through `lens`, in these regions. The row is uploaded only if
    /// it differs from the last one. `gain` amplifies a difference.
    pub(super) fn show(
        &mut self,
        lens: &Lens,
        sampling: Sampling,
        rendition: Rendition,
        regions: impl Iterator<Item = Region>,
        gain: f32,
    ) {
        self.regions.clear();
        self.regions.extend(regions);
        self.make_room(lens.row.shape(), sampling);
        let queue = &self.gpu.queue;
        let camera = CameraBlock::new(&lens.camera, Shadow::of(lens), rendition.light_scale);
        queue.write_buffer(&self.camera, 0, bytemuck::bytes_of(&camera));
        let regions = self.regions.iter().zip(tile_queues::offsets(&self.regions));
        for (i, (region, (queues, tiles))) in regions.enumerate() {
            let block = RegionBlock {
                first: region.first,
                count: region.count,
                queues,
                tiles,
                gain,
                padding: 0,
            };
            // They rarely change from frame to frame.
            if self.uploaded_regions.get(i) == Some(&block) {
                continue;
            }
            let offset = i as u64 * self.region_stride;
            queue.write_buffer(&self.region_blocks, offset, bytemuck::bytes_of(&block));
            self.uploaded_regions.truncate(i);
            self.uploaded_regions.push(block);
        }
        self.row.show(queue, &lens.row);
    }

    /// Sets the stars that the next dispatches draw through `lens`. Their lists are created anew only for other
    /// stars.
    pub(super) fn show_stars(&mut self, lens: &Lens, stars: &StarsOnDevice, rendition: Rendition) {
        if self.stars.as_ref().is_none_or(|lists| !lists.are_of(stars)) {
            let size = [lens.camera.width, lens.camera.height];
            let size = match &self.target {
                Target::Buffer(_) => size,
                Target::Texture(view) => {
                    let texture = view.texture();
                    [texture.width(), texture.height()]
                }
            };
            let programs = self.pipelines.stars();
            let layouts = &self.pipelines.layouts;
            self.stars = Some(StarLists::new(&self.gpu, layouts, programs, stars, size));
        }
        if let Some(lists) = &mut self.stars {
            lists.show(lens, rendition);
        }
    }

    /// Checks that no light of the stars was lost in the picture drawn last.
    ///
    /// # Errors
    /// [`GpuError::TooManyStars`] if some was, [`GpuError::Failed`] if the device fails.
    pub(super) async fn check_stars(&self) -> Result<(), GpuError> {
        match &self.stars {
            Some(lists) => lists.check(&self.gpu).await,
            None => Ok(()),
        }
    }

    /// Whether the newest picture whose node count has arrived since the last call contains the light of all its
    /// stars; `None` if no count has arrived. Does not block. Call it after the encoded commands are submitted.
    pub(super) fn star_light(&self) -> Option<StarLight> {
        self.stars.as_ref().and_then(StarLists::arrived)
    }

    /// Whether a node count is under way that [`FrameResources::star_light`] will report.
    pub(super) fn awaits_star_light(&self) -> bool {
        self.stars.as_ref().is_some_and(StarLists::awaited)
    }

    /// Encodes the drawing of region `index` by `program`, in front of `sky`; `timestamps` records when it begins
    /// and ends. The first region also makes the star lists, which all regions read.
    pub(super) fn encode(
        &self,
        encoder: &mut CommandEncoder,
        sky: Option<&SkyOnDevice>,
        program: &Program,
        index: usize,
        timestamps: Option<ComputePassTimestampWrites>,
    ) {
        let stars = self.stars.as_ref().filter(|_| program.key.stars);
        let lists = stars.filter(|_| index == 0);
        if let Some(lists) = lists {
            lists.clear(encoder);
        }
        if program.classifier.is_some() {
            self.queues.clear(encoder, index);
        }
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
            label: Some(program.key.name()),
            timestamp_writes: timestamps,
        });
        let offset = (index as u64 * self.region_stride) as u32;
        if let Some(lists) = lists {
            lists.make(&mut pass);
        }
        let region = self.regions[index];
        if let (Some(classifier), Some(sky)) = (&program.classifier, sky) {
            self.queues
                .classify(&mut pass, classifier, &sky.bind_group, region, offset);
        }
        pass.set_bind_group(0, &self.bind_group, &[offset]);
        if let Some(sky) = sky {
            pass.set_bind_group(1, &sky.bind_group, &[]);
        }
        if let Some(stars) = stars {
            pass.set_bind_group(2, stars.reading(), &[]);
        }
        for (queue, pipeline) in program.pipelines.iter().enumerate() {
            pass.set_pipeline(pipeline);
            if program.classifier.is_some() {
                self.queues.draw(&mut pass, index, queue);
            } else {
                let [across, down] = region.count.map(|n| n.div_ceil(TILE));
                pass.dispatch_workgroups(across, down, 1);
            }
        }
        drop(pass);
        if let Some(lists) = lists {
            lists.report(encoder);
        }
    }

    /// Makes room for a row of this shape, for the uniform blocks of all regions, and for their work queues if the
    /// picture is filtered. Creates resources anew only for another shape, or if there are more regions or tiles
    /// than ever before.
    fn make_room(&mut self, row: RowShape, sampling: Sampling) {
        let blocks = self.regions.len() as u64 * self.region_stride;
        let queued = sampling == Sampling::Filtered;
        let holds = !queued || self.queues.holds(&self.regions);
        if row == self.row.shape() && blocks <= self.region_blocks.size() && holds {
            return;
        }
        let device = &self.gpu.device;
        if row != self.row.shape() {
            self.row = RowTexture::new(device, row);
        }
        if blocks > self.region_blocks.size() {
            self.region_blocks = uniform_buffer(device, "regions", blocks);
            self.uploaded_regions.clear();
        }
        let inputs = ClassifierInputs {
            camera: &self.camera,
            regions: &self.region_blocks,
            row: self.row.view(),
        };
        let regions = if queued { &self.regions[..] } else { &[] };
        self.queues = WorkQueues::new(device, &self.pipelines.layouts, &inputs, regions);
        self.bind_group = draw_group(device, &self.pipelines, &inputs, &self.target, &self.queues);
    }
}

fn draw_group(
    device: &Device,
    pipelines: &Pipelines,
    inputs: &ClassifierInputs,
    target: &Target,
    queues: &WorkQueues,
) -> BindGroup {
    let resources = [
        inputs.camera.as_entire_binding(),
        block_of::<RegionBlock>(inputs.regions),
        BindingResource::TextureView(inputs.row),
        target.binding(),
        queues.tiles().as_entire_binding(),
    ];
    let layout = pipelines.layouts.draw(target.store());
    bind_group(device, "draw", layout, resources)
}
