//! The compiled program: what it prints, what it writes, and its exit codes.

use lensbake_core::Observer;
use lensbake_tables::{ATLAS_BINARY, ATLAS_EXR, container};
use lensbake_test_support::{Damaged, Program, damaged_tables, one_row};
use tempfile::TempDir;

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// Lines `R THETA_DEG` or `inf B`, with 1 − x log-uniform from `gap` to 1, at radii from 1.01 to ∞.
fn questions(gap: f64) -> Vec<String> {
    let mut rng = fastrand::Rng::with_seed(11);
    let radii = [
        1.01, 1.1, 1.4, 1.499_999, 1.5, 1.500_001, 1.6, 2.0, 3.0, 5.0, 10.0, 25.0, 1e3, 1e6,
    ];
    let mut lines = Vec::new();
    for r in radii {
        let observer = Observer::at(r).unwrap();
        for _ in 0..150 {
            let x = 1.0 - gap.powf(rng.f64());
            lines.push(format!("{r} {}", observer.view_angle(x).to_degrees()));
        }
    }
    for _ in 0..150 {
        let x = 1.0 - gap.powf(rng.f64());
        lines.push(format!("inf {}", lensbake_core::B_CRIT / x));
    }
    lines
}

fn answers(method: &str, lines: &[String]) -> Vec<f64> {
    let run = BAKE
        .run_with(&["query", "--method", method], &lines.join("\n"))
        .succeeds();
    assert_eq!(run.stderr, "");
    run.stdout
        .lines()
        .map(|line| line.parse().unwrap())
        .collect()
}

#[test]
fn query_by_rk4_and_by_the_closed_form_agree() {
    for (gap, allowed) in [(1e-4, 1e-9), (1e-6, 1e-7)] {
        let lines = questions(gap);
        let (rk4, exact) = (answers("rk4", &lines), answers("exact", &lines));
        let lut = answers("lut", &lines);
        assert_eq!((rk4.len(), exact.len()), (lines.len(), lines.len()));
        let mut worst = 0.0_f64;
        for (i, line) in lines.iter().enumerate() {
            let off = (rk4[i] - exact[i]).abs();
            assert!(off <= allowed, "{line}: {off:e}");
            assert!(
                (lut[i] - exact[i]).abs() <= 1e-7,
                "{line}: table {}",
                lut[i]
            );
            worst = worst.max(off);
        }
        println!(
            "1 - x from {gap:e}: {} rays, at most {worst:e} rad apart",
            lines.len()
        );
    }
}

#[test]
fn query_knows_the_oracle_values() {
    let lines = [
        // The bending at the f64 nearest to 2.5981.
        ("inf 2.5981", 11.200_883_845_254_955),
        ("inf 3", 1.719_388_310_230_169),
        ("inf 1000", 0.002_002_950_587_024_579),
        ("25 30", 0.166_853_965_779_262_6),
        ("10 150", 0.029_045_012_913_274_29),
        ("1.5 91", 4.205_156_393_021_806),
        ("1.5 120", 1.007_019_464_772_651),
        ("1.05 170", 0.646_782_515_739_128_5),
    ];
    let input = lines.map(|(line, _)| line.to_owned());
    for (method, allowed) in [("exact", 1e-12), ("rk4", 1e-11), ("lut", 1e-7)] {
        for ((line, known), answer) in lines.iter().zip(answers(method, &input)) {
            assert!(
                (answer - known).abs() < allowed,
                "{method}, {line}: {answer}"
            );
        }
    }
}

#[test]
fn query_says_captured_and_prints_seventeen_digits() {
    let run = BAKE
        .run_with(&["query"], "10 5\n# a comment\n\ninf 2\n1.2 90\ninf 10\n")
        .succeeds();
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(&lines[..3], ["captured"; 3]);
    let digits = lines[3].split('e').next().unwrap().replace('.', "");
    assert_eq!(digits.len(), 17, "{}", lines[3]);
}

