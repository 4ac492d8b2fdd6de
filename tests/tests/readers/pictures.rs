//! Pictures with layers and metadata: the bits that were written, under the names that compositors look for.

use crate::programs::{READERS, RGB};
use lensbake_core::Motion;
use lensbake_render::camera::View;
use lensbake_render::cpu;
use lensbake_render::layers::{self, Channel, Layer};
use lensbake_render::lens::Deflection;
use lensbake_render::openexr::{Metadata, Value, encode};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::grid;
use lensbake_test_support::fetched;
use lensbake_tests::lens;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The channels of all layers, as a file sorts them.
const LAYERS: [&str; 9] = [
    "captured.V",
    "direction.X",
    "direction.Y",
    "direction.Z",
    "magnification.V",
    "order.V",
    "shift.V",
    "uv.U",
    "uv.V",
];

/// A picture with all layers whose width and height are no multiples of anything.
fn picture() -> (Picture, Vec<Channel>) {
    let view = View {
        radius: 6.0,
        motion: Motion::Orbit,
        yaw_deg: 10.0,
        width: 83,
        height: 47,
        ..View::default()
    };
    let lens = lens(&view, Deflection::Lut);
    let layers = layers::trace(&lens, &Layer::ALL, Sampling::Filtered, || ());
    let scene = Scene::new(lens, grid(64)).with_sampling(Sampling::Filtered);
    (cpu::render(&scene, || ()), layers)
}

fn metadata() -> Metadata {
    Metadata {
        software: "a program".to_owned(),
        comments: "two words, and a degree: 1°".to_owned(),
        attributes: vec![
            (
                "lensbake.options",
                Value::Text(r#"{"sky":["上海.exr"]}"#.to_owned()),
            ),
            ("lensbake.radius", Value::Real(0.1)),
        ],
    }
}

/// Writes the picture to `folder`.
fn written(folder: &TempDir, picture: &Picture, layers: Vec<Channel>) -> PathBuf {
    let file = folder.path().join("picture.exr");
    std::fs::write(&file, encode(picture, layers, &metadata()).unwrap()).unwrap();
    file
}

/// The bits of these planes, pixel by pixel.
fn interleaved(planes: &[&[f32]]) -> Vec<u32> {
    let pixels = 0..planes[0].len();
    pixels
        .flat_map(|pixel| planes.iter().map(move |plane| plane[pixel].to_bits()))
        .collect()
}

/// The bits of R, G and B, pixel by pixel.
fn rgb(picture: &Picture) -> Vec<u32> {
    let samples = picture.pixels().iter().flatten();
    samples.map(|sample| sample.to_bits()).collect()
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn every_reader_sees_the_picture_with_layers_beside_it_and_without() {
    let folder = TempDir::new().unwrap();
    let (picture, layers) = picture();
    for layers in [Vec::new(), layers] {
        let file = written(&folder, &picture, layers);
        for reader in READERS.iter() {
            let found = reader.read(&file, &RGB);
            let size = (found.width, found.height);
            assert_eq!(size, (picture.width(), picture.height()), "{}", reader.name);
            assert!(found.samples == rgb(&picture), "{}", reader.name);
        }
    }
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn readers_that_know_layers_see_every_bit_of_them() {
    let folder = TempDir::new().unwrap();
    let (picture, layers) = picture();
    let plane = |name: &&str| layers.iter().find(|channel| channel.name == *name).unwrap();
    let planes = LAYERS.map(|name| plane(&name).samples.as_slice());
    let expected = interleaved(&planes);
    assert!(
        planes
            .iter()
            .all(|plane| plane.iter().any(|&sample| sample != 0.0))
    );
    let file = written(&folder, &picture, layers.clone());
    let mut asked = 0;
    for reader in READERS.iter().filter(|reader| reader.knows_layers) {
        let found = reader.read(&file, &LAYERS);
        assert!(found.samples == expected, "{}", reader.name);
        asked += 1;
    }
    assert_eq!(asked, 2);
}

/// Runs OpenEXR's own library in Python on `file`, as docs/layers.md does.
fn python(code: &str, file: &Path) -> String {
    let python = fetched(env!("CARGO_TARGET_TMPDIR")).join("venv/bin/python");
    let run = Command::new(python)
        .args(["-c", code])
        .arg(file)
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    String::from_utf8(run.stdout).unwrap()
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn openexr_sees_the_names_and_the_metadata() {
    const CODE: &str = r#"
import sys
import OpenEXR
sys.stdout.reconfigure(encoding="utf-8")
with OpenEXR.File(sys.argv[1], separate_channels=True) as file:
    print(",".join(file.channels()))
    for name in ["software", "comments", "lensbake.options", "compression", "type"]:
        print(file.header()[name])
    print(float(file.header()["lensbake.radius"][0]))
"#;
    let folder = TempDir::new().unwrap();
    let (picture, layers) = picture();
    let printed = python(CODE, &written(&folder, &picture, layers));
    let expected = [
        &format!("B,G,R,{}", LAYERS.join(",")),
        "a program",
        "two words, and a degree: 1°",
        r#"{"sky":["上海.exr"]}"#,
        "Compression.ZIP_COMPRESSION",
        "Storage.scanlineimage",
        "0.1",
    ];
    assert_eq!(printed.lines().collect::<Vec<_>>(), expected);
}
