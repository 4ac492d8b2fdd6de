//! The CPU renderer in f64, parallel over rows of pixels: the reference for the GPU renderer.

use crate::camera::{Camera, Mapping, ViewAngle};
use crate::disc::{Disc, SeenDisc};
use crate::filter::FilteredPixels;
use crate::lens::{Deflector, Lens, RAYS};
use crate::picture::Picture;
use crate::scene::{Sampling, Scene};
use crate::shift::Rendition;
use crate::stars;
use glam::{DVec3, Vec3};
use lensbake_core::RayOutcome;
use rayon::prelude::*;

/// Draws `scene`. [`Sampling::Anisotropic`] is drawn as [`Sampling::Filtered`]. `row_done` is called after each row of
/// pixels.
///
/// ```
/// use lensbake_render::camera::{Camera, View};
/// use lensbake_render::lens::{Deflection, Lens};
/// use lensbake_render::scene::{Sampling, Scene};
/// use lensbake_render::{cpu, sky};
/// use lensbake_tables::default_atlas;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let view = View { width: 64, height: 36, ..View::default() };
/// let lens = Lens::new(Camera::new(&view)?, default_atlas(), Deflection::Lut)?;
/// let scene = Scene::new(lens, sky::load(&sky::SkySource::Grid)?).with_sampling(Sampling::Filtered);
/// let picture = cpu::render(&scene, || ());
/// assert_eq!(picture.pixels().len(), 64 * 36);
/// # Ok(())
/// # }
/// ```
pub fn render(scene: &Scene, row_done: impl Fn() + Sync) -> Picture {
    let (lens, sky) = (&scene.lens, scene.sky.as_ref());
    let camera = &lens.camera;
    let filtered = FilteredPixels::new(lens, scene.rendition).with_disc(scene.disc);
    let disc = scene
        .disc
        .map(|disc| SeenDisc::new(lens, disc, scene.rendition));
    let deflector = Deflector::new(lens);
    let pixels = by_part(camera, row_done, |[column, row], pixels| {
        match scene.sampling {
            Sampling::Single => {
                single(scene, &deflector, disc.as_ref(), [column, row], pixels);
            }
            Sampling::Filtered | Sampling::Anisotropic => {
                let count = pixels.len() as u32;
                filtered.lights(&deflector, sky, [column, row], count, |i, light| {
                    pixels[i] = light.truncate().to_array();
                });
            }
        }
    });
    let mut picture = Picture::new(camera.width, camera.height, pixels);
    finish(&mut picture, scene);
    picture
}

/// Blackens what is outside the disc of a fisheye, and adds the stars of `scene` to the picture of its sky.
pub(crate) fn finish(picture: &mut Picture, scene: &Scene) {
    let camera = &scene.lens.camera;
    if camera.mapping == Mapping::Equidistant {
        picture.cover(|column, row| camera.coverage(column, row) as f32);
    }
    if let Some(field) = &scene.stars {
        add_stars(
            picture,
            &scene.lens,
            scene.rendition,
            scene.disc,
            |picture| {
                stars::draw(picture, &scene.lens, field, scene.rendition);
            },
        );
    }
}

/// Adds the light of stars, which `draw` adds to a picture, to the picture of their sky. A disc dims the stars behind it,
/// by pixel.
pub fn add_stars(
    picture: &mut Picture,
    lens: &Lens,
    rendition: Rendition,
    disc: Option<Disc>,
    draw: impl FnOnce(&mut Picture),
) {
    if disc.is_none() {
        draw(picture);
        return;
    }
    let mut stars = Picture::black(picture.width(), picture.height());
    draw(&mut stars);
    let pixels = FilteredPixels::new(lens, rendition).with_disc(disc);
    stars.cover(|column, row| pixels.through_disc(column, row));
    picture.add_picture(&stars);
}

/// Writes the light of the single rays of the pixels of a row from (column, row) = `first` on.
fn single(
    scene: &Scene,
    deflector: &Deflector,
    disc: Option<&SeenDisc>,
    [first, row]: [u32; 2],
    pixels: &mut [[f32; 3]],
) {
    let camera = &scene.lens.camera;
    let (mut directions, mut seen) = ([DVec3::ZERO; RAYS], [DVec3::ZERO; RAYS]);
    let mut angles = [ViewAngle { cos: 0.0, sin: 1.0 }; RAYS];
    let rays = directions.iter_mut().zip(&mut seen).zip(&mut angles);
    for (column, ((direction, seen), angle)) in (first..).zip(rays.take(pixels.len())) {
        *direction = camera.direction(column, row);
        *seen = camera.unboosted(*direction).0;
        *angle = ViewAngle::of(*seen);
    }
    deflector.deflect(&angles[..pixels.len()], |i, outcome| {
        let sky = match outcome {
            RayOutcome::Captured => Vec3::ZERO,
            RayOutcome::Escapes(deflected) => {
                let on_sky = camera.sky_from_hole * angles[i].turn(seen[i], deflected.sky);
                let light = scene.sky.sample(on_sky.as_vec3());
                let shift = || scene.lens.frequency_shift(seen[i]);
                scene.rendition.seen(light, shift)
            }
        };
        let light = match disc {
            Some(disc) => disc.before(directions[i], sky.extend(1.0)).truncate(),
            None => sky,
        };
        pixels[i] = light.to_array();
    });
}

/// Traces the ray of each pixel's centre: unit directions on the sky in the hole frame, row-major
/// `[height][width]`. `row_done` is called after each row of pixels.
pub fn trace(lens: &Lens, row_done: impl Fn() + Sync) -> Vec<RayOutcome<DVec3>> {
    let camera = &lens.camera;
    by_pixel(camera, row_done, |column, row| {
        lens.ray(camera.direction(column, row))
            .map(|ray| ray.direction)
    })
}

/// Calls `f` with the first (column, row) of every part of a row of pixels and with those pixels, at most [`RAYS`]; rows in
/// parallel. Returns the pixels row-major, `[height][width]`. `row_done` is called once for each row.
fn by_part(
    camera: &Camera,
    row_done: impl Fn() + Sync,
    f: impl Fn([u32; 2], &mut [[f32; 3]]) + Sync,
) -> Vec<[f32; 3]> {
    let mut pixels = vec![[0.0; 3]; camera.pixels()];
    let rows = pixels.par_chunks_mut(camera.width as usize);
    rows.zip(0..camera.height).for_each(|(pixels, row)| {
        for (column, part) in (0..).step_by(RAYS).zip(pixels.chunks_mut(RAYS)) {
            f([column, row], part);
        }
        row_done();
    });
    pixels
}

/// Calls `f` with the (column, row) of every pixel, rows in parallel. Returns the results row-major,
/// `[height][width]`. `row_done` is called once for each row of pixels.
pub fn by_pixel<T: Send>(
    camera: &Camera,
    row_done: impl Fn() + Sync,
    f: impl Fn(u32, u32) -> T + Sync,
) -> Vec<T> {
    let width = camera.width as usize;
    // Of known length, so that the results of a large picture are in memory once.
    (0..camera.pixels())
        .into_par_iter()
        .with_min_len(width)
        .map(|index| {
            let (column, row) = ((index % width) as u32, (index / width) as u32);
            if column == 0 {
                row_done();
            }
            f(column, row)
        })
        .collect()
}
