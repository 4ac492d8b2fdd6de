//! The shadow as a disc: the distance of a view direction from its edge (the critical curve), and the part of a
//! patch of the picture that sees the sky. Reference of `shaders/shadow.wgsl`.
//!
//! For a camera above the photon sphere the smaller disc is the shadow, θ < θ_c. Below the photon sphere it is the
//! sky, a window centred on the direction away from the hole. Either disc has an edge at θ_c and ends on its far
//! side one diameter from there, so one formula serves both.

use crate::camera::{Camera, ViewAngle};
use crate::lens::{Deflection, Lens};
use glam::{DQuat, DVec3};
use std::f64::consts::FRAC_PI_2;

/// The shadow of a scene: the view angles below θ_c.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shadow {
    /// cos(θ_c/2).
    pub half_cos: f64,
    /// sin(θ_c/2).
    pub half_sin: f64,
}

/// The part of a patch of the picture that sees the sky. The patch is a square of side 1 with one side in the
/// radial direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkyPart {
    /// Its share of the patch's area, 0 to 1.
    pub covered: f64,
    /// Distance from the centre of the patch to the centre of that part, positive away from the hole.
    pub shift: f64,
    /// Radial length of that part, 0 to 1.
    pub extent: f64,
}

impl Shadow {
    /// No shadow.
    pub const NONE: Shadow = Shadow {
        half_cos: 1.0,
        half_sin: 0.0,
    };

    /// The shadow that the deflection method of `lens` draws: the captured rays, or the horizon as a plain sphere.
    pub fn of(lens: &Lens) -> Self {
        let observer = &lens.camera.observer;
        let tan_half = match lens.deflection {
            Deflection::Lut | Deflection::Direct { .. } => observer.tan_half_shadow(),
            Deflection::Flat => {
                let sin = observer.inverse_radius().min(1.0);
                sin / (1.0 + ((1.0 - sin) * (1.0 + sin)).sqrt())
            }
        };
        let half_cos = 1.0 / tan_half.hypot(1.0);
        Shadow {
            half_cos,
            half_sin: tan_half * half_cos,
        }
    }

    /// The shadow as a moving camera sees it, and the same camera in a frame with −Z along the middle of that shadow. The
    /// aberration maps circles to circles, so the shadow of a boosted camera is a disc, too, but its middle is not in the
    /// direction of the hole.
    pub fn apparent(self, camera: &Camera) -> (Camera, Shadow) {
        let Some(boost) = camera.boost else {
            return (*camera, self);
        };
        // The plane through the hole and the motion holds a diameter. In it, angles are counted from the motion towards
        // the hole, and the aberration divides tan(α/2) by k.
        let motion = DVec3::from(boost.direction);
        let hole = motion.angle_between(DVec3::NEG_Z);
        let radius = 2.0 * self.half_sin.atan2(self.half_cos);
        let seen = |angle: f64| {
            let (sin, cos) = (0.5 * angle).sin_cos();
            2.0 * (sin / boost.doppler).atan2(cos)
        };
        let (near, far) = (seen(hole - radius), seen(hole + radius));
        let half = 0.25 * (far - near);
        // The unit vector of the plane across the motion, on the side of the hole.
        let across = (DVec3::NEG_Z - motion * DVec3::NEG_Z.dot(motion))
            .try_normalize()
            .unwrap_or_else(|| motion.any_orthonormal_vector());
        let (sin, cos) = (0.5 * (near + far)).sin_cos();
        let middle = motion * cos + across * sin;
        let turn = DQuat::from_rotation_arc(middle, DVec3::NEG_Z);
        let camera = Camera {
            right: turn * camera.right,
            down: turn * camera.down,
            forward: turn * camera.forward,
            ..*camera
        };
        let shadow = Shadow {
            half_cos: half.cos(),
            half_sin: half.sin(),
        };
        (camera, shadow)
    }

    /// 2 sin((θ − θ_c)/2): near the edge equal to θ − θ_c in rad, elsewhere of the same sign and at least 2/π of
    /// its size.
    pub fn distance(&self, view_angle: ViewAngle) -> f64 {
        // cos and sin of θ/2, without the cancellation of √(1 − |cos θ|).
        let greater = (0.5 + 0.5 * view_angle.cos.abs()).sqrt();
        let lesser = 0.5 * view_angle.sin / greater;
        let (cos, sin) = if view_angle.cos >= 0.0 {
            (greater, lesser)
        } else {
            (lesser, greater)
        };
        2.0 * (sin * self.half_cos - cos * self.half_sin)
    }

