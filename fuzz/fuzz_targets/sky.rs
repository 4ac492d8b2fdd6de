//! A sky picture, by the viewer's own entry and with its limits: PNG, JPEG, HDR and OpenEXR.

#![no_main]

use lensbake_fuzz::one_line;
use libfuzzer_sys::fuzz_target;
use std::path::Path;
use viewer::sky::{declared_size, panorama_from_bytes};

/// Larger pictures are valid, but take their time.
const MAX_WIDTH: u32 = 256;
/// How many texels of the sky, each of four channels, are looked at.
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
