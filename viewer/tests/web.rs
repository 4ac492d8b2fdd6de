//! The web page in Chromium: its pictures against those of the program, its use, and its weight. `scripts/web.sh` builds
//! the page.
#![cfg(target_os = "linux")]

use image::RgbImage;
use lensbake_test_support::{Program, browser, workspace};
use serde_json::{Value, json};
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

/// The built page.
fn dist() -> PathBuf {
    let dist = workspace().join("web/dist");
    assert!(
        dist.join("index.html").is_file(),
        "{} is not built: run scripts/web.sh, or test with --features viewer/no-web",
        dist.display()
    );
    dist
}

/// Runs a script of `web/tests` on a virtual screen: without one, a browser takes empty pictures of WebGPU.
fn run(script: &str, arguments: &[&Path]) -> Value {
    let mut on_screen = Command::new("xvfb-run");
    on_screen.args(["-a", "-s", "-screen 0 1600x1200x24", "node"]);
    let arguments: Vec<&str> = arguments
        .iter()
        .map(|path| path.to_str().unwrap())
        .collect();
    browser::run(
        env!("CARGO_TARGET_TMPDIR"),
        &["tests/browser", "web/tests"],
        on_screen,
        script,
        &arguments,
    )
}

/// A scene as an address of the page and as options of the program.
struct Scene {
    name: &'static str,
    query: &'static str,
    options: &'static [&'static str],
    /// Whether many pixels see the edges of the faces of the cube map, across which the compute shaders of SwiftShader,
    /// the software GPU of Chromium, do not filter; its fragment shaders do.
    has_edges: bool,
}

/// At rest, the hole aside and the grid, stars, below the horizon with colours, and in orbit.
const SCENES: [Scene; 5] = [
    Scene {
        name: "at rest",
        query: "?radius=10",
        options: &["-r", "10"],
        has_edges: false,
    },
    Scene {
        name: "grid, looking aside",
        query: "?radius=4&yaw=40&pitch=-15&roll=10&fov=110&sky=grid",
        options: &[
            "-r", "4", "--yaw", "40", "--pitch", "-15", "--roll", "10", "--fov", "110", "-s",
            "grid",
        ],
        has_edges: true,
    },
    Scene {
        name: "stars",
        query: "?radius=5&orbit=84&latitude=1&sky=stars",
        options: &["-r", "5", "--orbit", "84", "--latitude", "1", "-s", "stars"],
        has_edges: false,
    },
    Scene {
        name: "below the horizon, with colours",
        query: "?radius=0.5&motion=fall&fov=150&shift=colour&sky=starmap",
        options: &[
            "-r",
            "0.5",
            "--motion",
            "fall",
            "--fov",
            "150",
            "--shift",
            "colour",
            "--exposure",
            "auto",
            "-s",
            "starmap",
        ],
        has_edges: false,
    },
    Scene {
        name: "in orbit",
        query: "?radius=3&motion=orbit&yaw=90",
        options: &["-r", "3", "--motion", "orbit", "--yaw", "90"],
        has_edges: true,
    },
];

/// Whether a page draws a scene.
type Draws = fn(&Scene) -> bool;

/// What draws in the browser, and which scenes: WebGL2 has no point stars.
const PAGES: [(&str, Draws); 3] = [
    ("backend=webgpu", |_| true),
    ("backend=webgpu&pass=fragment", |scene| scene.has_edges),
    ("backend=webgl", |scene| scene.name != "stars"),
];
const SIZE: [u32; 2] = [960, 540];

/// Differences of two pictures in 1/255: the mean of all channels, and the largest channel of 99.9 % of the pixels and of
/// all.
struct Difference {
    mean: f64,
    most_of_999: u8,
    most: u8,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Difference {
            mean,
            most_of_999,
            most,
        } = self;
        write!(
            f,
            "mean {mean:.4}, 99.9 % of the pixels ≤ {most_of_999}, most {most}"
        )
    }
}

impl Difference {
    fn of(a: &RgbImage, b: &RgbImage) -> Self {
        assert_eq!(a.dimensions(), b.dimensions());
        let mut pixels: Vec<u8> = Vec::with_capacity(a.len() / 3);
        let mut sum = 0u64;
        for (a, b) in a.pixels().zip(b.pixels()) {
            let channels = [0, 1, 2].map(|i| a.0[i].abs_diff(b.0[i]));
            sum += channels.map(u64::from).iter().sum::<u64>();
            pixels.extend(channels.iter().max());
        }
        pixels.sort_unstable();
        Difference {
            mean: sum as f64 / (3 * pixels.len()) as f64,
            most_of_999: pixels[pixels.len() * 999 / 1000],
            most: pixels[pixels.len() - 1],
        }
    }
}

