//! The real program on a virtual screen, driven by keys and checked by screenshots.
#![cfg(target_os = "linux")]

use lensbake_test_support::Program;
use lensbake_test_support::desktop::{Desktop, Shot, WindowedProgram};
use std::path::Path;
use std::time::{Duration, Instant};

const VIEWER: &str = env!("CARGO_BIN_EXE_viewer");
const SIZE: &str = "640x360";

/// Largest difference of a channel, of 255, between the window and the headless picture: the window's
/// picture goes through 16-bit floats.
const ROUNDING: u8 = 1;

/// A window without its panel, at rest.
fn open(desktop: &Desktop, folder: &Path, args: &[&str]) -> (WindowedProgram, Shot) {
    let args = [&["--size", SIZE], args].concat();
    let mut window = desktop.start(VIEWER, &args, folder);
    let panel = |shot: &Shot| shot.part(20..100, 60..260);
    window.shows("a picture is there", has_light);
    let with_panel = window.at_rest();
    window.press(&["Tab"]);
    window.shows("the panel is gone", |shot| {
        let changed = panel(shot)
            .pixels
            .into_iter()
            .zip(panel(&with_panel).pixels);
        changed.filter(|(a, b)| a != b).count() > 80 * 200 / 2
    });
    let shot = window.at_rest();
    (window, shot)
}

/// All but the strip at the bottom, where messages are shown.
fn scene(shot: &Shot) -> Shot {
    shot.part(0..shot.width, 0..shot.height.saturating_sub(60))
}

/// Whether two pictures are the same except for rounding and messages.
fn alike(shot: &Shot, expected: &Shot) -> bool {
    let distance = scene(shot).distance(&scene(expected));
    distance.is_some_and(|d| d <= ROUNDING)
}

fn has_light(shot: &Shot) -> bool {
    let lit = shot.pixels.iter().filter(|p| p.iter().any(|&c| c > 40));
    lit.count() > shot.pixels.len() / 20
}

/// The picture that `viewer render` draws.
fn rendered(folder: &Path, args: &[&str]) -> Shot {
    let path = folder.join("rendered.png");
    let all = [
        &["render", "--size", SIZE, "-o", path.to_str().unwrap()],
        args,
    ]
    .concat();
    Program::at(VIEWER).run(&all).succeeds();
    Shot::read(&path)
}

#[track_caller]
fn same(shot: &Shot, expected: &Shot) {
    let distance = shot.distance(expected);
    assert!(distance.is_some_and(|d| d <= ROUNDING), "{distance:?}");
}

fn radius(title: &str) -> f64 {
    let at = title.find("r = ").unwrap() + 4;
    title[at..].split(' ').next().unwrap().parse().unwrap()
}

