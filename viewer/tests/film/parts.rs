//! A film that is divided, or interrupted, has the same bytes.

use crate::{SMALL, VIEWER, catalogue, folder, frames, text};
use std::fs;
use std::process::Stdio;
use std::time::Duration;

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
fn a_frame_with_a_disc_depends_on_its_number_alone() {
    falls_apart(
        &[&SMALL[..], &["--disc", "3,7", "--disc-opacity", "0.8"]].concat(),
        60,
        2,
    );
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
