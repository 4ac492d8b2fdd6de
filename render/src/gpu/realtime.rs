//! The realtime renderer: draws frames one after the other, for a window or a benchmark. A frame uploads what has
//! changed and dispatches what the picture needs.

use super::camera_key::CameraKey;
use super::frame_resources::FrameResources;
use super::lookup_shape::LookupShape;
use super::pipelines::Program;
use super::region::dispatch_pixels;
use super::source::{Output, PipelineKey, Store};
use super::target::Target;
use super::timestamps::PassTimestamps;
use super::{Passes, Region, Renderer, ResidentScene, SkyOnDevice, StarLight};
use crate::lens::Deflection;
use std::sync::Arc;
use wgpu::*;

/// What a frame shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrameContent {
    /// The picture by the deflection method of the lens.
    Picture,
    /// The picture by the table to the left of a column of pixels, and by direct integration from this column on.
    Split {
        /// The first column by direct integration.
        divider: u32,
    },
    /// The difference between the picture by the table and that by direct integration.
    Difference {
        /// Factor by which it is multiplied.
        gain: f32,
    },
}

/// What is drawn in a region.
#[derive(Debug, Clone, Copy, PartialEq)]
enum DrawKind {
    Picture(Deflection),
    Difference,
}

/// Draws frames to a texture. The first frame of a kind compiles its pipelines.
#[derive(Debug)]
pub struct RealtimeRenderer {
    renderer: Renderer,
    resources: FrameResources,
    room: [u32; 2],
    sky: Option<SkyOnDevice>,
    /// The program of each region.
    programs: Vec<Arc<Program>>,
}

impl RealtimeRenderer {
    /// Frames of at most `room` pixels (width and height), drawn by `renderer`.
    pub fn new(renderer: Renderer, room: [u32; 2]) -> Self {
        RealtimeRenderer {
            resources: FrameResources::new(&renderer, Target::texture(&renderer, room)),
            room,
            sky: None,
            programs: Vec::new(),
            renderer,
        }
    }

    /// The renderer, which can also upload skies and stars.
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }

    /// Largest width and height of a frame, pixels.
    pub fn room(&self) -> [u32; 2] {
        self.room
    }

    /// Changes the largest size of a frame, for which the texture is created anew.
    pub fn set_room(&mut self, room: [u32; 2]) {
        if room != self.room {
            self.room = room;
            self.resources =
                FrameResources::new(&self.renderer, Target::texture(&self.renderer, room));
            self.programs.clear();
        }
    }

    /// Whether the newest frame whose node count has arrived since the last call contains the light of all its
    /// stars; `None` if no count has arrived. Does not block. Call it after each frame is submitted, and again
    /// while [`RealtimeRenderer::awaits_star_light`].
    pub fn star_light(&self) -> Option<StarLight> {
        self.resources.star_light()
    }

    /// Whether a node count is under way that [`RealtimeRenderer::star_light`] will report.
    pub fn awaits_star_light(&self) -> bool {
        self.resources.awaits_star_light()
    }

    /// The texture that the frames are drawn to, of [`RealtimeRenderer::room`] pixels. A smaller frame fills its
    /// upper left corner.
    pub fn texture(&self) -> &TextureView {
        self.resources.target().view()
    }

    /// Sets what the next frame draws. This is all the CPU work of a frame besides submitting it. [`FrameContent::Split`]
    /// and [`FrameContent::Difference`] take the step of direct integration from the deflection method of the lens. A
    /// difference is drawn with one ray per pixel and without stars.
    ///
    /// # Panics
    /// If the scene is larger than [`RealtimeRenderer::room`].
    pub fn show(&mut self, scene: &ResidentScene, show: FrameContent) {
        let lens = &scene.lens;
        let (width, height) = (lens.camera.width, lens.camera.height);
        let [most_wide, most_high] = self.room;
        assert!(width <= most_wide && height <= most_high, "no room");
        let direct = Deflection::Direct {
            step: lens.deflection.integrator_step(),
        };
        let whole = columns(0, width, height);
        let (parts, gain) = match show {
            FrameContent::Picture => (vec![(DrawKind::Picture(lens.deflection), whole)], 1.0),
            FrameContent::Difference { gain } => (vec![(DrawKind::Difference, whole)], gain),
            FrameContent::Split { divider } => {
                let divider = divider.min(width);
                let left = columns(0, divider, height);
                let right = columns(divider, width - divider, height);
                let parts = vec![
                    (DrawKind::Picture(Deflection::Lut), left),
                    (DrawKind::Picture(direct), right),
                ];
                (parts, 1.0)
            }
        };
        let stars = scene.stars.as_ref();
        let stars = stars.filter(|_| self.renderer.draws_stars_through(lens));
        let mut regions = Vec::new();
        self.programs.clear();
        for (kind, part) in parts.into_iter().filter(|(_, part)| part.count[0] > 0) {
            let (deflection, output) = match kind {
                DrawKind::Picture(deflection) => (deflection, Output::Picture(scene.sampling)),
                DrawKind::Difference => (direct, Output::Difference),
            };
            let (lookup, motion) = (LookupShape::of(lens), CameraKey::of(&lens.camera));
            let key = PipelineKey::new(
                deflection,
                output,
                Store::Texture,
                lookup,
                stars.is_some(),
                motion,
                scene.rendition.shift,
            )
            .with_disc(scene.disc.as_ref());
            let program = self.renderer.program(key);
            for region in part.bands(dispatch_pixels(deflection)) {
                regions.push(region);
                self.programs.push(program.clone());
            }
        }
        let output = match show {
            FrameContent::Difference { .. } => Output::Difference,
            FrameContent::Picture | FrameContent::Split { .. } => Output::Picture(scene.sampling),
        };
        let drawn = (output.sampling(), self.renderer.pass(output));
        self.resources
            .show(lens, drawn, scene.rendition, regions.into_iter(), gain);
        if let Some(stars) = stars {
            self.resources.show_stars(lens, stars, scene.rendition);
        }
        if let Some(disc) = scene.disc {
            self.resources.show_disc(lens, disc, scene.rendition);
        }
        self.sky = Some(scene.sky.clone());
    }
}

impl Passes for RealtimeRenderer {
    fn count(&self) -> usize {
        self.programs.len()
    }

    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        pass: usize,
        timestamps: Option<PassTimestamps>,
    ) {
        let (sky, program) = (self.sky.as_ref(), &self.programs[pass]);
        self.resources
            .encode(encoder, sky, program, pass, timestamps);
    }
}

fn columns(first: u32, count: u32, height: u32) -> Region {
    Region {
        first: [first, 0],
        count: [count, height],
    }
}
