//! From the finished picture to a window's pixels: `shaders/present.wgsl`.

use super::bindings::{bind_group, bind_group_layout, texture_binding, uniform_binding};
use super::{Frame, Gpu, Live, Tile};
use crate::camera::Camera;
use crate::tone_map;
use lensbake_tables::{Interpolation, lookup};
use wgpu::*;

/// The struct `Present` of `shaders/present.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Present {
    picture: [u32; 2],
    divider: u32,
    exposure: f32,
}

const NO_DIVIDER: u32 = u32::MAX;

/// How the picture becomes the window's: the constant `FIT` of the shader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fit {
    AsItIs,
    FromTwoByTwo,
    Enlarged,
    EnlargedShadow,
    EnlargedSphere,
}

impl Fit {
    const ALL: [Fit; 5] = [
        Fit::AsItIs,
        Fit::FromTwoByTwo,
        Fit::Enlarged,
        Fit::EnlargedShadow,
        Fit::EnlargedSphere,
    ];

    fn of(picture: [u32; 2], window: [u32; 2], edge: Edge) -> Self {
        if picture == window {
            return Fit::AsItIs;
        }
        if picture == window.map(|side| 2 * side) {
            return Fit::FromTwoByTwo;
        }
        match edge {
            Edge::AsDrawn => Fit::Enlarged,
            Edge::Shadow => Fit::EnlargedShadow,
            Edge::Sphere => Fit::EnlargedSphere,
        }
    }
}

/// Shows pictures on a surface.
#[derive(Debug)]
pub struct Presenter {
    queue: Queue,
    layout: BindGroupLayout,
    pipelines: [RenderPipeline; Fit::ALL.len()],
    fit: Fit,
    frame: Buffer,
    present: Buffer,
    bind_group: BindGroup,
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Showing {
    /// What becomes of the edge.
    pub edge: Edge,
    /// The window's column in which a divider stands.
    pub divider: Option<u32>,
    /// How much brighter it is shown, in stops.
    pub exposure: f32,
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
        let layout = layout(device);
        let frame = uniform("window", size_of::<Frame>());
        let present = uniform("present", size_of::<Present>());
        Presenter {
            queue: gpu.queue.clone(),
            pipelines: pipelines(device, &layout, format),
            fit: Fit::AsItIs,
            bind_group: present_group(device, &layout, &frame, &present, live),
            layout,
            frame,
            present,
        }
    }

    /// Turns to the texture that `live` draws to now.
    pub fn follow(&mut self, gpu: &Gpu, live: &Live) {
        let (frame, present) = (&self.frame, &self.present);
        self.bind_group = present_group(&gpu.device, &self.layout, frame, present, live);
    }

    /// Sets what is shown next: a picture of `picture` pixels in a window whose own camera is `window`.
    pub fn show(&mut self, picture: [u32; 2], window: &Camera, showing: Showing) {
        let whole = Tile {
            first: [0, 0],
            count: [window.width, window.height],
        };
        let frame = Frame::new(window, whole, 1.0);
        let present = Present {
            picture,
            divider: showing.divider.unwrap_or(NO_DIVIDER),
            exposure: showing.exposure,
        };
        self.fit = Fit::of(picture, whole.count, showing.edge);
        self.queue
            .write_buffer(&self.frame, 0, bytemuck::bytes_of(&frame));
        self.queue
            .write_buffer(&self.present, 0, bytemuck::bytes_of(&present));
    }

    /// Draws it.
    pub fn draw(&self, pass: &mut RenderPass) {
        pass.set_pipeline(&self.pipelines[self.fit as usize]);
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
        tone_map::WGSL,
        include_str!("../shaders/present.wgsl"),
    ]
    .join("\n")
}

fn pipelines(
    device: &Device,
    layout: &BindGroupLayout,
    format: TextureFormat,
) -> [RenderPipeline; Fit::ALL.len()] {
    let module = device.create_shader_module(ShaderModuleDescriptor {
        label: Some("present"),
        source: ShaderSource::Wgsl(source().into()),
    });
    let layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: Some("present"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let encode = f64::from(u8::from(!format.is_srgb()));
    Fit::ALL.map(|fit| {
        let constants = [("FIT", f64::from(fit as u32)), ("ENCODE", encode)];
        device.create_render_pipeline(&RenderPipelineDescriptor {
            label: Some("present"),
            layout: Some(&layout),
            vertex: VertexState {
                module: &module,
                entry_point: Some("corner"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            fragment: Some(FragmentState {
                module: &module,
                entry_point: Some("shade"),
                compilation_options: PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                targets: &[Some(format.into())],
            }),
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            multiview_mask: None,
            cache: None,
        })
    })
}

fn layout(device: &Device) -> BindGroupLayout {
    let uniform = uniform_binding(false);
    let picture = texture_binding(TextureViewDimension::D2, false);
    let stages = ShaderStages::FRAGMENT;
    bind_group_layout(device, "present", stages, &[uniform, uniform, picture])
}

fn present_group(
    device: &Device,
    layout: &BindGroupLayout,
    frame: &Buffer,
    present: &Buffer,
    live: &Live,
) -> BindGroup {
    let resources = [
        frame.as_entire_binding(),
        present.as_entire_binding(),
        BindingResource::TextureView(live.texture()),
    ];
    bind_group(device, "present", layout, resources)
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
        assert_eq!(offsets, [0, 8, 12]);
        assert_eq!(*span as usize, size_of::<Present>());
    }
}
