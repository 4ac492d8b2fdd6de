//! Videos, with programs in place of ffmpeg.

use crate::{SMALL, VIEWER, file, film, folder, frames, text};
use lensbake_test_support::{Program, Run};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use tempfile::TempDir;

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
fn a_video_that_fails_leaves_the_old_one() {
    let folder = folder();
    let old = file(&folder, "film.mp4", "old");
    let fails = ffmpeg("for last; do :; done; /bin/cat > \"$last\"; exit 1");
    video(fails.path(), &old, "64x36", &["--overwrite"]).refuses(&["film.mp4: ffmpeg failed"]);
    assert_eq!(fs::read(&old).unwrap(), b"old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
