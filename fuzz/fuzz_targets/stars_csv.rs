//! Fuzz target: a star catalogue as CSV.

#![no_main]

use lensbake_fuzz::{exercise_stars, one_line};
use lensbake_render::stars::{StarsProblem, catalogue_from_bytes};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // The compact format has its own target.
    if bytes.starts_with(b"LBSTARS\0") {
        return;
    }
    match catalogue_from_bytes(bytes) {
        Ok(catalogue) => exercise_stars(&catalogue),
        Err(problem) => {
            one_line(&problem);
            if let StarsProblem::Line { line, .. } | StarsProblem::Value { line, .. } = problem {
                assert!(
                    (1..=lines(bytes)).contains(&line),
                    "{line} of {}",
                    lines(bytes)
                );
            }
        }
    }
});

/// Number of lines as an editor counts them.
fn lines(bytes: &[u8]) -> u64 {
    let text = String::from_utf8_lossy(bytes).replace("\r\n", "\n");
    text.split(['\n', '\r']).count() as u64
}
