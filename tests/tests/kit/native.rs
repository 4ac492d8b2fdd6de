//! C, and the texts in HLSL and Metal's language, which a C++ compiler takes with stand-ins for their types.

use super::rays::{Answer, Errors, RADII, Ray, rays, rows};
use super::{HINT, bytes_as, report, words_of};
use lensbake_test_support::workspace;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// Largest error of 16-bit floats, in pixels.
const HALF_BOUND: f64 = 3.0;

/// A text to run.
struct Text<'a> {
    file: &'static str,
    /// What compiles it.
    compiler: &'a [&'a str],
    call: &'static str,
    radii: &'static [f64],
    /// The table, with the number of its texels in a line; `None` for the row of each observer.
    table: Option<(&'static str, usize)>,
}

pub const C: &[&str] = &[
    "gcc",
    "-x",
    "c",
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-pedantic",
    "-DKIT_TYPES=0",
];
const CPP: &[&str] = &[
    "g++",
    "-x",
    "c++",
    "-std=c++14",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-DKIT_TYPES=0",
];
pub const HLSL: &[&str] = &["g++", "-x", "c++", "-std=c++14", "-DKIT_TYPES=1"];
const METAL: &[&str] = &[
    "g++",
    "-x",
    "c++",
    "-std=c++14",
    "-DKIT_TYPES=1",
    "-DKIT_METAL=1",
];

fn run(text: &Text) -> Errors {
    let folder = TempDir::new().unwrap();
    let file = workspace().join("kit").join(text.file);
    let mut rays = rays(text.radii);
    let (texels, width): (Vec<f32>, usize) = match text.table {
        None => (words_of(&rows(text.radii)), 64),
        Some((file, width)) => {
            for ray in &mut rays {
                ray.observer = 0.0;
            }
            (super::values_and_slopes(file), width)
        }
    };
    let answers = answers(
        text.compiler,
        &file,
        text.call,
        &rays,
        &texels,
        width,
        &folder,
    );
    Errors::of(&rays, &answers)
}

/// The answers of `text` to `rays`: compiled with the command `compiler` and `call`, and run with `texels`, `width` a line.
pub fn answers(
    compiler: &[&str],
    text: &Path,
    call: &str,
    rays: &[Ray],
    texels: &[f32],
    width: usize,
    folder: &TempDir,
) -> Vec<Answer> {
    let sources = workspace().join("tests/kit");
    let program = folder.path().join("run");
    let status = Command::new(compiler[0])
        .args(&compiler[1..])
        .args(["-O2", "-I"])
        .arg(&sources)
        .arg(format!("-DKIT_TEXT=\"{}\"", text.display()))
        .arg(format!("-DKIT_CALL={call}"))
        .args([
            Path::new("-o"),
            &program,
            &sources.join("run.cc"),
            Path::new("-lm"),
        ])
        .status()
        .unwrap_or_else(|e| panic!("{}: {e}: {HINT}", compiler[0]));
    assert!(status.success(), "{} does not compile", text.display());
    let file = |name: &str, bytes: &[u8]| -> PathBuf {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let [rays, texels, out] = [
        file("rays", bytemuck::cast_slice(rays)),
        file("texels", bytemuck::cast_slice(texels)),
        file("out", &[]),
    ];
    let status = Command::new(program)
        .args([&rays, &texels, Path::new(&width.to_string()), &out])
        .status()
        .unwrap();
    assert!(status.success());
    bytes_as(&std::fs::read(out).unwrap())
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn c() {
    let text = Text {
        file: "c/lensbake.h",
        compiler: C,
        call: "lensbake(d,hole,r,data)",
        radii: &RADII,
        table: None,
    };
    report("C99, row", run(&text), super::F32_BOUND);
    let as_cpp = Text {
        compiler: CPP,
        ..text
    };
    report("C as C++14, row", run(&as_cpp), super::F32_BOUND);
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn hlsl_and_metal() {
    let row = Text {
        file: "hlsl/lensbake.hlsl",
        compiler: HLSL,
        call: "lensbake(d,hole,r,Texture2D(data))",
        radii: &RADII,
        table: None,
    };
    let one = Text {
        file: "hlsl/lensbake_r10.hlsl",
        call: "lensbake_r10(d,hole)",
        radii: &[10.0],
        ..row
    };
    let simple = Text {
        file: "hlsl/lensbake_simple.hlsl",
        call: "lensbake_simple(d,hole,r,Texture2D(data),SamplerState())",
        radii: &RADII,
        table: Some(("tables/simple.exr", 64)),
        ..row
    };
    report("HLSL in C++, row", run(&row), super::F32_BOUND);
    report("HLSL in C++, array", run(&one), super::F32_BOUND);
    report("HLSL in C++, simple", run(&simple), super::SIMPLE_BOUND);
    let metal = |text: Text, file, call| Text {
        file,
        call,
        compiler: METAL,
        ..text
    };
    let row = metal(
        row,
        "metal/lensbake.metal",
        "lensbake(d,hole,r,metal::texture2d<float>(data))",
    );
    let one = metal(one, "metal/lensbake_r10.metal", "lensbake_r10(d,hole)");
    let simple = metal(
        simple,
        "metal/lensbake_simple.metal",
        "lensbake_simple(d,hole,r,metal::texture2d<float>(data),metal::sampler())",
    );
    report("Metal in C++, row", run(&row), super::F32_BOUND);
    report("Metal in C++, array", run(&one), super::F32_BOUND);
    report("Metal in C++, simple", run(&simple), super::SIMPLE_BOUND);
}

/// What the kit says of 16-bit floats: the picture is off by up to 3 pixels.
#[test]
#[cfg_attr(
    any(
        feature = "no-readers",
        not(target_os = "linux"),
        not(target_arch = "x86_64")
    ),
    ignore = "feature no-readers, or not Linux on x86-64"
)]
fn half_precision_costs_pixels() {
    let compiler = [
        "gcc",
        "-x",
        "c",
        "-fexcess-precision=16",
        "-DKIT_TYPES=0",
        "-DKIT_HALF=1",
    ];
    let text = Text {
        file: "c/lensbake.h",
        compiler: &compiler,
        call: "lensbake(d,hole,r,data)",
        radii: &[1000.0, 100.0, 10.0, 3.0, 1.5],
        table: None,
    };
    let errors = run(&text);
    super::print("C, 16-bit floats", errors);
    assert!(
        (0.5..HALF_BOUND).contains(&errors.pixels),
        "{} px",
        errors.pixels
    );
}
