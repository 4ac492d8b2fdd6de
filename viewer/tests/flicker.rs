//! `viewer flicker`, run as a user runs it.

use lensbake_test_support::Program;
use std::fs;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

#[test]
fn a_short_orbit_of_few_stars_is_measured_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("new");
    let few = ["--frames", "16", "--stars", "2", "--size", "160x90"];
    let args = ["flicker", "--device", "cpu", "-o", output.to_str().unwrap()];
    let run = VIEWER.run(&[&args[..], &few].concat()).succeeds();
    // Two header lines name the columns.
    assert_eq!(run.stdout.lines().count(), 2 + 2, "{run:?}");
    let csv = fs::read_to_string(output.join("flicker.csv")).unwrap();
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines.len(), 1 + 2, "{csv}");
    for line in &lines[1..] {
        assert_eq!(line.len(), lines[0].len(), "{csv}");
        let column = |name| {
            let at = lines[0].iter().position(|head| *head == name).unwrap();
            line[at]
        };
        assert!(column("point").parse::<f64>().unwrap() <= 0.02, "{csv}");
        assert_eq!(column("point_gpu"), "", "{csv}");
    }
    let figure = image::open(output.join("flicker.png")).unwrap();
    assert_eq!(figure.width(), 1600);
}

#[test]
fn a_fall_and_an_orbit_are_measured_with_their_brightness() {
    let folder = tempfile::tempdir().unwrap();
    let few = ["--frames", "16", "--stars", "2", "--size", "160x90"];
    for motion in [
        ["fall", "-r", "6", "--yaw", "90"],
        ["orbit", "-r", "6", "--yaw", "50"],
    ] {
        let output = folder.path().join(motion[0]);
        let start = ["flicker", "--device", "cpu", "-o", output.to_str().unwrap()];
        let args = [&start[..], &few[..], &["--motion"][..], &motion[..]].concat();
        let run = VIEWER.run(&args).succeeds();
        assert_eq!(run.stdout.lines().count(), 2 + 2, "{run:?}");
        assert!(output.join("flicker.png").is_file());
    }
}

#[test]
fn what_cannot_be_measured_is_refused_in_one_line_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("new");
    let output = output.to_str().unwrap();
    let flicker = |args: &[&str]| {
        let start = ["flicker", "--device", "cpu", "-o", output];
        VIEWER.run(&[&start[..], args].concat())
    };
    flicker(&["-r", "1"]).refuses(&["radius", "greater than 1"]);
    flicker(&["-r", "NaN"]).refuses(&["radius"]);
    flicker(&["-r", "1.4", "--motion", "orbit"]).refuses(&["no circular orbit", "1.5"]);
    flicker(&["--size", "0x9"]).refuses(&["0x9"]);
    flicker(&["--frames", "0"]).refuses(&["--frames"]);
    flicker(&["--stars", "0"]).refuses(&["--stars"]);
    // So near that the shadow fills the picture.
    flicker(&["-r", "1.01", "--frames", "8", "--stars", "1"]).refuses(&["no star", "radius"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);

    let file = tempfile::NamedTempFile::new().unwrap();
    let below = file.path().join("below");
    let below = below.to_str().unwrap();
    let few = ["--frames", "8", "--stars", "1", "--device", "cpu"];
    VIEWER
        .run(&[&["flicker", "-o", below], &few[..]].concat())
        .refuses(&[below]);
}
