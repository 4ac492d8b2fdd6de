//! `viewer film`: the frames, how they are divided and resumed, and what is refused.
#![cfg(unix)]

use lensbake_test_support::streams::link;
use lensbake_test_support::{Program, Run, workspace};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

/// Small frames on the CPU, with a sky that is generated quickly.
const SMALL: [&str; 6] = ["--device", "cpu", "--size", "64x36", "-s", "grid"];

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn film(args: &[&str]) -> Run {
    VIEWER.run(&[&["film"], args].concat())
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A file in `folder`.
fn file(folder: &TempDir, name: &str, content: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    path
}

/// A catalogue of a few hundred stars all over the sky, some of them bright.
fn catalogue(folder: &TempDir) -> PathBuf {
    let mut random = fastrand::Rng::with_seed(7);
    let mut csv = "ra,dec,mag,bv\n".to_owned();
    for _ in 0..400 {
        let dec = (2.0 * random.f64() - 1.0).asin().to_degrees();
        let (ra, mag) = (360.0 * random.f64(), 4.0 * random.f64());
        csv += &format!("{ra},{dec},{mag},{}\n", random.f64());
    }
    file(folder, "stars.csv", &csv)
}

/// The frames in `folder` by name. What an interrupted process leaves has no such names.
fn frames(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let pictures = entries.filter(|path| path.extension().is_some());
    pictures
        .map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            (name, fs::read(path).unwrap())
        })
        .collect()
}

/// Draws a fall with `more` arguments in one process, in `parts` ranges, and resumed after it was killed: the same bytes.
fn falls_apart(more: &[&str], count: usize, parts: usize) {
    let folder = folder();
    let stars = catalogue(&folder);
    let seconds = (count as f64 / 60.0).to_string();
    let flight = [
        "film",
        "--path",
        "fall",
        "--fps",
        "60",
        "--seconds",
        &seconds,
    ];
    let seen = [
        "--shift",
        "colour",
        "--exposure",
        "auto",
        "--stars",
        text(&stars),
    ];
    let scene = [&flight[..], &seen, more].concat();
    let into = |name: &str| {
        let path = folder.path().join(name);
        fs::create_dir(&path).unwrap();
        (path.join("%05d.png").to_str().unwrap().to_owned(), path)
    };
    let draw = |pattern: &str, more: &[&str]| {
        VIEWER
            .run(&[&scene[..], &["-o", pattern], more].concat())
            .succeeds()
    };
    let (pattern, whole) = into("whole");
    draw(&pattern, &[]);
    let whole = frames(&whole);
    assert_eq!(whole.len(), count);

    let (pattern, divided) = into("divided");
    for part in 0..parts {
        // Half of them are ranges, and half are every so-many-th frame of the rest.
        let range = match part < parts / 2 {
            true => format!("{}..{}", part * count / parts, (part + 1) * count / parts),
            false => format!("{}..:{}", count / 2 + part - parts / 2, parts - parts / 2),
        };
        draw(&pattern, &["--frames", &range]);
    }
    assert!(
        frames(&divided) == whole,
        "drawn in parts, the film differs"
    );

    let (pattern, killed) = into("killed");
    let mut command = VIEWER.command();
    command
        .args(&scene)
        .args(["-o", &pattern])
        .stderr(Stdio::null());
    let mut process = command.spawn().unwrap();
    let enough = fastrand::usize(1..count - 10);
    while frames(&killed).len() < enough {
        std::thread::sleep(Duration::from_millis(1));
        assert!(
            process.try_wait().unwrap().is_none(),
            "it ended before it was killed"
        );
    }
    process.kill().unwrap();
    process.wait().unwrap();
    let left = frames(&killed);
    assert!(left.len() < count, "killed too late");
    assert!(
        left.iter().all(|(name, bytes)| whole[name] == *bytes),
        "a frame is half-written"
    );
    let resumed = draw(&pattern, &[]).stderr;
    assert!(
        resumed.contains(&format!(" {} skipped", left.len())),
        "{resumed}"
    );
    assert!(
        frames(&killed) == whole,
        "resumed after {enough} frames, the film differs"
    );
    assert!(draw(&pattern, &[]).stderr.contains("all"));
}

