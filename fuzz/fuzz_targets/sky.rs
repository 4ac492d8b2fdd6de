//! Fuzz target: a sky picture (PNG, JPEG, HDR or OpenEXR), read by the viewer's own function with its limits.

#![no_main]

use lensbake_fuzz::one_line;
use lensbake_render::sky::{declared_size, panorama_from_bytes};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

/// Largest side: larger pictures are valid, but slow.
const MAX_WIDTH: u32 = 256;
/// Number of texels of the sky to check, each of four channels.
const TEXELS: usize = 1000;

fuzz_target!(|bytes: &[u8]| {
    let path = Path::new("sky");
    match declared_size(path, bytes.to_vec()) {
        Ok((width, height)) if width <= MAX_WIDTH && height <= MAX_WIDTH => {}
        Ok(_) => return,
        Err(error) => return one_line(&error),
    }
    match panorama_from_bytes(path, bytes.to_vec()) {
        Ok(sky) => {
            let texels = sky.levels()[0].texels().iter().take(TEXELS);
            for light in texels.flatten() {
                assert!(light.is_finite() && light.to_f32() >= 0.0, "{light}");
            }
        }
        Err(error) => one_line(&error),
    }
});
