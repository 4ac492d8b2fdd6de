//! `bake export`: the files of `kit/`, the options, and bad calls.

use lensbake_test_support::{Program, workspace};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));

/// The options of each generated file of the kit.
fn kit_exports() -> Vec<Vec<String>> {
    let list = fs::read_to_string(workspace().join("kit/exports.txt")).unwrap();
    let lines = list.lines().filter(|line| !line.starts_with('#'));
    lines
        .map(|line| line.split_whitespace().map(str::to_owned).collect())
        .collect()
}

/// The words that follow an option.
fn value<'a>(options: &'a [String], name: &str) -> Option<&'a str> {
    let at = options.iter().position(|option| option == name)?;
    Some(&options[at + 1])
}

#[test]
fn the_kit_is_what_the_program_writes() {
    let exports = kit_exports();
    assert!(exports.len() > 15);
    let folder = TempDir::new().unwrap();
    for mut options in exports {
        let mut files = Vec::new();
        for name in ["--output", "--data"] {
            let Some(file) = value(&options, name).map(str::to_owned) else {
                continue;
            };
            let written = folder.path().join(&file);
            fs::create_dir_all(written.parent().unwrap()).unwrap();
            let at = options.iter().position(|option| *option == file).unwrap();
            options[at] = written.to_str().unwrap().to_owned();
            files.push((file, written));
        }
        options.insert(0, "export".to_owned());
        BAKE.run(&options).succeeds();
        for (file, written) in files {
            let kept = fs::read(workspace().join("kit").join(&file)).unwrap();
            assert!(
                fs::read(written).unwrap() == kept,
                "kit/{file}: run scripts/kit.sh"
            );
        }
    }
}

#[test]
fn the_python_package_has_the_built_in_atlas() {
    let kept = fs::read(workspace().join("kit/python/lensbake/atlas.lbt")).unwrap();
    assert!(
        kept == lensbake_tables::ATLAS_BINARY,
        "copy tables/assets/atlas.lbt"
    );
}

