//! The light of a pixel averaged over its area. Twin of `shaders/filtered.wgsl`.
//!
//! Away from the shadow's edge a pixel is one ray with its footprint. Beside the edge the footprint
//! changes within the pixel (at δ pixels from the edge it is 1/δ rad long, whatever the picture's size)
//! and infinitely many images of the sky crowd together; such pixels are cut into 3 × 3 patches, each a
//! ray with its own footprint. The part of a patch that lies in the shadow is known from the distance
//! to the edge, and the ray goes through the middle of the other part.

use crate::camera::Sight;
use crate::deflect::{Turned, deflect, look_up, undeflected};
use crate::footprint::{ONE_TAP_SQ, Patch};
use crate::scene::{Method, Scene};
use crate::shadow::Shadow;
use crate::sky::Sky;
use glam::{DVec2, DVec3, Vec3, Vec4};
use lensbake_core::Fate;
use std::f64::consts::FRAC_1_SQRT_2;

/// Rays along the side of a pixel beside the edge.
pub const SUB_RAYS: u32 = 3;
/// Taps along the long axis of a ray's footprint at the most: if it is its pixel's only ray, and beside
/// the edge.
const MOST_TAPS: u32 = 16;
const MOST_TAPS_BESIDE_EDGE: u32 = 8;
/// Pixels from the edge, outside and inside the shadow, within which a pixel has that many.
const NEAR_OUTSIDE: f64 = 3.0;
const NEAR_INSIDE: f64 = 1.0;

/// What the pixels of a square take at the most; what takes more is greater.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Need {
    /// One bilinear tap, or none: the sky is magnified, or they are dark.
    OneTap,
    /// One ray each, with taps along its footprint.
    OneRay,
    /// Many rays, for some lie beside the edge.
    ManyRays,
}

impl Need {
    /// All of them.
    pub const ALL: [Need; 3] = [Need::OneTap, Need::OneRay, Need::ManyRays];
}

/// What a pixel takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// It is dark.
    Shadow,
    /// It lies beside the edge.
    Edge,
    /// One ray with its footprint will do.
    Sky,
}

/// The pixels of a scene before a sky.
#[derive(Debug, Clone, Copy)]
pub struct Pixels<'a> {
    scene: &'a Scene,
    shadow: Shadow,
}

impl<'a> Pixels<'a> {
    /// Of `scene`.
    pub fn new(scene: &'a Scene) -> Self {
        Pixels {
            scene,
            shadow: Shadow::of(scene),
        }
    }

    /// The light of pixel (column, row) before `sky`: linear RGB times the part of the pixel that sees
    /// the sky, and that part.
    pub fn light(&self, sky: &Sky, column: u32, row: u32) -> Vec4 {
        let at = self.scene.camera.position(column, row);
        let whole = self.patch(at, 1.0);
        match self.kind(&whole) {
            Kind::Shadow => Vec4::ZERO,
            Kind::Sky => self.sky_light(sky, &whole, MOST_TAPS),
            Kind::Edge => self.edge_light(sky, at),
        }
    }

    /// The distance of the middle of pixel (column, row) from the shadow's edge in pixels, positive
    /// outside.
    pub fn edge_distance(&self, column: u32, row: u32) -> f64 {
        let whole = self.patch(self.scene.camera.position(column, row), 1.0);
        self.shadow.distance(whole.sight) / whole.gradient()
    }

    /// How many rays pixel (column, row) takes beyond one.
    pub fn extra_rays(&self, column: u32, row: u32) -> u32 {
        let at = self.scene.camera.position(column, row);
        match self.kind(&self.patch(at, 1.0)) {
            Kind::Edge => SUB_RAYS * SUB_RAYS - 1,
            Kind::Shadow | Kind::Sky => 0,
        }
    }

