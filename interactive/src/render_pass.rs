//! The render pass that draws a whole window.

use wgpu::*;

/// Begins the pass and clears `view` to black.
pub fn begin<'a>(
    encoder: &'a mut CommandEncoder,
    view: &TextureView,
    timestamp_writes: Option<RenderPassTimestampWrites>,
) -> RenderPass<'a> {
    encoder.begin_render_pass(&RenderPassDescriptor {
        label: Some("window"),
        color_attachments: &[Some(RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: Operations {
                load: LoadOp::Clear(Color::BLACK),
                store: StoreOp::Store,
            },
        })],
        timestamp_writes,
        ..Default::default()
    })
}
