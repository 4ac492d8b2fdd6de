//! The reference renderer: the same scene on the CPU, in f64, in parallel by rows.

use crate::camera::{Camera, Sight};
use crate::deflect::{Turned, deflect};
use crate::filtered::Pixels;
use crate::picture::Picture;
use crate::scene::{Sampling, Scene};
use crate::sky::Sky;
use glam::{DVec3, Vec3};
use lensbake_core::Fate;
use rayon::prelude::*;

/// Draws `scene` before `sky`. `row_done` is called after each row of pixels.
pub fn render(scene: &Scene, sky: &Sky, row_done: impl Fn() + Sync) -> Picture {
    let camera = &scene.camera;
    let filtered = Pixels::new(scene);
    let pixels = by_pixel(camera, row_done, |column, row| match scene.sampling {
        Sampling::Single => single(scene, sky, camera.direction(column, row)).to_array(),
        Sampling::Filtered => filtered.light(sky, column, row).truncate().to_array(),
    });
    Picture::new(camera.width, camera.height, pixels)
}

/// The light of one ray in a unit `direction` in the hole frame.
fn single(scene: &Scene, sky: &Sky, direction: DVec3) -> Vec3 {
    match light_direction(scene, direction) {
        Fate::Captured => Vec3::ZERO,
        Fate::Escapes(light) => sky.sample((scene.camera.sky_from_hole * light).as_vec3()),
    }
}

/// Finds where each pixel's light comes from: unit directions in the hole frame, row-major
/// `[height][width]`. `row_done` is called after each row of pixels.
pub fn trace(scene: &Scene, row_done: impl Fn() + Sync) -> Vec<Fate<DVec3>> {
    let camera = &scene.camera;
    by_pixel(camera, row_done, |column, row| {
        light_direction(scene, camera.direction(column, row))
    })
}

/// Where the light seen in a unit `direction` comes from, both in the hole frame.
pub fn light_direction(scene: &Scene, direction: DVec3) -> Fate<DVec3> {
    turned_direction(direction, |sight| deflect(scene, sight)).map(|(light, _)| light)
}

/// Calls `f` with the (column, row) of every pixel; row-major `[height][width]`.
pub fn by_pixel<T: Send>(
    camera: &Camera,
    row_done: impl Fn() + Sync,
    f: impl Fn(u32, u32) -> T + Sync,
) -> Vec<T> {
    (0..camera.height)
        .into_par_iter()
        .flat_map(|row| {
            let pixels: Vec<T> = (0..camera.width).map(|column| f(column, row)).collect();
            row_done();
            pixels
        })
        .collect()
}

/// The direction that a pixel's light comes from, in the hole frame, and dθ′/dθ.
pub fn turned_direction(
    direction: DVec3,
    deflect: impl Fn(Sight) -> Fate<Turned>,
) -> Fate<(DVec3, f64)> {
    let sight = Sight::of(direction);
    deflect(sight).map(|turned| (sight.turn(direction, turned.sight), turned.stretch))
}
