//! What the frames show.

use crate::{SMALL, VIEWER, catalogue, file, film, folder, frames, text};
use lensbake_test_support::workspace;
use std::fs;
use std::path::Path;

/// The mean absolute difference of each frame to the next, in units of a step of 8 bits.
fn changes(folder: &Path) -> Vec<f64> {
    let decoded = |bytes: &Vec<u8>| {
        image::load_from_memory(bytes)
            .unwrap()
            .into_rgb8()
            .into_raw()
    };
    let pictures: Vec<Vec<u8>> = frames(folder).values().map(decoded).collect();
    let change = |pair: &[Vec<u8>]| {
        let steps = pair[0]
            .iter()
            .zip(&pair[1])
            .map(|(a, b)| f64::from(a.abs_diff(*b)));
        steps.sum::<f64>() / pair[0].len() as f64
    };
    pictures.windows(2).map(change).collect()
}

#[test]
fn neighbouring_frames_of_a_fall_differ_by_its_motion_alone() {
    let folder = folder();
    let stars = catalogue(&folder);
    for (name, more) in [
        (
            "brightness",
            &[
                "-s",
                "nebula",
                "--shift",
                "brightness",
                "--exposure",
                "auto",
            ][..],
        ),
        (
            "colour",
            &["-s", "nebula", "--shift", "colour", "--exposure", "auto"],
        ),
        ("stars", &["-s", "stars", "--shift", "off"]),
    ] {
        let into = folder.path().join(name);
        fs::create_dir(&into).unwrap();
        let pattern = into.join("%05d.png");
        let flight = ["--path", "fall", "--fps", "60", "--seconds", "5"];
        let scene = [
            "--device",
            "cpu",
            "--size",
            "64x36",
            "--stars",
            text(&stars),
            "-o",
            text(&pattern),
        ];
        film(&[&flight[..], &scene, more].concat()).succeeds();
        let changes = changes(&into);
        assert_eq!(changes.len(), 299);
        for (i, near) in changes.windows(3).enumerate() {
            let most = 1.5 * 0.5 * (near[0] + near[2]) + 0.05;
            assert!(
                near[1] < most,
                "{name}: frame {} to the next: {near:?}",
                i + 1
            );
        }
    }
}

#[test]
fn a_frame_is_the_picture_that_render_draws() {
    let folder = folder();
    let stars = catalogue(&folder);
    let path = file(
        &folder,
        "path.json",
        r#"{"keyframes": [{"time": 0, "radius": 7, "orbit": 30, "latitude": 10, "yaw": 5, "fov": 70, "exposure": 0.5}]}"#,
    );
    let (frame, picture) = (
        folder.path().join("0.png"),
        folder.path().join("picture.png"),
    );
    let pattern = folder.path().join("%d.png");
    let scene = [&SMALL[..], &["--stars", text(&stars)]].concat();
    film(
        &[
            &scene[..],
            &[text(&path), "--seconds", "0.01", "-o", text(&pattern)],
        ]
        .concat(),
    )
    .succeeds();
    let view = [
        "-r",
        "7",
        "--orbit",
        "30",
        "--latitude",
        "10",
        "--yaw",
        "5",
        "--fov",
        "70",
        "--exposure",
        "0.5",
    ];
    let args = [&["render"], &scene[..], &view, &["-o", text(&picture)]].concat();
    VIEWER.run(&args).succeeds();
    assert!(fs::read(frame).unwrap() == fs::read(picture).unwrap());
}

/// Linear light of a frame.
fn light(path: &Path) -> Vec<f32> {
    image::open(path).unwrap().into_rgb32f().into_raw()
}

#[test]
fn motion_blur_is_the_mean_of_the_light_of_its_moments() {
    let folder = folder();
    let stars = catalogue(&folder);
    let pattern = |name: &str| folder.path().join(format!("{name}%d.exr"));
    let draw = |name: &str, more: &[&str]| {
        let flight = [
            "--path",
            "flyby",
            "--seconds",
            "1",
            "--stars",
            text(&stars),
            "-o",
        ];
        film(&[&SMALL[..], &flight, &[text(&pattern(name))], more].concat()).succeeds();
    };
    // A shutter open for half of 1/30 s takes light 1/240 s before and after the frame.
    draw(
        "blurred",
        &[
            "--fps",
            "30",
            "--frames",
            "12..13",
            "--shutter",
            "0.5",
            "--subframes",
            "2",
        ],
    );
    draw("sharp", &["--fps", "240", "--frames", "95..98:2"]);
    let [blurred, before, after] = ["blurred12.exr", "sharp95.exr", "sharp97.exr"]
        .map(|name| light(&folder.path().join(name)));
    assert!(before != after);
    for ((blurred, before), after) in blurred.iter().zip(&before).zip(&after) {
        let mean = 0.5 * (before + after);
        assert!(
            (blurred - mean).abs() <= 1e-5 * mean.max(1.0),
            "{blurred} {mean}"
        );
    }
}

#[test]
fn frames_that_exist_are_kept_unless_they_are_to_be_overwritten() {
    let folder = folder();
    let pattern = folder.path().join("%d.png");
    let frame = file(&folder, "1.png", "mine");
    let draw = |more: &[&str]| {
        let flight = ["--path", "dive", "--frames", "0..3", "-o", text(&pattern)];
        film(&[&SMALL[..], &flight, more].concat())
            .succeeds()
            .stderr
    };
    assert!(draw(&[]).contains("2 frames, 1 skipped"));
    assert_eq!(fs::read(&frame).unwrap(), b"mine");
    assert!(draw(&[]).contains("all 3 frames exist already; --overwrite"));
    assert!(draw(&["--overwrite"]).contains("3 frames, 0 skipped"));
    assert!(fs::read(&frame).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn a_ready_path_can_be_saved_and_gives_the_same_film() {
    let folder = folder();
    for name in ["orbit", "fall", "flyby", "dive"] {
        let saved = folder.path().join(format!("{name}.json"));
        let flight = ["--path", name, "--seconds", "7"];
        film(&[&flight[..], &["--save-path", text(&saved)]].concat()).succeeds();
        let pattern = |kind: &str| folder.path().join(format!("{name}-{kind}%d.png"));
        let few = ["--frames", "50..200:70"];
        let [ready, from_file] = ["ready", "file"].map(pattern);
        film(&[&SMALL[..], &few, &flight, &["-o", text(&ready)]].concat()).succeeds();
        film(&[&SMALL[..], &few, &[text(&saved), "-o", text(&from_file)]].concat()).succeeds();
        for frame in [50, 120, 190] {
            let [a, b] = ["ready", "file"]
                .map(|kind| folder.path().join(format!("{name}-{kind}{frame}.png")));
            assert!(
                fs::read(a).unwrap() == fs::read(b).unwrap(),
                "{name} {frame}"
            );
        }
    }
}

#[test]
fn the_example_of_the_document_flies() {
    let document = fs::read_to_string(workspace().join("docs/film.md")).unwrap();
    let json = document
        .split("```")
        .find_map(|part| part.strip_prefix("json"));
    let folder = folder();
    let path = file(&folder, "path.json", json.unwrap());
    let saved = folder.path().join("saved.json");
    film(&[text(&path), "--seconds", "20", "--save-path", text(&saved)]).succeeds();
    assert_eq!(
        fs::read_to_string(saved).unwrap().matches("time").count(),
        5
    );
}
