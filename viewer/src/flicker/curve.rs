//! The analytic curve: how much of a star's light the pictures of an orbit should hold.

use super::closed_form::exact_image;
use crate::scene::Scene;
use crate::stars::PointStar;
use crate::stars::images::{FAINTEST, Way, view_direction};
use crate::stars::kernel::spread;
use glam::{DVec2, Vec3};
use lensbake_core::CoreError;

/// What a picture should hold of one star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// The light of all images in the picture, in units of the star's light without the hole.
    pub light: f64,
    /// Whether its first image, the brightest, is among them.
    pub has_first: bool,
}

/// What the picture of `scene` should hold of `star`, by the closed form; `None` if an image is cut by the
/// picture's border, or none is seen. Images fainter than [`FAINTEST`] are left out, as they are drawn by
/// nobody.
///
/// # Errors
/// [`CoreError`] for an observer at infinity, which no camera is.
pub fn expected(scene: &Scene, star: &PointStar) -> Result<Option<Expected>, CoreError> {
    let camera = &scene.camera;
    let direction = camera.sky_from_hole.transpose() * star.direction;
    let beta = direction.truncate().length().atan2(-direction.z);
    let azimuth = direction.truncate().normalize_or(DVec2::X);
    let size = DVec2::new(camera.width.into(), camera.height.into());
    let mut sum = Expected {
        light: 0.0,
        has_first: false,
    };
    for pair in Way::all() {
        let mut bright = false;
        for way in pair {
            let image = exact_image(&camera.observer, beta, way)?;
            let light = star.light * image.magnification as f32;
            if light.max_element() < FAINTEST {
                continue;
            }
            bright = true;
            let Some(at) = camera.project(view_direction(azimuth * image.side, image.theta)) else {
                continue;
            };
            let inside = at.min(size - at).min_element();
            if inside.abs() < reach(light) {
                return Ok(None);
            }
            if inside > 0.0 {
                sum.light += image.magnification;
                sum.has_first |= way.is_straight();
            }
        }
        // Those that wind further are fainter still.
        if !bright {
            break;
        }
    }
    Ok((sum.light > 0.0).then_some(sum))
}

/// How far from its place an image of this light falls on pixels.
fn reach(light: Vec3) -> f64 {
    spread(light).last().map_or(0.0, |(reach, _)| reach)
}