#[test]
fn a_frame_depends_on_its_number_alone() {
    falls_apart(&SMALL, 240, 8);
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore)]
fn a_frame_of_a_gpu_depends_on_its_number_alone() {
    let gpu = ["--device", "gpu", "--size", "64x36", "-s", "grid"];
    falls_apart(
        &[&gpu[..], &["--shutter", "0.5", "--subframes", "2"]].concat(),
        60,
        4,
    );
}

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

/// A folder with a program `ffmpeg` that is this shell script.
fn ffmpeg(script: &str) -> TempDir {
    let folder = folder();
    let program = file(&folder, "ffmpeg", &format!("#!/bin/sh\n{script}\n"));
    fs::set_permissions(program, fs::Permissions::from_mode(0o755)).unwrap();
    folder
}

/// Draws a video of three frames with the programs in `programs` before others.
fn video(programs: &Path, output: &Path, size: &str, more: &[&str]) -> Run {
    const WITH_PATH: &str = "PATH=$1 && export PATH && shift && exec \"$0\" \"$@\"";
    let flight = [
        "film",
        "--path",
        "orbit",
        "--frames",
        "0..3",
        "-o",
        text(output),
        "--device",
        "cpu",
        "-s",
        "grid",
        "--size",
        size,
    ];
    let start = ["-c", WITH_PATH, VIEWER.path(), text(programs)];
    Program::at("/bin/sh").run(&[&start[..], &flight, more].concat())
}

#[test]
fn a_video_is_what_ffmpeg_makes_of_the_frames() {
    // Writes its arguments and its input to the file that it should write.
    let programs = ffmpeg(r#"for last; do :; done; { echo "$@"; /bin/cat; } > "$last""#);
    let folder = folder();
    let output = folder.path().join("film.mp4");
    video(programs.path(), &output, "64x36", &["--fps", "30000/1001"]).succeeds();
    let made = fs::read(&output).unwrap();
    let end = made.iter().position(|&byte| byte == b'\n').unwrap() + 1;
    let arguments = std::str::from_utf8(&made[..end]).unwrap();
    for words in [
        "-video_size 64x36 -framerate 30000/1001",
        "libx264",
        "yuv420p",
    ] {
        assert!(arguments.contains(words), "{arguments}");
    }
    let pattern = folder.path().join("%d.png");
    let flight = [
        "--path",
        "orbit",
        "--fps",
        "30000/1001",
        "--frames",
        "0..3",
        "-o",
        text(&pattern),
    ];
    film(&[&SMALL[..], &flight].concat()).succeeds();
    let pixels = (0..3).flat_map(|frame| {
        let path = folder.path().join(format!("{frame}.png"));
        image::open(path).unwrap().into_rgb8().into_raw()
    });
    assert!(made[end..] == pixels.collect::<Vec<u8>>());
    video(programs.path(), &output, "64x36", &[]).refuses(&["film.mp4", "exists", "--overwrite"]);
    video(programs.path(), &output, "64x36", &["--overwrite"]).succeeds();
    assert_eq!(frames(folder.path()).len(), 4);
}

#[test]
fn without_a_working_ffmpeg_there_is_no_video() {
    let (folder, nothing) = (folder(), folder());
    let output = folder.path().join("film.mkv");
    video(nothing.path(), &output, "64x36", &[]).refuses(&[
        "film.mkv",
        "ffmpeg",
        "not installed",
        "%05d.png",
    ]);
    let fails = ffmpeg("echo starting >&2; echo \"Unknown encoder 'libx264'\" >&2; exit 1");
    video(fails.path(), &output, "64x36", &[])
        .refuses(&["film.mkv: ffmpeg failed: Unknown encoder"]);
    let fails_late = ffmpeg("/bin/cat > /dev/null; echo No space left on device >&2; exit 1");
    video(fails_late.path(), &output, "64x36", &[]).refuses(&["film.mkv", "No space left"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    for size in ["63x36", "64x35"] {
        video(fails.path(), &output, size, &[]).refuses(&["--size", "even"]);
    }
}

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

#[test]
fn a_frame_has_layers_and_can_be_drawn_again_from_itself() {
    let folder = tempfile::tempdir().unwrap();
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