/// The centre and the number of the black pixels.
fn black(shot: &Shot) -> (f64, f64, usize) {
    let (mut x, mut y, mut count) = (0, 0, 0);
    for (i, _) in shot
        .pixels
        .iter()
        .enumerate()
        .filter(|(_, p)| **p == [0; 3])
    {
        x += i % shot.width as usize;
        y += i / shot.width as usize;
        count += 1;
    }
    let mean = |sum| sum as f64 / count as f64;
    (mean(x), mean(y), count)
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn the_window_shows_what_the_headless_program_draws_and_obeys_the_keys() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    let (mut window, start) = open(&desktop, folder, &[]);
    same(&start, &rendered(folder, &["--method", "lut"]));

    // L: without deflection and with it again.
    window.press(&["l"]);
    window.shows("deflection is off", |shot| *shot != start);
    same(&window.at_rest(), &rendered(folder, &["--method", "flat"]));
    window.press(&["l"]);
    assert_eq!(window.at_rest(), start);

    // V: the mean by the hardware, one ray per pixel, and the mean again.
    for sampling in ["anisotropic", "single"] {
        let before = window.at_rest();
        window.press(&["v"]);
        window.shows(sampling, |shot| *shot != before);
        same(
            &window.at_rest(),
            &rendered(folder, &["--sampling", sampling]),
        );
    }
    window.press(&["v"]);
    window.shows("the mean", |shot| *shot == start);

    // Z: cycles through the four skies.
    for sky in ["starmap", "grid", "stars"] {
        window.press(&["z"]);
        let expected = rendered(folder, &["-s", sky]);
        window.shows(sky, |shot| alike(shot, &expected));
        assert!(window.title().contains(sky), "{}", window.title());
    }
    window.press(&["z"]);
    window.shows("nebula", |shot| alike(shot, &start));

    // R: cycles through the four speeds; the picture moves, and stands still again.
    for speed in ["1×", "2×", "4×"] {
        window.press(&["r"]);
        window.until(speed, |w| w.title().ends_with(speed).then_some(()));
        let now = window.shot();
        window.shows("it moves", |shot| Some(shot) != now.as_ref());
    }
    window.press(&["r"]);
    window.until("0×", |w| w.title().ends_with(" 0×").then_some(()));
    assert_ne!(window.at_rest(), start);

    // Reset.
    window.press(&["Home"]);
    window.shows("the start", |shot| alike(shot, &start));
    window.press(&["Escape"]);
    assert_eq!(window.ends().0, 0);
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn the_keys_look_away_and_approach_but_not_through_the_horizon() {
    let folder = tempfile::tempdir().unwrap();
    let desktop = Desktop::new(1280, 800);
    let args = ["--radius", "8", "-s", "grid"];
    let (mut window, start) = open(&desktop, folder.path(), &args);
    let (x, y, area) = black(&start);
    assert!(
        (x - 319.5).abs() < 1.0 && (y - 179.5).abs() < 1.0,
        "{x} {y}"
    );

    // The hole moves in the direction opposite to the view.
    for (key, right, down) in [
        ("d", -1.0, 0.0),
        ("a", 1.0, 0.0),
        ("w", 0.0, 1.0),
        ("s", 0.0, -1.0),
    ] {
        window.hold(key, Duration::from_millis(200));
        window.shows(key, |shot| {
            let (to_x, to_y, _) = black(shot);
            right * (to_x - x) + down * (to_y - y) > 10.0
        });
        window.press(&["Home"]);
        window.shows("the start", |shot| *shot == start);
    }

    window.hold("Up", Duration::from_millis(300));
    let near = window.at_rest();
    assert!(
        radius(&window.title()) < 8.0 && black(&near).2 > area,
        "{}",
        window.title()
    );
    window.press(&["Home"]);
    window.hold("Down", Duration::from_millis(300));
    let far = window.at_rest();
    assert!(
        radius(&window.title()) > 8.0 && black(&far).2 < area,
        "{}",
        window.title()
    );

    // As near as possible: r = 1.01, where the whole view ahead is black.
    window.hold("Up", Duration::from_millis(300));
    window.scroll(100);
    window.until("the horizon", |w| {
        (radius(&w.title()) == 1.01).then_some(())
    });
    window.hold("Up", Duration::from_millis(300));
    window.shows("black", |shot| shot.pixels.iter().all(|p| *p == [0; 3]));
    assert_eq!(radius(&window.title()), 1.01);
}

/// Proper time of the fall from a radius to the singularity, r_s/c.
fn fall_time(radius: f64) -> f64 {
    2.0 / 3.0 * radius.powf(1.5)
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn the_camera_lets_go_and_falls_through_the_horizon_to_the_end_on_time() {
    /// Proper time per second that the window starts with, r_s/c.
    const PACE: f64 = 0.5;
    /// Longest delay on a busy machine: shaders compile on the way.
    const LATE: Duration = Duration::from_secs(6);
    let folder = tempfile::tempdir().unwrap();
    let desktop = Desktop::new(1280, 800);
    let args = ["--radius", "3", "-s", "grid"];
    let (mut window, start) = open(&desktop, folder.path(), &args);
    assert!(window.title().contains("r = 3.00 – at rest"));
    let due = Duration::from_secs_f64((fall_time(3.0) - fall_time(0.01)) / PACE);

    let began = Instant::now();
    window.press(&["g"]);
    // The title bar's radius: never ahead of the law. The title is rounded.
    let falls = |window: &WindowedProgram| {
        let title = window.title();
        let left = fall_time(3.0) - PACE * began.elapsed().as_secs_f64();
        let law = (1.5 * left.max(0.0)).powf(2.0 / 3.0);
        assert!(radius(&title) > law - 0.006, "{title}: ahead of {law}");
        title
    };
    window.until("it falls", |w| falls(w).contains("– falling").then_some(()));
    for (key, says) in [("l", "– no deflection –"), ("l", "– table –")] {
        window.press(&[key]);
        window.until(says, |w| falls(w).contains(says).then_some(()));
    }
    window.hold("d", Duration::from_millis(200));
    window.press(&["equal", "comma", "period"]);
    window.until("the horizon", |w| (radius(&falls(w)) < 1.0).then_some(()));
    window.press(&["l"]);
    window.until("the end", |w| falls(w).contains("– the end").then_some(()));
    let took = began.elapsed();
    assert!(due < took && took < due + LATE, "{took:?}, due {due:?}");
    window.until("the key below the horizon", |w| {
        w.title().contains("– no deflection –").then_some(())
    });
    window.at_rest();
    assert_eq!(radius(&window.title()), 0.01);

    window.press(&["t"]);
    window.until("where it let go", |w| {
        w.title().contains("r = 3.00 – at rest").then_some(())
    });
    window.press(&["Home"]);
    window.shows("the start", |shot| alike(shot, &start));
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn observers_in_motion_are_shown_as_the_headless_program_draws_them() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    let inside = ["--motion", "fall", "-r", "0.5", "--yaw", "90"];
    let orbit = ["--motion", "orbit", "-r", "3", "--heading", "30"];
    let velocity = ["--motion=-0.3,0.5", "-r", "2", "--yaw", "60"];
    for (args, name) in [
        (&inside[..], "r = 0.50 – free fall"),
        (&orbit[..], "r = 3.00 – circular orbit"),
        (&velocity[..], "r = 2.00 – velocity -0.3,0.5"),
    ] {
        let args = [args, &["--shift", "brightness"]].concat();
        let (window, start) = open(&desktop, folder, &args);
        same(
            &start,
            &rendered(folder, &[&args[..], &["--exposure", "auto"]].concat()),
        );
        assert!(window.title().ends_with(name), "{}", window.title());
    }

    let (mut window, start) = open(&desktop, folder, &orbit);
    window.press_until("r", "– true period");
    window.shows("it orbits", |shot| !alike(shot, &start));
    window.press(&["r"]);
    window.until("it stands", |w| w.title().ends_with("orbit").then_some(()));
    window.at_rest();
    for name in ["– at rest –", "– free fall", "– circular orbit"] {
        window.press_until("o", name);
    }
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn the_disc_is_shown_by_its_key_and_in_the_panel() {
    /// The middle of its box in the panel, pixels of the window.
    const BOX: (u32, u32) = (105, 224);
    let folder = tempfile::tempdir().unwrap();
    let desktop = Desktop::new(1280, 800);
    let args = ["--radius", "15", "-s", "grid"];
    let (mut window, start) = open(&desktop, folder.path(), &args);
    window.press(&["b"]);
    window.shows("a disc in front of the shadow", |shot| {
        4 * black(shot).2 < 3 * black(&start).2
    });
    let disc = window.at_rest();
    window.press(&["b"]);
    window.shows("no disc", |shot| *shot == start);

    // Right of the panel and its shadow.
    let beside_panel = |shot: &Shot| shot.part(400..640, 0..300);
    window.press(&["Tab"]);
    window.at_rest();
    window.click(BOX.0, BOX.1);
    window.shows("the disc again", |shot| {
        beside_panel(shot) == beside_panel(&disc)
    });
    // It is fixed in the sky: the camera sees another side of it.
    window.press(&["Tab"]);
    window.shows("the disc without the panel", |shot| *shot == disc);
    window.hold("Right", Duration::from_millis(300));
    assert!(!alike(&window.at_rest(), &disc));
    // Home hides it, as at the start.
    window.press(&["Home"]);
    window.shows("the start", |shot| alike(shot, &start));
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn methods_are_compared_at_any_resolution_and_shots_are_taken() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    let (mut window, start) = open(&desktop, folder, &[]);
    let direct = rendered(folder, &["--method", "direct"]);

    window.press_until("m", "– direct –");
    window.shows("direct", |shot| alike(shot, &direct));
    window.press_until("m", "– split –");
    window.shows("split", |shot| {
        let right = |shot: &Shot| shot.part(322..640, 0..360);
        let left = |shot: &Shot| shot.part(0..319, 0..360);
        let divider = |shot: &Shot| shot.part(319..322, 0..300);
        divider(shot) != divider(&direct)
            && alike(&right(shot), &right(&direct))
            && alike(&left(shot), &left(&start))
    });
    window.press_until("m", "– difference –");
    let difference = window.shows("difference", |shot| black(shot).2 > shot.pixels.len() / 2);
    window.press(&["bracketright", "bracketright", "bracketright"]);
    let sum = |shot: &Shot| {
        shot.pixels
            .iter()
            .flatten()
            .map(|&c| u64::from(c))
            .sum::<u64>()
    };
    window.shows("amplified", |shot| sum(shot) > 2 * sum(&difference));
    window.press_until("m", "– table –");
    window.shows("table", |shot| *shot == start);

    // X: the resolutions 2×2, automatic, 1/4 and 1/2 change the detail of the picture, but not the size of the
    // shadow.
    for resolution in ["2×2", "automatic", "quarter", "half"] {
        window.press(&["x"]);
        let shot = window.at_rest();
        let (_, _, area) = black(&start);
        let (x, y, now) = black(&shot);
        let share = now as f64 / area as f64;
        assert!((share - 1.0).abs() < 0.25, "{resolution}: {share}");
        assert!((x - 319.5).abs() < 40.0 && (y - 179.5).abs() < 40.0);
        assert!(resolution == "automatic" || shot != start, "{resolution}");
    }
    window.press(&["x"]);
    window.shows("full", |shot| *shot == start);

    // A screenshot is the window without its panel.
    window.press(&["Tab", "p", "Tab"]);
    let file = folder.join("lensbake-1.png");
    window.until("a file is there", |_| file.exists().then_some(()));
    assert_eq!(Shot::read(&file), start);

    // Another size, and the first again.
    window.resize(320, 200);
    window.shows("smaller", |shot| shot.width == 320 && has_light(shot));
    window.resize(640, 360);
    window.shows("as before", |shot| *shot == start);
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn files_are_dropped() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    let (mut window, start) = open(&desktop, folder, &[]);

    // A panorama of one colour.
    let green = folder.join("green sky.png");
    image::RgbImage::from_pixel(64, 32, image::Rgb([20, 200, 60]))
        .save(&green)
        .unwrap();
    window.drop_file(&green);
    window.shows("a green sky", |shot| shot.pixels.contains(&[20, 200, 60]));
    window.until("its name", |w| {
        w.title().contains("green sky.png").then_some(())
    });

    // A file that is neither a sky nor a table changes nothing and is named.
    let text = folder.join("notes.txt");
    std::fs::write(&text, "no picture").unwrap();
    window.drop_file(&text);
    window.until("a refusal", |w| {
        w.stderr().contains("notes.txt").then_some(())
    });
    assert!(window.title().contains("green sky.png"));

    // A coarse atlas, whose error is visible.
    let atlas = folder.join("coarse.lbt");
    lensbake_test_support::write_table(&atlas, &lensbake_test_support::coarse_atlas());
    let coarse = rendered(folder, &["--table", atlas.to_str().unwrap()]);
    assert!(!alike(&coarse, &start));
    window.press(&["Home", "z"]);
    window.shows("the nebula", |shot| alike(shot, &start));
    window.drop_file(&atlas);
    window.shows("the coarse atlas' picture", |shot| alike(shot, &coarse));
    assert!(!window.stderr().contains("panicked"), "{}", window.stderr());
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn a_path_is_recorded_played_saved_and_played_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    let (mut window, start) = open(&desktop, folder, &["-s", "grid", "-r", "10"]);
    window.press(&["k"]);
    window.hold("Up", Duration::from_millis(600));
    let near = window.at_rest();
    assert_ne!(scene(&near), scene(&start));
    let end = radius(&window.title());
    window.press(&["k", "j"]);
    window.until("it plays from the start", |w| {
        (radius(&w.title()) > end + 0.5).then_some(())
    });
    window.until("it ends where the second keyframe is", |w| {
        (radius(&w.title()) == end).then_some(())
    });
    assert!(alike(&window.at_rest(), &near));
    window.press(&["n"]);
    let file = folder.join("lensbake-path-1.json");
    window.until("the path is saved", |_| file.exists().then_some(()));
    drop(window);

    // The same path from its file; what comes after it is where it ends.
    let args = ["-s", "grid", "--play", file.to_str().unwrap()];
    let (again, last) = open(&desktop, folder, &args);
    assert!(alike(&last, &near));
    assert_eq!(radius(&again.title()), end);
}