    /// The part of a patch that sees the sky. `distance` is that of the patch's centre from the edge and `px` the
    /// width of the patch, both in rad. A disc smaller than the patch covers its own area.
    pub fn sky_part(&self, distance: f64, px: f64) -> SkyPart {
        let window = self.half_sin > self.half_cos;
        let radius = 2.0 * self.half_sin.min(self.half_cos) / px;
        // A disc of diameter 2R has a mean width of πR/2 across the radius.
        let width = (FRAC_PI_2 * radius).min(1.0);
        // The disc's edge and its far side, as distances from the centre of the patch.
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
    use crate::camera::View;
    use glam::DVec2;
    use lensbake_core::{Motion, RayOutcome};
    use lensbake_tables::default_atlas;
    use std::f64::consts::PI;

    fn shadow(radius: f64, method: Deflection) -> (Shadow, f64) {
        let view = View {
            radius,
            ..View::default()
        };
        let camera = Camera::new(&view).unwrap();
        let edge = camera.observer.shadow_angle();
        let lens = Lens::new(camera, default_atlas(), method).unwrap();
        (Shadow::of(&lens), edge)
    }

    fn view_angle(theta: f64) -> ViewAngle {
        ViewAngle {
            cos: theta.cos(),
            sin: theta.sin(),
        }
    }

    #[test]
    fn the_distance_is_the_angle_from_the_edge() {
        let mut compared = 0;
        for r in [1.0001, 1.2, 1.5, 2.0, 25.0, 1e6] {
            let (shadow, edge) = shadow(r, Deflection::Lut);
            for offset in [-1e-7, 1e-9, 1e-4, -0.01] {
                let theta = edge + offset;
                if theta > 0.0 && theta < PI {
                    let distance = shadow.distance(view_angle(theta));
                    let chord = 0.05 * offset.abs().powi(3) + 1e-15;
                    assert!((distance - offset).abs() < chord, "{r} {offset}");
                    compared += 1;
                }
            }
            for theta in [0.0, 0.1, 1.5, 3.0, PI] {
                let (distance, angle) = (shadow.distance(view_angle(theta)), theta - edge);
                assert!(
                    distance * angle > 0.0 && distance.abs() > 0.6 * angle.abs(),
                    "{r} {theta}"
                );
            }
        }
        assert!(compared > 20, "{compared}");
        let (flat, _) = shadow(4.0, Deflection::Flat);
        assert!(flat.distance(view_angle(0.25f64.asin())).abs() < 1e-15);
    }

    #[test]
    fn the_shadow_of_a_moving_camera_ends_where_its_rays_do() {
        let velocity = |radial, tangential| Motion::Velocity { radial, tangential };
        let mut compared = 0;
        for (radius, motion) in [
            (3.0, Motion::Orbit),
            (10.0, velocity(0.0, 0.99)),
            (1.2, velocity(-0.5, 0.6)),
            (300.0, Motion::Fall),
            (0.5, velocity(0.3, -0.8)),
        ] {
            let view = View {
                radius,
                motion,
                heading_deg: 30.0,
                ..View::default()
            };
            let camera = Camera::new(&view).unwrap();
            let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
            let (turned, shadow) = Shadow::of(&lens).apparent(&camera);
            for i in 0..4000 {
                let at = DVec2::new(f64::from(i % 63) - 31.0, f64::from(i / 63) - 31.0) * 90.0;
                for sign in [1.0, -1.0] {
                    let ray = (sign * camera.ray(at)).normalize();
                    let seen = ViewAngle::of((sign * turned.ray(at)).normalize());
                    let distance = shadow.distance(seen);
                    if distance.abs() > 1e-9 {
                        let captured = lens.ray(ray) == RayOutcome::Captured;
                        assert_eq!(
                            captured,
                            distance < 0.0,
                            "{radius} {motion} {at} {distance}"
                        );
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 30_000);
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
