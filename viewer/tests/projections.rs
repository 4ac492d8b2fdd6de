//! Panoramas, fisheyes, domes and cubes, drawn by the real program.

use lensbake_test_support::Program;
use std::path::Path;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn draw(file: &Path, more: &[&str]) -> image::Rgb32FImage {
    let file = file.to_str().unwrap();
    let args = ["render", "--device", "cpu", "-o", file];
    VIEWER.run(&[&args, more].concat()).succeeds();
    image::open(file).unwrap().into_rgb32f()
}

#[test]
fn every_projection_has_its_shape() {
    let folder = folder();
    for (projection, size, black_corner) in [
        ("perspective", "64x36", false),
        ("equirectangular", "64x32", false),
        ("fisheye", "64x64", true),
        ("dome", "64x64", true),
    ] {
        let file = folder.path().join(format!("{projection}.exr"));
        let args = [
            "--projection",
            projection,
            "--size",
            size,
            "-r",
            "30",
            "-s",
            "grid",
        ];
        let picture = draw(&file, &args);
        assert_eq!(format!("{}x{}", picture.width(), picture.height()), size);
        let is_black = picture.get_pixel(0, 0).0 == [0.0; 3];
        assert_eq!(is_black, black_corner, "{projection}");
    }
}

/// The faces of a cube are a sky, and drawn through a camera this sky is what the camera sees.
#[test]
fn the_faces_of_a_cube_can_be_read_as_a_sky() {
    let folder = folder();
    let flat = ["--method", "flat", "-r", "1e6"];
    let looks = ["--orbit", "50", "--latitude", "20"];
    let cube = folder.path().join("cube.exr");
    let args = ["--projection", "cube", "--size", "256x256", "-s", "grid"];
    let output = ["render", "--device", "cpu", "-o", cube.to_str().unwrap()];
    VIEWER
        .run(&[&output[..], &args, &flat, &looks].concat())
        .succeeds();
    assert!(!cube.exists());
    let faces = ["right", "left", "top", "bottom", "front", "back"];
    let sky = faces.map(|face| {
        let face = folder.path().join(format!("cube_{face}.exr"));
        face.to_str().unwrap().to_owned()
    });
    let sky = sky.join(",");
    for turned in [
        ["--yaw", "0", "--pitch", "0"],
        ["--yaw", "130", "--pitch", "50"],
    ] {
        let view = ["--size", "96x54", "--fov", "70"];
        let through_cube = draw(
            &folder.path().join("again.exr"),
            &[&view[..], &flat, &turned, &["-s", &sky]].concat(),
        );
        let at_once = draw(
            &folder.path().join("once.exr"),
            &[&view[..], &flat, &turned, &looks, &["-s", "grid"]].concat(),
        );
        let pairs = through_cube.iter().zip(at_once.iter());
        let (mut off, mut all) = (0.0, 0.0);
        for (a, b) in pairs {
            off += (a - b).abs();
            all += b;
        }
        assert!(off < 0.1 * all, "{turned:?}: {off} of {all}");
    }
}

#[test]
fn what_does_not_go_with_a_projection_is_refused_in_one_line() {
    for (args, words) in [
        (
            &["--projection", "equirectangular", "--size", "64x64"][..],
            &["--size", "64x64", "twice as wide as high"][..],
        ),
        (
            &["--projection", "equirectangular", "--fov", "90"],
            &["--fov", "all directions"],
        ),
        (
            &["--projection", "cube", "--size", "64x32"],
            &["--size", "64x32", "square"],
        ),
        (
            &["--projection", "fisheye", "--fov", "400"],
            &["--fov", "400", "at most 360"],
        ),
        (
            &["--projection", "dome", "--tilt", "100"],
            &["--tilt", "100", "from 0 to 90"],
        ),
        (&["--tilt", "10"], &["--tilt", "--projection dome"]),
        (&["--fov", "180"], &["--fov", "180", "between 0 and 180"]),
        (
            &["--projection", "cylinder"],
            &["cylinder", "equirectangular"],
        ),
        (
            &["--projection", "cube", "-o", "-"],
            &["--output", "a file name like cube.png"],
        ),
    ] {
        let start = ["render", "--device", "cpu", "-o", "never.png"];
        let args = match args.contains(&"-o") {
            true => [&start[..3], args].concat(),
            false => [&start, args].concat(),
        };
        VIEWER.run(&args).refuses(words);
    }
    assert!(!Path::new("never.png").exists());
}

/// The edges of neighbouring faces are equally bright, also with an exposure that is chosen by their light.
#[test]
fn the_faces_of_a_cube_have_one_exposure() {
    let folder = folder();
    let cube = folder.path().join("cube.png");
    let output = ["render", "--device", "cpu", "-o", cube.to_str().unwrap()];
    let scene = ["-r", "3", "--motion", "orbit", "--yaw", "60", "-s", "grid"];
    let light = ["--shift", "brightness", "--exposure", "auto"];
    let size = ["--projection", "cube", "--size", "64x64"];
    VIEWER
        .run(&[&output[..], &scene, &light, &size].concat())
        .succeeds();
    let [front, right] = ["front", "right"].map(|face| {
        let face = folder.path().join(format!("cube_{face}.png"));
        image::open(face).unwrap().into_rgb8()
    });
    let column = |face: &image::RgbImage, x: u32| -> f64 {
        let pixels = (0..64).flat_map(|y| face.get_pixel(x, y).0);
        pixels.map(f64::from).sum::<f64>() / (3.0 * 64.0)
    };
    let (a, b) = (column(&front, 63), column(&right, 0));
    assert!((a / b - 1.0).abs() < 0.1, "{a} {b}");
}
