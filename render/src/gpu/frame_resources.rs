//! The GPU resources that are kept from frame to frame: camera, row, regions, star lists and the target of the
//! picture. The next scene is written into the same resources; they are created anew only for another size of
//! picture or another shape of row.

use super::bindings::uniform_buffer;
use super::camera_block::{CameraBlock, RegionBlock};
use super::compute::begin_compute;
use super::compute_pass::ComputeResources;
use super::disc_block::DiscOnDevice;
use super::fragment_pass::{FragmentRegion, FragmentResources};
use super::layouts::Layouts;
use super::lights::Lights;
use super::lookup_shape::LookupShape;
use super::pass::Pass;
use super::pipelines::{Pipelines, Program, ProgramKind};
use super::renderer::Renderer;
use super::row_texture::RowTexture;
use super::stars::{Group, StarLight, StarLists, StarsOnDevice};
use super::target::Target;
use super::tile_queues::{self, PassInputs};
use super::timestamps::PassTimestamps;
use super::{Gpu, GpuError, Region, SkyOnDevice};
use crate::disc::Disc;
use crate::lens::Lens;
use crate::scene::Sampling;
use crate::shadow::Shadow;
use crate::shift::Rendition;
use lensbake_tables::lookup::HorizonSide;
use std::sync::Arc;
use wgpu::*;

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
    drawing: Drawing,
    /// The pixels that share a list of stars.
    group: Group,
    stars: Option<StarLists>,
    disc: Option<DiscOnDevice>,
}

/// What the programs of either kind of pass draw with.
#[derive(Debug)]
enum Drawing {
    Compute(ComputeResources),
    Fragment(FragmentResources),
}

