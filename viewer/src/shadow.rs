//! The shadow as a disc: how far a view direction is from its edge, and which part of a patch of the
//! picture it leaves to the sky. Twin of `shaders/shadow.wgsl`.
//!
//! Above the photon sphere the shadow is the lesser disc, θ < θ_c; below it the sky is, a window about
//! the direction away from the hole. Both have an edge at θ_c and a radius in which they end on the
//! other side, so one formula serves both.

use crate::camera::Sight;
use crate::scene::{Method, Scene};
use std::f64::consts::FRAC_PI_2;

/// The shadow of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shadow {
    /// cos(θ_c/2).
    pub half_cos: f64,
    /// sin(θ_c/2).
    pub half_sin: f64,
}

/// The part of a patch of the picture that sees the sky. The patch is a square of side 1 of which one
/// side lies along the hole's radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkyPart {
    /// The share of the patch's area, 0 to 1.
    pub covered: f64,
    /// From the middle of the patch to the middle of that part, away from the hole.
    pub shift: f64,
    /// Length of that part along the radius, 0 to 1.
    pub extent: f64,
}

impl Shadow {
    /// The shadow as the method of `scene` draws it: the captured rays', or the horizon as a plain sphere.
    pub fn of(scene: &Scene) -> Self {
        let observer = &scene.camera.observer;
        let tan_half = match scene.method {
            Method::Lut | Method::Direct { .. } => observer.tan_half_edge(),
            Method::Flat => {
                let sin = observer.inverse_radius();
                sin / (1.0 + ((1.0 - sin) * (1.0 + sin)).sqrt())
            }
        };
        let half_cos = 1.0 / tan_half.hypot(1.0);
        Shadow {
            half_cos,
            half_sin: tan_half * half_cos,
        }
    }

    /// 2 sin((θ − θ_c)/2): beside the edge the angle θ − θ_c in rad, elsewhere of its sign and not less
    /// than 2/π of it.
    pub fn distance(&self, sight: Sight) -> f64 {
        // cos and sin of θ/2, without the cancellation of √(1 − |cos θ|).
        let greater = (0.5 + 0.5 * sight.cos.abs()).sqrt();
        let lesser = 0.5 * sight.sin / greater;
        let (cos, sin) = if sight.cos >= 0.0 {
            (greater, lesser)
        } else {
            (lesser, greater)
        };
        2.0 * (sin * self.half_cos - cos * self.half_sin)
    }

    /// The part of a patch that sees the sky, from the distance of the patch's middle to the edge and
    /// `px`, the width of the patch: both in rad. A disc smaller than the patch covers its own area.
    pub fn sky_part(&self, distance: f64, px: f64) -> SkyPart {
        let window = self.half_sin > self.half_cos;
        let radius = 2.0 * self.half_sin.min(self.half_cos) / px;
        // A disc of diameter 2R has a mean width of πR/2 across the radius.
        let width = (FRAC_PI_2 * radius).min(1.0);
        // The edge, and where the disc ends beyond its middle, from the middle of the patch.
        let edge = -distance / px;
        let near = edge.clamp(-0.5, 0.5);
        if window {
            let far = (edge + 2.0 * radius).clamp(-0.5, 0.5);
            return SkyPart {
                covered: (far - near) * width,
                shift: 0.5 * (far + near),
                extent: far - near,
            };
        }
        let far = (edge - 2.0 * radius).clamp(-0.5, 0.5);
        SkyPart {
            covered: 1.0 - (near - far) * width,
            shift: 0.5 * (0.5 + near),
            extent: 0.5 - near,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use lensbake_tables::default_atlas;
    use std::f64::consts::PI;

    fn shadow(radius: f64, method: Method) -> (Shadow, f64) {
        let view = View {
            radius,
            ..View::default()
        };
        let camera = Camera::new(&view).unwrap();
        let edge = camera.observer.edge_angle();
        let scene = Scene::new(camera, default_atlas(), method).unwrap();
        (Shadow::of(&scene), edge)
    }

    fn sight(theta: f64) -> Sight {
        Sight {
            cos: theta.cos(),
            sin: theta.sin(),
        }
    }

    #[test]
    fn the_distance_is_the_angle_from_the_edge() {
        let mut compared = 0;
        for r in [1.0001, 1.2, 1.5, 2.0, 25.0, 1e6] {
            let (shadow, edge) = shadow(r, Method::Lut);
            for offset in [-1e-7, 1e-9, 1e-4, -0.01] {
                let theta = edge + offset;
                if theta > 0.0 && theta < PI {
                    let distance = shadow.distance(sight(theta));
                    let chord = 0.05 * offset.abs().powi(3) + 1e-15;
                    assert!((distance - offset).abs() < chord, "{r} {offset}");
                    compared += 1;
                }
            }
            for theta in [0.0, 0.1, 1.5, 3.0, PI] {
                let (distance, angle) = (shadow.distance(sight(theta)), theta - edge);
                assert!(
                    distance * angle > 0.0 && distance.abs() > 0.6 * angle.abs(),
                    "{r} {theta}"
                );
            }
        }
        assert!(compared > 20, "{compared}");
        let (flat, _) = shadow(4.0, Method::Flat);
        assert!(flat.distance(sight(0.25f64.asin())).abs() < 1e-15);
    }

    #[test]
    fn a_disc_within_the_patch_covers_its_area() {
        let (px, half) = (1e-3, 1e-4_f64);
        let (cos, sin) = (half.cos(), half.sin());
        let area = PI * (2.0 * sin / px).powi(2);
        let shadow = Shadow {
            half_cos: cos,
            half_sin: sin,
        };
        let window = Shadow {
            half_cos: sin,
            half_sin: cos,
        };
        for from_middle in [0.0, 0.1e-3, 0.29e-3] {
            let distance = from_middle - 2.0 * half;
            let dark = 1.0 - shadow.sky_part(distance, px).covered;
            let bright = window.sky_part(-distance, px).covered;
            assert!((dark - area).abs() < 1e-9, "{from_middle}: {dark} {area}");
            assert!(
                (bright - area).abs() < 1e-9,
                "{from_middle}: {bright} {area}"
            );
        }
    }

    #[test]
    fn a_straight_edge_splits_the_patch() {
        let shadow = Shadow {
            half_cos: 0.9,
            half_sin: 0.19f64.sqrt(),
        };
        let part = |distance| shadow.sky_part(distance * 1e-3, 1e-3);
        for (distance, covered, shift) in [
            (0.0, 0.5, 0.25),
            (0.3, 0.8, 0.1),
            (-0.4, 0.1, 0.45),
            (7.0, 1.0, 0.0),
            (-7.0, 0.0, 0.5),
        ] {
            let found = part(distance);
            assert!(
                (found.covered - covered).abs() < 1e-9 && (found.shift - shift).abs() < 1e-9,
                "{found:?}"
            );
            assert!((found.extent - covered).abs() < 1e-9, "{found:?}");
        }
    }
}
