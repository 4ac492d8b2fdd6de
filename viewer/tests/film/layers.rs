//! Frames in OpenEXR: their layers, and drawing them again from themselves.

use super::{VIEWER, folder};
use std::fs;

#[test]
fn a_frame_has_layers_and_can_be_drawn_again_from_itself() {
    let folder = folder();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let frames = file("%d.exr");
    for (path, projection) in [
        (
            "fall",
            &["--projection", "dome", "--tilt", "20", "--size", "48x48"][..],
        ),
        ("flyby", &["--size", "64x36"]),
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
            "--stars",
            "hipparcos",
            "--shift",
            "colour",
            "--aov",
            "shift,uv",
            "-o",
            &frames,
        ];
        VIEWER.run(&[&film, projection].concat()).succeeds();
        let again = file("again.exr");
        VIEWER
            .run(&["render", "--like", &file("7.exr"), "-o", &again])
            .succeeds();
        let [frame, again] = [file("7.exr"), again].map(|name| fs::read(name).unwrap());
        assert!(frame == again, "{path}");
        let names = String::from_utf8_lossy(&frame);
        assert!(names.contains("shift.V") && names.contains("uv.U"));
    }
    let png = file("%d.png");
    VIEWER
        .run(&["film", "--path", "orbit", "--aov", "uv", "-o", &png])
        .refuses(&["--aov", ".png", ".exr"]);
}
