//! Tests of the faults of picture files and their error messages.

use std::fs;
use std::path::{Path, PathBuf};

use image::{ImageBuffer, Luma, Rgb, Rgb32FImage, RgbImage};
use tempfile::TempDir;

use super::decoded::DecodedPicture;
use super::file::PictureFile;
use super::{SkyError, SkySource, load};

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn black(folder: &TempDir, name: &str, width: u32, height: u32) -> PathBuf {
    let path = folder.path().join(name);
    RgbImage::new(width, height).save(&path).unwrap();
    path
}

/// The error for this panorama; checks that it is one line that names the file.
fn panorama_error(path: &Path) -> SkyError {
    let error = load(&SkySource::Panorama(path.to_owned())).unwrap_err();
    check_message(&error, path);
    error
}

fn faces_error(paths: [&Path; 6], culprit: &Path) -> SkyError {
    let error = load(&SkySource::Faces(paths.map(Path::to_owned))).unwrap_err();
    check_message(&error, culprit);
    error
}

fn check_message(error: &SkyError, path: &Path) {
    let message = error.to_string();
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(
        message.starts_with(&format!("{}: ", path.display())),
        "{message}"
    );
    assert!(
        message.contains("; ") || message.contains("scale"),
        "{message}"
    );
}

/// A PNG file whose header declares this size, with the pixels of a 1x1 picture.
fn png_that_declares(folder: &TempDir, width: u32, height: u32) -> PathBuf {
    let path = black(folder, "huge.png", 1, 1);
    let mut bytes = fs::read(&path).unwrap();
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let checksum = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
    fs::write(&path, bytes).unwrap();
    path
}

/// The checksum of a PNG chunk, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 }
        })
    })
}

#[test]
fn a_file_that_cannot_be_read() {
    let folder = folder();
    for path in [folder.path().join("missing.png"), folder.path().to_owned()] {
        assert!(matches!(panorama_error(&path), SkyError::Unreadable { .. }));
    }
}

#[test]
fn a_file_that_is_no_picture() {
    let folder = folder();
    let whole = fs::read(black(&folder, "whole.png", 64, 32)).unwrap();
    let path = folder.path().join("bad.png");
    let truncated = &whole[..whole.len() / 2];
    for content in [
        b"".as_slice(),
        b"no picture at all, but a text",
        &whole[..9],
        truncated,
    ] {
        fs::write(&path, content).unwrap();
        let error = panorama_error(&path);
        assert!(matches!(error, SkyError::NotAPicture { .. }), "{error}");
    }
}

#[test]
fn a_panorama_of_the_wrong_shape() {
    let folder = folder();
    for (width, height) in [(64, 64), (98, 50), (102, 50), (32, 64), (5, 2)] {
        let path = black(&folder, "shape.png", width, height);
        let error = panorama_error(&path);
        assert!(matches!(error, SkyError::NotTwoToOne { .. }), "{error}");
    }
    for (width, height) in [(99, 50), (101, 50), (4, 2)] {
        load(&SkySource::Panorama(black(
            &folder,
            "shape.png",
            width,
            height,
        )))
        .unwrap();
    }
}

#[test]
fn a_panorama_of_the_wrong_size() {
    let folder = folder();
    for (width, height) in [(1, 1), (2, 1), (3, 2)] {
        let error = panorama_error(&black(&folder, "small.png", width, height));
        assert!(matches!(error, SkyError::TooSmall { .. }), "{error}");
    }
    for (width, height) in [
        (32768, 16384),
        (16386, 8193),
        (2_000_000_000, 1_000_000_000),
    ] {
        let error = panorama_error(&png_that_declares(&folder, width, height));
        assert!(matches!(error, SkyError::TooLarge { .. }), "{error}");
    }
}

#[test]
fn faces_that_do_not_fit() {
    let folder = folder();
    let good = black(&folder, "good.png", 8, 8);
    let wide = black(&folder, "wide.png", 8, 7);
    let small = black(&folder, "small.png", 7, 7);
    let huge = png_that_declares(&folder, 4097, 4097);
    let missing = folder.path().join("missing.png");
    for place in 0..6 {
        let with = |culprit| {
            let mut paths = [good.as_path(); 6];
            paths[place] = culprit;
            paths
        };
        assert!(matches!(
            faces_error(with(&wide), &wide),
            SkyError::NotSquare { .. }
        ));
        assert!(matches!(
            faces_error(with(&huge), &huge),
            SkyError::TooLarge { .. }
        ));
        assert!(matches!(
            faces_error(with(&missing), &missing),
            SkyError::Unreadable { .. }
        ));
        // If only the first file differs, the second is reported as different from it.
        let named = if place == 0 { &good } else { &small };
        assert!(matches!(
            faces_error(with(&small), named),
            SkyError::UnequalFaces { .. }
        ));
    }
    load(&SkySource::Faces([(); 6].map(|()| good.clone()))).unwrap();
}

#[test]
fn samples_that_are_no_light() {
    let folder = folder();
    let path = folder.path().join("samples.exr");
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e-3] {
        let mut image = Rgb32FImage::new(8, 4);
        image.put_pixel(5, 2, Rgb([0.0, bad, 0.0]));
        image.save(&path).unwrap();
        match panorama_error(&path) {
            SkyError::NotLight {
                column: 5,
                row: 2,
                value,
                ..
            } => {
                assert_eq!(value.to_bits(), bad.to_bits());
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn the_content_and_not_the_name_tells_the_format() {
    let folder = folder();
    let path = black(&folder, "sky.png", 8, 4);
    for name in ["sky.jpg", "sky", "sky.txt"] {
        let renamed = folder.path().join(name);
        fs::copy(&path, &renamed).unwrap();
        load(&SkySource::Panorama(renamed)).unwrap();
    }
}

#[test]
fn integers_are_srgb_and_floats_are_linear() {
    let folder = folder();
    let first = |name: &str| {
        let file = PictureFile::read(&folder.path().join(name)).unwrap();
        DecodedPicture::decode(&file).unwrap().light(0, 0)
    };
    let save = |name: &str| folder.path().join(name);
    // sRGB 188 is linear 0.5029; 10 lies on the straight part of the curve.
    RgbImage::from_pixel(8, 4, Rgb([188, 10, 255]))
        .save(save("8.png"))
        .unwrap();
    assert!((first("8.png") - glam::Vec3::new(0.5029, 0.003_035, 1.0)).length() < 1e-4);
    RgbImage::from_pixel(8, 4, Rgb([188; 3]))
        .save(save("8.jpg"))
        .unwrap();
    assert!((first("8.jpg") - 0.5029).length() < 0.02);
    let deep: ImageBuffer<Luma<u16>, _> = ImageBuffer::from_pixel(8, 4, Luma([188 * 257]));
    deep.save(save("16.png")).unwrap();
    assert!((first("16.png") - 0.5029).length() < 1e-4);
    for name in ["float.exr", "float.hdr"] {
        Rgb32FImage::from_pixel(8, 4, Rgb([0.25, 0.5, 8.0]))
            .save(save(name))
            .unwrap();
        assert!(
            (first(name) - glam::Vec3::new(0.25, 0.5, 8.0)).length() < 0.04,
            "{name}"
        );
    }
}
