//! A sky from one equirectangular picture.

use std::f32::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec3};

use super::decoded::DecodedPicture;
use super::file::PictureFile;
use super::{Sky, SkyError};

const MIN_WIDTH: u32 = 4;
const MIN_HEIGHT: u32 = 2;
const MAX_WIDTH: u32 = 16384;
const MAX_HEIGHT: u32 = 8192;
/// Largest side of a face, texels: the finest level of the cube map then takes 0.8 GB.
const MAX_FACE_TEXELS: u32 = 4096;

/// Returns the sky of the panorama in `file`.
pub(super) fn load(file: PictureFile) -> Result<Sky, SkyError> {
    check_size(&file)?;
    let picture = DecodedPicture::decode(&file)?;
    // Free the file's bytes: the sky needs as much memory again.
    drop(file);
    let (width, _) = picture.size();
    Ok(Sky::from_fn(face_texels(width), |dir| light(&picture, dir)))
}

fn check_size(file: &PictureFile) -> Result<(), SkyError> {
    let (width, height) = file.size()?;
    let path = file.path().to_owned();
    if width < MIN_WIDTH || height < MIN_HEIGHT {
        let (min_width, min_height) = (MIN_WIDTH, MIN_HEIGHT);
        return Err(SkyError::TooSmall {
            path,
            width,
            height,
            min_width,
            min_height,
        });
    }
    let expected_width = 2 * u64::from(height);
    if 100 * expected_width.abs_diff(u64::from(width)) > expected_width {
        return Err(SkyError::NotTwoToOne {
            path,
            width,
            height,
        });
    }
    if width > MAX_WIDTH || height > MAX_HEIGHT {
        let (max_width, max_height) = (MAX_WIDTH, MAX_HEIGHT);
        return Err(SkyError::TooLarge {
            path,
            width,
            height,
            max_width,
            max_height,
        });
    }
    Ok(())
}

/// Texels along the edge of a face that keep the detail of a panorama: in the centre of a face a texel is as wide
/// as a pixel on the equator. That takes width/π texels, rounded up to a multiple of 4.
fn face_texels(width: u32) -> u32 {
    ((width as f32 / PI).ceil() as u32)
        .next_multiple_of(4)
        .clamp(4, MAX_FACE_TEXELS)
}

/// The place of a unit direction (sky frame) in a panorama: 0 to 1 from the left edge to the right one, and from the
/// bottom (−Y) to the top (+Y).
pub fn panorama_uv(direction: DVec3) -> DVec2 {
    // Longitude grows from −Z towards +X, latitude towards +Y.
    let longitude = direction.x.atan2(-direction.z);
    let latitude = direction.y.atan2(direction.x.hypot(direction.z));
    DVec2::new(
        longitude / std::f64::consts::TAU,
        latitude / std::f64::consts::PI,
    ) + 0.5
}

/// Linear light of the panorama in a unit direction, filtered bilinearly.
fn light(picture: &DecodedPicture, dir: Vec3) -> Vec3 {
    let (width, height) = picture.size();
    // Longitude grows from −Z towards +X, latitude towards +Y.
    let longitude = dir.x.atan2(-dir.z);
    let latitude = dir.y.atan2(dir.x.hypot(dir.z));
    let x = (0.5 + longitude / TAU) * width as f32;
    let y = (0.5 - latitude / PI) * height as f32 - 0.5;
    let row = y.floor();
    light_in_row(picture, x, row as i64).lerp(light_in_row(picture, x, row as i64 + 1), y - row)
}

