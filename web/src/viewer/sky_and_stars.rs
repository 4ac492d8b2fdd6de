//! Skies, stars and tables, as the page loads them.

use super::{Viewer, error};
use crate::sky_texels::built_in;
use js_sys::Promise;
use lensbake_interactive::state::NamedTable;
use lensbake_render::gpu::SkyUpload;
use lensbake_render::sky::SkySource;
use lensbake_render::stars::{StarField, catalogue_from_bytes};
use lensbake_tables::container;
use std::path::PathBuf;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::future_to_promise;

/// A sky that is being written to the device.
#[wasm_bindgen]
pub struct SkyWriter {
    source: SkySource,
    upload: SkyUpload,
}

#[wasm_bindgen]
impl SkyWriter {
    /// Writes a face of a mip level: the bytes that `SkyTexels.face` gives.
    ///
    /// # Errors
    /// If the sky has no such face.
    pub fn write(&self, level: u32, face: u32, texels: &[u8]) -> Result<(), JsError> {
        let written = self.upload.write(level, face, texels);
        written
            .then_some(())
            .ok_or_else(|| error("the sky has no such face"))
    }
}

#[wasm_bindgen]
impl Viewer {
    /// Whether a built-in sky is to be made that [`Viewer::take_wanted_sky`] has not yet given.
    #[wasm_bindgen(getter, js_name = wantsSky)]
    pub fn wants_sky(&self) -> bool {
        !self.wanted_skies.is_empty()
    }

    /// The built-in sky that is to be made now by `makeSky`, once.
    #[wasm_bindgen(js_name = takeWantedSky)]
    pub fn take_wanted_sky(&mut self) -> Option<String> {
        self.wanted_skies.pop()
    }

    /// Makes room for a sky with this many texels along the edge of a face: a promise of its writer. A name that is not
    /// of a built-in sky is that of a file.
    #[wasm_bindgen(js_name = beginSky)]
    pub fn begin_sky(&self, name: &str, face_texels: u32) -> Promise {
        let source = built_in(name).unwrap_or_else(|| SkySource::Panorama(PathBuf::from(name)));
        let renderer = self.session.stage.renderer().clone();
        future_to_promise(async move {
            let upload = renderer.begin_sky(face_texels).await;
            let upload = upload.map_err(|e| error(format!("{}: {e}", source.name())))?;
            Ok(SkyWriter { source, upload }.into())
        })
    }

    /// Forgets that the built-in sky of this name is being made, because that failed: it is made when it is selected again.
    #[wasm_bindgen(js_name = skyFailed)]
    pub fn sky_failed(&mut self, name: &str) {
        if let Some(source) = built_in(name) {
            self.session.forget_sky(&source);
        }
    }

    /// Shows the sky whose faces have been written, unless another was selected meanwhile.
    #[wasm_bindgen(js_name = endSky)]
    pub fn end_sky(&mut self, writer: SkyWriter) {
        let SkyWriter { source, upload } = writer;
        if self.session.keep_sky(&source, upload.finish()) && !source.is_built_in() {
            self.say(format!("sky: {}", source.name()));
        }
    }

    /// Whether a catalogue of stars is wanted and missing.
    #[wasm_bindgen(getter, js_name = wantsStars)]
    pub fn wants_stars(&self) -> bool {
        self.session.wants_stars() && !self.session.has_stars()
    }

    /// Whether the device can draw stars as points.
    #[wasm_bindgen(getter, js_name = drawsStars)]
    pub fn draws_stars(&self) -> bool {
        self.session.stage.renderer().draws_stars()
    }

    /// Takes a catalogue of stars: the bytes of a file.
    ///
    /// # Errors
    /// If they are no catalogue.
    #[wasm_bindgen(js_name = takeStars)]
    pub fn take_stars(&mut self, bytes: &[u8]) -> Result<(), JsError> {
        let catalogue = catalogue_from_bytes(bytes).map_err(error)?;
        self.session.set_stars(StarField::new(&catalogue, 0.0));
        Ok(())
    }

    /// Takes a bending table: the bytes of a file. Returns false if they are no table.
    ///
    /// # Errors
    /// If they are a table that cannot be used.
    #[wasm_bindgen(js_name = takeTable)]
    pub fn take_table(&mut self, name: &str, bytes: &[u8]) -> Result<bool, JsError> {
        let table = match container::from_bytes(bytes) {
            Ok(table) => table,
            Err(problem) if problem.is_no_table() => return Ok(false),
            Err(problem) => return Err(error(format!("{name}: {problem}"))),
        };
        let said = self.session.state.take_table(NamedTable::new(table, name));
        self.say(said.map_err(error)?);
        Ok(true)
    }
}