impl FrameResources {
    /// Resources for pictures that are drawn to `target`.
    pub(super) fn new(renderer: &Renderer, target: Target) -> Self {
        let gpu = renderer.gpu().clone();
        let pipelines = renderer.pipelines().clone();
        let device = &gpu.device;
        let alignment = device.limits().min_uniform_buffer_offset_alignment;
        let region_stride = (size_of::<RegionBlock>() as u64).next_multiple_of(alignment.into());
        let camera = uniform_buffer(device, "camera", size_of::<CameraBlock>() as u64);
        let region_blocks = uniform_buffer(device, "regions", region_stride);
        let row = RowTexture::new(device, LookupShape::Stereographic(HorizonSide::Above));
        let inputs = PassInputs {
            camera: &camera,
            regions: &region_blocks,
            row: row.view(),
        };
        let drawing =
            Drawing::Fragment(FragmentResources::new(device, &pipelines.layouts, &inputs));
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
            drawing,
            group: Group::Rows,
            stars: None,
            disc: None,
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
    pub(super) fn work_queues(&self) -> Option<&tile_queues::WorkQueues> {
        match &self.drawing {
            Drawing::Compute(compute) => Some(compute.queues()),
            Drawing::Fragment(_) => None,
        }
    }

    /// Sets what the next programs draw, in this kind of pass: the view through `lens`, in these regions. The row is uploaded
    /// only if it differs from the last one. `gain` amplifies a difference.
    pub(super) fn show(
        &mut self,
        lens: &Lens,
        (sampling, pass): (Sampling, Pass),
        rendition: Rendition,
        regions: impl Iterator<Item = Region>,
        gain: f32,
    ) {
        self.regions.clear();
        self.regions.extend(regions);
        self.make_room(LookupShape::of(lens), sampling, pass);
        self.group = self.pipelines.group(pass, sampling);
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
        self.row.show(queue, lens);
    }

    /// Sets the stars that the next dispatches draw through `lens`, after [`FrameResources::show`]. Their lists are created
    /// anew only for other stars, or for another group of pixels that share a list.
    pub(super) fn show_stars(&mut self, lens: &Lens, stars: &StarsOnDevice, rendition: Rendition) {
        let is_shown = |lists: &StarLists| lists.are_of(stars, self.group);
        if !self.stars.as_ref().is_some_and(is_shown) {
            let size = [lens.camera.width, lens.camera.height];
            let size = self.target.room().unwrap_or(size);
            let programs = self.pipelines.stars(self.group);
            let layouts = &self.pipelines.layouts;
            self.stars = Some(StarLists::new(&self.gpu, layouts, programs, stars, size));
        }
        if let Some(lists) = &mut self.stars {
            lists.show(lens, rendition);
        }
    }

    /// Sets the disc that the next dispatches draw through `lens`.
    pub(super) fn show_disc(&mut self, lens: &Lens, disc: Disc, rendition: Rendition) {
        let (device, layout) = (&self.gpu.device, &self.pipelines.layouts.disc);
        let on_device = self
            .disc
            .get_or_insert_with(|| DiscOnDevice::new(device, layout));
        on_device.show(&self.gpu.queue, lens, disc, rendition);
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
        timestamps: Option<PassTimestamps>,
    ) {
        let stars = self.stars.as_ref().filter(|_| program.key.stars);
        let lists = stars.filter(|_| index == 0);
        let label = program.key.name();
        let disc = self.disc.as_ref().filter(|_| program.key.disc);
        let lights = Lights {
            on_sky: sky,
            sampling: program.key.sampling(),
            stars: stars.map(StarLists::reading),
            disc: disc.map(DiscOnDevice::bind_group),
        };
        let region = self.regions[index];
        let offset = (index as u64 * self.region_stride) as u32;
        let mut timestamps = timestamps;
        if let Some(lists) = lists {
            let (begins, ends) = timestamps.map_or((None, None), PassTimestamps::split);
            lists.make(encoder, begins);
            timestamps = ends;
        }
        match (&self.drawing, &program.kind) {
            (Drawing::Compute(resources), ProgramKind::Compute(program)) => {
                resources.clear(encoder, program, index);
                let mut pass = begin_compute(encoder, label, timestamps);
                resources.draw(&mut pass, program, &lights, (index, region, offset));
            }
            (Drawing::Fragment(resources), ProgramKind::Fragment(pipeline)) => {
                let drawn = FragmentRegion {
                    target: &self.target,
                    region,
                    offset,
                    // A GPU that draws tile by tile need not read a target that is cleared. A software adapter would
                    // only write each pixel twice.
                    clears: index == 0 && !self.gpu.is_software(),
                };
                let program = (label, pipeline);
                resources.draw(encoder, program, &lights, drawn, timestamps);
            }
            _ => unreachable!("a renderer's programs and resources are of its kind of pass"),
        }
        if let Some(lists) = lists {
            lists.report(encoder);
        }
    }

    /// Makes room for a row of this shape, for the uniform blocks of all regions, and for their work queues if the
    /// picture is filtered. Creates resources anew only for another shape or kind of pass, or if there are more regions or
    /// tiles than ever before.
    fn make_room(&mut self, lookup: LookupShape, sampling: Sampling, pass: Pass) {
        let blocks = self.regions.len() as u64 * self.region_stride;
        let by_tiles = pass == Pass::Compute && sampling.averages();
        let holds = match (&self.drawing, pass) {
            (Drawing::Compute(compute), Pass::Compute) => {
                !by_tiles || compute.queues().holds(&self.regions)
            }
            (Drawing::Fragment(_), Pass::Fragment) => true,
            (Drawing::Compute(_), Pass::Fragment) | (Drawing::Fragment(_), Pass::Compute) => false,
        };
        if self.row.fits(lookup) && blocks <= self.region_blocks.size() && holds {
            return;
        }
        let device = &self.gpu.device;
        if !self.row.fits(lookup) {
            self.row = RowTexture::new(device, lookup);
        }
        if blocks > self.region_blocks.size() {
            self.region_blocks = uniform_buffer(device, "regions", blocks);
            self.uploaded_regions.clear();
        }
        let regions = if by_tiles { &self.regions[..] } else { &[] };
        let inputs = PassInputs {
            camera: &self.camera,
            regions: &self.region_blocks,
            row: self.row.view(),
        };
        let layouts = &self.pipelines.layouts;
        self.drawing = drawing(pass, device, layouts, &inputs, &self.target, regions);
    }
}

/// What the programs of a kind of pass draw with, with work queues for `regions`.
fn drawing(
    pass: Pass,
    device: &Device,
    layouts: &Layouts,
    inputs: &PassInputs,
    target: &Target,
    regions: &[Region],
) -> Drawing {
    match pass {
        Pass::Compute => {
            let layouts = layouts.compute();
            Drawing::Compute(ComputeResources::new(
                device, layouts, inputs, target, regions,
            ))
        }
        Pass::Fragment => Drawing::Fragment(FragmentResources::new(device, layouts, inputs)),
    }
}
