//! The film camera: draws the light of a frame, without its stars.

use super::super::{CommandError, lens_of};
use super::latent::Latent;
use super::plan::Plan;
use crate::cli::Exposure;
use lensbake_film::Shot;
use lensbake_render::camera::{Camera, CubeFace, Projection, View};
use lensbake_render::disc::Disc;
use lensbake_render::gpu::{GpuError, Renderer};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::{Rendition, Shift};
use lensbake_render::sky::Sky;
use lensbake_render::tone_map::EXPOSURES;
use lensbake_render::{cpu, exposure};
use lensbake_tables::Table;
use pollster::block_on;
use std::sync::Arc;

/// Draws frames, each from its number alone.
pub(super) struct FilmCamera<'a> {
    pub(super) plan: &'a Plan,
    pub(super) table: &'a Table,
    pub(super) table_name: &'a str,
    pub(super) deflection: Deflection,
    pub(super) sampling: Sampling,
    pub(super) shift: Shift,
    pub(super) exposure: Exposure,
    /// Whether the frames keep all light, so that exposure does not change them.
    pub(super) keeps_light: bool,
    pub(super) sky: Arc<Sky>,
    /// The disc at the beginning of the film.
    pub(super) disc: Option<Disc>,
    /// How much time of the disc's pattern passes in a second of the film, r_s/c.
    pub(super) disc_rate: f64,
    /// The GPU's renderer; the CPU draws without one.
    pub(super) renderer: Option<Renderer>,
}

impl FilmCamera<'_> {
    /// Name of the device that draws.
    pub(super) fn device(&self) -> String {
        match &self.renderer {
            Some(renderer) => renderer.gpu().name(),
            None => "the CPU".to_owned(),
        }
    }

    /// Checks that the table has a row for each of `frames`.
    pub(super) fn check(&self, frames: &[u32]) -> Result<(), CommandError> {
        frames
            .iter()
            .try_for_each(|&frame| self.lens(&self.plan.shot(frame).view).map(drop))
    }

    /// Draws the light of `frame`.
    pub(super) fn expose(&self, frame: u32) -> Result<Latent, CommandError> {
        let shot = self.plan.shot(frame);
        let (rendition, exposure) = self.exposed(&shot)?;
        let mut latent = Latent::new(frame, shot.view, rendition, exposure);
        for (time, shot) in self.plan.moments(frame) {
            let lens = self.lens(&shot.view)?;
            latent.add(self.draw(lens, rendition, self.disc_at(time))?, shot.view);
        }
        Ok(latent)
    }

    pub(super) fn lens(&self, view: &View) -> Result<Lens, CommandError> {
        let camera = Camera::new(view)?;
        lens_of(camera, self.table, self.table_name, self.deflection)
    }

    /// The lenses of all pictures that are shown together with that of `view`: the faces of a cube, or one.
    fn lenses(&self, view: &View) -> Result<Vec<Lens>, CommandError> {
        let face = |face| View {
            projection: Projection::CubeFace(face),
            ..*view
        };
        let views = match view.projection {
            Projection::CubeFace(_) => CubeFace::ALL.map(face).to_vec(),
            _ => vec![*view],
        };
        views.iter().map(|view| self.lens(view)).collect()
    }

    /// The rendition of a frame, and its exposure in stops. The path's exposure is added to that of the command line. Where
    /// frames keep all light, `auto` changes nothing.
    fn exposed(&self, shot: &Shot) -> Result<(Rendition, f32), CommandError> {
        let plain = Rendition::of(self.shift);
        let (rendition, stops) = match self.exposure {
            Exposure::Stops(stops) => (plain, stops),
            Exposure::Automatic if self.keeps_light => (plain, 0.0),
            Exposure::Automatic => {
                let stops = exposure::automatic_of_all(&self.lenses(&shot.view)?, self.shift);
                let light_scale = stops.exp2();
                (
                    Rendition {
                        light_scale,
                        ..plain
                    },
                    0.0,
                )
            }
        };
        let sum = stops + shot.exposure as f32;
        Ok((rendition, sum.clamp(*EXPOSURES.start(), *EXPOSURES.end())))
    }

    /// The disc `time` seconds after the beginning of the film.
    pub(super) fn disc_at(&self, time: f64) -> Option<Disc> {
        self.disc.map(|disc| Disc {
            time: disc.time + self.disc_rate * time,
            ..disc
        })
    }

    /// Draws without stars: the GPU would add up those of a pixel in another order each time.
    fn draw(
        &self,
        lens: Lens,
        rendition: Rendition,
        disc: Option<Disc>,
    ) -> Result<Picture, GpuError> {
        let scene = Scene {
            lens,
            sampling: self.sampling,
            sky: self.sky.clone(),
            stars: None,
            rendition,
            disc,
        };
        match &self.renderer {
            Some(renderer) => block_on(renderer.picture(&scene, |_| ())),
            None => Ok(cpu::render(&scene, || ())),
        }
    }
}
