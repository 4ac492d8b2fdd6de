//! Fuzz target: a line of `bake query`. Every method answers it, or refuses it with a reason of one line.

#![no_main]

use bake::query::{Answers, QueryMethod, Question};
use lensbake_core::RayOutcome;
use lensbake_fuzz::one_line;
use lensbake_tables::default_atlas;
use libfuzzer_sys::fuzz_target;

/// Tolerance of the integration, rad per radian of orbital angle: the program's own is finer, but slower.
const TOLERANCE: f64 = 1e-6;

fuzz_target!(|line: &[u8]| {
    let question = match Question::parse(line) {
        Ok(Some(question)) => question,
        Ok(None) => return,
        Err(problem) => return one_line(&problem),
    };
    let methods = [
        QueryMethod::Lookup(default_atlas()),
        QueryMethod::Exact,
        QueryMethod::Rk4(TOLERANCE),
    ];
    for method in methods {
        match Answers::new(method).answer(&question) {
            Ok(RayOutcome::Escapes(bend)) => {
                assert!(bend.is_finite(), "{question:?} by {method:?}")
            }
            Ok(RayOutcome::Captured) => {}
            Err(problem) => one_line(&problem),
        }
    }
});
