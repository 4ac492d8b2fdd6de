//! The real program: what it prints, what it draws, and how it ends.

use lensbake_test_support::{Damaged, Program, damaged_tables, one_row};
use std::path::Path;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

#[test]
fn render_draws_without_a_gpu_and_writes_both_kinds_of_picture() {
    let folder = folder();
    for name in ["p.png", "p.exr"] {
        let file = path(&folder, name);
        let args = [
            "render", "--device", "cpu", "--size", "64x36", "-s", "grid", "-r", "4", "-o", &file,
        ];
        let run = VIEWER.run(&args).succeeds();
        assert!(run.stderr.contains("drawn on the CPU"), "{run:?}");
        assert!(run.stdout.is_empty(), "{run:?}");
        let picture = image::open(file).unwrap();
        assert_eq!((picture.width(), picture.height()), (64, 36));
    }
}

#[test]
fn filtering_counts_its_extra_rays_and_exposure_is_for_the_screen_alone() {
    let folder = folder();
    let draw = |name: &str, more: &[&str]| {
        let file = path(&folder, name);
        let scene = ["render", "--device", "cpu", "--size", "64x36", "-s", "grid"];
        let run = VIEWER.run(&[&scene[..], &["-r", "4", "-o", &file], more].concat());
        (run.succeeds(), image::open(file).unwrap())
    };
    let (filtered, light) = draw("filtered.exr", &[]);
    assert!(filtered.stderr.contains("extra rays"), "{filtered:?}");
    let (single, other) = draw("single.exr", &["--sampling", "single"]);
    assert!(!single.stderr.contains("extra rays"), "{single:?}");
    assert_ne!(light, other);
    let brighter = ["--exposure", "1.5"];
    assert_eq!(draw("brighter.exr", &brighter).1, light);
    assert_ne!(draw("a.png", &[]).1, draw("b.png", &brighter).1);
    for exposure in ["NaN", "inf", "33", "-40", "much"] {
        VIEWER
            .run(&["render", "-o", "never.png", "--exposure", exposure])
            .refuses(&["--exposure", exposure, "from -32 to 32"]);
    }
}

#[test]
fn render_takes_a_panorama_and_six_faces() {
    let folder = folder();
    let panorama = path(&folder, "sky.jpg");
    image::RgbImage::from_pixel(64, 32, image::Rgb([10, 200, 30]))
        .save(&panorama)
        .unwrap();
    let faces: Vec<String> = (0..6).map(|i| path(&folder, &format!("{i}.png"))).collect();
    for face in &faces {
        image::RgbImage::from_pixel(8, 8, image::Rgb([10, 200, 30]))
            .save(face)
            .unwrap();
    }
    for sky in [panorama, faces.join(",")] {
        let file = path(&folder, "out.png");
        let args = [
            "render", "--device", "cpu", "--size", "32x18", "--yaw", "180", "-s", &sky, "-o", &file,
        ];
        VIEWER.run(&args).succeeds();
        let picture = image::open(file).unwrap().into_rgb8();
        for pixel in picture.pixels() {
            let [r, g, b] = pixel.0;
            assert!(
                r.abs_diff(10) < 4 && g.abs_diff(200) < 4 && b.abs_diff(30) < 4,
                "{pixel:?}"
            );
        }
    }
}

#[test]
fn viewer_diff_reports_and_draws_its_heat_map() {
    let folder = folder();
    let file = path(&folder, "heat.png");
    let scene = [
        "--size", "160x90", "-r", "10", "-s", "grid", "--device", "cpu",
    ];
    let diff = |more: &[&str]| VIEWER.run(&[&["diff", "-o", &file], &scene[..], more].concat());
    let run = diff(&[]).succeeds();
    for what in [
        "lookup - closed form",
        "direct - closed form",
        "lookup - direct",
        "pictures of",
    ] {
        assert!(run.stdout.contains(what), "{}", run.stdout);
    }
    assert!(image::open(&file).unwrap().width() >= 160);
    let missed = diff(&["--budget-px", "1e-9"]);
    assert_eq!(missed.code, 1, "{missed:?}");
}

