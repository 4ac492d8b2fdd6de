//! A star as one texel of a sky, as programs show it that have only a picture of the stars.

use super::shift;
use glam::Vec3;
use lensbake_core::RayOutcome;
use lensbake_render::camera::Camera;
use lensbake_render::cpu;
use lensbake_render::lens::Lens;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::sky::{Sky, face_coordinates, texel_direction};
use std::sync::Arc;

/// Texels along the edge of a face of the sky. Each is about as wide as a pixel of 480 across 90°.
pub const FACE_TEXELS: u32 = 512;

/// A texel of a cube map whose faces have [`FACE_TEXELS`] texels along each edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Texel {
    face: usize,
    column: u32,
    row: u32,
}

impl Texel {
    /// The texel that contains `direction`, a vector in the sky frame of any length but zero.
    pub fn at(direction: Vec3) -> Self {
        let (face, u, v) = face_coordinates(direction);
        let place = |unit: f32| ((unit * FACE_TEXELS as f32) as u32).min(FACE_TEXELS - 1);
        Texel {
            face,
            column: place(u),
            row: place(v),
        }
    }

    /// Its solid angle, sr.
    pub fn solid_angle(self) -> f64 {
        let middle = texel_direction(FACE_TEXELS, self.face, self.column, self.row);
        let side = 2.0 / f64::from(FACE_TEXELS);
        side * side * f64::from(middle.abs().max_element()).powi(3)
    }

    /// A black sky in which only this texel is lit, as much as a white pixel.
    pub fn sky(self) -> Sky {
        Sky::from_fn(FACE_TEXELS, |direction| {
            if Texel::at(direction) == self {
                Vec3::ONE
            } else {
                Vec3::ZERO
            }
        })
    }
}

/// The light of `texel` in the picture through `lens` if each pixel shows the texel that its central ray meets, in
/// units of the texel's light without the hole.
pub fn nearest_sample(lens: &Lens, texel: Texel) -> f64 {
    let camera = &lens.camera;
    let light = cpu::by_pixel(
        camera,
        || (),
        |column, row| match lens.ray(camera.direction(column, row)) {
            RayOutcome::Escapes(ray) => {
                let met = Texel::at((camera.sky_from_hole * ray.direction).as_vec3());
                let light = shift(lens).seen(Vec3::ONE, ray.frequency_shift);
                f64::from(u8::from(met == texel)) * f64::from(light.y)
            }
            RayOutcome::Captured => 0.0,
        },
    );
    by_solid_angle(camera, light) / texel.solid_angle()
}

/// The light of `texel` in the filtered picture of `sky` through `lens`, in units of the texel's light without the
/// hole.
pub fn filtered_sky(lens: &Lens, texel: Texel, sky: &Arc<Sky>) -> f64 {
    let scene = Scene::new(lens.clone(), sky.clone())
        .with_sampling(Sampling::Filtered)
        .with_shift(shift(lens));
    let picture = cpu::render(&scene, || ());
    let light = picture.pixels().iter().map(|pixel| f64::from(pixel[1]));
    by_solid_angle(&lens.camera, light) / texel.solid_angle()
}

/// The sum of the pixels' light, each weighted by the solid angle of its pixel, sr: pixels at the border of a wide
/// picture are smaller than in the middle.
fn by_solid_angle(camera: &Camera, light: impl IntoIterator<Item = f64>) -> f64 {
    let in_middle = camera.right.length() * camera.down.length();
    let lit = (0..).zip(light).filter(|(_, light)| *light > 0.0);
    let parts = lit.map(|(pixel, light)| {
        let at = camera.position(pixel % camera.width, pixel / camera.width);
        light * in_middle / camera.ray(at).length().powi(3)
    });
    parts.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn the_texels_cover_the_sky_and_hold_their_own_middle() {
        let face: f64 = (0..FACE_TEXELS * FACE_TEXELS)
            .map(|i| {
                let texel = Texel {
                    face: 2,
                    column: i % FACE_TEXELS,
                    row: i / FACE_TEXELS,
                };
                let middle = texel_direction(FACE_TEXELS, 2, texel.column, texel.row);
                assert_eq!(Texel::at(middle), texel);
                texel.solid_angle()
            })
            .sum();
        assert!((6.0 * face / (4.0 * PI) - 1.0).abs() < 1e-5, "{face}");
    }

    #[test]
    fn one_texel_of_its_sky_is_lit() {
        let texel = Texel::at(Vec3::new(0.3, -0.2, 0.9));
        let lit = texel.sky().levels()[0]
            .texels()
            .iter()
            .filter(|t| t[1].to_f32() == 1.0)
            .count();
        assert_eq!(lit, 1);
    }
}
