//! A picture or a trace prepared on a GPU, to be drawn and read back in bands of rows.

use super::frame_resources::{FrameResources, Target};
use super::pipelines::Program;
use super::region::dispatch_pixels;
use super::renderer::Renderer;
use super::source::{Output, PipelineKey, Store};
use super::{GpuError, Passes, Region, ResidentScene, SkyOnDevice};
use crate::lens::Lens;
use crate::scene::Sampling;
use crate::shift::{Rendition, Shift};
use std::sync::Arc;
use wgpu::*;

/// Largest number of pixels of a band: 16 MiB of output.
const BUFFERED: u32 = 1 << 20;

/// A program and the resources that it draws with.
#[derive(Debug)]
pub struct Prepared {
    program: Arc<Program>,
    sky: Option<SkyOnDevice>,
    resources: FrameResources,
}

impl Prepared {
    /// Prepares the picture of `scene`.
    pub(super) fn picture(renderer: &Renderer, scene: &ResidentScene) -> Self {
        let lens = &scene.lens;
        let output = Output::Picture(scene.sampling);
        let key = PipelineKey::of(
            lens,
            output,
            Store::Buffer,
            scene.stars.is_some(),
            scene.rendition.shift,
        );
        let mut prepared = Prepared {
            program: renderer.program(key),
            sky: Some(scene.sky.clone()),
            resources: resources(renderer, lens, scene.sampling, scene.rendition),
        };
        if let Some(stars) = &scene.stars {
            prepared.resources.show_stars(lens, stars, scene.rendition);
        }
        prepared
    }

    /// Prepares the trace: where the light of each pixel comes from.
    pub(super) fn trace(renderer: &Renderer, lens: &Lens) -> Self {
        Prepared {
            program: renderer.program(PipelineKey::of(
                lens,
                Output::Trace,
                Store::Buffer,
                false,
                Shift::Off,
            )),
            sky: None,
            resources: resources(renderer, lens, Sampling::Single, Rendition::default()),
        }
    }

    /// The bands, from the top down, each as wide as the picture.
    pub fn bands(&self) -> &[Region] {
        self.resources.regions()
    }

    /// The buffer that every band in turn writes its pixels to, `[rows][width][4]` of f32.
    pub(super) fn pixels(&self) -> &Buffer {
        match self.resources.target() {
            Target::Buffer(buffer) => buffer,
            Target::Texture(_) => unreachable!("made on a buffer"),
        }
    }

    /// As [`FrameResources::check_stars`], to be called after the first band is drawn.
    pub(super) async fn check_stars(&self) -> Result<(), GpuError> {
        self.resources.check_stars().await
    }
}

fn resources(
    renderer: &Renderer,
    lens: &Lens,
    sampling: Sampling,
    rendition: Rendition,
) -> FrameResources {
    let size = [lens.camera.width, lens.camera.height];
    let most = BUFFERED.min(dispatch_pixels(lens.deflection));
    let rows = (most / size[0]).clamp(1, size[1]);
    let pixels = u64::from(rows) * u64::from(size[0]);
    let mut resources = FrameResources::on_buffer(renderer, pixels);
    resources.show(
        lens,
        sampling,
        rendition,
        Region::whole(size).bands(most),
        1.0,
    );
    resources
}

impl Passes for Prepared {
    fn count(&self) -> usize {
        self.bands().len()
    }

    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        pass: usize,
        timestamps: Option<ComputePassTimestampWrites>,
    ) {
        let (sky, program) = (self.sky.as_ref(), &self.program);
        self.resources
            .encode(encoder, sky, program, pass, timestamps);
    }
}
