//! Python: the package, and a text for one observer.

use super::rays::{Errors, RADII, rays};
use super::{F32_BOUND, bytes_as, report};
use lensbake_test_support::{fetched, workspace};
use std::process::Command;
use tempfile::TempDir;

/// Answers rays with the package in double precision.
const PACKAGE: &str = "
import sys, numpy as np, lensbake
rays = np.fromfile(sys.argv[1], dtype='<f4').reshape(-1, 8).astype(float)
out = np.zeros((len(rays), 3))
d, hole = (v / np.linalg.norm(v, axis=1, keepdims=True) for v in (rays[:, 1:4], rays[:, 4:7]))
across = np.cross(hole, np.cross(d, hole))
c, p = np.sum(d * hole, axis=1), np.linalg.norm(np.cross(d, hole), axis=1)
across /= np.linalg.norm(across, axis=1, keepdims=True)
for r in np.unique(rays[:, 0]):
    these = rays[:, 0] == r
    turn = np.arctan2(p[these], c[these])
    sky = turn - lensbake.bend(r, turn)
    seen = np.cos(sky)[:, None] * hole[these] + np.sin(sky)[:, None] * across[these]
    out[these] = np.nan_to_num(seen)
out.astype('<f4').tofile(sys.argv[2])
";

/// The same with the module for one observer.
const ONE: &str = "
import sys, numpy as np, lensbake_r10
rays = np.fromfile(sys.argv[1], dtype='<f4').reshape(-1, 8).astype(float)
seen = [lensbake_r10.lensbake_r10(ray[1:4], ray[4:7]) for ray in rays]
np.nan_to_num(np.array(seen)).astype('<f4').tofile(sys.argv[2])
";

fn answer(script: &str, path: &str, radii: &[f64]) -> Errors {
    let folder = TempDir::new().unwrap();
    let rays = rays(radii);
    let [input, output] = ["rays", "out"].map(|name| folder.path().join(name));
    std::fs::write(&input, bytemuck::cast_slice(&rays)).unwrap();
    let status = Command::new(fetched(env!("CARGO_TARGET_TMPDIR")).join("venv/bin/python"))
        .env("PYTHONPATH", workspace().join(path))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-W", "error", "-c", script])
        .args([&input, &output])
        .status()
        .unwrap();
    assert!(status.success());
    Errors::of(&rays, &bytes_as(&std::fs::read(output).unwrap()))
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn package() {
    report(
        "Python, package",
        answer(PACKAGE, "kit/python", &RADII),
        F32_BOUND,
    );
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn one_observer() {
    report(
        "Python, array",
        answer(ONE, "kit/python", &[10.0]),
        F32_BOUND,
    );
}

/// The package's own tests: its files, damaged ones, moving observers.
#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn the_package_passes_its_tests() {
    let output = Command::new(fetched(env!("CARGO_TARGET_TMPDIR")).join("venv/bin/python"))
        .current_dir(workspace().join("kit/python"))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-W", "error", "-m", "unittest", "discover", "-s", "tests"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && !said.contains("skipped"),
        "{said}"
    );
}
