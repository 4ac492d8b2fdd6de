//! What is refused, and what cannot be written.

use crate::{SMALL, file, film, folder, text};
use lensbake_test_support::streams::link;
use std::fs;

#[test]
fn what_cannot_be_written_is_named_and_what_was_done_stays() {
    let folder = folder();
    let pattern = folder.path().join("%d.png");
    let flight = [
        "--path",
        "orbit",
        "--frames",
        "0..4",
        "--overwrite",
        "-o",
        text(&pattern),
    ];
    link("/dev/full", &folder.path().join("3.png"));
    film(&[&SMALL[..], &flight].concat()).refuses(&["3.png", "No space left"]);
    for done in ["0.png", "1.png", "2.png"] {
        assert!(image::open(folder.path().join(done)).is_ok(), "{done}");
    }
    let nowhere = folder.path().join("no/%d.png");
    film(&["--path", "orbit", "-o", text(&nowhere)]).refuses(&["no/0.png", "does not exist"]);
    let nowhere = folder.path().join("no/a.mp4");
    film(&["--path", "orbit", "-o", text(&nowhere)]).refuses(&["a.mp4", "does not exist"]);
    // Not over a sky whose name is that of a frame.
    let sky = folder.path().join("1.png");
    let before = fs::read(&sky).unwrap();
    film(&[&flight[..], &["--device", "cpu", "-s", text(&sky)]].concat())
        .refuses(&["1.png", "also the input"]);
    assert_eq!(fs::read(&sky).unwrap(), before);
}

#[test]
fn no_output_is_written_over_the_path() {
    const PATH: &str = r#"{"keyframes": [{"time": 0}, {"time": 1}]}"#;
    let folder = folder();
    let name = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (path, output) in [
        ("a.json", &["--save-path", &name("a.json")][..]),
        ("3.png", &["--overwrite", "-o", &name("%d.png")]),
        ("a.mp4", &["--overwrite", "-o", &name("a.mp4")]),
    ] {
        let path = file(&folder, path, PATH);
        film(&[&[text(&path)], output].concat()).refuses(&[text(&path), "also the input"]);
        assert_eq!(fs::read_to_string(&path).unwrap(), PATH);
    }
}

#[test]
fn mistakes_in_a_path_are_refused_in_one_line() {
    let folder = folder();
    for (keyframes, words) in [
        ("", &["the path has none"][..]),
        (
            r#"{"time": 0}, {"time": 2}, {"time": 2}"#,
            &["keyframes[2].time", "two keyframes are at 2"],
        ),
        (
            r#"{"time": 0}, {"time": 2}, {"time": 1}"#,
            &["keyframes[2].time", "1 is not after 2"],
        ),
        (
            r#"{"time": 0, "yaw": 1, "yaw": 2}"#,
            &["duplicate field `yaw`"],
        ),
        (
            r#"{"time": 0, "radius": 0.9}"#,
            &["keyframes[0].radius", "horizon"],
        ),
        (r#"{"time": 0, "yaw": NaN}"#, &["yaw", "line 1"]),
        (r#"{"time": 0, "yaw": null}"#, &["keyframes[0].yaw", "null"]),
        (
            r#"{"time": 0, "radus": 3}"#,
            &["keyframes[0].radus", "did you mean `radius`?"],
        ),
        (r#"{"time": 0}"#, &["only the time 0", "--seconds"]),
    ] {
        let path = file(
            &folder,
            "path.json",
            &format!("{{\"keyframes\": [{keyframes}]}}"),
        );
        let words = [words, &["path.json"]].concat();
        film(&[text(&path), "-o", "never%d.png"]).refuses(&words);
    }
    film(&["no.json", "-o", "never%d.png"]).refuses(&["no.json", "No such file"]);
}

#[test]
fn mistakes_in_the_arguments_are_refused_in_one_line() {
    for (args, words) in [
        (&["-o", "never%d.png"][..], &["<FILE>"][..]),
        (&["--path", "orbit"], &["--output"]),
        (
            &["--path", "orbits", "-o", "never%d.png"],
            &["--path", "orbit"],
        ),
        (
            &["a.json", "--path", "orbit", "-o", "never%d.png"],
            &["--path", "FILE"],
        ),
        (
            &["a.json", "--radius", "3", "-o", "never%d.png"],
            &["--radius", "FILE"],
        ),
        (
            &["--path", "orbit", "-o", "never.png"],
            &["never.png", "%05d"],
        ),
        (
            &["--path", "orbit", "-o", "never%s.png"],
            &["never%s.png", "%05d"],
        ),
        (
            &["--path", "orbit", "-o", "never%d", "--projection", "cube"],
            &["--output", "never%d", "cube.png"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.jpg"],
            &["never%d.jpg", ".png or .exr"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--radius", "1.5"],
            &["--radius", "1.5", "orbit"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--seconds", "0"],
            &["--seconds", "0"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--seconds", "NaN"],
            &["--seconds", "NaN"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--seconds", "1e9"],
            &["--seconds", "too many"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--fps", "0"],
            &["--fps", "30000/1001"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--frames", "5"],
            &["--frames", "A..B"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--frames", "7..7"],
            &["--frames", "no frames"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--frames", "0..301"],
            &["--frames", "frame 300", "0..300"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--shutter", "2"],
            &["--shutter", "from 0 to 1"],
        ),
        (
            &["--path", "orbit", "-o", "never%d.png", "--size", "0x3"],
            &["--size"],
        ),
        (
            &[
                "--path",
                "orbit",
                "-o",
                "never%d.png",
                "--device",
                "cpu",
                "--pass",
                "compute",
            ],
            &["--pass", "GPU"],
        ),
    ] {
        film(args).refuses(words);
    }
    // A table of one observer has no rows for a flight.
    let folder = folder();
    let table = folder.path().join("r4.lbt");
    lensbake_test_support::write_table(&table, &lensbake_test_support::one_row(4.0));
    let args = [
        "--path",
        "dive",
        "-o",
        "never%d.png",
        "--device",
        "cpu",
        "--table",
        text(&table),
    ];
    film(&args).refuses(&["r4.lbt"]);
}
