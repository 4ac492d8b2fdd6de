//! `viewer render --like`: a picture drawn again from the options in its own header.

use lensbake_render::openexr::{Metadata, Value, encode};
use lensbake_render::picture::Picture;
use lensbake_test_support::exr_files::{attribute, with};
use lensbake_test_support::{Program, one_row, write_table};
use std::path::Path;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

/// A small picture on the CPU, with a sky that is generated quickly.
const RENDER: [&str; 5] = ["render", "--device", "cpu", "--size", "48x27"];

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// Draws to `out` with these options; returns the file.
#[track_caller]
fn draw(options: &[&str], out: &str) -> Vec<u8> {
    let args = [&RENDER[..], options, &["-o", out]].concat();
    VIEWER.run(&args).succeeds();
    std::fs::read(out).unwrap()
}

/// Draws to `out` like `picture`, with these options beside; returns the file.
#[track_caller]
fn draw_like(picture: &str, options: &[&str], out: &str) -> Vec<u8> {
    let args = [&["render", "--like", picture, "-o", out], options].concat();
    VIEWER.run(&args).succeeds();
    std::fs::read(out).unwrap()
}

/// Writes a panorama, six faces, a table, a catalogue of stars; returns their paths, the faces as one list.
fn inputs(folder: &TempDir) -> [String; 4] {
    let tinted = |side: u32, height: u32, name: &str| {
        let file = path(folder, name);
        let pixel = |x: u32, y: u32| image::Rgb([(x * 5) as u8, (y * 7) as u8, 90]);
        image::RgbImage::from_fn(side, height, pixel)
            .save(&file)
            .unwrap();
        file
    };
    let faces = ["r", "l", "t", "b", "f", "k"].map(|face| tinted(16, 16, &format!("{face}.png")));
    let (table, stars) = (path(folder, "r4.lbt"), path(folder, "my.csv"));
    write_table(&table, &one_row(4.0));
    std::fs::write(&stars, "ra,dec,mag\n180,10,-3\n200,-5,-2\n").unwrap();
    [
        tinted(64, 32, "sky, mine.png"),
        faces.join(","),
        table,
        stars,
    ]
}

#[test]
fn a_picture_drawn_again_from_itself_is_the_same_file() {
    let folder = folder();
    let [panorama, faces, table, stars] = inputs(&folder);
    let (first, again) = (path(&folder, "first.exr"), path(&folder, "again.exr"));
    let sets: &[&[&str]] = &[
        &["-s", "grid"],
        &[
            "-s",
            "grid",
            "--motion",
            "orbit",
            "-r",
            "3",
            "--heading",
            "-30",
            "--shift",
            "colour",
        ],
        &[
            "-s",
            "grid",
            "--motion",
            "-0.3,0.2",
            "--yaw=-20",
            "--aov",
            "uv,direction",
        ],
        &[
            "-s",
            "grid",
            "--motion",
            "fall",
            "-r",
            "0.5",
            "--fov",
            "150",
            "--shift",
            "brightness",
        ],
        &["-s", "stars", "--hole", "84,-1", "--star-exposure", "-2.5"],
        &[
            "-s",
            &panorama,
            "--sampling",
            "single",
            "--pitch",
            "3.25",
            "--aov",
            "all",
        ],
        &[
            "-s",
            &faces,
            "--orbit",
            "200",
            "--latitude",
            "-40",
            "--roll",
            "7",
        ],
        &["-s", "grid", "-r", "4", "--table", &table],
        &["-s", "grid", "--stars", &stars, "--star-radius", "1e-4"],
        &[
            "-s", "grid", "-r", "6", "--method", "direct", "--step", "0.1",
        ],
        &["-s", "grid", "--budget-px", "0.5", "--exposure", "auto"],
        &[
            "-s",
            "grid",
            "--stars",
            "hipparcos",
            "--disc",
            "--orbit",
            "50",
        ],
        &[
            "-s",
            "grid",
            "--disc",
            "3.5,1e2",
            "--inclination=-72.5",
            "--node",
            "33.3",
            "--disc-opacity",
            "0.25",
            "--disc-temperature",
            "7000",
            "--disc-brightness",
            "0.1",
            "--disc-shift",
            "brightness",
            "--hole",
            "9,-5",
        ],
    ];
    for options in sets {
        let written = draw(options, &first);
        assert!(draw_like(&first, &[], &again) == written, "{options:?}");
    }
}

/// What an .exr does not show is recorded all the same: the exposure of a .png.
#[test]
fn a_png_like_an_exr_has_its_exposure_and_no_layers() {
    let folder = folder();
    let (exr, png) = (path(&folder, "a.exr"), path(&folder, "a.png"));
    let options = [
        "-s",
        "grid",
        "--exposure",
        "1.5",
        "--motion",
        "fall",
        "--shift",
        "brightness",
    ];
    draw(&[&options[..], &["--aov", "all"]].concat(), &exr);
    let like = draw_like(&exr, &[], &path(&folder, "like.png"));
    assert!(like == draw(&options, &png));
}

