//! The window says so when the GPU has no room for all stars.
#![cfg(target_os = "linux")]

use lensbake_test_support::desktop::Desktop;
use std::time::Duration;

const VIEWER: &str = env!("CARGO_BIN_EXE_viewer");

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn the_window_says_once_that_it_has_no_room_for_all_stars() {
    let folder = tempfile::tempdir().unwrap();
    let desktop = Desktop::new(1280, 800);
    let args = ["--size", "640x360", "-s", "stars", "--star-exposure", "14"];
    let mut window = desktop.start(VIEWER, &args, folder.path());
    let says = |line: &&str| line.contains("stars are missing") && line.contains("--star-exposure");
    // The message comes after the first frame, although nothing moves.
    window.until("it says so", |w| w.stderr().lines().find(says).map(|_| ()));
    // Many frames with missing stars give one message.
    window.press(&["r"]);
    std::thread::sleep(Duration::from_secs(3));
    assert_eq!(window.stderr().lines().filter(says).count(), 1);
    window.press(&["Escape"]);
    assert_eq!(window.ends().0, 0);
}
