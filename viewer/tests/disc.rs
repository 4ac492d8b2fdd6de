//! `--disc`: which discs there can be, and that their pictures can be drawn again.

use lensbake_test_support::Program;
use std::path::Path;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

/// A small picture on the CPU, with a sky that is generated quickly, in which the default disc is large.
const RENDER: [&str; 8] = [
    "render", "-d", "cpu", "--size", "48x27", "-s", "grid", "-r20",
];

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// Draws to the file `out` with these options; returns its bytes.
#[track_caller]
fn draw(options: &[&str], out: &str) -> Vec<u8> {
    VIEWER
        .run(&[&RENDER, options, &["-o", out]].concat())
        .succeeds();
    std::fs::read(out).unwrap()
}

/// The window's flags are checked before there is a window: these need no screen.
#[test]
fn impossible_discs_are_refused_by_the_name_of_their_flag() {
    let folder = tempfile::tempdir().unwrap();
    let frames = path(&folder, "%d.png");
    let cases: &[(&[&str], &[&str])] = &[
        (&["--disc", "12,3"], &["--disc", "outer radius 3"]),
        (&["--disc", "3,3"], &["--disc", "outer radius 3"]),
        (&["--disc", "2,9"], &["--disc", "inner radius 2", "below 3"]),
        (&["--disc", "1.4,9"], &["--disc", "inner radius 1.4"]),
        (&["--disc=-3,9"], &["--disc", "inner radius -3"]),
        (&["--disc", "nan,9"], &["--disc", "NaN"]),
        (&["--disc", "3,nan"], &["--disc", "NaN"]),
        (&["--disc", "3,inf"], &["--disc", "inf"]),
        (&["--disc", "3,1e7"], &["--disc", "at most 1e6"]),
        (&["--disc", "3"], &["--disc", "like 3,12"]),
        (&["--disc", "3,9,12"], &["--disc", "like 3,12"]),
        (&["--disc", "thin"], &["--disc", "thin", "like 3,12"]),
        (&["--disc="], &["--disc", "like 3,12"]),
        (
            &["--disc", "--inclination", "nan"],
            &["--inclination", "NaN"],
        ),
        (&["--disc", "--node=-inf"], &["--node", "-inf"]),
        (
            &["--disc", "--disc-opacity", "1.5"],
            &["--disc-opacity", "1.5", "0 to 1"],
        ),
        (
            &["--disc", "--disc-opacity", "-1"],
            &["--disc-opacity", "-1"],
        ),
        (
            &["--disc", "--disc-temperature", "-5000"],
            &["--disc-temperature", "-5000", "1000 to 40000"],
        ),
        (
            &["--disc", "--disc-brightness", "inf"],
            &["--disc-brightness", "inf"],
        ),
        (
            &["--disc", "--disc-shift", "red"],
            &["--disc-shift", "colour"],
        ),
        (&["--inclination", "30"], &["--inclination", "add --disc"]),
        (&["--node", "0"], &["--node", "add --disc"]),
        (&["--disc-opacity", "1"], &["--disc-opacity", "add --disc"]),
        (
            &["--disc-temperature", "5000"],
            &["--disc-temperature", "add --disc"],
        ),
        (
            &["--disc-brightness", "1"],
            &["--disc-brightness", "add --disc"],
        ),
        (&["--disc-shift", "off"], &["--disc-shift", "add --disc"]),
    ];
    for (options, words) in cases {
        VIEWER.run(options).refuses(words);
        for command in [&["render", "-d", "cpu"][..], &["film", "--path", "fall"]] {
            let args = [command, options, &["-o", &frames]].concat();
            VIEWER.run(&args).refuses(words);
        }
    }
    assert!(!Path::new(&frames).exists());
    // The path is not taken for the radii in silence.
    VIEWER
        .run(&["film", "--disc", "my-path.json", "-o", &frames])
        .refuses(&["--disc", "my-path.json", "name both where a file follows"]);
    // What `diff` measures does not depend on a disc.
    VIEWER.run(&["diff", "--disc"]).refuses(&["--disc"]);
}

/// `--disc` without a value may stand anywhere before another option.
#[test]
fn a_disc_without_radii_is_the_default_one() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder, "a.exr");
    let default = draw(&["--disc"], &out);
    for same in [
        &["--disc", "3,12"][..],
        &["--disc=3,12"],
        &["--inclination", "80", "--disc", "--disc-shift", "colour"],
    ] {
        assert!(draw(same, &out) == default, "{same:?}");
    }
    for other in [&["--disc", "3,11"][..], &["--disc", "--node", "20"]] {
        assert!(draw(other, &out) != default, "{other:?}");
    }
}

#[test]
fn what_is_given_beside_a_picture_with_a_disc_changes_its_disc() {
    let folder = tempfile::tempdir().unwrap();
    let (first, like, wanted) = (
        path(&folder, "a.exr"),
        path(&folder, "b.exr"),
        path(&folder, "c.exr"),
    );
    draw(&["--disc", "4,9", "--inclination", "60"], &first);
    for (given, whole) in [
        (
            &["--inclination", "20"][..],
            &["--disc", "4,9", "--inclination", "20"][..],
        ),
        (&["--disc"], &["--disc", "--inclination", "60"]),
        (
            &["--disc-opacity", "0.5", "--hole", "40,10"],
            &[
                "--disc",
                "4,9",
                "--inclination",
                "60",
                "--disc-opacity",
                "0.5",
                "--hole",
                "40,10",
            ],
        ),
    ] {
        let args = [&["render", "--like", &first, "-o", &like], given].concat();
        VIEWER.run(&args).succeeds();
        let like = std::fs::read(&like).unwrap();
        assert!(like == draw(whole, &wanted), "{given:?}");
    }
    // Without a recorded disc, its options still need one.
    draw(&[], &first);
    VIEWER
        .run(&["render", "--like", &first, "-o", &like, "--node", "3"])
        .refuses(&["--node", "add --disc"]);
}

#[test]
fn the_header_of_a_picture_describes_its_disc() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder, "a.exr");
    let header = |options: &[&str]| String::from_utf8_lossy(&draw(options, &out)).into_owned();
    let with = header(&["--disc", "3,7.5", "--hole", "40,10"]);
    for words in [
        "lensbake.disc",
        "r = 3 to 7.5 Schwarzschild radii",
        "inclination 80° and node 0° from orbit 40°, latitude -10°",
    ] {
        assert!(with.contains(words), "{words}");
    }
    assert!(!header(&[]).contains("disc"));
}
