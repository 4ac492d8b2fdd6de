//! The viewer for a web page: WebAssembly that JavaScript calls. `page/lensbake.js` is the module for programs, which
//! passes events and draws frames; `page/page.js` adds the panel.
#![cfg(target_arch = "wasm32")]

mod panel;
mod sky_texels;
mod viewer;

pub use sky_texels::{SkyTexels, make_sky, read_panorama};
pub use viewer::{FrameState, SkyWriter, Viewer};

use wasm_bindgen::prelude::wasm_bindgen;

/// Runs once when the module is loaded: a panic is then told in the console.
#[wasm_bindgen(start)]
pub fn start() {
    console_error_panic_hook::set_once();
}
