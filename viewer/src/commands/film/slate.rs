//! The .exr of a frame: its light, its layers, and a header from which it can be drawn again.

use super::super::CommandError;
use super::super::metadata::{self, Described, TableFacts};
use super::camera::FilmCamera;
use super::latent::Developed;
use crate::cli::{Exposure, FilmArgs, LayerName};
use lensbake_render::layers;
use lensbake_render::openexr;

/// What the files of all frames have in common.
pub(super) struct Slate<'a> {
    pub(super) args: &'a FilmArgs,
    pub(super) camera: &'a FilmCamera<'a>,
}

impl Slate<'_> {
    /// The bytes of the .exr of `frame`. Its layers are those at the time of the frame, also of a frame with motion blur.
    pub(super) fn openexr(&self, frame: &Developed) -> Result<Vec<u8>, CommandError> {
        let (args, camera) = (self.args, self.camera);
        let lens = camera.lens(&frame.view)?;
        let wanted = LayerName::layers_of(&args.aov, &args.disc)?;
        let layers = layers::trace(&lens, &wanted, camera.sampling, camera.disc, || ());
        let exposure = match args.drawing.exposure {
            Exposure::Stops(_) => Some(frame.exposure),
            Exposure::Automatic => None,
        };
        let recorded = args.recorded.clone();
        let recorded = recorded.map(|options| options.with_camera(&frame.view, exposure));
        let disc = camera.disc_at(camera.plan.clock.time(frame.frame));
        let described = Described {
            light: &args.light,
            drawing: &args.drawing,
            stars: &args.stars,
            disc: disc.as_ref(),
            budget_px: None,
            recorded: recorded.as_ref(),
        };
        let table = TableFacts::new(camera.table_name.to_owned(), camera.table.header(), &lens);
        let metadata = metadata::of(&described, &frame.view, &table, &camera.device())?;
        Ok(openexr::encode(&frame.picture, layers, &metadata)?)
    }
}