    /// What the pixels of a square of `side` pixels take before a sky of `face_texels`: never less than
    /// any of them does. `corner` is its upper left corner, from that of the picture.
    pub fn need_of_square(&self, corner: DVec2, side: f64, face_texels: f64) -> Need {
        let camera = &self.scene.camera;
        let size = DVec2::new(camera.width.into(), camera.height.into());
        let at = corner + 0.5 * (side - size);
        let half_diagonal = side * FRAC_1_SQRT_2;
        // A pixel is the wider the nearer it is to the middle of the picture.
        let nearest = camera.right.length() * (at.length() - half_diagonal).max(0.0);
        let px = camera.right.length() / nearest.hypot(1.0);
        let reach = half_diagonal * px;

        let direction = camera.ray(at).normalize();
        let sight = Sight::of(direction);
        let distance = self.shadow.distance(sight);
        if distance < -NEAR_INSIDE * px - reach {
            return Need::OneTap;
        }
        if distance < NEAR_OUTSIDE * px + reach {
            return Need::ManyRays;
        }
        // The bending is the stronger the nearer to the hole.
        let (sin, cos) = reach.sin_cos();
        let towards = Sight {
            cos: sight.cos * cos + sight.sin * sin,
            sin: sight.sin * cos - sight.cos * sin,
        };
        let Fate::Escapes(turned) = self.turned(towards) else {
            return Need::ManyRays;
        };
        let least_sin = towards.sin.min(sight.sin * cos + sight.cos * sin);
        let most_sin = turned.sight.sin.abs() + 2.0 * reach * turned.stretch;
        // Both stretches are the same straight away from the hole.
        let about = if least_sin > 2.0 * reach {
            most_sin / least_sin
        } else {
            1.1 * turned.stretch
        };
        let most_stretch = turned.stretch.max(about);
        let in_sky = camera.sky_from_hole * sight.turn(direction, turned.sight);
        let depth = in_sky.abs().max_element() - 2.0 * reach * most_stretch;
        let texels = 0.5 * face_texels * px / (depth * depth);
        if depth > 0.0 && texels * texels * (turned.stretch.powi(2) + about * about) < ONE_TAP_SQ {
            Need::OneTap
        } else {
            Need::OneRay
        }
    }

    /// As the method of the scene turns the light, but without an integration.
    fn turned(&self, sight: Sight) -> Fate<Turned> {
        match self.scene.method {
            Method::Lut | Method::Direct { .. } => look_up(&self.scene.row, sight),
            Method::Flat => undeflected(&self.scene.camera.observer, sight),
        }
    }

    /// The square of `side` pixels about `at`, in pixels from the picture's middle.
    fn patch(&self, at: DVec2, side: f64) -> Patch {
        let camera = &self.scene.camera;
        Patch::new(camera.ray(at), camera.right * side, camera.down * side)
    }

    fn kind(&self, pixel: &Patch) -> Kind {
        let (distance, px) = (self.shadow.distance(pixel.sight), pixel.gradient());
        if distance < -NEAR_INSIDE * px {
            Kind::Shadow
        } else if distance < NEAR_OUTSIDE * px {
            Kind::Edge
        } else {
            Kind::Sky
        }
    }

    fn edge_light(&self, sky: &Sky, at: DVec2) -> Vec4 {
        let side = 1.0 / f64::from(SUB_RAYS);
        let offset = |i: u32| (f64::from(i) + 0.5) * side - 0.5;
        let mut sum = Vec4::ZERO;
        for (x, y) in (0..SUB_RAYS).flat_map(|y| (0..SUB_RAYS).map(move |x| (x, y))) {
            let patch = self.patch(at + DVec2::new(offset(x), offset(y)), side);
            let px = patch.gradient();
            let part = self.shadow.sky_part(self.shadow.distance(patch.sight), px);
            if part.covered > 0.0 {
                let patch = patch.moved(part.shift * px, part.extent);
                sum += part.covered as f32 * self.sky_light(sky, &patch, MOST_TAPS_BESIDE_EDGE);
            }
        }
        sum / (SUB_RAYS * SUB_RAYS) as f32
    }