#[test]
fn a_bad_call_says_in_one_line_what_is_wrong() {
    let folder = TempDir::new().unwrap();
    let locked = folder.path().join("no/such/folder/x.glsl");
    let locked = locked.to_str().unwrap();
    let cases: [(&[&str], &[&str]); 18] = [
        (&["--to", "glsl", "--motion", "fall"], &["--observer"]),
        (
            &["--to", "glsl", "--observer", "0.001", "--motion", "fall"],
            &["--observer", "0.01 or more"],
        ),
        (
            &["--to", "c", "--data", "x.exr"],
            &["--data", "reads no file"],
        ),
        (
            &["--to", "glsl", "--observer", "1"],
            &["--observer", "above 1"],
        ),
        (
            &["--to", "glsl", "--observer", "0.5"],
            &["--observer", "above 1"],
        ),
        (
            &["--to", "glsl", "--observer", "NaN"],
            &["--observer", "above 1"],
        ),
        (
            &["--to", "glsl", "--observer", "inf"],
            &["--observer", "infinity"],
        ),
        (
            &["--to", "glsl", "--observer", "ten"],
            &["--observer", "number"],
        ),
        (&["--to", "fortran"], &["--to", "fortran"]),
        (&["--observer", "10"], &["--to"]),
        (&["--to", "glsl", "--texels", "3"], &["--texels", "3"]),
        (
            &["--to", "glsl", "--precision", "f8"],
            &["--precision", "f8"],
        ),
        (
            &["--to", "glsl", "--function", "2fast"],
            &["--function", "letter"],
        ),
        (
            &["--to", "glsl", "--function", "a__b"],
            &["--function", "underscores"],
        ),
        (&["--to", "glsl", "--output", locked], &[locked]),
        (
            &["--to", "glsl", "--data", "table.tiff"],
            &["table.tiff", ".exr or .bin"],
        ),
        (&["--to", "shadertoy"], &["shadertoy", "--observer"]),
        (
            &["--to", "c", "--mode", "simple"],
            &["--to c", "--mode row"],
        ),
    ];
    for (options, wanted) in cases {
        let mut command = vec!["export"];
        command.extend(options);
        if !options.contains(&"--output") {
            command.extend(["--output", "-"]);
        }
        let run = BAKE.run(&command);
        assert_eq!(run.code, 2, "{options:?}: {run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{options:?}: {}", run.stderr);
        for part in wanted {
            assert!(run.stderr.contains(part), "{options:?}: {}", run.stderr);
        }
        assert_eq!(run.stdout, "");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// The error that the header of an exported text states, rad and pixels.
fn stated_errors(options: &[&str], folder: &Path) -> [f64; 2] {
    let path = folder.join("text");
    let mut command = vec!["export", "--output", path.to_str().unwrap()];
    command.extend(options);
    BAKE.run(&command).succeeds();
    let text = fs::read_to_string(&path).unwrap().replace("\n// ", " ");
    let word_before = |what: &str| {
        let line = text.lines().find(|line| line.contains(what)).unwrap();
        let before = line.split(what).next().unwrap();
        before.split_whitespace().last().unwrap().parse().unwrap()
    };
    [
        word_before(" rad on the sky"),
        word_before(" pixels of a picture"),
    ]
}

#[test]
fn the_header_states_what_texels_and_precision_cost() {
    let folder = TempDir::new().unwrap();
    let errors = |options: &[&str]| stated_errors(options, folder.path());
    let px = |options: &[&str]| errors(options)[1];
    let exact = errors(&["--to", "c"]);
    assert!(exact[0] < 7e-8 && exact[1] < 3e-5, "{exact:?}");
    let half = errors(&["--to", "c", "--precision", "f16"]);
    assert!(
        (1e-4..6e-4).contains(&half[0]) && (0.02..0.05).contains(&half[1]),
        "{half:?}"
    );
    let unorm16 = px(&["--to", "c", "--precision", "unorm16"]);
    assert!((0.005..0.02).contains(&unorm16), "{unorm16}");
    let coarse = px(&["--to", "c", "--texels", "16"]);
    assert!((0.002..0.005).contains(&coarse), "{coarse}");
    for precision in ["f32", "f16", "unorm16"] {
        let simple = px(&["--to", "glsl", "--mode", "simple", "--precision", precision]);
        assert!((0.1..0.13).contains(&simple), "{precision}: {simple}");
    }
}

#[test]
fn names_begin_with_that_of_the_function() {
    let run = BAKE
        .run(&[
            "export",
            "--to",
            "glsl",
            "--observer",
            "3",
            "--function",
            "bent",
            "--output",
            "-",
        ])
        .succeeds();
    assert!(run.stdout.contains("vec3 bent(vec3 d, vec3 hole)"));
    assert!(run.stdout.contains("const float bent_numbers[128]"));
    assert!(!run.stdout.contains("lensbake_") && !run.stdout.contains('$'));
    assert!(run.stdout.is_ascii());
}

/// A name may be a word that the program uses for itself.
#[test]
fn any_name_is_taken_as_it_is() {
    for name in [
        "FUNCTION",
        "ROW",
        "DATA_FILE",
        "lensed",
        "bend",
        "TEXEL_COUNT",
    ] {
        for language in ["glsl", "c", "osl", "three"] {
            let options = [
                "export",
                "--to",
                language,
                "--observer",
                "3",
                "--function",
                name,
                "-o",
                "-",
            ];
            let text = BAKE.run(&options).succeeds().stdout;
            assert!(
                text.contains(&format!("{name}(d, hole")),
                "{language} {name}"
            );
            assert!(
                text.contains(&format!("{name}_turned(")),
                "{language} {name}"
            );
            assert!(!text.contains('$'), "{language} {name}");
        }
    }
}

#[test]
fn no_marker_is_left_in_any_text() {
    for options in kit_exports() {
        let text = fs::read_to_string(
            workspace()
                .join("kit")
                .join(value(&options, "--output").unwrap()),
        )
        .unwrap();
        let markers = [
            "DATA",
            "RADIUS",
            "OBSERVER",
            "SCALE",
            "NUMBERS",
            "TEXEL_COUNT",
            "ROW_",
        ];
        assert!(
            !text.contains("$function") && !text.contains("$guard"),
            "{options:?}"
        );
        for marker in markers {
            let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
            let left: Vec<_> = words.filter(|word| word.starts_with(marker)).collect();
            assert!(left.is_empty(), "{options:?}: {left:?}");
        }
    }
}