#[test]
fn damaged_tables_are_refused_in_one_line() {
    let folder = folder();
    let out = path(&folder, "out.png");
    for Damaged { name, bytes, words } in damaged_tables() {
        let file = path(&folder, name);
        std::fs::write(&file, bytes).unwrap();
        let words = [words, &[file.as_str()]].concat();
        VIEWER
            .run(&["render", "--table", &file, "-o", &out])
            .refuses(&words);
    }
    assert!(!Path::new(&out).exists());
}

#[test]
fn files_that_are_not_there_or_cannot_be_written_are_named() {
    let folder = folder();
    let missing = path(&folder, "missing.png");
    VIEWER.run(&["render", "-s", &missing]).refuses(&[&missing]);
    let nowhere = path(&folder, "no/such/folder/a.png");
    VIEWER
        .run(&["render", "-o", &nowhere])
        .refuses(&[&nowhere, "does not exist"]);
    VIEWER
        .run(&["render", "-o", "p.jpg"])
        .refuses(&["p.jpg", ".png or .exr"]);
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 0, "something was left behind");
}

#[test]
fn skies_that_are_none_are_refused_in_one_line() {
    let folder = folder();
    let out = path(&folder, "out.png");
    let render = |sky: &str| VIEWER.run(&["render", "--device", "cpu", "-s", sky, "-o", &out]);
    let text = path(&folder, "sky.png");
    std::fs::write(&text, "no picture").unwrap();
    render(&text).refuses(&[&text, "not a usable picture"]);
    let pixel = path(&folder, "pixel.png");
    image::RgbImage::new(1, 1).save(&pixel).unwrap();
    render(&pixel).refuses(&[&pixel, "1x1 pixels"]);
    let square = path(&folder, "square.png");
    image::RgbImage::new(64, 64).save(&square).unwrap();
    render(&square).refuses(&[&square, "twice as wide as high"]);
    let five = [pixel.as_str(); 5].join(",");
    render(&five).refuses(&["one panorama or six cube faces, not 5 files"]);
    render("nebla").refuses(&["nebla", "built-in sky (nebula, starmap, grid, stars)"]);
    render(folder.path().to_str().unwrap()).refuses(&[folder.path().to_str().unwrap()]);
    assert!(!Path::new(&out).exists());
}

#[test]
fn views_that_are_none_are_refused_in_one_line() {
    let render = |args: &[&str]| VIEWER.run(&[&["render", "-o", "never.png"], args].concat());
    for r in ["1", "0.5", "0", "-3", "NaN"] {
        render(&["-r", r]).refuses(&["radius", "greater than 1"]);
    }
    render(&["-r", "inf"]).refuses(&["radius inf", "at most"]);
    for fov in ["0", "180", "270", "-20", "NaN"] {
        render(&["--fov", fov]).refuses(&["field of view", fov, "between 0 and 180"]);
    }
    render(&["--size", "0x100"]).refuses(&["0x100"]);
    render(&["--size", "99999x99999"]).refuses(&["99999x99999"]);
    render(&["--step", "0", "--method", "direct"]).refuses(&["step"]);
    assert!(!Path::new("never.png").exists());
}

#[test]
fn a_row_for_one_observer_refuses_another() {
    let folder = folder();
    let (table, out) = (path(&folder, "r10.exr"), path(&folder, "out.png"));
    lensbake_test_support::write_table(Path::new(&table), &one_row(10.0));
    let render = |r| {
        let size = ["--size", "32x18", "--device", "cpu", "-s", "grid"];
        VIEWER.run(
            &[
                &["render", "--table", &table, "-r", r, "-o", &out],
                &size[..],
            ]
            .concat(),
        )
    };
    render("10").succeeds();
    render("5").refuses(&[&table, "r = 10 only"]);
}

