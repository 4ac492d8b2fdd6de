//! Draws stars on the CPU in f64: the reference for `shaders/list_stars.wgsl`.

use super::aligned::arcs;
use super::images::{InverseLens, MAX_LIGHT, MIN_LIGHT};
use super::kernel::spread;
use super::splat::{Splat, add, add_curved};
use super::{PointStar, StarField};
use crate::camera::{Camera, Mapping};
use crate::lens::Lens;
use crate::picture::Picture;
use crate::shift::{Rendition, Shift};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Adds the stars of `field`, seen through `lens`, to `picture`.
pub fn draw(picture: &mut Picture, lens: &Lens, field: &StarField, rendition: Rendition) {
    add_splats(picture, &splats(lens, field, rendition), &lens.camera);
}

/// Adds the light of `splats`, seen by `camera`, to `picture`, in their order.
pub(super) fn add_splats(picture: &mut Picture, splats: &[Splat], camera: &Camera) {
    for splat in splats {
        match camera.mapping {
            Mapping::Perspective => add(picture, splat),
            Mapping::Equirectangular | Mapping::Equidistant => add_curved(picture, splat, camera),
        }
    }
}

/// The splats of the stars of `field`, seen through `lens`, in this rendition.
pub fn splats(lens: &Lens, field: &StarField, rendition: Rendition) -> Vec<Splat> {
    let (inverse, stars) = (InverseLens::of(lens), field.stars.par_iter());
    splats_of(lens, &inverse, stars, field.disc_radius, rendition)
}

/// The splats of `stars` of the angular radius `disc_radius` (rad), in their order.
pub(super) fn splats_of<'a>(
    lens: &Lens,
    inverse: &InverseLens,
    stars: impl ParallelIterator<Item = &'a PointStar>,
    disc_radius: f64,
    rendition: Rendition,
) -> Vec<Splat> {
    let per_star = |star: &PointStar| {
        let mut drawing = Drawing::new(lens, inverse, disc_radius, rendition);
        drawing.add_points(star);
        drawing.add_arcs(star);
        drawing.splats
    };
    stars.flat_map_iter(per_star).collect()
}

/// The splats of the arcs of `stars`, seen through `lens`. A star that is not on the optical axis has none.
pub fn arc_splats<'a>(
    lens: &Lens,
    inverse: &InverseLens,
    stars: impl Iterator<Item = &'a PointStar>,
    disc_radius: f64,
    rendition: Rendition,
) -> Vec<Splat> {
    let mut drawing = Drawing::new(lens, inverse, disc_radius, rendition);
    for star in stars {
        drawing.add_arcs(star);
    }
    drawing.splats
}

/// Splats of stars of one angular radius, seen by a camera through a lens.
struct Drawing<'a> {
    lens: &'a Lens,
    inverse: &'a InverseLens,
    disc_radius: f64,
    rendition: Rendition,
    splats: Vec<Splat>,
}

impl<'a> Drawing<'a> {
    fn new(
        lens: &'a Lens,
        inverse: &'a InverseLens,
        disc_radius: f64,
        rendition: Rendition,
    ) -> Self {
        Drawing {
            lens,
            inverse,
            disc_radius,
            rendition,
            splats: Vec::new(),
        }
    }

    fn add_points(&mut self, star: &PointStar) {
        let direction = self.lens.camera.sky_from_hole.transpose() * star.direction;
        for pair in self.inverse.images(direction, self.disc_radius) {
            let mut bright = false;
            for image in pair.into_iter().flatten() {
                let light = magnified(star.light, image.magnification);
                let (direction, light) =
                    observed(self.lens, self.rendition, image.direction, light);
                if light.max_element() >= MIN_LIGHT {
                    bright = true;
                    self.add(direction, light);
                }
            }
            // The higher image orders are fainter, unless motion or shift brighten another part of the view.
            let is_even = self.rendition.shift == Shift::Off && self.lens.camera.boost.is_none();
            if !bright && is_even {
                break;
            }
        }
    }

    fn add_arcs(&mut self, star: &PointStar) {
        let (inverse, disc_radius, camera) = (self.inverse, self.disc_radius, &self.lens.camera);
        let direction = camera.sky_from_hole.transpose() * star.direction;
        // A boost magnifies an arc by at most its Doppler factor.
        let px = camera.right.length() / camera.boost.map_or(1.0, |boost| boost.doppler);
        arcs(inverse, direction, disc_radius, px, |piece| {
            let light = magnified(star.light, piece.magnification);
            let (direction, light) = observed(self.lens, self.rendition, piece.direction, light);
            self.add(direction, light);
        });
    }

    /// Adds light in the view direction `direction` (hole frame), unless it falls outside the picture.
    fn add(&mut self, direction: DVec3, light: Vec3) {
        let camera = &self.lens.camera;
        let Some(at) = camera.project(direction) else {
            return;
        };
        for (reach, light) in spread(light) {
            let splat = Splat { at, reach, light };
            if splat.may_touch(camera) {
                self.splats.push(splat);
            }
        }
    }
}

/// The light of a point, which the observer of the row sees in the unit direction `direction` without frequency shift, as
/// the camera of `lens` sees it: its direction and its light. The solid angle of a small image, and with it its light,
/// shrinks by the square of the ratio of the frequencies.
pub(super) fn observed(
    lens: &Lens,
    rendition: Rendition,
    direction: DVec3,
    light: Vec3,
) -> (DVec3, Vec3) {
    let (seen, doppler) = lens.camera.boosted(direction);
    let light = rendition.seen(light, || lens.frequency_shift(direction));
    (seen, light / (doppler * doppler) as f32)
}

/// `light` times `magnification`, limited to [`MAX_LIGHT`] in its brightest channel.
fn magnified(light: Vec3, magnification: f64) -> Vec3 {
    let most = f64::from(MAX_LIGHT) / f64::from(light.max_element());
    light * magnification.min(most) as f32
}
