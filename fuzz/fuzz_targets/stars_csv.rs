//! A star catalogue as CSV.

#![no_main]

use lensbake_fuzz::{exercise_stars, one_line};
use libfuzzer_sys::fuzz_target;
use viewer::stars::{StarsProblem, catalogue_from_bytes};

fuzz_target!(|bytes: &[u8]| {
    // The other format has a target of its own.
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

/// How many lines an editor shows.
fn lines(bytes: &[u8]) -> u64 {
    let text = String::from_utf8_lossy(bytes).replace("\r\n", "\n");
    text.split(['\n', '\r']).count() as u64
}
