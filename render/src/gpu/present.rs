//! The last render pass, which presents the finished picture in a window: `shaders/present.wgsl`.

use super::bindings::{
    bind_group, bind_group_layout, texture_binding, uniform_binding, uniform_buffer,
};
use super::compute::module;
use super::render_pipeline::{FullScreen, full_screen_pipeline};
use super::{CameraBlock, Gpu, RealtimeRenderer};
use crate::camera::Camera;
use crate::shaders::Modules;
use crate::shadow::Shadow;
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

/// How the picture is scaled to the window: the constant `FIT` of the shader.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fit {
    Unscaled,
    FromTwoByTwo,
    Enlarged,
    EnlargedEdge,
}

impl Fit {
    const ALL: [Fit; 4] = [
        Fit::Unscaled,
        Fit::FromTwoByTwo,
        Fit::Enlarged,
        Fit::EnlargedEdge,
    ];

    fn of(picture: [u32; 2], window: [u32; 2], edge: EdgeMode) -> Self {
        if picture == window {
            return Fit::Unscaled;
        }
        if picture == window.map(|side| 2 * side) {
            return Fit::FromTwoByTwo;
        }
        match edge {
            EdgeMode::AsDrawn => Fit::Enlarged,
            EdgeMode::Redrawn(_) => Fit::EnlargedEdge,
        }
    }
}

/// Presents pictures on a surface.
#[derive(Debug)]
pub struct Presenter {
    queue: Queue,
    layout: BindGroupLayout,
    pipelines: [RenderPipeline; Fit::ALL.len()],
    fit: Fit,
    camera: Buffer,
    present: Buffer,
    /// The block in that buffer.
    uploaded: Option<Present>,
    bind_group: BindGroup,
}

/// How the shadow's edge is drawn if the picture has fewer pixels than the window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EdgeMode {
    /// Enlarged like the rest of the picture.
    AsDrawn,
    /// Redrawn at the window's resolution, as the edge of this shadow.
    Redrawn(Shadow),
}

/// How a picture is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Presentation {
    /// How the shadow's edge is drawn.
    pub edge: EdgeMode,
    /// Column of the divider, in pixels of the window.
    pub divider: Option<u32>,
    /// Exposure, in stops.
    pub exposure: f32,
}

impl Presenter {
    /// A presenter for the pictures of `live` on surfaces of `format`.
    pub fn new(gpu: &Gpu, live: &RealtimeRenderer, format: TextureFormat) -> Self {
        let device = &gpu.device;
        let layout = layout(device);
        let camera = uniform_buffer(device, "window", size_of::<CameraBlock>() as u64);
        let present = uniform_buffer(device, "present", size_of::<Present>() as u64);
        Presenter {
            queue: gpu.queue.clone(),
            pipelines: pipelines(device, &layout, format),
            fit: Fit::Unscaled,
            bind_group: present_group(device, &layout, &camera, &present, live),
            layout,
            camera,
            present,
            uploaded: None,
        }
    }

    /// Binds the texture that `live` draws to now; needed whenever that texture is created anew.
    pub fn follow(&mut self, gpu: &Gpu, live: &RealtimeRenderer) {
        let (camera, present) = (&self.camera, &self.present);
        self.bind_group = present_group(&gpu.device, &self.layout, camera, present, live);
    }

    /// Sets what the next draw presents: a picture of `picture` pixels (width and height), in a window whose own
    /// camera is `window`.
    pub fn show(&mut self, picture: [u32; 2], window: &Camera, presentation: Presentation) {
        let shadow = match presentation.edge {
            EdgeMode::AsDrawn => Shadow::NONE,
            EdgeMode::Redrawn(shadow) => shadow,
        };
        let (window_camera, shadow) = shadow.apparent(window);
        let camera = CameraBlock::new(&window_camera, shadow, 1.0);
        let present = Present {
            picture,
            divider: presentation.divider.unwrap_or(NO_DIVIDER),
            exposure: presentation.exposure,
        };
        self.fit = Fit::of(picture, [window.width, window.height], presentation.edge);
        self.queue
            .write_buffer(&self.camera, 0, bytemuck::bytes_of(&camera));
        if self.uploaded != Some(present) {
            self.queue
                .write_buffer(&self.present, 0, bytemuck::bytes_of(&present));
            self.uploaded = Some(present);
        }
    }

    /// Encodes the drawing of the picture.
    pub fn draw(&self, pass: &mut RenderPass) {
        pass.set_pipeline(&self.pipelines[self.fit as usize]);
        pass.set_bind_group(0, &self.bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// The WGSL source of the render pass.
fn source() -> String {
    Modules::new().assemble(&["present"])
}

fn pipelines(
    device: &Device,
    layout: &BindGroupLayout,
    format: TextureFormat,
) -> [RenderPipeline; Fit::ALL.len()] {
    let module = module(device, "present", source());
    let encode = f64::from(u8::from(!format.is_srgb()));
    Fit::ALL.map(|fit| {
        let pipeline = FullScreen {
            label: "present",
            groups: &[layout],
            module: &module,
            entry_point: "shade",
            constants: &[("FIT", f64::from(fit as u32)), ("ENCODE", encode)],
            format,
        };
        full_screen_pipeline(device, pipeline)
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
    camera: &Buffer,
    present: &Buffer,
    live: &RealtimeRenderer,
) -> BindGroup {
    let resources = [
        camera.as_entire_binding(),
        present.as_entire_binding(),
        BindingResource::TextureView(live.texture()),
    ];
    bind_group(device, "present", layout, resources)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::source::tests::{assert_webgl2, validate};
    use crate::shaders::layouts::assert_layout;

    #[test]
    fn the_shader_is_valid_for_webgl2_too_and_lays_its_block_out_as_here() {
        let source = source();
        validate(&source, &["shade", "corner"]);
        for fit in Fit::ALL {
            for encode in [0.0, 1.0] {
                let constants = [("FIT", f64::from(fit as u32)), ("ENCODE", encode)];
                assert_webgl2(&source, &["shade", "corner"], &constants);
            }
        }
        assert_layout!(&source, "Present", Present, picture, divider, exposure);
    }
}
