//! `bake chart`, `bake stability` and `bake luminet`, run as a user runs them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn bake(args: &[&str], directory: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_bake"))
        .args(args)
        .arg("--output")
        .arg(directory)
        .output()
        .unwrap()
}

#[test]
fn a_quick_chart_is_written_whole() {
    let directory = tempfile::tempdir().unwrap();
    let output = bake(&["chart", "--quick"], directory.path());
    // 0 or 1: whether the claim holds depends on times, and no test may depend on times.
    assert!(matches!(output.status.code(), Some(0 | 1)), "{output:?}");
    let csv = fs::read_to_string(directory.path().join("chart.csv")).unwrap();
    let columns = csv.lines().next().unwrap().split(',').count();
    assert_eq!(columns, 16);
    for observer in ["far,", "50,", "25,", "10,", "5,"] {
        let lines = csv.lines().filter(|line| line.starts_with(observer));
        assert!(lines.count() > 20, "{observer}");
    }
    for name in ["chart-rad", "chart-px"] {
        let stem = directory.path().join(name);
        let svg = fs::read_to_string(stem.with_extension("svg")).unwrap();
        assert!(svg.contains("lensbake default row"));
        assert!(fs::read(stem.with_extension("png")).unwrap().len() > 10_000);
    }
    let summary = String::from_utf8(output.stdout).unwrap();
    assert!(summary.contains("noise of this run"), "{summary}");
}

#[test]
fn a_quick_chart_of_crossings_is_written_whole() {
    let directory = tempfile::tempdir().unwrap();
    let output = bake(&["chart", "--disc", "--quick"], directory.path());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let csv = fs::read_to_string(directory.path().join("crossings.csv")).unwrap();
    let recorded = include_str!("../../docs/disc/crossings.csv");
    assert_eq!(csv.lines().count(), recorded.lines().count());
    assert_eq!(csv.lines().next(), recorded.lines().next());
    let stem = directory.path().join("crossings");
    let svg = fs::read_to_string(stem.with_extension("svg")).unwrap();
    assert!(svg.contains("1 duplication"));
    assert!(fs::read(stem.with_extension("png")).unwrap().len() > 10_000);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 3);
    let summary = String::from_utf8(output.stdout).unwrap();
    assert!(summary.contains("used:"), "{summary}");
}

#[test]
fn the_atlas_of_stability_is_the_recorded_size_and_the_product_passes() {
    let directory = tempfile::tempdir().unwrap();
    let output = bake(&["stability"], directory.path());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let csv = fs::read_to_string(directory.path().join("atlas.csv")).unwrap();
    let recorded = include_str!("../../docs/stability/atlas.csv");
    assert_eq!(csv.lines().count(), recorded.lines().count());
    for (name, regime) in [
        ("atlas", "b from infinity"),
        ("atlas-motion", "free fall through the horizon"),
    ] {
        let stem = directory.path().join(name);
        let svg = fs::read_to_string(stem.with_extension("svg")).unwrap();
        assert!(svg.contains(regime), "{name}");
        assert!(fs::read(stem.with_extension("png")).unwrap().len() > 10_000);
    }
}

#[test]
fn luminets_disc_is_the_recorded_one() {
    let directory = tempfile::tempdir().unwrap();
    let output = bake(&["luminet"], directory.path());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let csv = fs::read_to_string(directory.path().join("luminet.csv")).unwrap();
    let recorded = include_str!("../../docs/disc/luminet.csv");
    assert_eq!(csv.lines().count(), recorded.lines().count());
    let svg = fs::read_to_string(directory.path().join("luminet.svg")).unwrap();
    assert!(svg.contains("80°"));
    let summary = String::from_utf8(output.stdout).unwrap();
    assert!(
        summary.starts_with("brightest point: flux 2.808"),
        "{summary}"
    );
    let refused = bake(&["luminet", "--inclination", "90"], directory.path());
    assert_eq!(refused.status.code(), Some(2));
    let line = String::from_utf8(refused.stderr).unwrap();
    assert!(
        line.contains("--inclination") && line.contains("1 to 89"),
        "{line}"
    );
}

#[test]
fn a_directory_that_cannot_be_made_is_one_clear_line() {
    let file = tempfile::NamedTempFile::new().unwrap();
    for command in [&["chart"][..], &["chart", "--disc"], &["stability"]] {
        let output = bake(command, &file.path().join("below"));
        assert_eq!(output.status.code(), Some(2));
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}
