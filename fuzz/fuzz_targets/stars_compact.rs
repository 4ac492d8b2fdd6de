//! Fuzz target: the compact star catalogue, from any bytes after its magic number, and with the checksum
//! corrected.

#![no_main]

use lensbake_fuzz::{exercise_stars, one_line};
use lensbake_render::stars::{StarsProblem, catalogue_from_bytes, to_bytes};
use libfuzzer_sys::fuzz_target;

const MAGIC: &[u8] = b"LBSTARS\0";
const CHECKSUM: std::ops::Range<usize> = 24..28;

fuzz_target!(|bytes: &[u8]| {
    let mut file = [MAGIC, bytes.get(MAGIC.len()..).unwrap_or(&[])].concat();
    let mut catalogue = catalogue_from_bytes(&file);
    if let Err(StarsProblem::Checksum { found, .. }) = catalogue {
        file[CHECKSUM].copy_from_slice(&found.to_le_bytes());
        catalogue = catalogue_from_bytes(&file);
    }
    match catalogue {
        Ok(catalogue) => {
            exercise_stars(&catalogue);
            let again = catalogue_from_bytes(&to_bytes(&catalogue)).unwrap();
            assert_eq!(again.stars().len(), catalogue.stars().len());
        }
        Err(problem) => one_line(&problem),
    }
});
