//! Skies as texels, for a worker that makes or reads a sky and sends it to the page face by face.

use lensbake_render::sky::{self, Sky, SkySource};
use std::path::Path;
use wasm_bindgen::prelude::*;

/// The texels of a sky.
#[wasm_bindgen]
#[derive(Debug)]
pub struct SkyTexels(Sky);

#[wasm_bindgen]
impl SkyTexels {
    /// Texels along the edge of a face of the first level.
    #[wasm_bindgen(getter, js_name = faceTexels)]
    pub fn face_texels(&self) -> u32 {
        self.0.face_texels()
    }

    /// Number of mip levels.
    #[wasm_bindgen(getter)]
    pub fn levels(&self) -> u32 {
        self.0.levels().len() as u32
    }

    /// The texels of a face of a level as bytes, or nothing if there is none.
    pub fn face(&self, level: u32, face: u32) -> Option<Vec<u8>> {
        let cube = self.0.levels().get(level as usize)?;
        (face < 6).then(|| cube.face_bytes(face as usize).to_vec())
    }
}

impl SkyTexels {
    /// The sky.
    pub fn into_sky(self) -> Sky {
        self.0
    }
}

/// The built-in sky of this name.
pub fn built_in(name: &str) -> Option<SkySource> {
    let all = lensbake_interactive::skies::BUILT_IN;
    all.into_iter().find(|source| source.name() == name)
}

/// Makes the built-in sky of this name, with `face_texels` texels along the edge of a face, or as many as it always has
/// if that is 0.
///
/// # Errors
/// If there is no such sky.
#[wasm_bindgen(js_name = makeSky)]
pub fn make_sky(name: &str, face_texels: u32) -> Result<SkyTexels, JsError> {
    let source =
        built_in(name).ok_or_else(|| JsError::new(&format!("there is no sky '{name}'")))?;
    let sky = match (&source, face_texels) {
        (SkySource::Nebula, 1..) => sky::nebula(face_texels),
        (SkySource::Starmap, 1..) => sky::starmap(face_texels),
        (SkySource::Grid, 1..) => sky::grid(face_texels),
        _ => sky::load(&source).map_err(|error| JsError::new(&error.to_string()))?,
    };
    Ok(SkyTexels(sky))
}

/// Reads a panorama: the bytes of a PNG, JPEG, Radiance HDR or OpenEXR file.
///
/// # Errors
/// If it cannot be used, with the reason and `name`.
#[wasm_bindgen(js_name = readPanorama)]
pub fn read_panorama(name: &str, bytes: Vec<u8>) -> Result<SkyTexels, JsError> {
    let sky = sky::panorama_from_bytes(Path::new(name), bytes);
    sky.map(SkyTexels)
        .map_err(|error| JsError::new(&error.to_string()))
}