#[test]
fn options_that_are_given_win() {
    let folder = folder();
    let (first, like, wanted) = (
        path(&folder, "a.exr"),
        path(&folder, "b.exr"),
        path(&folder, "c.exr"),
    );
    draw(
        &[
            "-s", "grid", "-r", "5", "--orbit", "20", "--yaw", "10", "--aov", "order",
        ],
        &first,
    );
    let cases: [(&[&str], &[&str]); 4] = [
        (
            &["--yaw", "0"],
            &["-r", "5", "--orbit", "20", "--yaw", "0", "--aov", "order"],
        ),
        (
            &["-r8", "--aov=uv"],
            &["-r", "8", "--orbit", "20", "--yaw", "10", "--aov", "uv"],
        ),
        // These exclude options that are recorded.
        (
            &["--hole", "9,5"],
            &["-r", "5", "--hole", "9,5", "--yaw", "10", "--aov", "order"],
        ),
        (
            &["--budget-px", "1"],
            &[
                "-r",
                "5",
                "--orbit",
                "20",
                "--yaw",
                "10",
                "--aov",
                "order",
                "--budget-px",
                "1",
            ],
        ),
    ];
    for (given, whole) in cases {
        let whole = [&["-s", "grid"], whole].concat();
        assert!(
            draw_like(&first, given, &like) == draw(&whole, &wanted),
            "{given:?}"
        );
    }
}

/// An .exr of one pixel whose header records `options`.
fn recording(folder: &TempDir, options: &str) -> String {
    let picture = Picture::new(1, 1, vec![[0.0; 3]]);
    let metadata = Metadata {
        attributes: vec![("lensbake.options", Value::Text(options.to_owned()))],
        ..Metadata::default()
    };
    let file = path(folder, "recording.exr");
    std::fs::write(&file, encode(&picture, Vec::new(), &metadata).unwrap()).unwrap();
    file
}

