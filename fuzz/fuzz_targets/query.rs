//! A line of `bake query`: it is answered by every method, or refused with a reason of one line.

#![no_main]

use bake::query::{Answers, Method, Question};
use lensbake_core::Fate;
use lensbake_fuzz::one_line;
use lensbake_tables::default_atlas;
use libfuzzer_sys::fuzz_target;

/// The tolerance of the integration, rad a radian of orbital angle: the program's own is finer, but slower.
const TOLERANCE: f64 = 1e-6;

fuzz_target!(|line: &[u8]| {
    let question = match Question::parse(line) {
        Ok(Some(question)) => question,
        Ok(None) => return,
        Err(problem) => return one_line(&problem),
    };
    let methods = [
        Method::Lookup(default_atlas()),
        Method::Exact,
        Method::Rk4(TOLERANCE),
    ];
    for method in methods {
        match Answers::new(method).answer(&question) {
            Ok(Fate::Escapes(bend)) => assert!(bend.is_finite(), "{question:?} by {method:?}"),
            Ok(Fate::Captured) => {}
            Err(problem) => one_line(&problem),
        }
    }
});
