//! Fuzz target: a line of `bake query`, for an observer at rest and in motion. Every method answers it, or refuses it with a
//! reason of one line.

#![no_main]

use bake::query::{Answers, QueryMethod, Question};
use lensbake_core::{Motion, RayOutcome, ThinDisc};
use lensbake_fuzz::one_line;
use lensbake_tables::default_atlas;
use libfuzzer_sys::fuzz_target;

/// Tolerance of the integration, rad per radian of orbital angle: the program's own is finer, but slower.
const TOLERANCE: f64 = 1e-6;

const MOTIONS: [Motion; 4] = [
    Motion::Rest,
    Motion::Fall,
    Motion::Orbit,
    Motion::Velocity {
        radial: -0.6,
        tangential: 0.7,
    },
];

fuzz_target!(|line: &[u8]| {
    for motion in MOTIONS {
        ask(line, motion);
    }
});

fn disc() -> ThinDisc {
    ThinDisc::new(3.0, 12.0, 80.0, 0.0).expect("the default disc is one")
}

fn ask(line: &[u8], motion: Motion) {
    let question = match Question::parse(line, motion) {
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
        let mut answers = Answers::new(method);
        for crossing in answers.crossings(&question, &disc()).into_iter().flatten() {
            let numbers = [crossing.radius, crossing.shift];
            assert!(
                numbers.iter().all(|number| number.is_finite()),
                "{question:?} by {method:?}: {crossing:?}"
            )
        }
        match answers.answer(&question) {
            Ok(RayOutcome::Escapes(sky)) => {
                let numbers = [sky.theta, sky.azimuth, sky.shift, sky.bend];
                assert!(
                    numbers.iter().all(|number| number.is_finite()),
                    "{question:?} by {method:?}: {sky:?}"
                )
            }
            Ok(RayOutcome::Captured) => {}
            Err(problem) => one_line(&problem),
        }
    }
}
