//! Soak test: random keys, drags, resizes and dropped files, valid and invalid, for half a minute or
//! `LENSBAKE_SOAK_S` seconds. The window stays alive, reports no panic, and its memory does not grow when the same
//! inputs are repeated. Memory that new inputs need is no leak: the window keeps a pipeline for each combination of
//! settings that it has drawn with.
#![cfg(target_os = "linux")]

use fastrand::Rng;
use lensbake_test_support::desktop::{Desktop, WindowedProgram};
use lensbake_test_support::{coarse_atlas, one_row, one_row_of};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const USUAL_S: u64 = 30;
/// Shortest time before memory is measured, in which allocators and drivers reach the size that they keep, and the
/// pipelines for the inputs are made.
const WARM_UP: Duration = Duration::from_secs(30);
/// Largest allowed growth of memory, as a part of the memory before.
const GROWTH: f64 = 0.05;
/// Keys to press; the key that ends the program is not among them.
const KEYS: [&str; 24] = [
    "o",
    "g",
    "t",
    "comma",
    "period",
    "r",
    "c",
    "e",
    "z",
    "l",
    "m",
    "bracketleft",
    "bracketright",
    "x",
    "equal",
    "minus",
    "Home",
    "f",
    "p",
    "Tab",
    "h",
    "F1",
    "q",
    "space",
];
const HELD: [&str; 8] = ["w", "a", "s", "d", "Up", "Down", "Left", "Right"];
const SIZES: [(u32, u32); 7] = [
    (640, 360),
    (1, 1),
    (2, 700),
    (1200, 3),
    (321, 457),
    (1000, 600),
    (64, 64),
];

/// Files to drop: skies, tables, and files that are neither.
fn files(folder: &Path) -> Vec<PathBuf> {
    let file = |name: &str| folder.join(name);
    let picture = |width, height| {
        image::RgbImage::from_fn(width, height, |x, y| image::Rgb([x as u8, y as u8, 90]))
    };
    picture(256, 128).save(file("panorama.png")).unwrap();
    picture(100, 100).save(file("square.png")).unwrap();
    std::fs::write(file("text.jpg"), "no picture at all").unwrap();
    std::fs::write(file("empty.png"), "").unwrap();
    let table = |name: &str, table| lensbake_test_support::write_table(file(name), &table);
    table("coarse.lbt", coarse_atlas());
    table("coarse.exr", coarse_atlas());
    table("r10.lbt", one_row(10.0));
    table("r5000.lbt", one_row(5000.0));
    table("long.lbt", one_row_of(1.005, 9000));
    let whole = std::fs::read(file("coarse.lbt")).unwrap();
    std::fs::write(file("cut.lbt"), &whole[..whole.len() / 2]).unwrap();
    let mut flipped = whole.clone();
    flipped[whole.len() - 9] ^= 0x40;
    std::fs::write(file("flipped.lbt"), flipped).unwrap();
    let png = std::fs::read(file("panorama.png")).unwrap();
    std::fs::write(file("cut.png"), &png[..png.len() / 2]).unwrap();
    std::fs::create_dir(file("folder")).unwrap();
    let mut all: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    all.sort();
    all
}

/// Sends one random input.
fn stir(window: &mut WindowedProgram, files: &[PathBuf], rng: &mut Rng) {
    window.still_runs("the soak is over");
    let (x, y) = (rng.u32(0..640).to_string(), rng.u32(0..360).to_string());
    match rng.u32(0..20) {
        0 => {
            let (width, height) = SIZES[rng.usize(..SIZES.len())];
            window.resize(width, height);
        }
        1 | 2 => window.drop_file(&files[rng.usize(..files.len())]),
        3 => {
            window.hide();
            window.unhide();
        }
        4 => window.scroll(rng.i32(-20..20)),
        5 => {
            let button = ["1", "3"][rng.usize(..2)];
            window.xdotool(&["mousedown", button, "mousemove", &x, &y, "mouseup", button]);
        }
        6 => window.xdotool(&["mousemove", &x, &y, "click", "1"]),
        7..10 => {
            let time = Duration::from_millis(rng.u64(0..200));
            window.hold(HELD[rng.usize(..HELD.len())], time);
        }
        _ => window.press(&[KEYS[rng.usize(..KEYS.len())]]),
    }
}

/// Brings the window to a fixed state, and returns its memory there.
fn settled_memory(window: &mut WindowedProgram, files: &[PathBuf]) -> u64 {
    window.resize(640, 360);
    let panorama = files.iter().find(|f| f.ends_with("panorama.png")).unwrap();
    let table = files.iter().find(|f| f.ends_with("coarse.lbt")).unwrap();
    window.drop_file(table);
    window.drop_file(panorama);
    window.press(&["Home"]);
    window.until("the panorama is shown", |w| {
        let title = w.title();
        (title.contains("panorama.png") && title.contains("r = 25.00")).then_some(())
    });
    window.at_rest();
    window.memory()
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn the_window_stays_alive_and_does_not_grow() {
    let seconds = std::env::var("LENSBAKE_SOAK_S");
    let seconds = seconds.map_or(USUAL_S, |s| s.parse().expect("LENSBAKE_SOAK_S in seconds"));
    let folder = tempfile::tempdir().unwrap();
    let pictures = tempfile::tempdir().unwrap();
    let files = files(folder.path());
    let desktop = Desktop::new(1280, 800);
    let viewer = env!("CARGO_BIN_EXE_viewer");
    let mut window = desktop.start(viewer, &["--size", "640x360"], pictures.path());
    window.shows("a picture", |shot| shot.pixels.iter().any(|p| *p != [0; 3]));

    // What is created only once is created before memory is measured: skies, pipelines, the largest pictures.
    for keys in [
        ["z", "z", "z"],
        ["m", "m", "m"],
        ["l", "l", "m"],
        ["h", "h", "p"],
    ] {
        window.press(&keys);
        window.at_rest();
    }
    window.resize(1000, 600);
    for _ in 0..5 {
        window.press(&["x"]);
        window.at_rest();
    }
    // Sends inputs, the same in each call, for a time or up to a number of them.
    let stir_for = |window: &mut WindowedProgram, time: Duration, most: u64| {
        let mut rng = Rng::with_seed(7);
        let start = Instant::now();
        let mut events = 0;
        while start.elapsed() < time && events < most {
            stir(window, &files, &mut rng);
            events += 1;
        }
        (events, settled_memory(window, &files))
    };
    let quarter = Duration::from_secs(seconds) / 4;
    settled_memory(&mut window, &files);
    let (most, before) = stir_for(&mut window, WARM_UP.max(quarter), u64::MAX);
    println!("after the warm-up: {:.1} MB", 1e-6 * before as f64);
    let (mut stirred, mut after) = (0, before);
    for _ in 0..4 {
        let (events, memory) = stir_for(&mut window, quarter, most);
        stirred += events;
        after = memory;
        println!("after {stirred} events: {:.1} MB", 1e-6 * memory as f64);
    }
    let growth = after as f64 / before as f64 - 1.0;
    println!("{seconds} s: memory {:+.1} %", 100.0 * growth);
    let stderr = window.stderr();
    assert!(!stderr.contains("panicked"), "{stderr}");
    assert!(growth <= GROWTH, "memory grew by {:.1} %", 100.0 * growth);
    assert!(stirred > seconds, "only {stirred} events");

    window.press(&["Escape"]);
    if window.is_alive_after(Duration::from_millis(500)) {
        // The help was open, or the window filled the screen.
        window.press(&["Escape", "Escape"]);
    }
    assert_eq!(window.ends().0, 0);
}
