//! The light of a pixel averaged over its area. Twin of `shaders/filtered.wgsl`.
//!
//! Away from the shadow's edge a pixel is one ray with its footprint. Beside the edge the footprint
//! changes within the pixel (at δ pixels from the edge it is 1/δ rad long, whatever the picture's size)
//! and infinitely many images of the sky crowd together; such pixels are cut into 3 × 3 patches, each a
//! ray with its own footprint. The part of a patch that lies in the shadow is known from the distance
//! to the edge, and the ray goes through the middle of the other part.

use crate::deflect::deflect;
use crate::footprint::Patch;
use crate::scene::Scene;
use crate::shadow::Shadow;
use crate::sky::Sky;
use glam::{DVec2, DVec3, Vec3, Vec4};
use lensbake_core::Fate;

/// Rays along the side of a pixel beside the edge.
pub const SUB_RAYS: u32 = 3;
/// Taps along the long axis of a ray's footprint at the most: if it is its pixel's only ray, and beside
/// the edge.
const MOST_TAPS: u32 = 16;
const MOST_TAPS_BESIDE_EDGE: u32 = 8;
/// Pixels from the edge, outside and inside the shadow, within which a pixel has that many.
const NEAR_OUTSIDE: f64 = 3.0;
const NEAR_INSIDE: f64 = 1.0;

/// What the pixels of a block take at the most; what takes more is greater.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Need {
    /// One bilinear tap, or none: the sky is magnified, or they are dark.
    OneTap,
    /// One ray each, with taps along its footprint.
    OneRay,
    /// Many rays, for some lie beside the edge.
    ManyRays,
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

    /// What pixel (column, row) takes before a sky of `face_texels`.
    #[cfg(test)]
    pub(crate) fn need(&self, column: u32, row: u32, face_texels: f64) -> Need {
        let patch = self.patch(self.scene.camera.position(column, row), 1.0);
        match (self.kind(&patch), deflect(self.scene, patch.sight)) {
            (Kind::Edge, _) => Need::ManyRays,
            (Kind::Sky, Fate::Escapes(turned)) => {
                let footprint = patch
                    .footprint(turned)
                    .in_frame(&self.scene.camera.sky_from_hole);
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
    use crate::scene::Method;
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
