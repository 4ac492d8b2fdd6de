//! The least model and the chart, as the real program computes them.

use lensbake_test_support::{Program, Run};
use std::path::Path;

fn viewer(args: &[&str]) -> Run {
    Program::at(env!("CARGO_BIN_EXE_viewer")).run(args)
}

fn render(folder: &Path, args: &[&str]) -> Run {
    let output = folder.join("picture.png").display().to_string();
    let scene = [
        "render", "--size", "64x36", "--sky", "grid", "--device", "cpu", "-o", &output,
    ];
    viewer(&[&scene, args].concat())
}

#[test]
fn the_explanation_names_the_choice_and_the_picture_is_drawn_by_it() {
    let folder = tempfile::tempdir().unwrap();
    let run = render(folder.path(), &["--budget-px", "0.1", "--explain"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let starts = |verdict: &str| run.stdout.lines().any(|line| line.starts_with(verdict));
    for verdict in [
        "least model within 0.1 px",
        "left out   flat",
        "chosen     row of",
        "not asked  direct",
    ] {
        assert!(starts(verdict), "{verdict}: {}", run.stdout);
    }
    let least = std::fs::read(folder.path().join("picture.png")).unwrap();
    let flat = render(folder.path(), &["--method", "flat"]);
    assert_eq!((flat.code, flat.stdout.as_str()), (0, ""));
    assert_ne!(
        std::fs::read(folder.path().join("picture.png")).unwrap(),
        least
    );
}

#[test]
fn the_explanation_says_what_a_disc_adds() {
    let folder = tempfile::tempdir().unwrap();
    // The part of the disc between the camera and the hole.
    let scene = ["--explain", "-r", "6", "--pitch", "-14", "--fov", "20"];
    let explain = |more: &[&str]| {
        let run = render(folder.path(), &[&scene, more].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
        run.stdout
    };
    let (without, with) = (explain(&[]), explain(&["--disc"]));
    assert!(!without.contains("disc"), "{without}");
    for words in [
        "with disc  in every model",
        "bytes per frame more",
        "px, on the disc (",
    ] {
        assert!(with.contains(words), "{words}: {with}");
    }
}

#[test]
fn a_budget_that_nothing_keeps_is_missed_and_drawn_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let run = render(folder.path(), &["--budget-px", "1e-9"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(
        run.stderr
            .contains("no model keeps the error within 0.000000001 px"),
        "{}",
        run.stderr
    );
    assert!(folder.path().join("picture.png").exists());
}

#[test]
fn invalid_budgets_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for budget in ["0", "-1", "nan", "inf"] {
        let run = render(folder.path(), &["--budget-px", budget]);
        assert_eq!(run.code, 2, "{budget}: {}", run.stderr);
    }
    let both = render(folder.path(), &["--budget-px", "0.1", "--method", "lut"]);
    assert_eq!(both.code, 2, "{}", both.stderr);
}

#[test]
fn diff_measures_what_was_predicted_of_the_least_model() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("diff.png").display().to_string();
    let scene = [
        "--size", "64x36", "--sky", "grid", "--device", "cpu", "-o", &output,
    ];
    let run = viewer(
        &[
            &["diff", "--least", "--explain", "--budget-px", "0.1"],
            &scene[..],
        ]
        .concat(),
    );
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let pixels = |line: Option<&str>, before: &str| -> f64 {
        let words: Vec<&str> = line.unwrap().split_whitespace().collect();
        let at = words.iter().position(|word| *word == before).unwrap();
        words[at + 1].parse().unwrap()
    };
    let chosen = run.stdout.lines().find(|line| line.starts_with("chosen"));
    let words: Vec<&str> = chosen.unwrap().split_whitespace().collect();
    let predicted: f64 = words[words.iter().position(|w| *w == "px,").unwrap() - 1]
        .parse()
        .unwrap();
    // The second line of the lookup's errors is in pixels.
    let measured = pixels(
        run.stdout
            .lines()
            .skip_while(|line| !line.starts_with("lookup - closed form"))
            .nth(1),
        "max",
    );
    assert!(
        (measured / predicted - 1.0).abs() < 0.06,
        "{predicted} {measured}"
    );
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn the_chart_measures_every_way_to_draw() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("new/chart");
    let run = viewer(&[
        "chart",
        "--quick",
        "--size",
        "64x36",
        "-o",
        output.to_str().unwrap(),
    ]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let csv = std::fs::read_to_string(output.join("gpu.csv")).unwrap();
    for family in [
        "undeflected",
        "\"row, linear\"",
        "\"row, Hermite\"",
        "\"row, other formats\",half floats",
        "\"row, other formats\",coefficients",
        "\"direct RK4, f32\"",
    ] {
        assert!(
            csv.lines().any(|line| line.starts_with(family)),
            "{family}: {csv}"
        );
    }
    let svg = std::fs::read_to_string(output.join("gpu.svg")).unwrap();
    assert!(svg.contains("<svg") && svg.contains("64 texels"));
    let png = image::open(output.join("gpu.png")).unwrap();
    assert!(png.width() >= 800);
}

#[test]
fn a_chart_of_no_camera_is_refused() {
    let run = viewer(&["chart", "--quick", "-r", "0.5"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
}
