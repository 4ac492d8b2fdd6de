//! Texts for one observer in free fall, above the horizon and below, which the kit does not contain.

use super::native::{C, HLSL, answers};
use super::rays::{Answer, Errors, Ray, in_fall, rays_of};
use super::{F32_BOUND, HINT, bytes_as, report};
use bake::export::{Language, Mode, Precision, Request, export};
use lensbake_core::Observer;
use lensbake_test_support::fetched;
use lensbake_tests::gpu;
use lensbake_tests::probe::{Bindings, probe_with};
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

const RADII: [f64; 5] = [10.0, 3.0, 1.0, 0.5, 0.1];
/// Largest error in image space, in pixels. Below the horizon a pixel straight away from the hole covers little of the sky,
/// so that single precision is off by more than elsewhere.
const BOUND: f64 = 1.5e-3;

/// The text for the observer in free fall at `radius`.
fn text(language: Language, radius: f64) -> String {
    let request = Request {
        language,
        observer: Some(Observer::falling(radius).unwrap()),
        mode: Mode::Row,
        texels: 64,
        precision: Precision::F32,
        function: "lensbake".to_owned(),
        data: None,
        flip: false,
    };
    export(&request).unwrap().text
}

fn check(
    name: &str,
    language: Language,
    radii: &[f64],
    bound: f64,
    run: impl Fn(&Path, &[Ray], &TempDir) -> Vec<Answer>,
) {
    for &radius in radii {
        let folder = TempDir::new().unwrap();
        let path = folder
            .path()
            .join(format!("lensbake.{}", language.extension()));
        std::fs::write(&path, text(language, radius)).unwrap();
        let rays = rays_of(&[radius], in_fall);
        let answers = run(&path, &rays, &folder);
        report(
            &format!("{name}, fall, r = {radius}"),
            Errors::of_moving(&rays, &answers, in_fall),
            bound,
        );
    }
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn hlsl_in_cpp() {
    check(
        "HLSL in C++",
        Language::Hlsl,
        &RADII,
        BOUND,
        |path, rays, folder| answers(HLSL, path, "lensbake(d,hole)", rays, &[], 1, folder),
    );
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn c() {
    let options = [C, &["-DKIT_ONE=1"]].concat();
    check("C99", Language::C, &RADII, BOUND, |path, rays, folder| {
        answers(&options, path, "lensbake(d,hole)", rays, &[], 1, folder)
    });
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn wgsl() {
    let gpu = gpu();
    // A software GPU takes seconds to compile each of them.
    check(
        "WGSL",
        Language::Wgsl,
        &[3.0, 0.5],
        BOUND,
        |path, rays, _| {
            let source = std::fs::read_to_string(path).unwrap()
                + &super::wgsl::PROBE.replace("CALL", "lensbake(d, hole)");
            let bindings = Bindings {
                questions: 0,
                answers: 1,
            };
            probe_with(&gpu, source, bindings, rays, &[])
        },
    );
}

/// Answers rays with the module beside it.
const SCRIPT: &str = "
import sys, numpy as np, lensbake
rays = np.fromfile(sys.argv[1], dtype='<f4').reshape(-1, 8).astype(float)
seen = [lensbake.lensbake(ray[1:4], ray[4:7]) for ray in rays]
np.nan_to_num(np.array(seen)).astype('<f4').tofile(sys.argv[2])
";

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn python() {
    check(
        "Python",
        Language::Python,
        &RADII,
        F32_BOUND,
        |_, rays, folder| {
            let [input, output] = ["rays", "out"].map(|name| folder.path().join(name));
            std::fs::write(&input, bytemuck::cast_slice(rays)).unwrap();
            let status = Command::new(fetched(env!("CARGO_TARGET_TMPDIR")).join("venv/bin/python"))
                .current_dir(folder.path())
                .args(["-W", "error", "-c", SCRIPT])
                .args([&input, &output])
                .status()
                .unwrap();
            assert!(status.success(), "{HINT}");
            bytes_as(&std::fs::read(output).unwrap())
        },
    );
}
