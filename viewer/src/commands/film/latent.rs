//! A frame between drawing and encoding.

use lensbake_render::camera::View;
use lensbake_render::lens::Lens;
use lensbake_render::picture::Picture;
use lensbake_render::shift::Rendition;
use lensbake_render::stars::SortedStars;

/// A latent frame: the light of its sky, summed over the moments at which the shutter was open, still without stars.
pub(super) struct Latent {
    frame: u32,
    /// Exposure of its file, stops.
    exposure: f32,
    /// What the frame shows at its time.
    view: View,
    rendition: Rendition,
    light: Option<Picture>,
    moments: Vec<Lens>,
}

/// A frame to be encoded.
pub(super) struct Developed {
    pub(super) frame: u32,
    /// Exposure of its file, stops.
    pub(super) exposure: f32,
    /// What it shows at its time.
    pub(super) view: View,
    pub(super) picture: Picture,
}

impl Latent {
    pub(super) fn new(frame: u32, view: View, rendition: Rendition, exposure: f32) -> Self {
        Latent {
            frame,
            view,
            exposure,
            rendition,
            light: None,
            moments: Vec::new(),
        }
    }

    /// Adds the light of a moment, seen through `lens`.
    pub(super) fn add(&mut self, light: Picture, lens: Lens) {
        match &mut self.light {
            Some(sum) => sum.add_picture(&light),
            None => self.light = Some(light),
        }
        self.moments.push(lens);
    }

    /// The frame: the mean over its moments, with `stars`. `None` without moments.
    pub(super) fn developed(self, stars: Option<&SortedStars>) -> Option<Developed> {
        let mut picture = self.light?;
        if let Some(stars) = stars {
            for lens in &self.moments {
                stars.draw(&mut picture, lens, self.rendition);
            }
        }
        if self.moments.len() > 1 {
            picture.scale(1.0 / self.moments.len() as f32);
        }
        Some(Developed {
            frame: self.frame,
            exposure: self.exposure,
            view: self.view,
            picture,
        })
    }
}
