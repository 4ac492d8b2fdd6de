//! A line of `bake query`: it is answered, or refused with a reason of one line.

#![no_main]

use bake::query::Question;
use lensbake_core::Fate;
use lensbake_fuzz::one_line;
use lensbake_tables::default_atlas;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|line: &[u8]| {
    match Question::parse(line) {
        Ok(question) => match question.answer(default_atlas()) {
            Ok(Fate::Escapes(bend)) => assert!(bend.is_finite(), "{bend}"),
            Ok(Fate::Captured) => {}
            Err(problem) => one_line(&problem),
        },
        Err(problem) => one_line(&problem),
    }
});
