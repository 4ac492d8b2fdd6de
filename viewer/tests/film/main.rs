//! `viewer film`: the frames, how they are divided and resumed, videos, and what is refused.
#![cfg(unix)]

mod cube;
mod frames;
mod layers;
mod mistakes;
mod parts;
mod video;

use lensbake_test_support::{Program, Run};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

/// Small frames on the CPU, with a sky that is generated quickly.
const SMALL: [&str; 6] = ["--device", "cpu", "--size", "64x36", "-s", "grid"];

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn film(args: &[&str]) -> Run {
    VIEWER.run(&[&["film"], args].concat())
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A file in `folder`.
fn file(folder: &TempDir, name: &str, content: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    path
}

/// A catalogue of a few hundred stars all over the sky, some of them bright.
fn catalogue(folder: &TempDir) -> PathBuf {
    let mut random = fastrand::Rng::with_seed(7);
    let mut csv = "ra,dec,mag,bv\n".to_owned();
    for _ in 0..400 {
        let dec = (2.0 * random.f64() - 1.0).asin().to_degrees();
        let (ra, mag) = (360.0 * random.f64(), 4.0 * random.f64());
        csv += &format!("{ra},{dec},{mag},{}\n", random.f64());
    }
    file(folder, "stars.csv", &csv)
}

/// The frames in `folder` by name. What an interrupted process leaves has no such names.
fn frames(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let pictures = entries.filter(|path| path.extension().is_some());
    pictures
        .map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            (name, fs::read(path).unwrap())
        })
        .collect()
}
