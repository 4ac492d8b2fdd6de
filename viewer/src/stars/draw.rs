//! Draws stars on the CPU, in f64: the reference of the GPU's.

use super::aligned::arcs;
use super::images::{FAINTEST, Lens};
use super::kernel::{spread, weight};
use super::{PointStar, StarField};
use crate::camera::Camera;
use crate::picture::Picture;
use crate::scene::Scene;
use glam::{DVec2, Vec3};
use lensbake_core::CoreError;
use rayon::prelude::*;

/// Light that falls on a point of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Splat {
    /// Where, in pixels from the picture's top left corner.
    pub at: DVec2,
    /// How far the kernel reaches that it is spread with, pixels.
    pub reach: f64,
    /// Its light, linear RGB.
    pub light: Vec3,
}

/// Adds the stars of `field` to the `picture` of `scene`.
///
/// # Errors
/// [`CoreError`] for an observer at infinity, which no camera is.
pub fn draw(picture: &mut Picture, scene: &Scene, field: &StarField) -> Result<(), CoreError> {
    for splat in splats(scene, field)? {
        add(picture, &splat);
    }
    Ok(())
}

/// All that the stars of `field` add to the picture of `scene`.
///
/// # Errors
/// As [`draw`].
pub fn splats(scene: &Scene, field: &StarField) -> Result<Vec<Splat>, CoreError> {
    let lens = Lens::of(scene)?;
    let camera = &scene.camera;
    let per_star = |star: &PointStar| {
        let mut drawn = Vec::new();
        point_images(camera, &lens, star, field.disc_radius, &mut drawn);
        arc_images(camera, &lens, star, field.disc_radius, &mut drawn);
        drawn
    };
    Ok(field.stars.par_iter().flat_map_iter(per_star).collect())
}

/// The pieces of the arcs of those of `stars` that stand on the axis, as `lens` shows them.
pub fn arc_splats<'a>(
    camera: &Camera,
    lens: &Lens,
    stars: impl Iterator<Item = &'a PointStar>,
    disc_radius: f64,
) -> Vec<Splat> {
    let mut drawn = Vec::new();
    for star in stars {
        arc_images(camera, lens, star, disc_radius, &mut drawn);
    }
    drawn
}

fn point_images(
    camera: &Camera,
    lens: &Lens,
    star: &PointStar,
    disc_radius: f64,
    drawn: &mut Vec<Splat>,
) {
    let direction = camera.sky_from_hole.transpose() * star.direction;
    for pair in lens.images(direction, disc_radius) {
        let mut bright = false;
        for image in pair.into_iter().flatten() {
            let light = star.light * image.magnification as f32;
            if light.max_element() >= FAINTEST {
                bright = true;
                if let Some(at) = camera.project(image.direction) {
                    push(camera, at, light, drawn);
                }
            }
        }
        if !bright {
            break;
        }
    }
}

fn arc_images(
    camera: &Camera,
    lens: &Lens,
    star: &PointStar,
    disc_radius: f64,
    drawn: &mut Vec<Splat>,
) {
    let direction = camera.sky_from_hole.transpose() * star.direction;
    arcs(
        lens,
        direction,
        disc_radius,
        camera.right.length(),
        |piece| {
            if let Some(at) = camera.project(piece.direction) {
                push(camera, at, star.light * piece.magnification as f32, drawn);
            }
        },
    );
}

/// Adds the light that falls `at` a point to what is drawn, as far as the picture has it.
fn push(camera: &Camera, at: DVec2, light: Vec3, drawn: &mut Vec<Splat>) {
    let size = DVec2::new(camera.width.into(), camera.height.into());
    for (reach, light) in spread(light) {
        let margin = DVec2::splat(reach);
        if at.cmpgt(-margin).all() && at.cmplt(size + margin).all() {
            drawn.push(Splat { at, reach, light });
        }
    }
}

fn add(picture: &mut Picture, splat: &Splat) {
    let (width, height) = (picture.width(), picture.height());
    let covered = |at: f64, side: u32| {
        let bound = |edge: f64| edge.clamp(0.0, side.into()) as u32;
        bound(at - splat.reach)..bound(at + splat.reach + 1.0)
    };
    for row in covered(splat.at.y, height) {
        for column in covered(splat.at.x, width) {
            let middle = DVec2::new(column.into(), row.into()) + 0.5;
            let light = splat.light * weight(middle - splat.at, splat.reach) as f32;
            picture.add(column, row, light.to_array());
        }
    }
}
