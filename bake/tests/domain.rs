//! Questions at and beyond the limits of the domain, and budgets without rays.

use lensbake_test_support::Program;
use tempfile::TempDir;

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));
const METHODS: [&str; 3] = ["lut", "rk4", "exact"];

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

fn ask(method: &str, line: &str) -> lensbake_test_support::Run {
    BAKE.run_with(&["query", "--method", method], line)
}

#[test]
fn minus_zero_is_straight_at_the_hole() {
    for method in METHODS {
        for line in ["10 -0", "1.01 -0.0", "1e100 -0", "10 0"] {
            assert_eq!(ask(method, line).succeeds().stdout, "captured\n", "{line}");
        }
    }
}

#[test]
fn distances_too_large_to_compute_with_are_refused() {
    for method in METHODS {
        for line in ["1e162 30", "1e200 30", "inf 1e200", "1e151 90", "inf 1e308"] {
            ask(method, line).refuses(&["line 1", "1e150"]);
        }
    }
}

#[test]
fn the_three_methods_agree_to_the_end_of_the_domain() {
    let mut lines = String::new();
    for decade in (3..=150).step_by(3) {
        for angle in ["1e-9", "0.01", "30", "90", "150", "179.9999", "180"] {
            lines += &format!("1e{decade} {angle}\n");
        }
        lines += &format!("inf 1e{decade}\n");
    }
    let [lut, rk4, exact] = METHODS.map(|method| ask(method, &lines).succeeds().stdout);
    let mut compared = 0;
    for ((line, lut), (rk4, exact)) in lines
        .lines()
        .zip(lut.lines())
        .zip(rk4.lines().zip(exact.lines()))
    {
        if exact == "captured" {
            assert_eq!([lut, rk4], ["captured"; 2], "{line}");
            continue;
        }
        let [lut, rk4, exact] = [lut, rk4, exact].map(|text| text.parse::<f64>().unwrap());
        assert!((lut - exact).abs() < 1e-7, "{line}: {lut} {exact}");
        assert!((rk4 - exact).abs() < 1e-10, "{line}: {rk4} {exact}");
        compared += 1;
    }
    assert!(compared > 250, "{compared}");
}

#[test]
fn a_table_is_not_asked_beyond_its_axis() {
    let folder = tempfile::tempdir().unwrap();
    for axis in ["b", "inverse-b", "log-b"] {
        let file = path(&folder, &format!("{axis}.lbt"));
        let args = ["--axis", axis, "--b-min", "2.6", "--b-max", "100"];
        BAKE.run(&[&args[..], &["-o", &file]].concat()).succeeds();
        let ask = |line| BAKE.run_with(&["query", "--table", &file], line);
        for line in ["inf 1000", "inf 100.001", "inf 2.599"] {
            ask(line).refuses(&[&file, "2.6", "100"]);
        }
        // The ends of the axis and the shadow are within its reach.
        let run = ask("inf 2.6\ninf 100\ninf 2.5\ninf 1e-9\n").succeeds();
        let lines: Vec<_> = run.stdout.lines().collect();
        assert_eq!(lines[2..], ["captured", "captured"]);
        let last: f64 = lines[1].parse().unwrap();
        assert!((last - 0.020_299_966_239_537).abs() < 1e-6, "{last}");
    }
}

#[test]
fn a_budget_over_no_rays_is_missed() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "never.lbt");
    let narrow = [
        "--axis",
        "b",
        "--b-min",
        "2.59807621136",
        "--b-max",
        "2.5980762114",
    ];
    let bake = |more: &[&str]| BAKE.run(&[&narrow[..], &["-o", &file], more].concat());
    let run = bake(&["--budget", "1e-30"]);
    assert_eq!(run.code, 1, "{run:?}");
    assert!(run.stderr.contains("no ray"), "{run:?}");
    assert!(!std::path::Path::new(&file).exists());
    // Without a budget the table is written, with the message that its error is not known.
    let run = bake(&[]).succeeds();
    assert!(run.stderr.contains("no ray"), "{run:?}");
    let run = BAKE.run(&["inspect", &file]).succeeds();
    assert!(run.stdout.contains("measured_rays      0"), "{run:?}");
    assert!(run.stdout.contains("max_error          inf"), "{run:?}");
}
