//! The documents agree with the project.

use lensbake_test_support::workspace;
use std::collections::BTreeSet;
use std::fs;

fn read(path: &str) -> String {
    fs::read_to_string(workspace().join(path)).unwrap()
}

#[test]
fn the_cos_sin_in_use_md_is_the_one_that_the_lookup_uses() {
    let (document, source) = (read("docs/use.md"), read("tables/src/wgsl/arithmetic.wgsl"));
    let start = source.find("// (cos, sin) of an angle").unwrap();
    let length = source[start..].find("\n}\n").unwrap() + 3;
    let function = &source[start..start + length];
    assert!(function.contains("fn cos_sin("), "{function}");
    assert!(
        document.contains(function),
        "docs/use.md has another:\n{function}"
    );
}

/// The packages that are drawn in docs/architecture.md: those below the tests.
const PACKAGES: [&str; 7] = [
    "core", "tables", "render", "studies", "program", "bake", "viewer",
];

#[test]
fn the_arrows_in_architecture_md_are_those_of_the_manifests() {
    let mut of_manifests = BTreeSet::new();
    for from in PACKAGES {
        let manifest = read(&format!("{from}/Cargo.toml"));
        let dependencies = manifest.split("[dependencies]").nth(1).unwrap();
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
