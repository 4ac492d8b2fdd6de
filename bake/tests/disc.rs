//! `bake query --disc`: where rays cross a thin disc, by all three methods.

use lensbake_test_support::{Program, Run};

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));
const METHODS: [&str; 3] = ["exact", "rk4", "lut"];

/// A crossing as it is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Crossing {
    radius: f64,
    order: u32,
    shift: f64,
}

fn query(args: &[&str], lines: &str) -> Run {
    BAKE.run_with(&[&["query"], args].concat(), lines)
}

/// The crossings of each line.
fn crossings(args: &[&str], lines: &str) -> Vec<Vec<Crossing>> {
    let run = query(args, lines).succeeds();
    assert_eq!(run.stderr, "");
    run.stdout.lines().map(crossings_of).collect()
}

fn crossings_of(line: &str) -> Vec<Crossing> {
    if line == "-" {
        return Vec::new();
    }
    let words: Vec<&str> = line.split(' ').collect();
    assert_eq!(words.len() % 3, 0, "{line}");
    let crossing = |words: &[&str]| Crossing {
        radius: words[0].parse().unwrap(),
        order: words[1].parse().unwrap(),
        shift: words[2].parse().unwrap(),
    };
    words.chunks(3).map(crossing).collect()
}

/// Impact parameters of the images of a disc inclined by 80°, for an observer far away, in units of M = r_s/2: of the near
/// point, the side and the far point, and of the second image at the side; computed independently of this project.
const IMAGES: [(f64, [f64; 3], f64); 3] = [
    (6.0, [1.043_217, 6.932_148, 6.669_365], 5.478_914),
    (10.0, [1.737_810, 10.956_115, 8.407_115], 5.666_150),
    (20.0, [3.474_292, 20.976_651, 11.892_317], 5.865_411),
];

#[test]
fn the_images_are_where_they_are_known_to_be() {
    for (r, [near, side, far], second) in IMAGES {
        for (b, azimuth, order) in [
            (near, -90.0, 0),
            (side, 0.0, 0),
            (far, 90.0, 0),
            (second, 0.0, 1),
        ] {
            // The radius grows with b. Below 6 M the disc has ended.
            let ask = |b: f64| format!("inf {} {azimuth}\n", 0.5 * b);
            let lines = ask(b - 1e-6) + &ask(b + 1e-6);
            for method in METHODS {
                let answers = crossings(&["--disc", "--method", method], &lines);
                let radius = |index: usize| {
                    let image = answers[index].iter().find(|c| c.order == order);
                    image.map_or(6.0, |image| 2.0 * image.radius)
                };
                let (below, above) = (radius(0), radius(1));
                assert!(below <= r && r < above, "{method} {r} M: {below} {above}");
            }
        }
    }
}

/// g = √(1 − 3/(2r)) / (1 − Ω L) far away, with Ω = √(1/(2r³)) and L = b sin i on the side that comes nearer.
#[test]
fn shifts_are_those_of_matter_on_circular_orbits() {
    for (azimuth, side) in [(180.0, 1.0), (0.0, -1.0), (90.0, 0.0), (-90.0, 0.0)] {
        for (degrees, inclination) in [("0", 0.0_f64), ("60", 60.0), ("85", 85.0)] {
            for b in [4.5, 7.0, 11.0] {
                let args = ["--disc=3,100", "--inclination", degrees];
                let answers = crossings(&args, &format!("inf {b} {azimuth}"));
                for crossing in &answers[0] {
                    let r = crossing.radius;
                    let omega_l =
                        (0.5 / r.powi(3)).sqrt() * side * b * inclination.to_radians().sin();
                    let known = (1.0 - 1.5 / r).sqrt() / (1.0 - omega_l);
                    let off = crossing.shift - known;
                    assert!(
                        off.abs() < 1e-12,
                        "{inclination} {azimuth} {b}: {crossing:?} {known}"
                    );
                }
                assert!(!answers[0].is_empty(), "{inclination} {azimuth} {b}");
            }
        }
    }
}

const MOTIONS: [(&str, &[f64]); 5] = [
    ("rest", &[1.2, 2.5, 4.0, 10.0, 25.0, 1e4]),
    ("fall", &[0.05, 0.5, 1.0, 1.4, 3.5, 10.0, 100.0]),
    ("orbit", &[1.6, 3.0, 7.0, 40.0]),
    ("-0.5,0.3", &[0.7, 2.0, 6.0, 30.0]),
    ("0.2,0.9", &[0.7, 2.0, 6.0, 30.0]),
];

