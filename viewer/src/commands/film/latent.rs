//! A frame between drawing and encoding.

use super::super::CommandError;
use super::camera::FilmCamera;
use lensbake_render::camera::View;
use lensbake_render::cpu;
use lensbake_render::picture::Picture;
use lensbake_render::shift::Rendition;
use lensbake_render::stars::SortedStars;

/// A latent frame: the light of its sky, summed over the moments at which the shutter was open, still without stars.
pub(super) struct Latent {
    frame: u32,
    /// Exposure of its file, stops; an .exr, which keeps all light, only records it.
    exposure: f32,
    /// What the frame shows at its time.
    view: View,
    rendition: Rendition,
    light: Option<Picture>,
    /// What it shows at each moment. Its lenses would take the memory of as many rows of the table.
    moments: Vec<View>,
}

/// A frame to be encoded.
pub(super) struct Developed {
    pub(super) frame: u32,
    /// Exposure of its file, stops; an .exr, which keeps all light, only records it.
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

    /// Adds the light of a moment, which shows `view`.
    pub(super) fn add(&mut self, light: Picture, view: View) {
        match &mut self.light {
            Some(sum) => sum.add_picture(&light),
            None => self.light = Some(light),
        }
        self.moments.push(view);
    }

    /// The frame: the mean over its moments, with `stars`, seen by `camera`. `None` without moments.
    pub(super) fn developed(
        self,
        stars: Option<&SortedStars>,
        camera: &FilmCamera,
    ) -> Result<Option<Developed>, CommandError> {
        let Some(mut picture) = self.light else {
            return Ok(None);
        };
        if let Some(stars) = stars {
            for view in &self.moments {
                let lens = camera.lens(view)?;
                cpu::add_stars(&mut picture, &lens, self.rendition, camera.disc, |light| {
                    stars.draw(light, &lens, self.rendition);
                });
            }
        }
        if self.moments.len() > 1 {
            picture.scale(1.0 / self.moments.len() as f32);
        }
        Ok(Some(Developed {
            frame: self.frame,
            exposure: self.exposure,
            view: self.view,
            picture,
        }))
    }
}