#[test]
fn invalid_questions_name_their_line() {
    for (input, word) in [
        ("10 30\n1 40", "greater than 1"),
        ("10 30\n10 181", "0 to 180"),
        ("10 30\n10 x", "'x' is not a number"),
        ("10 30\n10", "R THETA_DEG"),
        ("10 30\ninf -2", "impact parameter"),
        ("10 30\nnan 30", "greater than 1"),
    ] {
        let run = BAKE.run_with(&["query"], input);
        assert_eq!(run.code, 2, "{run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
        assert!(
            run.stderr.contains("line 2") && run.stderr.contains(word),
            "{run:?}"
        );
        assert_eq!(
            run.stdout.lines().count(),
            1,
            "the first answer stands: {run:?}"
        );
    }
}

#[test]
fn bake_writes_the_same_bytes_for_any_number_of_threads_and_both_containers() {
    let folder = folder();
    let bake = |threads: &str, name: &str| {
        let file = path(&folder, name);
        let run = BAKE.run(&["--threads", threads, "-o", &file]).succeeds();
        assert!(run.stdout.is_empty(), "{run:?}");
        assert!(
            run.stderr.contains("baked 192 x 64 texels (96.0 KiB) in"),
            "{run:?}"
        );
        std::fs::read(file).unwrap()
    };
    let one = bake("1", "one.lbt");
    assert_eq!(one, bake("3", "three.lbt"));
    assert_eq!(bake("2", "two.exr"), bake("1", "one.exr"));
    // Convert to the other container and back.
    let (exr, back) = (path(&folder, "a.exr"), path(&folder, "b.lbt"));
    BAKE.run(&["convert", &path(&folder, "one.lbt"), &exr])
        .succeeds();
    BAKE.run(&["convert", &exr, &back]).succeeds();
    assert_eq!(std::fs::read(back).unwrap(), one);
}

#[test]
fn convert_keeps_a_solver_name_of_any_letters() {
    let folder = folder();
    let [from, exr, back] = ["a.lbt", "a.exr", "b.lbt"].map(|name| path(&folder, name));
    for name in ["метод", "Störmer", "", "a\0\"b\"\n"] {
        let table = one_row(10.0);
        let mut header = table.header().clone();
        header.solver.name = name.to_owned();
        lensbake_test_support::write_table(&from, &table.with_header(header).unwrap());
        BAKE.run(&["convert", &from, &exr]).succeeds();
        BAKE.run(&["convert", &exr, &back]).succeeds();
        assert_eq!(std::fs::read(&from).unwrap(), std::fs::read(&back).unwrap());
    }
    // Control characters are shown escaped.
    let shown = BAKE.run(&["inspect", &exr]).succeeds().stdout;
    assert!(
        shown.contains("\nsolver             a\\0\"b\"\\n\n"),
        "{shown}"
    );
}

#[test]
fn the_exr_table_opens_as_a_picture() {
    let picture = image::load_from_memory(ATLAS_EXR).unwrap().into_rgb32f();
    assert_eq!(picture.dimensions(), (64, 192));
    let table = container::from_bytes(ATLAS_BINARY).unwrap();
    for (pixel, texel) in picture.pixels().zip(table.texels()) {
        assert_eq!([pixel.0[0], pixel.0[1]], *texel);
    }
}

#[test]
fn inspect_shows_the_header() {
    let folder = folder();
    let file = path(&folder, "far.exr");
    let args = [
        "--observer",
        "far",
        "--axis",
        "log-b",
        "--texels",
        "256",
        "-o",
        &file,
    ];
    BAKE.run(&args).succeeds();
    let run = BAKE.run(&["inspect", &file]).succeeds();
    for line in [
        "axis               log-b",
        "texels             256",
        "inverse_radius     0",
    ] {
        assert!(run.stdout.contains(line), "{}", run.stdout);
    }
}

#[test]
fn a_table_above_its_budget_is_not_written() {
    let folder = folder();
    let missed = BAKE.run(&["--budget", "1e-12", "-o", &path(&folder, "never.lbt")]);
    assert_eq!(missed.code, 1, "{missed:?}");
    assert!(!folder.path().join("never.lbt").exists());
}

#[test]
fn damaged_binary_tables_are_refused_in_one_line() {
    let folder = folder();
    for Damaged { name, bytes, words } in damaged_tables() {
        let file = path(&folder, name);
        std::fs::write(&file, bytes).unwrap();
        let words = [words, &[file.as_str()]].concat();
        BAKE.run(&["inspect", &file]).refuses(&words);
        BAKE.run_with(&["query", "--table", &file], "10 30")
            .refuses(&words);
    }
}

#[test]
fn every_flipped_bit_of_a_table_is_noticed() {
    let mut noticed = 0;
    for (bytes, stride) in [(ATLAS_BINARY, 211), (ATLAS_EXR, 97)] {
        let table = container::from_bytes(bytes).unwrap();
        for at in (0..bytes.len()).step_by(stride) {
            let mut damaged = bytes.to_vec();
            damaged[at] ^= 1 << (at % 8);
            // A bit without meaning (padding, a channel that is not read) may change unnoticed, but then the table
            // is the same.
            match container::from_bytes(&damaged) {
                Err(_) => noticed += 1,
                Ok(read) => assert!(read == table, "byte {at} changed the table unnoticed"),
            }
        }
    }
    assert!(noticed > 600, "{noticed}");
}

#[test]
fn damaged_exr_tables_are_refused_in_one_line() {
    let folder = folder();
    let picture = path(&folder, "picture.exr");
    image::Rgb32FImage::new(64, 128).save(&picture).unwrap();
    BAKE.run(&["inspect", &picture])
        .refuses(&[&picture, "no attribute 'lensbake."]);
    let truncated = path(&folder, "truncated.exr");
    std::fs::write(&truncated, &ATLAS_EXR[..ATLAS_EXR.len() / 2]).unwrap();
    BAKE.run(&["inspect", &truncated]).refuses(&[&truncated]);
    // A data window of two billion lines.
    let mut absurd = ATLAS_EXR.to_vec();
    let window = absurd
        .windows(11)
        .position(|w| w == b"dataWindow\0")
        .unwrap();
    let bottom = window + 11 + b"box2i\0".len() + 4 + 12;
    absurd[bottom..bottom + 4].copy_from_slice(&0x7fff_fff0_u32.to_le_bytes());
    let file = path(&folder, "absurd.exr");
    std::fs::write(&file, absurd).unwrap();
    BAKE.run(&["inspect", &file]).refuses(&[&file]);
}

#[test]
fn files_that_are_not_there_or_cannot_be_written_are_named() {
    let folder = folder();
    let missing = path(&folder, "missing.lbt");
    BAKE.run(&["inspect", &missing])
        .refuses(&[&missing, "No such file"]);
    let nowhere = path(&folder, "no/such/folder/a.lbt");
    BAKE.run(&["-o", &nowhere])
        .refuses(&[&nowhere, "does not exist"]);
    BAKE.run(&["-o", "atlas.txt"])
        .refuses(&["atlas.txt", ".lbt"]);
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 0, "something was left behind");
}

#[test]
fn a_row_for_one_observer_refuses_another() {
    let folder = folder();
    let file = path(&folder, "r10.lbt");
    BAKE.run(&["--observer", "10", "-o", &file]).succeeds();
    let table = ["query", "--table", &file];
    BAKE.run_with(&table, "10 30").succeeds();
    BAKE.run_with(&table, "11 30")
        .refuses(&[&file, "r = 10 only, not at r = 11"]);
}

#[test]
fn typos_are_told_with_a_hint() {
    for (args, word) in [
        (["--observer", "1e-7"], "1e-6 to infinity"),
        (["--tolerance", "2"], "1e-13 to 1e-2"),
    ] {
        BAKE.run(&args).refuses(&[args[0], word]);
    }
    let run = BAKE.run(&["inspekt"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(run.stderr.contains("inspect"), "{run:?}");
}