fn picture(path: &Path) -> RgbImage {
    image::open(path).unwrap().into_rgb8()
}

#[test]
#[cfg_attr(
    any(feature = "no-web", feature = "no-gpu"),
    ignore = "feature no-web or no-gpu"
)]
fn the_page_draws_what_the_program_does() {
    let folder = TempDir::new().unwrap();
    let file = |name: String| folder.path().join(name.replace([' ', ',', '&', '='], "-"));
    let mut jobs = Vec::new();
    let mut drawn = Vec::new();
    for (page, draws) in PAGES {
        for scene in SCENES.iter().filter(|scene| draws(scene)) {
            let [shown, read] =
                ["shown", "read"].map(|what| file(format!("{} {page} {what}.png", scene.name)));
            jobs.push(json!({
                "query": format!("{}&panel=off&{page}", scene.query),
                "width": SIZE[0], "height": SIZE[1], "shown": shown, "read": read,
            }));
            drawn.push((scene, page, shown, read));
        }
    }
    let list = file("jobs.json".into());
    fs::write(&list, json!(jobs).to_string()).unwrap();
    let said = run("draw.mjs", &[&dist(), &list]);
    assert_eq!(said["errors"], json!([]), "{said}");

    let [width, height] = SIZE;
    for (i, (scene, page, shown, read)) in drawn.into_iter().enumerate() {
        let adapter = said["adapters"][i].as_str().unwrap();
        let backend = if page.contains("webgpu") {
            "webgpu"
        } else {
            "webgl"
        };
        assert!(adapter.starts_with(backend), "{adapter}");
        let native = file(format!("{}.png", scene.name));
        let size = format!("{width}x{height}");
        let output = ["-o", native.to_str().unwrap(), "--size", &size];
        VIEWER
            .run(&[&["render"], scene.options, &output].concat())
            .succeeds();
        let native = picture(&native);
        for (what, path) in [("shown", shown), ("read back", read)] {
            let difference = Difference::of(&picture(&path), &native);
            println!("{}, {page}, {what}: {difference}", scene.name);
            assert!(
                difference.mean <= 0.5,
                "{}, {page}: {difference}",
                scene.name
            );
            let filters_edges = !scene.has_edges || page != "backend=webgpu";
            assert!(
                difference.most_of_999 <= 4 || !filters_edges,
                "{}, {page}: {difference}",
                scene.name
            );
        }
    }
}

#[test]
#[cfg_attr(feature = "no-web", ignore = "feature no-web")]
fn the_page_is_used_as_people_use_it() {
    let folder = TempDir::new().unwrap();
    let [own, bad] = ["own.png", "bad.png"].map(|name| folder.path().join(name));
    let panorama = RgbImage::from_fn(512, 256, |x, y| {
        image::Rgb([(x / 2) as u8, y as u8, if y % 16 == 0 { 255 } else { 60 }])
    });
    panorama.save(&own).unwrap();
    let bytes = fs::read(&own).unwrap();
    fs::write(&bad, &bytes[..bytes.len() / 2]).unwrap();
    let said = run("use.mjs", &[&dist(), &own, &bad]);
    let passed = said["passed"].as_array().unwrap();
    println!("{passed:?}");
    assert!(passed.len() > 20, "{said}");
}

/// Most bytes that may be transferred until the first picture, compressed with gzip.
const MOST_BYTES: u64 = 2_500_000;

#[test]
#[cfg_attr(feature = "no-web", ignore = "feature no-web")]
fn the_first_picture_needs_few_bytes() {
    let said = run("weight.mjs", &[&dist()]);
    let files = said["before"].as_object().unwrap();
    for (name, bytes) in files {
        println!("{name}: {bytes}");
    }
    let bytes: u64 = files.values().map(|bytes| bytes.as_u64().unwrap()).sum();
    println!("together: {bytes}; later: {}", said["after"]);
    assert!(files.contains_key("lensbake_web_bg.wasm"), "{said}");
    assert!(bytes <= MOST_BYTES, "{bytes} bytes until the first picture");
    assert!(said["after"].get("hipparcos.stars").is_some(), "{said}");
}
