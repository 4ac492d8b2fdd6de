//! From the finished picture to a window's pixels: `shaders/present.wgsl`.

use super::renderer::resource;
use super::{Frame, Gpu, Live, Tile};
use crate::camera::Camera;
use crate::scene::Method;
use lensbake_tables::{Interpolation, lookup};
use wgpu::*;

/// The struct `Present` of `shaders/present.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Present {
    picture: [u32; 2],
    edge: u32,
    divider: u32,
    encode: u32,
    padding: u32,
}

const NO_EDGE: u32 = 0;
const SHADOW: u32 = 1;
const SPHERE: u32 = 2;
const NO_DIVIDER: u32 = u32::MAX;

/// Shows pictures on a surface.
#[derive(Debug)]
pub struct Presenter {
    queue: Queue,
    pipeline: RenderPipeline,
    frame: Buffer,
    present: Buffer,
    bind_group: BindGroup,
    encode: bool,
}

/// The edge between the hole and the sky, where the picture has fewer pixels than the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// Enlarged like the rest.
    AsDrawn,
    /// The shadow's, drawn anew at the window's resolution.
    Shadow,
    /// The horizon's as a plain sphere, drawn anew.
    Sphere,
}

/// How a picture is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Showing {
    /// What becomes of the edge.
    pub edge: Edge,
    /// The window's column in which a divider stands.
    pub divider: Option<u32>,
}

impl Presenter {
    /// Shows what `live` draws on surfaces of `format`.
    pub fn new(gpu: &Gpu, live: &Live, format: TextureFormat) -> Self {
        let device = &gpu.device;
        let uniform = |label, size: usize| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size: size as u64,
                usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let pipeline = pipeline(device, format);
        let frame = uniform("window", size_of::<Frame>());
        let present = uniform("present", size_of::<Present>());
        Presenter {
            queue: gpu.queue.clone(),
            bind_group: bind_group(device, &pipeline, &frame, &present, live),
            encode: !format.is_srgb(),
            pipeline,
            frame,
            present,
        }
    }

    /// Turns to the texture that `live` draws to now.
    pub fn follow(&mut self, gpu: &Gpu, live: &Live) {
        let (frame, present) = (&self.frame, &self.present);
        self.bind_group = bind_group(&gpu.device, &self.pipeline, frame, present, live);
    }

    /// Sets what is shown next: a picture of `picture` pixels in a window whose own camera is `window`.
    pub fn show(&self, picture: [u32; 2], window: &Camera, showing: Showing) {
        let whole = Tile {
            first: [0, 0],
            count: [window.width, window.height],
        };
        let frame = Frame::new(window, whole, Method::DEFAULT_STEP, 1.0);
        let present = Present {
            picture,
            edge: match showing.edge {
                Edge::AsDrawn => NO_EDGE,
                Edge::Shadow => SHADOW,
                Edge::Sphere => SPHERE,
            },
            divider: showing.divider.unwrap_or(NO_DIVIDER),
            encode: self.encode.into(),
            padding: 0,
        };
        self.queue
            .write_buffer(&self.frame, 0, bytemuck::bytes_of(&frame));
        self.queue
            .write_buffer(&self.present, 0, bytemuck::bytes_of(&present));
    }

    /// Draws it.
    pub fn draw(&self, pass: &mut RenderPass) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// The WGSL of the last pass. It reads the shadow's edge, not the row.
fn source() -> String {
    [
        &lookup::wgsl_row(2, Interpolation::Hermite, 0, 3),
        lookup::WGSL,
        include_str!("../shaders/frame.wgsl"),
        include_str!("../shaders/present.wgsl"),
    ]
    .join("\n")
}

fn pipeline(device: &Device, format: TextureFormat) -> RenderPipeline {
    let module = device.create_shader_module(ShaderModuleDescriptor {
        label: Some("present"),
        source: ShaderSource::Wgsl(source().into()),
    });
    device.create_render_pipeline(&RenderPipelineDescriptor {
        label: Some("present"),
        layout: None,
        vertex: VertexState {
            module: &module,
            entry_point: Some("corner"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        fragment: Some(FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        multiview_mask: None,
        cache: None,
    })
}

fn bind_group(
    device: &Device,
    pipeline: &RenderPipeline,
    frame: &Buffer,
    present: &Buffer,
    live: &Live,
) -> BindGroup {
    device.create_bind_group(&BindGroupDescriptor {
        label: Some("present"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            resource(0, frame.as_entire_binding()),
            resource(1, present.as_entire_binding()),
            resource(2, BindingResource::TextureView(live.texture())),
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    #[test]
    fn the_shader_is_valid_and_lays_its_block_out_as_here() {
        let source = source();
        let module = naga::front::wgsl::parse_str(&source)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap();
        let block = module
            .types
            .iter()
            .find(|(_, t)| t.name.as_deref() == Some("Present"))
            .unwrap();
        let naga::TypeInner::Struct { members, span } = &block.1.inner else {
            panic!("no struct");
        };
        let offsets: Vec<u32> = members.iter().map(|m| m.offset).collect();
        assert_eq!(offsets, [0, 8, 12, 16]);
        assert_eq!(*span as usize, size_of::<Present>());
    }
}
