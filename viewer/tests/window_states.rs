//! The real window in unusual states: tables of one row, long tables, radii beyond the slider. In each state it
//! draws, it can be left, and at rest it does nothing.
#![cfg(target_os = "linux")]

use lensbake_test_support::desktop::{Desktop, Shot, WindowedProgram};
use lensbake_test_support::{Program, one_row, one_row_of};
use std::path::{Path, PathBuf};
use std::time::Duration;

const VIEWER: &str = env!("CARGO_BIN_EXE_viewer");
const SIZE: &str = "1000x600";

/// Largest difference of a channel, of 255, between the window and the headless picture: the window's
/// picture goes through 16-bit floats.
const ROUNDING: u8 = 1;
/// Position of the radius field in the panel, pixels of the window.
const RADIUS: (u32, u32) = (230, 63);
/// Largest CPU share of a window at rest, where 1 is one core: only the test's own queries wake it.
const AT_REST: f64 = 0.1;

/// A window at rest, with its panel.
fn open(desktop: &Desktop, folder: &Path, args: &[&str]) -> (WindowedProgram, Shot) {
    let args = [&["--size", SIZE, "-s", "grid"], args].concat();
    let mut window = desktop.start(VIEWER, &args, folder);
    window.shows("a picture is there", |shot| {
        let lit = shot.pixels.iter().filter(|p| p.iter().any(|&c| c > 40));
        lit.count() > shot.pixels.len() / 20
    });
    let shot = window.at_rest();
    (window, shot)
}

/// The part to the right of the panel with its shadow, and above the messages.
fn scene(shot: &Shot) -> Shot {
    shot.part(400..1000, 0..480)
}

fn alike(shot: &Shot, expected: &Shot) -> bool {
    let distance = scene(shot).distance(&scene(expected));
    distance.is_some_and(|d| d <= ROUNDING)
}

/// Waits until the title bar contains `words`.
#[track_caller]
fn says(window: &mut WindowedProgram, words: &str) {
    window.until(words, |w| w.title().contains(words).then_some(()));
}

/// Drops a file and waits until a message about it is shown.
#[track_caller]
fn drop_and_hear(window: &mut WindowedProgram, path: &Path) {
    let message = |shot: &Shot| shot.part(400..600, 540..590);
    let before = window.at_rest();
    window.drop_file(path);
    window.shows("a message", |shot| message(shot) != message(&before));
    window.at_rest();
}

fn radius(title: &str) -> f64 {
    let at = title.find("r = ").unwrap() + 4;
    title[at..].split(' ').next().unwrap().parse().unwrap()
}

fn table(folder: &Path, name: &str, radius: f64, texels: u32) -> PathBuf {
    let path = folder.join(name);
    lensbake_test_support::write_table(&path, &one_row_of(radius, texels));
    path
}

/// The picture that `viewer render` draws.
fn rendered(folder: &Path, args: &[&str]) -> Shot {
    let path = folder.join("rendered.png");
    let to = ["render", "--size", SIZE, "-s", "grid", "-o"];
    let all = [&to[..], &[path.to_str().unwrap()], args].concat();
    Program::at(VIEWER).run(&all).succeeds();
    Shot::read(&path)
}

