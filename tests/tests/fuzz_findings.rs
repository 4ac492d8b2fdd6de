//! Regression tests of fuzzing: each file in `fuzz/findings` once broke a program. A file gets the checks of its
//! fuzz target, and may be accepted, or refused in one line.

use lensbake_core::{RayOutcome, ShadowCoordinate};
use lensbake_render::sky::panorama_from_bytes;
use lensbake_tables::container;
use lensbake_test_support::workspace;
use std::fs;
use std::path::{Path, PathBuf};

/// The files that a target has found.
fn findings(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = workspace().join("fuzz/findings").join(target);
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .map(|path| (path.clone(), fs::read(path).unwrap()))
        .collect()
}

fn one_line(path: &Path, message: &impl ToString) {
    let message = message.to_string();
    assert_eq!(
        message.lines().count(),
        1,
        "{}: {message:?}",
        path.display()
    );
}

#[test]
fn tables() {
    for target in ["table_binary", "table_exr"] {
        let findings = findings(target);
        assert!(!findings.is_empty(), "{target}");
        for (path, bytes) in findings {
            let table = match container::from_bytes(&bytes) {
                Ok(table) => table,
                Err(problem) => {
                    one_line(&path, &problem);
                    continue;
                }
            };
            let row = table.row(table.header().observer(0)).unwrap();
            for one_minus_x in [f64::MIN_POSITIVE, 1e-9, 0.1, 0.5, 1.0] {
                let x = 1.0 - one_minus_x;
                if let RayOutcome::Escapes(bend) = row.bend(ShadowCoordinate { x, one_minus_x }) {
                    assert!(!bend.is_nan(), "{}", path.display());
                }
            }
        }
    }
}

#[test]
fn skies() {
    let findings = findings("sky");
    assert!(!findings.is_empty());
    for (path, bytes) in findings {
        if let Err(error) = panorama_from_bytes(&path, bytes) {
            one_line(&path, &error);
        }
    }
}
