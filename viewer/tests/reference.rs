//! `viewer reference --disc`, run as a user runs it.

use lensbake_test_support::Program;
use std::fs;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

#[test]
fn pictures_of_a_disc_are_compared_with_their_reference() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().to_str().unwrap();
    let small = ["--device", "cpu", "--size", "192x108", "--rays", "4"];
    let view = ["reference", "--disc", "--only", "r = 25, 60", "-o", output];
    let run = VIEWER.run(&[&view[..], &small].concat()).succeeds();
    let table = fs::read_to_string(folder.path().join("disc.csv")).unwrap();
    assert_eq!(run.stdout, table);
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 3, "{table}");
    let whole = |line: &str| -> f64 { line.split(',').nth(4).unwrap().parse().unwrap() };
    let (filtered, single) = (whole(lines[1]), whole(lines[2]));
    assert!(lines[1].contains("filtered (CPU)") && lines[2].contains("one ray (CPU)"));
    assert!(2.0 * filtered < single, "{table}");
    assert!(image::open(folder.path().join("disc.png")).is_ok());
}

#[test]
fn a_view_that_does_not_exist_is_refused() {
    let run = VIEWER.run(&["reference", "--disc", "--only", "r = 7"]);
    run.refuses(&["--only r = 7"]);
}