/// Light between the pixel centres of one row, `x` pixels from the left edge of the picture. A row beyond a pole
/// is the row before the pole, shifted by half a turn.
fn light_in_row(picture: &DecodedPicture, x: f32, row: i64) -> Vec3 {
    let (width, height) = picture.size();
    let last = i64::from(height) - 1;
    let (row, x) = match row {
        row if row < 0 => (0, x + 0.5 * width as f32),
        row if row > last => (last, x + 0.5 * width as f32),
        row => (row, x),
    };
    let x = x - 0.5;
    let column = x.floor();
    let pixel = |column: i64| picture.light(column.rem_euclid(i64::from(width)) as u32, row as u32);
    pixel(column as i64).lerp(pixel(column as i64 + 1), x - column)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use image::{Rgb, Rgb32FImage, RgbImage};

    use super::*;

    const WIDTH: u32 = 64;
    const HEIGHT: u32 = 32;

    /// The direction in which the sky of a black panorama with one white pixel is brightest.
    fn brightest(column: u32, row: u32) -> Vec3 {
        let mut image = RgbImage::new(WIDTH, HEIGHT);
        image.put_pixel(column, row, Rgb([255; 3]));
        let sky = saved(
            |path| image.save(path).unwrap(),
            "one.png",
            |path| load(PictureFile::read(path).unwrap()).unwrap(),
        );
        let n = sky.face_texels();
        let dirs = (0..6 * n * n)
            .map(|i| super::super::texel_direction(n, (i / (n * n)) as usize, i % n, i / n % n));
        let (_, brightest) = sky.levels()[0]
            .texels()
            .iter()
            .zip(dirs)
            .max_by_key(|(texel, _)| texel[0].to_bits())
            .unwrap();
        brightest
    }

    /// The result of `read` for a temporary file that `write` has written.
    fn saved<T>(write: impl Fn(&Path), name: &str, read: impl Fn(&Path) -> T) -> T {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        write(&path);
        read(&path)
    }

    fn picture(image: &Rgb32FImage) -> DecodedPicture {
        saved(
            |path| image.save(path).unwrap(),
            "p.exr",
            |path| DecodedPicture::decode(&PictureFile::read(path).unwrap()).unwrap(),
        )
    }

    #[test]
    fn a_pixel_lies_where_its_direction_says() {
        for (column, row) in [(0, 3), (5, 2), (32, 16), (40, 29), (63, 20)] {
            let direction = brightest(column, row).as_dvec3();
            let size = DVec2::new(WIDTH.into(), HEIGHT.into());
            let from_left_bottom = panorama_uv(direction) * size;
            let (x, y) = (from_left_bottom.x, f64::from(HEIGHT) - from_left_bottom.y);
            // Near the poles a texel of the cube map is wider than a pixel.
            let wide = 1.0 / direction.x.hypot(direction.z);
            assert!(
                (x - f64::from(column) - 0.5).abs() < wide,
                "{column}, {row}: {x}"
            );
            assert!(
                (y - f64::from(row) - 0.5).abs() < 1.0,
                "{column}, {row}: {y}"
            );
        }
    }

    #[test]
    fn the_middle_looks_along_minus_z_and_right_is_plus_x() {
        // The pixels at the poles are on a diagonal of the face, where the texels nearest to the pole are.
        let (middle, equator) = (WIDTH / 2, HEIGHT / 2);
        for (column, row, expected) in [
            (middle, equator, Vec3::NEG_Z),
            (middle + WIDTH / 4, equator, Vec3::X),
            (middle - WIDTH / 4, equator, Vec3::NEG_X),
            (0, equator, Vec3::Z),
            (WIDTH - 1, equator, Vec3::Z),
            (middle, HEIGHT / 4, Vec3::new(0.0, 1.0, -1.0)),
            (
                middle + WIDTH / 8,
                3 * HEIGHT / 4,
                Vec3::new(0.5, -0.5f32.sqrt(), -0.5),
            ),
            (8, 0, Vec3::Y),
            (39, HEIGHT - 1, Vec3::NEG_Y),
        ] {
            // The centre of the pixel is half a pixel off, and a texel of the cube map is as wide as a pixel.
            let off = brightest(column, row).angle_between(expected);
            assert!(
                off < 1.5 * TAU / WIDTH as f32,
                "({column}, {row}): {off} rad off {expected}"
            );
        }
    }

    #[test]
    fn pixel_centres_are_exact() {
        let image = Rgb32FImage::from_fn(WIDTH, HEIGHT, |column, row| {
            Rgb([column as f32, row as f32, 1.0])
        });
        let picture = picture(&image);
        let mut checked = 0;
        for (column, row, pixel) in image.enumerate_pixels() {
            let longitude = ((column as f32 + 0.5) / WIDTH as f32 - 0.5) * TAU;
            let latitude = (0.5 - (row as f32 + 0.5) / HEIGHT as f32) * PI;
            let level = latitude.cos();
            let dir = Vec3::new(
                level * longitude.sin(),
                latitude.sin(),
                -level * longitude.cos(),
            );
            assert!(
                (light(&picture, dir) - Vec3::from(pixel.0))
                    .abs()
                    .max_element()
                    < 1e-3
            );
            checked += 1;
        }
        assert_eq!(checked, WIDTH * HEIGHT);
    }

    #[test]
    fn there_is_no_seam_where_the_picture_ends() {
        // Neighbouring pixels differ by up to 1, also across the ends of a row.
        for width in [WIDTH, WIDTH - 1] {
            let image = Rgb32FImage::from_fn(width, HEIGHT, |column, row| {
                Rgb([
                    (column * 7 % 10) as f32 / 9.0,
                    (row * 3 % 10) as f32 / 9.0,
                    0.5,
                ])
            });
            let picture = picture(&image);
            let mut checked = 0;
            for step in 0..1000 {
                let latitude = (step as f32 / 1000.0 - 0.5) * PI;
                let behind = |x: f32| light(&picture, Vec3::new(x, latitude.tan(), 1.0));
                let jump = (behind(1e-5) - behind(-1e-5)).abs().max_element();
                assert!(jump < 1e-3, "{latitude}: {jump}");

                let (sin, cos) = (step as f32 / 1000.0 * TAU).sin_cos();
                for pole in [Vec3::Y, Vec3::NEG_Y] {
                    let aside = 1e-5 * Vec3::new(sin, 0.0, cos);
                    let jump = light(&picture, pole + aside) - light(&picture, pole - aside);
                    assert!(jump.abs().max_element() < 1e-3, "{pole} {aside}: {jump}");
                }
                checked += 1;
            }
            assert_eq!(checked, 1000);
        }
    }

    #[test]
    fn faces_keep_the_detail_of_the_panorama() {
        for (width, expected) in [(4, 4), (64, 24), (4096, 1304), (8192, 2608), (16384, 4096)] {
            assert_eq!(face_texels(width), expected);
        }
    }
}
