//! The code in the documents is the code of the project.

use lensbake_tests::workspace;

#[test]
fn the_cos_sin_in_use_md_is_the_one_that_the_lookup_uses() {
    let read = |path: &str| std::fs::read_to_string(workspace().join(path)).unwrap();
    let (document, source) = (read("docs/use.md"), read("tables/src/arithmetic.wgsl"));
    let start = source.find("// (cos, sin) of an angle").unwrap();
    let length = source[start..].find("\n}\n").unwrap() + 3;
    let function = &source[start..start + length];
    assert!(function.contains("fn cos_sin("), "{function}");
    assert!(
        document.contains(function),
        "docs/use.md has another:\n{function}"
    );
}
