//! A sky from six square pictures in the order of skybox sets: right, left, top, bottom, front, back.
//!
//! Such sets follow the cube map convention +X −X +Y −Y +Z −Z, whose frame is left-handed. The sky frame is
//! right-handed, so z is reflected: the front picture is straight ahead along −Z, and no picture appears mirrored.

use std::path::PathBuf;

use super::decoded::DecodedPicture;
use super::file::PictureFile;
use super::{Sky, SkyError};

/// Largest side of a face, pixels: the finest level of the cube map then takes 0.8 GB.
const MAX_SIZE: u32 = 4096;

/// Returns the sky of the six pictures, one texel per pixel.
pub(super) fn load(paths: &[PathBuf; 6]) -> Result<Sky, SkyError> {
    // Each file is read once, so that the bytes checked are the bytes decoded.
    let files = paths.iter().map(|path| PictureFile::read(path));
    let files = files.collect::<Result<Vec<_>, _>>()?;
    let size = common_size(&files)?;
    // Each file's bytes are freed once it is decoded.
    let decoded = files.into_iter().map(|file| DecodedPicture::decode(&file));
    let faces = decoded.collect::<Result<Vec<_>, _>>()?;
    Ok(Sky::from_rows(size, |face, row, texels| {
        for (column, texel) in (0..).zip(texels) {
            let (face, column, row) = reflected(size, face, column, row);
            *texel = faces[face].light(column, row);
        }
    }))
}

/// The reflection in z of a texel of a cube map with `size` texels per side.
fn reflected(size: u32, face: usize, column: u32, row: u32) -> (usize, u32, u32) {
    match face {
        0 | 1 => (face, size - 1 - column, row),
        2 | 3 => (face, column, size - 1 - row),
        _ => (face ^ 1, size - 1 - column, row),
    }
}

/// The width and height that all pictures declare, if they agree.
fn common_size(files: &[PictureFile]) -> Result<u32, SkyError> {
    let sizes = files.iter().map(square_size);
    let sizes = sizes.collect::<Result<Vec<_>, _>>()?;
    let first_size = sizes[0];
    match files
        .iter()
        .zip(sizes)
        .find(|&(_, size)| size != first_size)
    {
        None => Ok(first_size),
        Some((file, size)) => Err(SkyError::UnequalFaces {
            path: file.path().to_owned(),
            size,
            first: files[0].path().to_owned(),
            first_size,
        }),
    }
}

fn square_size(file: &PictureFile) -> Result<u32, SkyError> {
    let (width, height) = file.size()?;
    let path = file.path().to_owned();
    if width == 0 || height == 0 {
        return Err(SkyError::TooSmall {
            path,
            width,
            height,
            min_width: 1,
            min_height: 1,
        });
    }
    if width != height {
        return Err(SkyError::NotSquare {
            path,
            width,
            height,
        });
    }
    if width > MAX_SIZE {
        let (max_width, max_height) = (MAX_SIZE, MAX_SIZE);
        return Err(SkyError::TooLarge {
            path,
            width,
            height,
            max_width,
            max_height,
        });
    }
    Ok(width)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use image::{Rgb, RgbImage};

    use super::*;

    #[test]
    fn each_picture_lies_where_a_skybox_has_it_and_is_not_mirrored() {
        // Face f is red with the value 40 f; its top left pixel is green, its bottom right one blue.
        let folder = tempfile::tempdir().unwrap();
        let paths: [PathBuf; 6] = std::array::from_fn(|face| {
            let path = folder.path().join(format!("{face}.png"));
            let mut image = RgbImage::from_pixel(8, 8, Rgb([40 * face as u8, 0, 0]));
            image.put_pixel(0, 0, Rgb([0, 255, 0]));
            image.put_pixel(7, 7, Rgb([0, 0, 255]));
            image.save(&path).unwrap();
            path
        });
        let sky = load(&paths).unwrap();
        assert_eq!(sky.face_texels(), 8);
        // For each face its axis, top left corner and bottom right corner in the left-handed frame of the cube map
        // convention; z changes its sign in the sky frame.
        let places = [
            ([1, 0, 0], [1, 1, 1], [1, -1, -1]),
            ([-1, 0, 0], [-1, 1, -1], [-1, -1, 1]),
            ([0, 1, 0], [-1, 1, -1], [1, 1, 1]),
            ([0, -1, 0], [-1, -1, 1], [1, -1, -1]),
            ([0, 0, 1], [-1, 1, 1], [1, -1, 1]),
            ([0, 0, -1], [1, 1, -1], [-1, -1, -1]),
        ]
        .map(|(axis, first, last)| {
            [axis, first, last].map(|[x, y, z]: [i32; 3]| Vec3::new(x as f32, y as f32, -z as f32))
        });
        for (face, [axis, first, last]) in places.into_iter().enumerate() {
            let shade = 40.0 * face as f32 / 255.0;
            let linear = ((shade + 0.055) / 1.055).powf(2.4);
            let expected = if face == 0 { 0.0 } else { linear };
            assert!((sky.sample(axis) - expected * Vec3::X).abs().max_element() < 1e-3);
            // The centre of the corner texel lies 1/8 of the way to the axis.
            let centre = |corner: Vec3| axis + 0.875 * (corner - axis);
            assert!(
                (sky.sample(centre(first)) - Vec3::Y).abs().max_element() < 1e-5,
                "{face}"
            );
            assert!(
                (sky.sample(centre(last)) - Vec3::Z).abs().max_element() < 1e-5,
                "{face}"
            );
        }
    }
}