    /// The mean light of a patch that sees nothing but sky, alpha 1; 0 if its ray is captured.
    fn sky_light(&self, sky: &Sky, patch: &Patch, most_taps: u32) -> Vec4 {
        let Fate::Escapes(turned) = deflect(self.scene, patch.sight) else {
            return Vec4::ZERO;
        };
        let footprint = patch
            .footprint(turned)
            .in_frame(&self.scene.camera.sky_from_hole);
        let taps = footprint.taps(sky.face_texels().into(), most_taps);
        let sample = |direction: DVec3| sky.sample_level(direction.as_vec3(), taps.level as f32);
        let sum: Vec3 = taps.directions(footprint.direction).map(sample).sum();
        (sum / taps.count as f32).extend(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use lensbake_tables::default_atlas;
    use std::f64::consts::PI;

    const SIDE: u32 = 41;

    fn scene(view: View, method: Method) -> Scene {
        Scene::new(Camera::new(&view).unwrap(), default_atlas(), method).unwrap()
    }

    /// A view of the lesser disc, shadow or window, `pixels` wide in radius and off the middle by a
    /// part of a pixel.
    fn disc_view(radius: f64, pixels: f64) -> View {
        let edge = Camera::new(&View {
            radius,
            ..View::default()
        })
        .unwrap()
        .observer
        .edge_angle();
        let (disc, yaw_deg) = if edge < PI / 2.0 {
            (edge, 0.0)
        } else {
            (PI - edge, 180.0)
        };
        let px = disc.tan() / pixels;
        View {
            radius,
            yaw_deg: yaw_deg + (0.31 * px).to_degrees(),
            pitch_deg: (0.17 * px).to_degrees(),
            roll_deg: 30.0,
            fov_deg: 2.0 * (0.5 * f64::from(SIDE) * px).atan().to_degrees(),
            width: SIDE,
            height: SIDE,
            ..View::default()
        }
    }

    /// Before a white sky, what is dark is the shadow's area to a part of a pixel, whatever its size;
    /// the same for the window of a camera near the horizon.
    #[test]
    fn the_edge_covers_what_it_should() {
        let white = Sky::from_fn(1, |_| Vec3::ONE);
        let mut checked = 0;
        for radius in [1.000001, 1.0001, 1000.0, 1e6] {
            for pixels in [0.2, 0.5, 1.1, 4.3, 15.0] {
                let scene = scene(disc_view(radius, pixels), Method::Lut);
                let edge = scene.camera.observer.edge_angle();
                let all = Pixels::new(&scene);
                let sum: f64 = (0..SIDE * SIDE)
                    .map(|i| all.light(&white, i % SIDE, i / SIDE))
                    .map(|light| {
                        assert!((light.x - light.w).abs() < 1e-5, "{light}");
                        f64::from(if edge < PI / 2.0 {
                            1.0 - light.w
                        } else {
                            light.w
                        })
                    })
                    .sum();
                let area = PI * pixels * pixels;
                let allowed = 0.001 * area + 0.035;
                assert!(
                    (sum - area).abs() < allowed,
                    "r {radius}, {pixels} px: {sum} for {area}"
                );
                checked += 1;
            }
        }
        assert_eq!(checked, 20);
    }

    /// What a pixel takes by itself.
    fn need_of_pixel(pixels: &Pixels, column: u32, row: u32, face_texels: f64) -> Need {
        let scene = pixels.scene;
        let patch = pixels.patch(scene.camera.position(column, row), 1.0);
        match (pixels.kind(&patch), deflect(scene, patch.sight)) {
            (Kind::Edge, _) => Need::ManyRays,
            (Kind::Sky, Fate::Escapes(turned)) => {
                let footprint = patch
                    .footprint(turned)
                    .in_frame(&scene.camera.sky_from_hole);
                let taps = footprint.taps(face_texels, MOST_TAPS);
                if taps.count == 1 && taps.level == 0.0 {
                    Need::OneTap
                } else {
                    Need::OneRay
                }
            }
            _ => Need::OneTap,
        }
    }

    #[test]
    fn a_square_takes_what_any_of_its_pixels_does() {
        const BLOCK: u32 = 8;
        let mut seen = [0; 3];
        for (radius, yaw_deg, fov_deg, width) in [
            (25.0, 0.0, 90.0, 240),
            (1.2, 140.0, 90.0, 240),
            (1.5, 180.0, 120.0, 160),
            (3.0, 40.0, 175.0, 160),
            (1000.0, 3.0, 20.0, 240),
            (1e6, 0.01, 0.1, 160),
        ] {
            let view = View {
                radius,
                yaw_deg,
                pitch_deg: 7.0 * fov_deg / 90.0,
                fov_deg,
                width,
                height: width / 2,
                ..View::default()
            };
            for method in [Method::Lut, Method::Flat] {
                let scene = scene(view, method);
                let pixels = Pixels::new(&scene);
                // About one texel a pixel, where it matters.
                let face_texels = 1.2 * f64::from(width) / (0.5 * fov_deg.to_radians()).tan();
                for i in 0..width * width / 2 {
                    let (column, row) = (i % width, i / width);
                    let corner = DVec2::new((column & !7).into(), (row & !7).into());
                    let square = pixels.need_of_square(corner, BLOCK.into(), face_texels);
                    let pixel = need_of_pixel(&pixels, column, row, face_texels);
                    assert!(
                        square >= pixel,
                        "{view:?} {method:?} ({column}, {row}): {square:?} {pixel:?}"
                    );
                    seen[square as usize] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&n| n > 2000), "{seen:?}");
    }

    /// Along a row of pixels across the edge the coverage rises without a step.
    #[test]
    fn the_edge_of_the_plain_sphere_is_covered_too() {
        let view = View {
            radius: 4.0,
            fov_deg: 60.0,
            width: 64,
            height: 36,
            ..View::default()
        };
        let scene = scene(view, Method::Flat);
        let white = Sky::from_fn(1, |_| Vec3::ONE);
        let pixels = Pixels::new(&scene);
        let dark: f64 = (0..64 * 36)
            .map(|i| 1.0 - f64::from(pixels.light(&white, i % 64, i / 64).w))
            .sum();
        // sin θ = 1/4: tan θ = 1/√15, and 32 px are tan 30°.
        let radius = 32.0 * 3f64.sqrt() / 15f64.sqrt();
        assert!((dark - PI * radius * radius).abs() < 0.3, "{dark}");
    }
}