/// Checks that the window obeys a key, and that Escape ends it.
#[track_caller]
fn obeys_and_ends(mut window: WindowedProgram) {
    let before = window.at_rest();
    window.press(&["l"]);
    says(&mut window, "no deflection");
    window.shows("another picture", |shot| !alike(shot, &before));
    window.press(&["l"]);
    window.shows("the picture again", |shot| alike(shot, &before));
    window.press(&["Escape"]);
    let (code, stderr) = window.ends();
    assert_eq!(code, 0, "{stderr}");
    assert!(!stderr.contains("panicked"), "{stderr}");
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn a_table_of_one_row_holds_the_radius_and_home_leads_away_from_it() {
    let folder = tempfile::tempdir().unwrap();
    let desktop = Desktop::new(1280, 800);
    let ten = table(folder.path(), "r10.lbt", 10.0, 64);
    let (mut window, start) = open(&desktop, folder.path(), &[]);
    window.until("the radius is typed in", |w| {
        // Repeated if the keys came before the panel had handled the click.
        w.click(RADIUS.0, RADIUS.1);
        std::thread::sleep(Duration::from_millis(300));
        w.press(&["1", "0", "Return"]);
        std::thread::sleep(Duration::from_millis(300));
        w.title().contains("r = 10.00 ").then_some(())
    });
    drop_and_hear(&mut window, &ten);
    let at_ten = window.at_rest();

    window.hold("Up", Duration::from_millis(300));
    window.scroll(-3);
    assert!(alike(&window.at_rest(), &at_ten));
    assert_eq!(radius(&window.title()), 10.0);
    // Only the radius is fixed.
    window.hold("d", Duration::from_millis(300));
    window.shows("another picture", |shot| !alike(shot, &at_ten));

    window.press(&["Home"]);
    says(&mut window, "r = 25.00 ");
    window.shows("the start", |shot| alike(shot, &start));
    window.hold("Up", Duration::from_millis(300));
    window.until("it moves", |w| (radius(&w.title()) < 25.0).then_some(()));

    // Dropped at another radius, the table moves the camera to its own.
    drop_and_hear(&mut window, &ten);
    says(&mut window, "r = 10.00 ");
    window.press(&["Home"]);
    says(&mut window, "r = 25.00 ");
    obeys_and_ends(window);
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn a_table_of_ten_thousand_texels_is_drawn_with() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    let long = table(folder, "long.lbt", 10.0, 10_000);
    let args = ["-r", "10", "--table", long.to_str().unwrap()];
    let expected = rendered(folder, &args);
    let (mut window, _) = open(&desktop, folder, &["-r", "10"]);
    drop_and_hear(&mut window, &long);
    window.shows("its picture", |shot| alike(shot, &expected));
    // It is the table in use: it fixes the radius.
    window.hold("Up", Duration::from_millis(300));
    window.at_rest();
    assert_eq!(radius(&window.title()), 10.0);
    obeys_and_ends(window);

    let (window, shot) = open(&desktop, folder, &args);
    assert!(alike(&shot, &expected));
    obeys_and_ends(window);
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn radii_beyond_the_slider_are_shown_as_they_were_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    for (asked, nearer) in [("5000", true), ("1.005", false)] {
        let args = ["-r", asked, "--fov", "30", "--yaw", "150"];
        let (mut window, shot) = open(&desktop, folder, &args);
        assert_eq!(radius(&window.title()), asked.parse::<f64>().unwrap());
        assert!(alike(&shot, &rendered(folder, &args)));
        assert_rests(&window);
        // The camera cannot go farther out, but back in.
        let [out, back] = if nearer {
            ["Down", "Up"]
        } else {
            ["Up", "Down"]
        };
        window.hold(out, Duration::from_millis(200));
        window.at_rest();
        assert_eq!(radius(&window.title()), asked.parse::<f64>().unwrap());
        window.hold(back, Duration::from_millis(200));
        window.at_rest();
        let moved = radius(&window.title()) - asked.parse::<f64>().unwrap();
        assert!(if nearer { moved < 0.0 } else { moved > 0.0 }, "{moved}");
        window.press(&["Home"]);
        window.shows("the start", |shot| alike(shot, &rendered(folder, &args)));
        obeys_and_ends(window);
    }
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn a_row_far_away_is_drawn_with_and_the_window_rests() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let desktop = Desktop::new(1280, 800);
    let far = folder.join("r5000.lbt");
    lensbake_test_support::write_table(&far, &one_row(5000.0));
    let args = ["-r", "5000", "--table", far.to_str().unwrap()];
    let (window, shot) = open(&desktop, folder, &args);
    assert_eq!(radius(&window.title()), 5000.0);
    assert!(alike(&shot, &rendered(folder, &args)));
    assert_rests(&window);
    obeys_and_ends(window);
}

#[test]
#[cfg_attr(any(feature = "no-gpu", feature = "no-window"), ignore)]
fn windows_wider_than_textures_are_drawn_and_rest() {
    let folder = tempfile::tempdir().unwrap();
    let desktop = Desktop::new(20_000, 600);
    let args = ["--size", "9000x100", "-s", "grid"];
    let mut window = desktop.start(VIEWER, &args, folder.path());
    let lit = |shot: &Shot| {
        let end = shot.part(shot.width - 100..shot.width, 0..shot.height);
        end.pixels.iter().any(|p| p.iter().any(|&c| c > 40))
    };
    window.shows("its right end", |shot| shot.width == 9000 && lit(shot));
    window.at_rest();
    assert_rests(&window);
    // Wider than most devices can draw: they draw a part of it.
    window.resize(20_000, 100);
    window.shows("wider", |shot| shot.width == 20_000);
    window.at_rest();
    assert_rests(&window);
    window.resize(1000, 600);
    window.shows("as usual", |shot| shot.width == 1000 && lit(shot));
    obeys_and_ends(window);
}

/// A picture that stands still may still await a frame, and on a busy machine longer.
#[track_caller]
fn assert_rests(window: &WindowedProgram) {
    let mut shares = (0..10).map(|_| window.processor_share(Duration::from_secs(1)));
    assert!(
        shares.any(|share| share < AT_REST),
        "never at rest in ten seconds"
    );
}