#[test]
fn the_three_methods_agree_in_every_motion() {
    let mut rng = fastrand::Rng::with_seed(5);
    for (motion, radii) in MOTIONS {
        let mut lines = String::new();
        for r in radii {
            for _ in 0..200 {
                // Uniform on the sphere, and for far observers near the hole.
                let cos = 1.0 - 2.0 * rng.f64();
                let theta = cos.acos().to_degrees() * (20.0 / r).min(1.0);
                lines += &format!("{r} {theta} {}\n", 360.0 * rng.f64());
            }
        }
        let [exact, rk4, lut] = METHODS.map(|method| {
            let args = [
                "--disc=3,30",
                "--inclination",
                "75",
                "--node",
                "-20",
                "--motion",
                motion,
            ];
            crossings(&[&args[..], &["--method", method]].concat(), &lines)
        });
        let mut compared = 0;
        for ((line, exact), (rk4, lut)) in lines.lines().zip(&exact).zip(rk4.iter().zip(&lut)) {
            for (other, allowed) in [(rk4, 1e-8), (lut, 1e-3)] {
                assert_eq!(
                    exact.len(),
                    other.len(),
                    "{motion} {line}: {exact:?} {other:?}"
                );
                for (exact, other) in exact.iter().zip(other) {
                    let off = (exact.radius / other.radius - 1.0).abs();
                    assert!(off < allowed, "{motion} {line}: {exact:?} {other:?}");
                    assert_eq!(exact.order, other.order, "{motion} {line}");
                    assert!(exact.shift > 0.0, "{motion} {line}: {exact:?}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 100, "{motion}: {compared}");
    }
}

/// An observer in motion sees the same crossing in the aberrated direction: tan(α/2) = tan(θ/2)/k.
#[test]
fn aberration_moves_the_image_and_keeps_the_radius() {
    let k = 2.0;
    for theta in [10.0_f64, 40.0, 140.0] {
        let moved = 2.0 * ((0.5 * theta.to_radians()).tan() / k).atan().to_degrees();
        let at_rest = crossings(&["--disc=3,100"], &format!("10 {theta} -60"));
        let moving = crossings(
            &["--disc=3,100", "--motion", "-0.6,0"],
            &format!("10 {moved} -60"),
        );
        let [[rest], [moving]] = [&at_rest[0][..], &moving[0][..]] else {
            panic!("{at_rest:?} {moving:?}");
        };
        assert!((rest.radius / moving.radius - 1.0).abs() < 1e-6);
        assert_eq!(rest.order, moving.order);
        // The Doppler factor towards the hole at the angle θ of the observer at rest.
        let cos = theta.to_radians().cos();
        let doppler = 0.5 * ((1.0 + cos) * k + (1.0 - cos) / k);
        assert!(
            (moving.shift / rest.shift - doppler).abs() < 1e-6,
            "{theta}"
        );
    }
}

/// The azimuth and the node turn together, and without an azimuth it is 0.
#[test]
fn only_the_azimuth_from_the_node_counts() {
    let first = crossings(
        &["--disc", "--node", "30"],
        "10 30 -60\n10 20 -60\ninf 5 30",
    );
    let turned = crossings(
        &["--disc", "--node=-15"],
        "10 30 -105\n10 20 -105\ninf 5 -15",
    );
    for (first, turned) in first.iter().flatten().zip(turned.iter().flatten()) {
        assert!((first.radius - turned.radius).abs() < 1e-12);
        assert!((first.shift - turned.shift).abs() < 1e-12);
    }
    assert_eq!(first.iter().map(Vec::len).collect::<Vec<_>>(), [1, 2, 1]);
    let lines = "10 28\ninf 5";
    assert_eq!(
        crossings(&["--disc"], lines),
        crossings(&["--disc"], "10 28 0\ninf 5 0")
    );
    let given = ["--disc=3,12", "--inclination", "80", "--node", "0"];
    assert_eq!(crossings(&["--disc"], lines), crossings(&given, lines));
}

#[test]
fn each_question_has_one_line_in_the_order_of_the_ray() {
    // Both crossings, no ray that meets the disc, straight at the hole, straight away; comments have none.
    let run = query(
        &["--disc"],
        "10 20 -90\n# no question\n10 90\n10 0\n\n10 180\n",
    )
    .succeeds();
    let lines: Vec<_> = run.stdout.lines().map(crossings_of).collect();
    let orders: Vec<Vec<u32>> = lines
        .iter()
        .map(|line| line.iter().map(|c| c.order).collect())
        .collect();
    assert_eq!(orders, [vec![0, 1], vec![], vec![], vec![]], "{run:?}");
}

#[test]
fn what_is_no_disc_is_refused_in_one_line() {
    for (args, words) in [
        (&["--disc=12,3"][..], &["--disc", "outer radius 3"][..]),
        (&["--disc=3,3"], &["--disc", "outer radius 3"]),
        (
            &["--disc", "2.9,12"],
            &["--disc", "inner radius 2.9 is below 3"],
        ),
        (&["--disc=NaN,12"], &["--disc", "NaN"]),
        (&["--disc=3,NaN"], &["--disc", "NaN"]),
        (&["--disc=3,inf"], &["--disc", "inf"]),
        (&["--disc=3"], &["--disc", "two radii, such as 3,12"]),
        (&["--disc=3,4,5"], &["--disc", "4,5"]),
        (
            &["--disc", "--inclination", "inf"],
            &["--inclination", "inf", "finite"],
        ),
        (
            &["--disc", "--inclination", "NaN"],
            &["--inclination", "NaN"],
        ),
        (&["--disc", "--node=-inf"], &["--node", "-inf"]),
        (&["--inclination", "80"], &["--disc"]),
        (&["--node", "0"], &["--disc"]),
        (&["--disc", "--sky"], &["--disc", "--sky"]),
    ] {
        query(args, "10 30").refuses(words);
    }
    query(&["--disc"], "10 30 inf").refuses(&["line 1", "azimuth inf"]);
}