#[test]
fn records_that_cannot_be_used_are_refused_in_one_line() {
    let folder = folder();
    let out = path(&folder, "out.exr");
    let refused = |options: &str, words: &[&str]| {
        let file = recording(&folder, options);
        let run = VIEWER.run(&["render", "--like", &file, "-o", &out]);
        run.refuses(&[words, &["--like", &file]].concat());
    };
    let version_1 =
        |options: &str| format!(r#"{{"version":1,"program":"0.1.0","options":{options}}}"#);
    refused("", &["damaged"]);
    refused("nonsense\nin two lines", &["damaged"]);
    refused(&"[".repeat(100_000), &["damaged"]);
    refused(r#"{"version":1}"#, &["damaged", "program"]);
    refused(
        r#"{"version":1,"program":"0.1.0","options":{},"more":3}"#,
        &["damaged", "more"],
    );
    refused(
        r#"{"version":2,"program":"9.1.0","scenes":[{}]}"#,
        &["written by viewer 9.1.0", "cannot read"],
    );
    refused(
        &version_1(r#"{"spin":["0.9"]}"#),
        &["--spin", "no such option"],
    );
    refused(&version_1(r#"{"a\nb":["0.9"]}"#), &["no such option"]);
    // What does not belong to a picture is no recorded option.
    refused(
        &version_1(r#"{"output":["/etc/passwd"]}"#),
        &["--output", "no such option"],
    );
    refused(&version_1(r#"{"help":[]}"#), &["--help", "no such option"]);
    refused(
        &version_1(r#"{"motion":["sideways"]}"#),
        &["--motion", "must be rest, fall, orbit"],
    );
    refused(&version_1(r#"{"size":["3x3","4x4"]}"#), &["--size"]);
    refused(
        &version_1(r#"{"hole":["1,2"],"orbit":["3"]}"#),
        &["--orbit", "--hole"],
    );
    assert!(!Path::new(&out).exists());
}

/// Recorded values are checked as those that are given.
#[test]
fn recorded_values_out_of_range_are_named() {
    let folder = folder();
    let file = recording(
        &folder,
        r#"{"version":1,"program":"","options":{"radius":["0.5"]}}"#,
    );
    let out = path(&folder, "out.exr");
    VIEWER
        .run(&["render", "--like", &file, "-o", &out])
        .refuses(&["--radius", "greater than 1"]);
    assert!(!Path::new(&out).exists());
}

#[test]
fn files_that_are_gone_are_named_with_the_option_that_replaces_them() {
    let folder = folder();
    let [panorama, faces, table, stars] = inputs(&folder);
    let (first, out) = (path(&folder, "first.exr"), path(&folder, "out.exr"));
    let gone = |option: &str, value: &str, file: &str, instead: &str| {
        let options = ["-s", "grid", "-r", "4"];
        // The last of two skies would be an error, so grid only where the sky is not the question.
        let options = if option == "--sky" {
            &options[2..]
        } else {
            &options[..]
        };
        draw(&[options, &[option, value]].concat(), &first);
        let kept = std::fs::read(file).unwrap();
        std::fs::remove_file(file).unwrap();
        let like = ["render", "--like", &first, "-o", &out];
        let words = [
            value,
            "which is not there",
            &format!("name another with {option}"),
        ];
        VIEWER.run(&like).refuses(&[&words[..], &[&first]].concat());
        assert!(!Path::new(&out).exists());
        if !instead.is_empty() {
            draw_like(&first, &[option, instead], &out);
            std::fs::remove_file(&out).unwrap();
        }
        std::fs::write(file, kept).unwrap();
    };
    gone("--sky", &panorama, &panorama, "grid");
    gone("--sky", &faces, &path(&folder, "b.png"), &panorama);
    gone("--table", &table, &table, "");
    gone("--stars", &stars, &stars, "hipparcos");
}

#[test]
fn files_that_are_no_recording_picture_are_refused_in_one_line() {
    let folder = folder();
    let out = path(&folder, "out.exr");
    let refused = |file: &str, words: &[&str]| {
        VIEWER
            .run(&["render", "--like", file, "-o", &out])
            .refuses(&[words, &["--like", file]].concat());
        assert!(!Path::new(&out).exists());
    };
    refused(&path(&folder, "missing.exr"), &["cannot be read"]);
    refused(folder.path().to_str().unwrap(), &["cannot be read"]);
    let file = path(&folder, "file");
    let write = |bytes: &[u8]| std::fs::write(&file, bytes).unwrap();
    for bytes in [
        &b""[..],
        b"\x76\x2f\x31\x01",
        b"a text",
        b"\x89PNG\r\n\x1a\n",
    ] {
        write(bytes);
        refused(&file, &["not a readable OpenEXR picture"]);
    }
    // A table, and a picture of another program.
    write_table(path(&folder, "table.exr"), &one_row(4.0));
    refused(&path(&folder, "table.exr"), &["records no options"]);
    image::Rgb32FImage::new(4, 4)
        .save(path(&folder, "other.exr"))
        .unwrap();
    refused(&path(&folder, "other.exr"), &["records no options"]);
    // A header that is longer than any.
    let long = recording(&folder, &" ".repeat(2 << 20));
    refused(&long, &["its header is damaged, or longer than"]);
}

#[test]
#[cfg(unix)]
fn damaged_headers_allocate_nothing() {
    let folder = folder();
    let (first, out) = (path(&folder, "first.exr"), path(&folder, "out.exr"));
    let whole = draw(&["-s", "grid"], &first);
    let at = attribute(&whole, "lensbake.options");
    let refused = |bytes: &[u8]| {
        std::fs::write(&first, bytes).unwrap();
        let run = VIEWER.run_in_little_memory(&["render", "--like", &first, "-o", &out]);
        run.refuses(&["--like", &first]);
        assert!(!Path::new(&out).exists());
    };
    for length in [9, at - 4, at, at + 20] {
        refused(&whole[..length]);
    }
    // The length of the attribute.
    for length in [i32::MAX, -1, i32::MIN, 1 << 24] {
        refused(&with(whole.clone(), at - 4, &length.to_le_bytes()));
    }
    refused(&with(whole.clone(), at + 3, b"\xff\x00{"));
    // Nothing after the header is read.
    let end = lensbake_test_support::exr_files::table_of_chunks(&whole);
    std::fs::write(&first, &whole[..end]).unwrap();
    assert!(draw_like(&first, &[], &out) == whole);
}

#[test]
fn a_picture_is_not_drawn_over_the_one_it_is_like() {
    let folder = folder();
    let first = path(&folder, "first.exr");
    let whole = draw(&["-s", "grid"], &first);
    VIEWER
        .run(&["render", "--like", &first, "-o", &first])
        .refuses(&[&first, "also the input"]);
    assert!(std::fs::read(&first).unwrap() == whole);
}

/// A name that is not UTF-8 cannot be recorded; the picture is drawn all the same, and a line says so.
#[test]
#[cfg(target_os = "linux")]
fn a_path_that_is_not_utf_8_is_not_recorded() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = folder();
    let sky = folder.path().join(OsStr::from_bytes(b"sk\xff.png"));
    let out = path(&folder, "out.exr");
    image::RgbImage::new(64, 32)
        .save_with_format(&sky, image::ImageFormat::Png)
        .unwrap();
    let mut args: Vec<&OsStr> = RENDER.iter().map(OsStr::new).collect();
    args.extend([
        OsStr::new("-s"),
        sky.as_os_str(),
        OsStr::new("-o"),
        OsStr::new(&out),
    ]);
    let run = VIEWER.run(&args).succeeds();
    assert!(run.stderr.contains("not UTF-8"), "{run:?}");
    VIEWER
        .run(&["render", "--like", &out, "-o", &path(&folder, "again.exr")])
        .refuses(&["records no options"]);
}
