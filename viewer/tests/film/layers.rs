//! Frames in OpenEXR: their layers, and drawing them again from themselves.

use super::{SMALL, VIEWER, file, film, folder, text};
use std::fs;

#[test]
fn a_frame_has_layers_and_can_be_drawn_again_from_itself() {
    let folder = folder();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let frames = file("%d.exr");
    for (path, options) in [
        (
            "fall",
            &[
                "--projection",
                "dome",
                "--tilt",
                "20",
                "--size",
                "48x48",
                "--stars",
                "hipparcos",
            ][..],
        ),
        ("flyby", &["--size", "64x36", "--stars", "hipparcos"]),
        (
            "orbit",
            &[
                "--size",
                "64x36",
                "--stars",
                "hipparcos",
                "--disc",
                "3,9",
                "--disc-opacity",
                "0.6",
                "--aov",
                "disc_radius,disc_alpha",
            ],
        ),
    ] {
        let film = [
            "film",
            "--path",
            path,
            "--fps",
            "1",
            "--frames",
            "7..8",
            "--overwrite",
            "-d",
            "cpu",
            "-s",
            "grid",
            "--shift",
            "colour",
            "--aov",
            "shift,uv",
            "-o",
            &frames,
        ];
        VIEWER.run(&[&film, options].concat()).succeeds();
        let again = file("again.exr");
        VIEWER
            .run(&["render", "--like", &file("7.exr"), "-o", &again])
            .succeeds();
        let [frame, again] = [file("7.exr"), again].map(|name| fs::read(name).unwrap());
        assert!(frame == again, "{path}");
        let names = String::from_utf8_lossy(&frame);
        assert!(names.contains("shift.V") && names.contains("uv.U"));
        assert_eq!(names.contains("disc_alpha.V"), path == "orbit");
    }
    let png = file("%d.png");
    VIEWER
        .run(&["film", "--path", "orbit", "--aov", "uv", "-o", &png])
        .refuses(&["--aov", ".png", ".exr"]);
}

#[test]
fn a_frame_in_openexr_records_its_exposure() {
    let folder = folder();
    let keyframes = r#"{"time": 0, "exposure": -3}, {"time": 1, "exposure": 2.7}"#;
    let keyframes = format!(r#"{{"keyframes": [{keyframes}]}}"#);
    let path = file(&folder, "path.json", &keyframes);
    let name = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (frame, again) = (name("24.exr"), name("again.png"));
    let draw = |pattern: &str, stops: &str| {
        let frames = ["--frames", "24..25", "--exposure", stops];
        let pattern = name(pattern);
        let output = ["--overwrite", "-o", &pattern];
        film(&[&[text(&path)], &SMALL[..], &frames, &output].concat()).succeeds();
    };
    // The last is more than the most that the path and the command line may ask for together.
    for stops in ["0", "-1.3", "32"] {
        draw("%d.exr", stops);
        draw("%d.png", stops);
        VIEWER
            .run(&["render", "--like", &frame, "-o", &again])
            .succeeds();
        let [frame, again] = [&name("24.png"), &again].map(|name| fs::read(name).unwrap());
        assert!(frame == again, "{stops}");
    }
    draw("%d.exr", "auto");
    let header = fs::read(&frame).unwrap();
    assert!(String::from_utf8_lossy(&header).contains(r#""exposure":["auto"]"#));
}

/// Options that cannot be recorded are reported once, not for each face of a cube and each frame.
#[test]
#[cfg(target_os = "linux")]
fn one_line_says_that_options_are_not_recorded() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = folder();
    let sky = folder.path().join(OsStr::from_bytes(b"sk\xff.png"));
    image::RgbImage::new(64, 32)
        .save_with_format(&sky, image::ImageFormat::Png)
        .unwrap();
    let pattern = folder.path().join("%d.exr");
    let cube = ["--projection=cube", "--size=16x16", "--device=cpu", "-s"].map(OsStr::new);
    let output = [sky.as_os_str(), OsStr::new("-o"), pattern.as_os_str()];
    for command in [&["film", "--path=orbit", "--frames=0..2"][..], &["render"]] {
        let command: Vec<&OsStr> = command.iter().map(OsStr::new).collect();
        let run = VIEWER.run(&[&command[..], &cube, &output].concat());
        let said = run.succeeds().stderr;
        assert_eq!(said.matches("not UTF-8").count(), 1, "{said}");
    }
}
