//! What compute passes draw with: a dispatch for each region, or for each tile class of a filtered region.

use super::Region;
use super::bindings::{bind_group, block_of};
use super::camera_block::RegionBlock;
use super::layouts::ComputeLayouts;
use super::lights::Lights;
use super::pipelines::ComputeProgram;
use super::target::Target;
use super::tile_queues::{PassInputs, WorkQueues};
use crate::filter::TileClass;
use crate::shaders::TILE;
use wgpu::*;

/// The bind group of the target, and the work queues of filtered regions.
#[derive(Debug)]
pub(super) struct ComputeResources {
    queues: WorkQueues,
    bind_group: BindGroup,
}

impl ComputeResources {
    /// Resources with work queues for `regions`.
    pub(super) fn new(
        device: &Device,
        layouts: &ComputeLayouts,
        inputs: &PassInputs,
        target: &Target,
        regions: &[Region],
    ) -> Self {
        let queues = WorkQueues::new(device, layouts, inputs, regions);
        let resources = [
            inputs.camera.as_entire_binding(),
            block_of::<RegionBlock>(inputs.regions),
            BindingResource::TextureView(inputs.row),
            target.binding(),
            queues.tiles().as_entire_binding(),
        ];
        let layout = layouts.draw(target.store());
        ComputeResources {
            bind_group: bind_group(device, "draw", layout, resources),
            queues,
        }
    }

    /// The work queues.
    pub(super) fn queues(&self) -> &WorkQueues {
        &self.queues
    }

    /// Encodes the clearing of the work queues of region `index`, before the pass.
    pub(super) fn clear(
        &self,
        encoder: &mut CommandEncoder,
        program: &ComputeProgram,
        index: usize,
    ) {
        if program.classifier.is_some() {
            self.queues.clear(encoder, index);
        }
    }

    /// Encodes the dispatches that draw `region`, the one with this index, whose uniform block is at `offset`.
    pub(super) fn draw(
        &self,
        pass: &mut ComputePass,
        program: &ComputeProgram,
        lights: &Lights,
        (index, region, offset): (usize, Region, u32),
    ) {
        if let (Some(classifier), Some(sky)) = (&program.classifier, lights.sky()) {
            let lights = (sky, lights.disc);
            self.queues
                .classify(pass, classifier, lights, region, offset);
        }
        pass.set_bind_group(0, &self.bind_group, &[offset]);
        for (group, bound) in (1..).zip(lights.groups()) {
            pass.set_bind_group(group, bound, &[]);
        }
        for (queue, (pipeline, class)) in program.pipelines.iter().zip(TileClass::ALL).enumerate() {
            pass.set_pipeline(pipeline);
            if program.classifier.is_some() {
                if let Some(sky) = lights.sky_of(class) {
                    pass.set_bind_group(1, sky, &[]);
                }
                self.queues.draw(pass, index, queue);
            } else {
                let [across, down] = region.count.map(|n| n.div_ceil(TILE));
                pass.dispatch_workgroups(across, down, 1);
            }
        }
    }
}
