//! `bake query --motion`: known values, by all three methods.

use lensbake_test_support::Program;

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));
const METHODS: [(&str, f64); 3] = [("exact", 1e-13), ("rk4", 1e-11), ("lut", 2e-6)];

/// The answers to `lines`: their numbers, none for a captured ray.
fn ask(method: &str, motion: &str, more: &[&str], lines: &str) -> Vec<Vec<f64>> {
    let args = ["query", "--method", method, "--motion", motion];
    let run = BAKE.run_with(&[&args[..], more].concat(), lines).succeeds();
    let numbers = |line: &str| {
        line.split(' ')
            .filter(|word| *word != "captured")
            .map(|word| word.parse().unwrap())
            .collect()
    };
    run.stdout.lines().map(numbers).collect()
}

/// θ_sky of the observer in free fall, rad, computed independently of this project.
const FALL: [(&str, f64); 6] = [
    ("1 90", 2.095_934_186_715_96),
    ("1 150", 2.872_836_912_436_42),
    ("0.5 60", 0.637_155_722_699_676),
    ("0.5 90", 2.199_610_059_431_48),
    ("0.1 90", 2.442_960_622_626_93),
    ("3 150", 2.803_460_309_541_40),
];

#[test]
fn the_falling_observer_sees_the_known_sky() {
    let lines = FALL.map(|(line, _)| line).join("\n");
    for (method, allowed) in METHODS {
        let skies = ask(method, "fall", &["--sky"], &lines);
        let bends = ask(method, "fall", &[], &lines);
        assert_eq!((skies.len(), bends.len()), (6, 6));
        for (((line, known), sky), bend) in FALL.iter().zip(skies).zip(bends) {
            assert!((sky[0] - known).abs() < allowed, "{method} {line}: {sky:?}");
            assert_eq!(sky[1], 0.0, "{method} {line}");
            let theta: f64 = line.split(' ').nth(1).unwrap().parse().unwrap();
            let off = bend[0] - (theta.to_radians() - sky[0]);
            assert!(off.abs() < 1e-14, "{method} {line}: {bend:?}");
        }
    }
}

#[test]
fn shifts_are_the_known_ones() {
    let root_half = 0.5_f64.sqrt();
    for (motion, line, known) in [
        ("fall", "1 42.103449", 31.0 / 8.0),
        ("fall", "1 180", 0.5),
        ("fall", "0.2 90", 1.0),
        ("orbit", "3 90 0", 3.0 * root_half),
        ("orbit", "3 90 180", root_half),
        ("rest", "2 120", 2.0_f64.sqrt()),
    ] {
        for (method, _) in METHODS {
            let [answer] = &ask(method, motion, &["--sky"], line)[..] else {
                panic!("{line}");
            };
            // The view angle of the shadow boundary is known to 1e-6 degrees.
            let allowed = if line.starts_with("1 4") { 1e-6 } else { 1e-9 };
            assert!(
                (answer[2] - known).abs() < allowed,
                "{motion} {line}: {answer:?}"
            );
        }
    }
}

#[test]
fn nothing_comes_from_within_the_shadow_of_the_falling_observer() {
    // Just within the shadow boundary, straight at the hole, and light of no energy at infinity and less.
    let lines = "1 42.1034\n0.5 53.27\n0.1 0\n0.25 60\n0.25 20\n0.01 80";
    for (method, _) in METHODS {
        let answers = ask(method, "fall", &["--sky"], lines);
        assert_eq!(answers, vec![Vec::<f64>::new(); 6], "{method}");
    }
}
