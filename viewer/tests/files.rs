//! How the program treats files, streams and file names, and what it does without a screen.
#![cfg(unix)]

use lensbake_test_support::Program;
use lensbake_test_support::streams::{Spawned, full_device, link, mode, set_mode};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// A small picture on the CPU, with a sky that is generated quickly.
const RENDER: [&str; 6] = ["render", "--device", "cpu", "--size", "32x18", "-sgrid"];

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn render(args: &[&OsStr]) -> lensbake_test_support::Run {
    let fixed = RENDER.iter().map(OsStr::new);
    VIEWER.run(&fixed.chain(args.iter().copied()).collect::<Vec<_>>())
}

fn render_to(output: &Path) -> lensbake_test_support::Run {
    render(&["-o".as_ref(), output.as_os_str()])
}

fn names(folder: &Path) -> Vec<OsString> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    names
}

/// A panorama of one colour at `path`.
fn panorama(path: &Path) {
    let image = image::RgbImage::from_pixel(64, 32, image::Rgb([10, 200, 30]));
    let mut file = fs::File::create(path).unwrap();
    image.write_to(&mut file, image::ImageFormat::Png).unwrap();
}

#[test]
fn a_picture_goes_through_a_link_keeps_the_mode_and_spares_what_is_read_only() {
    let folder = folder();
    let (real, linked) = (folder.path().join("real.png"), folder.path().join("l.png"));
    fs::write(&real, "old").unwrap();
    set_mode(&real, 0o600);
    link("real.png", &linked);
    render_to(&linked).succeeds();
    assert!(linked.is_symlink());
    assert_eq!(mode(&real), 0o600);
    assert!(fs::read(&real).unwrap().starts_with(PNG));
    set_mode(&real, 0o400);
    let before = fs::read(&real).unwrap();
    render_to(&linked).refuses(&["l.png", "read-only"]);
    assert_eq!(fs::read(&real).unwrap(), before);
    assert_eq!(names(folder.path()), ["l.png", "real.png"]);
}

#[test]
fn a_dash_is_standard_output() {
    let folder = folder();
    let args = [&RENDER[..], &["-o", "-"]].concat();
    let written = VIEWER.run_bytes(&args).stdout;
    assert!(written.starts_with(PNG));
    let file = folder.path().join("p.png");
    render_to(&file).succeeds();
    assert_eq!(fs::read(file).unwrap(), written);
    // `diff` prints its report there.
    let args = ["diff", "--device", "cpu", "--size", "32x18", "-o", "-"];
    VIEWER.run(&args).refuses(&["report"]);
}

#[test]
fn messages_that_cannot_be_written_change_nothing() {
    let folder = folder();
    let file = folder.path().join("p.png");
    let mut command = VIEWER.command();
    command.args(RENDER).arg("-o").arg(&file);
    let status = command.stderr(full_device()).status().unwrap();
    assert_eq!(status.code(), Some(0));
    assert!(fs::read(&file).unwrap().starts_with(PNG));
    // The picture itself cannot be written.
    let full = folder.path().join("full.png");
    link("/dev/full", &full);
    render_to(&full).refuses_after_messages(&["full.png", "No space left"]);
}

#[test]
fn an_output_over_an_input_is_refused() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let (sky, csv, table) = (path("sky.png"), path("s.png"), path("t.png"));
    panorama(&sky);
    fs::write(&csv, "ra,dec,mag\n1,2,3\n").unwrap();
    fs::write(&table, lensbake_test_support::ATLAS).unwrap();
    for (flag, input) in [("-s", &sky), ("--stars", &csv), ("--table", &table)] {
        let before = fs::read(input).unwrap();
        for command in ["render", "diff"] {
            if command == "diff" && flag == "--stars" {
                continue;
            }
            let args: [&OsStr; 7] = [
                command.as_ref(),
                "--device".as_ref(),
                "cpu".as_ref(),
                flag.as_ref(),
                input.as_ref(),
                "-o".as_ref(),
                input.as_ref(),
            ];
            VIEWER
                .run(&args)
                .refuses(&[input.to_str().unwrap(), "also the input"]);
        }
        assert_eq!(fs::read(input).unwrap(), before);
    }
    let raw = path("hip2.dat");
    let line = format!("{:171}\n", "");
    fs::write(&raw, &line).unwrap();
    let raw_text = raw.to_str().unwrap();
    VIEWER
        .run(&["catalogue", raw_text, "-o", raw_text])
        .refuses(&[raw_text, "also the input"]);
    assert_eq!(fs::read_to_string(&raw).unwrap(), line);
}

#[test]
fn a_reader_that_goes_away_is_no_error_and_costs_no_file() {
    let folder = folder();
    let heat = folder.path().join("heat.png");
    let mut command = VIEWER.command();
    command.args(["diff", "--device", "cpu", "--size", "64x36", "-sgrid", "-o"]);
    command.arg(&heat);
    let mut child = Spawned::start(command, "");
    child.close_stdout();
    let run = child.run_within_a_minute();
    assert_eq!(run.code, 0, "{run:?}");
    assert!(fs::read(heat).unwrap().starts_with(PNG));
}

