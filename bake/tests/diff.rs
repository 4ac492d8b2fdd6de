//! `bake diff`: what it prints and writes, and when it fails, for observers at rest and in motion.

use lensbake_test_support::Program;
use tempfile::TempDir;

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// The largest errors of the table against the closed form that a report states, rad.
fn largest_errors(report: &str) -> Vec<f64> {
    let lines = report
        .lines()
        .filter_map(|line| line.strip_prefix("table - closed form"));
    lines
        .map(|line| line.split_whitespace().nth(2).unwrap().parse().unwrap())
        .collect()
}

/// The numbers of each line of a CSV text behind the motion, which is in quotation marks; empty fields are left out.
fn numbers(csv: &str) -> Vec<Vec<f64>> {
    let fields = |line: &str| line.rsplit('"').next().unwrap().to_owned();
    let parsed = |line: &str| {
        fields(line)
            .split(',')
            .filter_map(|field| field.parse().ok())
            .collect()
    };
    csv.lines().skip(1).map(parsed).collect()
}

#[test]
fn diff_states_both_units_and_ends_with_1_over_budget() {
    let folder = folder();
    let (csv, plot) = (path(&folder, "d.csv"), path(&folder, "d.svg"));
    let args = ["diff", "--rays", "3000", "--csv", &csv, "--plot", &plot];
    let run = BAKE.run(&args).succeeds();
    assert_eq!(run.stdout.lines().count(), 7, "{}", run.stdout);
    let text = std::fs::read_to_string(csv).unwrap();
    assert!(text.starts_with("r,theta_rad,x,one_minus_x,lookup_rad,"));
    assert_eq!(text.lines().count(), 3001);
    assert!(std::fs::read_to_string(plot).unwrap().starts_with("<svg"));
    let missed = BAKE.run(&["diff", "--rays", "3000", "--budget", "1e-9"]);
    assert_eq!(missed.code, 1, "{missed:?}");
    assert_eq!(missed.stderr.lines().count(), 1);
}

const FALL: [&str; 5] = ["diff", "--motion", "fall", "--rays", "20000"];

#[test]
fn diff_of_observers_in_free_fall_states_three_ranges_of_radii() {
    let folder = folder();
    let (csv, plot) = (path(&folder, "d.csv"), path(&folder, "d.svg"));
    let files = ["--csv", &csv, "--plot", &plot];
    let run = BAKE.run(&[&FALL[..], &files].concat()).succeeds();
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(lines.len(), 1 + 3 * 7, "{}", run.stdout);
    for (index, name, rays) in [
        (1, "r > 1", 10_000_u32),
        (8, "0.1 <= r <= 1", 5000),
        (15, "r < 0.1", 5000),
    ] {
        let count = lines[index].strip_prefix(&format!("{name}: ")).unwrap();
        let count: u32 = count.strip_suffix(" rays").unwrap().parse().unwrap();
        assert!(count.abs_diff(rays) < 300, "{name}: {count}");
    }
    let errors = largest_errors(&run.stdout);
    let ranges = [1e-8..1e-7, 1e-7..2e-6, 2e-6..3e-5];
    for (error, range) in errors.iter().zip(ranges) {
        assert!(range.contains(error), "{errors:?}");
    }
    let drawn = std::fs::read_to_string(plot).unwrap();
    assert!(drawn.contains("0.1 &lt;= r &lt;= 1"));
    let text = std::fs::read_to_string(csv).unwrap();
    assert!(text.starts_with("motion,r,theta_rad,azimuth_rad,x,"));
    let lines = numbers(&text);
    assert_eq!(lines.len(), 20_000);
    assert!(lines.iter().all(|line| line[0] >= 0.01));
}

#[test]
fn each_range_of_radii_has_its_budget() {
    for (flag, budget, ranges) in [
        ("--budget", "1e-7", vec!["0.1 <= r <= 1"]),
        ("--budget", "1e-9", vec!["r > 1", "0.1 <= r <= 1"]),
        ("--budget-deep", "1e-6", vec!["r < 0.1"]),
        ("--budget-px", "1e-4", vec!["0.1 <= r <= 1"]),
    ] {
        let missed = BAKE.run(&[&FALL[..], &[flag, budget]].concat());
        assert_eq!(missed.code, 1, "{missed:?}");
        assert_eq!(missed.stderr.lines().count(), ranges.len(), "{missed:?}");
        for (line, range) in missed.stderr.lines().zip(ranges) {
            assert!(line.contains(&format!("for {range} is above")), "{line}");
        }
    }
}

/// 0,0.99995 has γ = 100. Against such a motion the sky is magnified 200 times, and with it the error in pixels.
#[test]
fn diff_of_observers_in_any_motion_above_the_horizon_is_as_accurate_as_at_rest() {
    let folder = folder();
    let csv = path(&folder, "d.csv");
    for (motion, budget_px) in [
        ("orbit", "0.002"),
        ("0,0.99995", "0.01"),
        ("-0.6,0.3", "0.002"),
    ] {
        let args = ["diff", "--motion", motion, "--rays", "20000"];
        let budgets = ["--budget", "1e-7", "--budget-px", budget_px];
        let run = BAKE.run(&[&args[..], &budgets, &["--csv", &csv]].concat());
        let run = run.succeeds();
        assert!(run.stdout.contains("\nr > 1: 20000 rays\n"), "{run:?}");
        assert_eq!(largest_errors(&run.stdout).len(), 1);
        check_own_directions(motion, &std::fs::read_to_string(&csv).unwrap());
    }
}

/// Asks for some of the rays again, by the view angle and the azimuth in the observer's own frame.
fn check_own_directions(motion: &str, csv: &str) {
    let mut questions = String::new();
    let mut bends = Vec::new();
    for line in numbers(csv).iter().step_by(100) {
        let [r, theta, azimuth, _, gap, _, _, closed, ..] = line[..] else {
            panic!("{line:?}");
        };
        if gap > 1e-3 && r < 1e3 {
            let (theta, azimuth) = (theta.to_degrees(), azimuth.to_degrees());
            questions += &format!("{r} {theta} {azimuth}\n");
            bends.push(closed);
        }
    }
    assert!(bends.len() > 100, "{motion}: {}", bends.len());
    let query = ["query", "--method", "exact", "--motion", motion];
    let answers = BAKE.run_with(&query, &questions).succeeds().stdout;
    assert_eq!(answers.lines().count(), bends.len());
    for ((question, answer), bend) in questions.lines().zip(answers.lines()).zip(bends) {
        let answer: f64 = answer.parse().unwrap();
        let off = (answer - bend).abs();
        assert!(off < 1e-9, "{motion}: {question}: {answer} {bend}");
    }
}

#[test]
fn motions_that_do_not_exist_are_told_in_one_line() {
    for motion in ["flal", "0.8,0.7", "1", "nan,0"] {
        BAKE.run(&["diff", "--motion", motion])
            .refuses(&["--motion", motion, "rest, fall, orbit"]);
    }
    let folder = folder();
    let file = path(&folder, "row.lbt");
    for (observer, motion, words) in [
        ("1.2", "orbit", "no circular orbit at radius 1.2"),
        ("far", "0.1,0", "an observer at infinity"),
        ("0.5", "rest", "radius 0.5 is not above the horizon"),
    ] {
        BAKE.run(&["--observer", observer, "-o", &file]).succeeds();
        BAKE.run(&["diff", &file, "--motion", motion])
            .refuses(&["--motion", motion, words]);
    }
}
