//! A picture or a trace prepared on a GPU, to be drawn and read back in bands of rows.

use super::frame_resources::FrameResources;
use super::pipelines::Program;
use super::region::dispatch_pixels;
use super::renderer::Renderer;
use super::source::{Output, PipelineKey, Store};
use super::target::Target;
use super::timestamps::PassTimestamps;
use super::{GpuError, Passes, Region, ResidentScene, SkyOnDevice};
use crate::disc::Disc;
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
        let stars = scene.stars.as_ref();
        let stars = stars.filter(|_| renderer.draws_stars_through(lens));
        let (shift, disc) = (scene.rendition.shift, scene.disc.as_ref());
        let key = picture_key(lens, scene.sampling, stars.is_some(), shift, disc);
        let mut prepared = Prepared {
            program: renderer.program(key),
            sky: Some(scene.sky.clone()),
            resources: resources(renderer, lens, key.output, scene.rendition),
        };
        if let Some(stars) = stars {
            prepared.resources.show_stars(lens, stars, scene.rendition);
        }
        if let Some(disc) = scene.disc {
            prepared.resources.show_disc(lens, disc, scene.rendition);
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
            resources: resources(renderer, lens, Output::Trace, Rendition::default()),
        }
    }

    /// The bands, from the top down, each as wide as the picture.
    pub fn bands(&self) -> &[Region] {
        self.resources.regions()
    }

    /// What every band in turn is drawn to.
    pub(super) fn target(&self) -> &Target {
        self.resources.target()
    }

    /// As [`FrameResources::check_stars`], to be called after the first band is drawn.
    pub(super) async fn check_stars(&self) -> Result<(), GpuError> {
        self.resources.check_stars().await
    }
}

/// The key of the program that draws a picture.
pub(super) fn picture_key(
    lens: &Lens,
    sampling: Sampling,
    stars: bool,
    shift: Shift,
    disc: Option<&Disc>,
) -> PipelineKey {
    let output = Output::Picture(sampling);
    PipelineKey::of(lens, output, Store::Buffer, stars, shift).with_disc(disc)
}

fn resources(
    renderer: &Renderer,
    lens: &Lens,
    output: Output,
    rendition: Rendition,
) -> FrameResources {
    let size = [lens.camera.width, lens.camera.height];
    let most = BUFFERED.min(dispatch_pixels(lens.deflection));
    let rows = (most / size[0]).clamp(1, size[1]);
    let target = Target::regions(renderer, output, [size[0], rows]);
    let mut resources = FrameResources::new(renderer, target);
    resources.show(
        lens,
        (output.sampling(), renderer.pass(output)),
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
        timestamps: Option<PassTimestamps>,
    ) {
        let (sky, program) = (self.sky.as_ref(), &self.program);
        self.resources
            .encode(encoder, sky, program, pass, timestamps);
    }
}
