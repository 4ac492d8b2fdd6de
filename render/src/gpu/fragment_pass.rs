//! What render passes draw with: one triangle over the target for each region, clipped to the region.

use super::Region;
use super::bindings::{bind_group, block_of};
use super::camera_block::RegionBlock;
use super::layouts::Layouts;
use super::lights::Lights;
use super::target::Target;
use super::tile_queues::PassInputs;
use super::timestamps::PassTimestamps;
use wgpu::*;

/// The bind group of camera, region and row.
#[derive(Debug)]
pub(super) struct FragmentResources {
    bind_group: BindGroup,
}

/// One region as a render pass draws it.
pub(super) struct FragmentRegion<'a> {
    pub(super) target: &'a Target,
    pub(super) region: Region,
    /// Where its uniform block begins, bytes.
    pub(super) offset: u32,
    /// Whether the target is cleared first. The picture does not depend on it, because each pixel of a region is drawn.
    pub(super) clears: bool,
}

impl FragmentResources {
    pub(super) fn new(device: &Device, layouts: &Layouts, inputs: &PassInputs) -> Self {
        let resources = [
            inputs.camera.as_entire_binding(),
            block_of::<RegionBlock>(inputs.regions),
            BindingResource::TextureView(inputs.row),
        ];
        FragmentResources {
            bind_group: bind_group(device, "draw", &layouts.fragment, resources),
        }
    }

    /// Encodes the render pass that draws a region.
    pub(super) fn draw(
        &self,
        encoder: &mut CommandEncoder,
        (label, pipeline): (&str, &RenderPipeline),
        lights: &Lights,
        drawn: FragmentRegion,
        timestamps: Option<PassTimestamps>,
    ) {
        let load = if drawn.clears {
            LoadOp::Clear(Color::TRANSPARENT)
        } else {
            LoadOp::Load
        };
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            label: Some(label),
            color_attachments: &[Some(RenderPassColorAttachment {
                view: drawn.target.view(),
                depth_slice: None,
                resolve_target: None,
                ops: Operations {
                    load,
                    store: StoreOp::Store,
                },
            })],
            timestamp_writes: timestamps.map(PassTimestamps::of_render_pass),
            ..Default::default()
        });
        let [column, row] = drawn.target.origin_of(&drawn.region);
        let [width, height] = drawn.region.count;
        pass.set_scissor_rect(column, row, width, height);
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.bind_group, &[drawn.offset]);
        for (group, bound) in (1..).zip(lights.groups()) {
            pass.set_bind_group(group, bound, &[]);
        }
        pass.draw(0..3, 0..1);
    }
}