#[test]
fn a_heat_map_is_a_png_and_nothing_else() {
    let folder = folder();
    let file = folder.path().join("heat.exr");
    VIEWER
        .run(
            &["diff", "--device", "cpu", "--size", "32x18", "-o"]
                .map(OsStr::new)
                .into_iter()
                .chain([file.as_os_str()])
                .collect::<Vec<_>>(),
        )
        .refuses(&["heat.exr", ".png"]);
    assert!(!file.exists());
}

#[test]
fn a_side_output_that_fails_does_not_swallow_the_report() {
    let folder = folder();
    let heat = folder.path().join("heat.png");
    link("/dev/full", &heat);
    let args = ["diff", "--device", "cpu", "--size", "32x18", "-sgrid", "-o"];
    let args: Vec<&OsStr> = args
        .iter()
        .map(OsStr::new)
        .chain([heat.as_os_str()])
        .collect();
    let run = VIEWER.run(&args);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(run.stdout.contains("lookup - closed form"), "{run:?}");
    assert!(run.stderr.contains("heat.png"), "{run:?}");
}

#[test]
fn names_with_commas_and_names_that_are_no_text_are_files_too() {
    let folder = folder();
    let out = folder.path().join("out.png");
    let comma = folder.path().join("a panorama, of mine.png");
    let bytes = folder.path().join(OsStr::from_bytes(b"sky-\xff\xfe.png"));
    let stars = folder.path().join(OsStr::from_bytes(b"stars-\xff.csv"));
    panorama(&comma);
    panorama(&bytes);
    fs::write(&stars, "ra,dec,mag\n1,2,3\n").unwrap();
    for (flag, file) in [("-s", &comma), ("-s", &bytes), ("--stars", &stars)] {
        let args: [&OsStr; 4] = [flag.as_ref(), file.as_ref(), "-o".as_ref(), out.as_ref()];
        let fixed = RENDER[..5].iter().map(OsStr::new);
        VIEWER
            .run(&fixed.chain(args).collect::<Vec<_>>())
            .succeeds();
    }
    // A file name that is not UTF-8 is also refused if there is no such file.
    let nowhere = OsStr::from_bytes(b"nowhere-\xff.png");
    let args = ["-o".as_ref(), out.as_ref(), "-s".as_ref(), nowhere];
    VIEWER
        .run(
            &RENDER[..5]
                .iter()
                .map(OsStr::new)
                .chain(args)
                .collect::<Vec<_>>(),
        )
        .refuses(&["neither a file nor a built-in sky"]);
}

/// The program in `folder` on a machine without a screen.
fn without_screen(folder: &Path) -> Command {
    let mut command = VIEWER.command();
    command.current_dir(folder);
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(variable);
    }
    command
}

fn pictures(folder: &Path) -> Vec<PathBuf> {
    let names = names(folder).into_iter();
    names.map(|name| folder.join(name)).collect()
}

#[test]
fn without_a_screen_the_first_command_draws_a_picture() {
    let folder = folder();
    let mut command = without_screen(folder.path());
    command.args(["--size", "160x90"]);
    let run = Spawned::start(command, "").run_within_a_minute();
    assert_eq!(run.code, 0, "{run:?}");
    let why: Vec<_> = run
        .stderr
        .lines()
        .filter(|l| l.contains("no window"))
        .collect();
    assert_eq!(why.len(), 1, "{run:?}");
    assert!(run.stderr.contains("wrote lensed.png"), "{run:?}");
    let [picture] = &pictures(folder.path())[..] else {
        panic!("{:?}", pictures(folder.path()));
    };
    let picture = image::open(picture).unwrap();
    assert_eq!((picture.width(), picture.height()), (160, 90));
}

#[test]
fn without_a_screen_and_without_a_gpu_too() {
    let folder = folder();
    let mut command = without_screen(folder.path());
    command.args(["--size", "160x90", "-r", "4", "-s", "grid"]);
    for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        command.env(variable, "/nonexistent.json");
    }
    let run = Spawned::start(command, "").run_within_a_minute();
    assert_eq!(run.code, 0, "{run:?}");
    assert!(run.stderr.contains("no window"), "{run:?}");
    assert!(run.stderr.contains("on the CPU"), "{run:?}");
    // It draws the same picture as `render` for this view.
    let mut command = VIEWER.command();
    let other = folder.path().join("other.png");
    command.args(["render", "-dcpu", "--size", "160x90", "-r4", "-sgrid", "-o"]);
    assert!(command.arg(&other).status().unwrap().success());
    let drawn = fs::read(folder.path().join("lensed.png")).unwrap();
    assert_eq!(drawn, fs::read(other).unwrap());
}

#[test]
fn without_a_screen_a_mistake_is_still_refused() {
    let folder = folder();
    for (args, word) in [(["-r", "0.5"], "radius"), (["--table", "no.lbt"], "no.lbt")] {
        let mut command = without_screen(folder.path());
        command.args(args);
        Spawned::start(command, "")
            .run_within_a_minute()
            .refuses(&[word]);
    }
    assert!(pictures(folder.path()).is_empty());
}
