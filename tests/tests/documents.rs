//! The documents agree with the project.

use lensbake_core::{Observer, RayOutcome, exact};
use lensbake_tables::{Axis, default_atlas};
use lensbake_test_support::workspace;
use std::collections::BTreeSet;
use std::fs;

fn read(path: &str) -> String {
    fs::read_to_string(workspace().join(path)).unwrap()
}

/// The function in `source` that begins with `start`.
fn function<'a>(source: &'a str, start: &str) -> &'a str {
    let start = source.find(start).unwrap();
    let length = source[start..].find("\n}\n").unwrap() + 3;
    &source[start..start + length]
}

#[test]
fn the_functions_in_use_md_are_those_of_the_shaders_and_the_kit() {
    let document = read("docs/use.md");
    for (file, start) in [
        (
            "tables/src/wgsl/arithmetic.wgsl",
            "// (cos, sin) of an angle",
        ),
        ("kit/wgsl/lensbake.wgsl", "fn lensbake_bend("),
        ("kit/c/lensbake.h", "static inline void lensbake_row("),
    ] {
        let source = read(file);
        let function = function(&source, start);
        assert!(
            document.contains(function),
            "docs/use.md has another:\n{function}"
        );
    }
}

/// An observer of the test vectors, and the direction: a view angle in degrees, or x for the observer at infinity.
enum Direction {
    Degrees(f64),
    X(f64),
}

/// A line of the table of test vectors in use.md.
fn test_vector(r: f64, falls: bool, direction: Direction) -> String {
    let observer = match falls {
        true => Observer::falling(r).unwrap(),
        false => Observer::at(r).unwrap(),
    };
    let (theta, at) = match direction {
        Direction::Degrees(degrees) => {
            let at = observer.shadow_coordinate(degrees.to_radians());
            (format!("{degrees}°"), at)
        }
        Direction::X(x) => {
            let at = lensbake_core::ShadowCoordinate {
                x,
                one_minus_x: 1.0 - x,
            };
            ("–".to_owned(), at)
        }
    };
    let row = default_atlas().row(observer.in_row_frame()).unwrap();
    let RayOutcome::Escapes(bend) = row.bend(at) else {
        panic!("captured")
    };
    let closed = exact::bend(&observer.in_row_frame().ray_at(at))
        .escaped()
        .unwrap();
    let axis = Axis::Residual.of(&observer);
    let (weight, d) = (
        axis.log_weight(&observer),
        axis.row_coordinate(&observer, at).one_minus_x,
    );
    let stored = bend + (1.0 + weight * d) * d.ln();
    let (name, motion) = (
        if r.is_infinite() {
            "∞".to_owned()
        } else {
            r.to_string()
        },
        if falls { "fall" } else { "rest" },
    );
    format!(
        "| {name} | {motion} | {theta} | {:.12} | {weight:.12} | {:.12} | {stored:.10} | {bend:.10} | {closed:.10} |",
        observer.tan_half_shadow(),
        at.x,
    )
}

#[test]
fn the_test_vectors_in_use_md_are_those_of_the_library() {
    use Direction::{Degrees, X};
    let vectors = [
        test_vector(f64::INFINITY, false, X(0.5)),
        test_vector(f64::INFINITY, false, X(0.99)),
        test_vector(1000.0, false, Degrees(1.0)),
        test_vector(10.0, false, Degrees(30.0)),
        test_vector(3.0, false, Degrees(90.0)),
        test_vector(1.5, false, Degrees(100.0)),
        test_vector(1.2, false, Degrees(150.0)),
        test_vector(1.0001, false, Degrees(179.0)),
        test_vector(1.0, true, Degrees(90.0)),
        test_vector(0.5, true, Degrees(60.0)),
    ];
    let table = vectors.join("\n");
    assert!(
        read("docs/use.md").contains(&table),
        "docs/use.md must have\n{table}"
    );
}

/// The packages that are drawn in docs/architecture.md: those below the tests.
const PACKAGES: [&str; 10] = [
    "core",
    "tables",
    "render",
    "film",
    "interactive",
    "studies",
    "program",
    "bake",
    "viewer",
    "web",
];

#[test]
fn the_arrows_in_architecture_md_are_those_of_the_manifests() {
    let mut of_manifests = BTreeSet::new();
    for from in PACKAGES {
        let manifest = read(&format!("{from}/Cargo.toml"));
        // Those of the web page are for one target only.
        let dependencies = manifest.split("dependencies]").nth(1).unwrap();
        let dependencies = dependencies.split("\n[").next().unwrap();
        let names = dependencies.lines().filter_map(|line| {
            let name = line.split(['.', ' ', '=']).next()?;
            Some(name.strip_prefix("lensbake-").unwrap_or(name).to_owned())
        });
        let names = names.filter(|name| PACKAGES.contains(&name.as_str()));
        of_manifests.extend(names.map(|to| (from.to_owned(), to)));
    }
    let document = read("docs/architecture.md");
    let drawn: BTreeSet<_> = document
        .lines()
        .filter_map(|line| line.trim().split_once(" --> "))
        .map(|(from, to)| (from.to_owned(), to.to_owned()))
        .collect();
    assert_eq!(drawn, of_manifests);
}

/// Every file that architecture.md names exists.
#[test]
fn the_files_in_architecture_md_exist() {
    let document = read("docs/architecture.md");
    let mut found = 0;
    for name in document.split('`').skip(1).step_by(2) {
        let is_path = name.contains('/') && !name.contains(['#', ' ', '*']);
        if is_path && !name.starts_with("//") {
            assert!(workspace().join(name).exists(), "{name}");
            found += 1;
        }
    }
    assert!(found > 30, "{found}");
}
