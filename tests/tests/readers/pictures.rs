//! Pictures with layers and metadata: the bits that were written, under the names that compositors look for.

use crate::programs::{READERS, RGB};
use lensbake_core::Motion;
use lensbake_render::camera::View;
use lensbake_render::cpu;
use lensbake_render::disc::Disc;
use lensbake_render::layers::{self, Channel, Layer};
use lensbake_render::lens::Deflection;
use lensbake_render::openexr::{Metadata, Value, encode};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::{self, SkySource, grid};
use lensbake_test_support::{fetched, workspace};
use lensbake_tests::lens;
use std::f32::consts::TAU;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The channels of all layers, as a file sorts them.
const LAYERS: [&str; 13] = [
    "captured.V",
    "direction.X",
    "direction.Y",
    "direction.Z",
    "disc_alpha.V",
    "disc_order.V",
    "disc_radius.V",
    "disc_shift.V",
    "magnification.V",
    "order.V",
    "shift.V",
    "uv.U",
    "uv.V",
];

/// A view whose width and height are no multiples of anything.
fn view() -> View {
    View {
        radius: 6.0,
        motion: Motion::Orbit,
        yaw_deg: 10.0,
        width: 83,
        height: 47,
        ..View::default()
    }
}

/// A picture with all layers.
fn picture() -> (Picture, Vec<Channel>) {
    let lens = lens(&view(), Deflection::Lut);
    let disc = Disc::default();
    let layers = layers::trace(&lens, &Layer::ALL, Sampling::Filtered, Some(disc), || ());
    let scene = Scene {
        disc: Some(disc),
        ..Scene::new(lens, grid(64)).with_sampling(Sampling::Filtered)
    };
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

/// Runs Python `code`, which uses OpenEXR's own library, in `folder`.
fn python(code: &str, folder: &Path) -> String {
    let python = fetched(env!("CARGO_TARGET_TMPDIR")).join("venv/bin/python");
    let run = Command::new(python)
        .args(["-c", code])
        .env("PYTHONIOENCODING", "utf-8")
        .current_dir(folder)
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{stderr}");
    String::from_utf8(run.stdout).unwrap()
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn openexr_sees_the_names_and_the_metadata() {
    const CODE: &str = r#"
import OpenEXR
with OpenEXR.File("picture.exr", separate_channels=True) as file:
    print(",".join(file.channels()))
    for name in ["software", "comments", "lensbake.options", "compression", "type"]:
        print(file.header()[name])
    print(float(file.header()["lensbake.radius"][0]))
"#;
    let folder = TempDir::new().unwrap();
    let (picture, layers) = picture();
    written(&folder, &picture, layers);
    let printed = python(CODE, folder.path());
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

/// The code of docs/layers.md swaps the sky for the one that the picture has.
#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn the_python_code_of_the_document_swaps_the_sky() {
    let document = std::fs::read_to_string(workspace().join("docs/layers.md")).unwrap();
    let code = document.split("```python\n").nth(1).unwrap();
    let code = code.split("```").next().unwrap().to_owned()
        + "print(abs(swapped - np.stack([layers[name] for name in \"RGB\"], axis=-1)).max())\n"
        + "print(swapped.max(), options)\n";
    let folder = TempDir::new().unwrap();
    let panorama = folder.path().join("panorama.exr");
    // Light that grows along each axis of the sky frame.
    let light = |x: u32, y: u32| {
        let longitude = TAU * ((x as f32 + 0.5) / 1024.0 - 0.5);
        let latitude = 0.5 * TAU * (0.5 - (y as f32 + 0.5) / 512.0);
        let across = latitude.cos();
        let direction = [
            across * longitude.sin(),
            latitude.sin(),
            -across * longitude.cos(),
        ];
        image::Rgb(direction.map(|axis| 0.5 + 0.5 * axis))
    };
    let picture = image::Rgb32FImage::from_fn(1024, 512, light);
    picture.save(&panorama).unwrap();
    let sky = sky::load(&SkySource::Panorama(panorama)).unwrap();
    let lens = lens(&view(), Deflection::Lut);
    let layers = layers::trace(&lens, &Layer::ALL, Sampling::Single, None, || ());
    let picture = cpu::render(&Scene::new(lens, sky), || ());
    let frame = encode(&picture, layers, &metadata()).unwrap();
    std::fs::write(folder.path().join("frame.exr"), frame).unwrap();
    let printed = python(&code, folder.path());
    let words: Vec<_> = printed.split_whitespace().collect();
    let (off, brightest): (f32, f32) = (words[0].parse().unwrap(), words[1].parse().unwrap());
    // Without interpolation it is off by up to half a pixel of the panorama, 0.003 rad.
    assert!(off < 3e-3, "{printed}");
    assert!(brightest > 0.9 && words[2].contains("上海"), "{printed}");
}
