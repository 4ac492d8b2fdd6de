//! The six films of a cube.

use crate::{VIEWER, file, film, folder, frames, text};
use lensbake_test_support::streams::{Spawned, fifo_writer};
use std::fs;

/// Two small frames of each face.
const FACES: [&str; 9] = [
    "--projection",
    "cube",
    "--frames",
    "0..2",
    "--size",
    "16x16",
    "--device=cpu",
    "-s",
    "grid",
];

#[test]
fn the_path_is_read_once_for_all_faces() {
    let folder = folder();
    let path = folder.path().join("path");
    let writer = fifo_writer(&path, r#"{"keyframes": [{"time": 0}, {"time": 1}]}"#);
    let pattern = folder.path().join("%d.png");
    // A frame that exists is compared with the inputs.
    file(&folder, "0_right.png", "old");
    let mut command = VIEWER.command();
    command.args(["film", text(&path), "--overwrite", "-o", text(&pattern)]);
    command.args(FACES);
    let run = Spawned::start(command, "").run_within_a_minute();
    run.succeeds();
    writer.join().unwrap().unwrap();
    assert_eq!(frames(folder.path()).len(), 12);
}

#[test]
fn a_face_that_is_complete_is_not_said_to_be_drawn() {
    let folder = folder();
    let pattern = folder.path().join("%d.png");
    let flight = ["--path", "orbit", "-o", text(&pattern)];
    let draw = || film(&[&FACES[..], &flight].concat()).succeeds().stderr;
    draw();
    fs::remove_file(folder.path().join("1_left.png")).unwrap();
    let said = draw();
    assert_eq!(said.matches("drawn on").count(), 1, "{said}");
    assert!(said.contains("1 frames, 1 skipped"), "{said}");
    let complete = "_top.png: all 2 frames exist already";
    assert!(said.contains(complete), "{said}");
    assert_eq!(said.matches("exist already").count(), 5, "{said}");
}