#[test]
fn typos_are_told_with_a_hint() {
    let run = VIEWER.run(&["render", "--radus", "5"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(run.stderr.contains("--radius"), "{run:?}");
}

#[test]
fn stars_are_drawn_before_any_sky_and_from_a_persons_own_catalogue() {
    let folder = folder();
    let (csv, out) = (path(&folder, "my.csv"), path(&folder, "out.png"));
    // One star in the middle of the picture; the hole is far away and beside the star.
    std::fs::write(&csv, "ra,dec,mag\n30,10,-1\n").unwrap();
    let render = |sky: &str, stars: &[&str]| {
        let scene = [
            "render", "--device", "cpu", "--size", "65x37", "-r", "1e5", "--fov", "20", "--hole",
            "20,10", "--yaw", "-9.848", "--pitch", "0.15", "-s", sky, "-o", &out,
        ];
        VIEWER.run(&[&scene[..], stars].concat()).succeeds();
        image::open(&out).unwrap().into_rgb8()
    };
    let picture = render("stars", &["--stars", &csv]);
    // As white as the tone map permits.
    let middle = picture.get_pixel(32, 18).0;
    assert!(middle.iter().all(|&c| c >= 250), "{middle:?}");
    assert_eq!(picture.get_pixel(2, 2).0, [0; 3]);
    let dimmer = render("stars", &["--stars", &csv, "--star-exposure", "-9"]);
    let pixel = dimmer.get_pixel(32, 18).0[0];
    assert!((10..255).contains(&pixel), "{pixel}");
    let both = render("grid", &["--stars", "hipparcos"]);
    assert_ne!(both, render("grid", &[]));
}

#[test]
fn catalogues_that_are_none_are_refused_in_one_line() {
    let folder = folder();
    let out = path(&folder, "out.png");
    let draw = |stars: &str| {
        let args = [
            "render", "--device", "cpu", "--size", "32x18", "-s", "grid", "--stars",
        ];
        VIEWER.run(&[&args[..], &[stars, "-o", &out]].concat())
    };
    let mut truncated = lensbake_render::stars::to_bytes(&lensbake_render::stars::hipparcos());
    truncated.truncate(1000);
    let junk: Vec<u8> = (0..10_000_u32).map(|i| ((i * i) >> 3) as u8).collect();
    let cases: [(&str, &[u8], &str); 8] = [
        ("empty.csv", b"", "no column 'ra'"),
        ("header.csv", b"ra,dec,mag\n", "holds no star"),
        ("column.csv", b"ra,mag\n1,2\n", "no column 'dec'"),
        (
            "nan.csv",
            b"ra,dec,mag\n1,2,3\n1,NaN,3\n",
            "line 3: dec is 'NaN'",
        ),
        ("short.csv", b"ra,dec,mag\n1,2\n", "line 2: mag is ''"),
        ("binary.csv", &junk, "binary.csv"),
        ("truncated.stars", &truncated, "truncated or damaged"),
        ("magic.stars", b"LBSTARS\0", "truncated or damaged"),
    ];
    for (name, bytes, words) in cases {
        let file = path(&folder, name);
        std::fs::write(&file, bytes).unwrap();
        draw(&file).refuses(&[&file, words]);
    }
    draw("nowhere.csv").refuses(&["nowhere.csv", "neither a file nor"]);
    draw(folder.path().to_str().unwrap()).refuses(&["cannot be read"]);
    let raw = path(&folder, "nan.csv");
    VIEWER
        .run(&["catalogue", &raw, "-o", &path(&folder, "c.stars")])
        .refuses(&[&raw, "line 1 is no record of hip2.dat"]);
    let render = |args: &[&str]| {
        let base = [
            "render",
            "--device",
            "cpu",
            "-s",
            "stars",
            "-o",
            out.as_str(),
        ];
        VIEWER.run(&[&base[..], args].concat())
    };
    render(&["--star-radius", "0"]).refuses(&["--star-radius 0"]);
    render(&["--star-exposure", "99"]).refuses(&["--star-exposure", "from -30 to 30"]);
    render(&["--hole", "12"]).refuses(&["--hole", "two angles in degrees"]);
    render(&["--hole", "0,91"]).refuses(&["--hole", "two angles in degrees"]);
    assert!(!Path::new(&out).exists());
}

#[test]
fn a_million_lines_load() {
    let folder = folder();
    let (csv, out) = (path(&folder, "many.csv"), path(&folder, "out.png"));
    let mut text = String::from("ra,dec,mag,bv\n");
    for i in 0..1_000_000 {
        let (ra, dec) = (i % 3600, (i / 3600) as f64 * 0.6 - 83.0);
        text += &format!("{}.{},{dec:.1},{}.5,0.6\n", ra / 10, ra % 10, 6 + i % 8);
    }
    std::fs::write(&csv, text).unwrap();
    let size = [
        "render", "--device", "cpu", "--size", "160x90", "-s", "stars",
    ];
    VIEWER
        .run(&[&size[..], &["--stars", &csv, "-o", &out]].concat())
        .succeeds();
    let lit = image::open(&out).unwrap().into_rgb8();
    assert!(lit.pixels().filter(|p| p.0[1] > 0).count() > 5000);
}

/// Heat map, pictures and both integrators for a pixel that looks straight away from the hole.
#[test]
fn a_pixel_straight_away_from_the_hole_is_like_any_other() {
    let folder = folder();
    let file = path(&folder, "heat.png");
    let odd = [
        "--size", "161x91", "--yaw", "180", "-s", "grid", "-o", &file,
    ];
    VIEWER
        .run(&[&["diff", "--device", "cpu"], &odd[..]].concat())
        .succeeds();
    let exr = path(&folder, "p.exr");
    let steep = ["--step", "0.5", "--fov", "1", "--size", "400x400"];
    for device in ["cpu", "auto"] {
        let args = ["render", "--device", device, "--method", "direct"];
        let more = ["--yaw", "180", "-s", "grid", "-o", &exr];
        VIEWER.run(&[&args[..], &steep, &more].concat()).succeeds();
        let picture = image::open(&exr).unwrap().into_rgb32f();
        let lost = picture
            .pixels()
            .filter(|p| !p.0.iter().all(|c| c.is_finite()));
        assert_eq!(lost.count(), 0, "{device}");
        let dark = picture.pixels().filter(|p| p.0 == [0.0; 3]);
        assert_eq!(dark.count(), 0, "{device}");
    }
}

/// A field of view so narrow that 32-bit floats cannot resolve its pixels.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn what_32_bits_cannot_draw_is_drawn_on_the_cpu_or_said() {
    let folder = folder();
    let draw = |device: &str, fov: &str| {
        let file = path(&folder, &format!("{device}-{fov}.png"));
        let view = [
            "render",
            "-s",
            "starmap",
            "-r",
            "10",
            "--yaw",
            "14.26902733",
        ];
        let more = ["--size", "160x90", "--fov", fov, "-d", device, "-o", &file];
        let run = VIEWER.run(&[&view[..], &more].concat()).succeeds();
        (run, image::open(file).unwrap().into_rgb8())
    };
    let (gpu, _) = draw("gpu", "0.0001");
    assert!(gpu.stderr.contains("32-bit"), "{gpu:?}");
    let (auto, by_auto) = draw("auto", "0.0001");
    assert!(auto.stderr.contains("32-bit"), "{auto:?}");
    assert!(auto.stderr.contains("drawn on the CPU"), "{auto:?}");
    assert_eq!(by_auto, draw("cpu", "0.0001").1);
    // A view that the GPU can draw gives no message.
    for device in ["gpu", "auto"] {
        let (run, _) = draw(device, "20");
        assert!(!run.stderr.contains("32-bit"), "{run:?}");
        assert!(!run.stderr.contains("drawn on the CPU"), "{run:?}");
    }
}
