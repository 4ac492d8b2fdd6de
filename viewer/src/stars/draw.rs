//! Draws stars on the CPU, in f64: the reference of the GPU's.

use super::aligned::arcs;
use super::images::{BRIGHTEST, FAINTEST, Lens};
use super::kernel::{spread, weight};
use super::{PointStar, StarField};
use crate::camera::Camera;
use crate::picture::Picture;
use crate::scene::Scene;
use glam::{DVec2, DVec3, Vec3};
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
    let per_star = |star: &PointStar| {
        let mut drawing = Drawing::new(&scene.camera, &lens, field.disc_radius);
        drawing.add_points(star);
        drawing.add_arcs(star);
        drawing.splats
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
    let mut drawing = Drawing::new(camera, lens, disc_radius);
    for star in stars {
        drawing.add_arcs(star);
    }
    drawing.splats
}

/// Stars of one angular radius as a camera sees them through a lens.
struct Drawing<'a> {
    camera: &'a Camera,
    lens: &'a Lens,
    disc_radius: f64,
    splats: Vec<Splat>,
}

impl<'a> Drawing<'a> {
    fn new(camera: &'a Camera, lens: &'a Lens, disc_radius: f64) -> Self {
        Drawing {
            camera,
            lens,
            disc_radius,
            splats: Vec::new(),
        }
    }

    fn add_points(&mut self, star: &PointStar) {
        let direction = self.camera.sky_from_hole.transpose() * star.direction;
        for pair in self.lens.images(direction, self.disc_radius) {
            let mut bright = false;
            for image in pair.into_iter().flatten() {
                let light = magnified(star.light, image.magnification);
                if light.max_element() >= FAINTEST {
                    bright = true;
                    self.add(image.direction, light);
                }
            }
            if !bright {
                break;
            }
        }
    }

    fn add_arcs(&mut self, star: &PointStar) {
        let (lens, disc_radius) = (self.lens, self.disc_radius);
        let direction = self.camera.sky_from_hole.transpose() * star.direction;
        let px = self.camera.right.length();
        arcs(lens, direction, disc_radius, px, |piece| {
            self.add(piece.direction, magnified(star.light, piece.magnification));
        });
    }

    /// Adds the light that is seen in a direction, as far as the picture has it.
    fn add(&mut self, direction: DVec3, light: Vec3) {
        let Some(at) = self.camera.project(direction) else {
            return;
        };
        let size = DVec2::new(self.camera.width.into(), self.camera.height.into());
        for (reach, light) in spread(light) {
            let margin = DVec2::splat(reach);
            if at.cmpgt(-margin).all() && at.cmplt(size + margin).all() {
                self.splats.push(Splat { at, reach, light });
            }
        }
    }
}

/// `light` so many times brighter, up to [`BRIGHTEST`] in its brightest channel.
fn magnified(light: Vec3, magnification: f64) -> Vec3 {
    let most = f64::from(BRIGHTEST) / f64::from(light.max_element());
    light * magnification.min(most) as f32
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
