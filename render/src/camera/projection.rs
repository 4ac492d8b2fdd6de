//! How view directions are mapped to the plane of the picture.

use super::{Camera, CameraError, View};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// What a picture shows of all directions, as a user asks for it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Projection {
    /// Straight lines stay straight. The field of view is between 0° and 180°.
    #[default]
    Perspective,
    /// All directions, twice as wide as high: longitude to the right and latitude upwards, both counted from the view
    /// direction, with equal steps. The field of view of the view does not matter.
    Equirectangular,
    /// A disc as wide as the picture: the distance from its centre, which is the view direction, is proportional to the
    /// angle from there (equidistant). The field of view, across the disc, is at most 360°. Black outside of it.
    Fisheye,
    /// A fisheye for the dome of a planetarium (dome master): the view direction is the front of the horizon, at the
    /// bottom of the disc, and the centre is the zenith of the dome.
    Dome {
        /// The angle by which the dome is tilted towards the front, degrees: the centre of the disc is this far from
        /// straight up.
        tilt_deg: f64,
    },
    /// A face of a cube around the camera: a square of 90° in perspective, turned from the view direction. The field of
    /// view of the view does not matter.
    CubeFace(CubeFace),
}

/// A face of a cube around the camera, as seen from inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CubeFace {
    /// To the right of the view direction.
    Right,
    /// To the left.
    Left,
    /// Above; the lower edge meets the front.
    Top,
    /// Below; the upper edge meets the front.
    Bottom,
    /// The view direction.
    Front,
    /// Behind.
    Back,
}

impl CubeFace {
    /// All faces, in the order in which [`SkySource::Faces`](crate::sky::SkySource::Faces) reads them.
    pub const ALL: [CubeFace; 6] = [
        CubeFace::Right,
        CubeFace::Left,
        CubeFace::Top,
        CubeFace::Bottom,
        CubeFace::Front,
        CubeFace::Back,
    ];

    /// Its name in names of files.
    pub fn name(self) -> &'static str {
        match self {
            CubeFace::Right => "right",
            CubeFace::Left => "left",
            CubeFace::Top => "top",
            CubeFace::Bottom => "bottom",
            CubeFace::Front => "front",
            CubeFace::Back => "back",
        }
    }

    /// Rotation from the front to this face.
    fn turn(self) -> DMat3 {
        match self {
            CubeFace::Right => DMat3::from_rotation_y(-FRAC_PI_2),
            CubeFace::Left => DMat3::from_rotation_y(FRAC_PI_2),
            CubeFace::Top => DMat3::from_rotation_x(FRAC_PI_2),
            CubeFace::Bottom => DMat3::from_rotation_x(-FRAC_PI_2),
            CubeFace::Front => DMat3::IDENTITY,
            CubeFace::Back => DMat3::from_rotation_y(PI),
        }
    }
}

/// The map from view directions to the plane of the picture. `shaders/ray_*.wgsl` have the same formulae.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Mapping {
    /// The tangent of the angle from the view direction is proportional to the distance from the centre (gnomonic).
    #[default]
    Perspective,
    /// Column and row are proportional to longitude and latitude.
    Equirectangular,
    /// The angle from the view direction is proportional to the distance from the centre.
    Equidistant,
}

/// The view direction at a point of the picture, not normalised, and its derivatives with respect to pixels to the right
/// and downwards, in the hole frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewRay {
    /// The view direction.
    pub direction: DVec3,
    /// Its change from one pixel to the next on the right.
    pub right: DVec3,
    /// Its change from one pixel to the next below.
    pub down: DVec3,
}

impl Projection {
    /// The map from view directions to the picture.
    pub fn mapping(self) -> Mapping {
        match self {
            Projection::Perspective | Projection::CubeFace(_) => Mapping::Perspective,
            Projection::Equirectangular => Mapping::Equirectangular,
            Projection::Fisheye | Projection::Dome { .. } => Mapping::Equidistant,
        }
    }

    /// Rotation from the frame in which the picture is drawn, with its centre along −Z, to the camera frame.
    ///
    /// # Errors
    /// [`CameraError::Tilt`] if the tilt of a dome is not from 0° to 90°.
    pub(super) fn turn(self) -> Result<DMat3, CameraError> {
        match self {
            Projection::Dome { tilt_deg } if (0.0..=90.0).contains(&tilt_deg) => {
                Ok(DMat3::from_rotation_x(FRAC_PI_2 - tilt_deg.to_radians()))
            }
            Projection::Dome { tilt_deg } => Err(CameraError::Tilt(tilt_deg)),
            Projection::CubeFace(face) => Ok(face.turn()),
            Projection::Perspective | Projection::Equirectangular | Projection::Fisheye => {
                Ok(DMat3::IDENTITY)
            }
        }
    }

    /// The angle between the directions of neighbouring pixels in the centre of the picture of `view`, rad; for
    /// [`Mapping::Perspective`] its tangent.
    ///
    /// # Errors
    /// [`CameraError`] if the projection has no such field of view, or no picture of this shape.
    pub(super) fn pixel(self, view: &View) -> Result<f64, CameraError> {
        let fov_deg = view.fov_deg;
        let angle = match self {
            Projection::Perspective if fov_deg > 0.0 && fov_deg < 180.0 => {
                2.0 * (0.5 * fov_deg.to_radians()).tan()
            }
            Projection::Perspective => return Err(CameraError::FieldOfView(fov_deg)),
            Projection::CubeFace(_) => {
                Self::check_shape(view, "a face of a cube is square", 1)?;
                2.0
            }
            Projection::Equirectangular => {
                let what = "an equirectangular picture is twice as wide as high";
                Self::check_shape(view, what, 2)?;
                TAU
            }
            Projection::Fisheye | Projection::Dome { .. } if fov_deg > 0.0 && fov_deg <= 360.0 => {
                fov_deg.to_radians()
            }
            Projection::Fisheye | Projection::Dome { .. } => {
                return Err(CameraError::DiscFieldOfView(fov_deg));
            }
        };
        Ok(angle / f64::from(view.width))
    }

    fn check_shape(view: &View, what: &'static str, times: u32) -> Result<(), CameraError> {
        let (width, height) = (view.width, view.height);
        if Some(width) == height.checked_mul(times) {
            Ok(())
        } else {
            Err(CameraError::Shape {
                what,
                width,
                height,
            })
        }
    }
}

/// sin α / α, for α ≥ 0.
fn sinc(angle: f64) -> f64 {
    if angle < 1e-4 {
        1.0 - angle * angle / 6.0
    } else {
        angle.sin() / angle
    }
}

impl Camera {
    /// The view direction at `at`, in pixels from the centre of the picture, with its derivatives.
    pub fn view_ray(&self, at: DVec2) -> ViewRay {
        match self.mapping {
            Mapping::Perspective => ViewRay {
                direction: self.forward + self.right * at.x + self.down * at.y,
                right: self.right,
                down: self.down,
            },
            Mapping::Equirectangular => self.on_sphere(at),
            Mapping::Equidistant => self.on_disc(at),
        }
    }

    /// The picture's axes as unit vectors, and the angle between neighbouring pixels in its centre, rad.
    fn axes(&self) -> (DVec3, DVec3, f64) {
        let pixel = self.right.length();
        (self.right / pixel, self.down / pixel, pixel)
    }

    fn on_sphere(&self, at: DVec2) -> ViewRay {
        let (right, down, pixel) = self.axes();
        let (longitude_sin, longitude_cos) = (pixel * at.x).sin_cos();
        let (latitude_sin, latitude_cos) = (pixel * at.y).sin_cos();
        let on_equator = right * longitude_sin + self.forward * longitude_cos;
        let along = right * longitude_cos - self.forward * longitude_sin;
        ViewRay {
            direction: on_equator * latitude_cos + down * latitude_sin,
            right: along * (pixel * latitude_cos),
            down: (down * latitude_cos - on_equator * latitude_sin) * pixel,
        }
    }

    fn on_disc(&self, at: DVec2) -> ViewRay {
        let (right, down, pixel) = self.axes();
        let angle = pixel * at.length();
        let (sin, cos) = angle.sin_cos();
        let outward = at.try_normalize().unwrap_or(DVec2::X);
        let from_centre = right * outward.x + down * outward.y;
        let around = down * outward.x - right * outward.y;
        let radial = (from_centre * cos - self.forward * sin) * pixel;
        let tangential = around * (sinc(angle) * pixel);
        ViewRay {
            direction: self.forward * cos + from_centre * sin,
            right: radial * outward.x - tangential * outward.y,
            down: radial * outward.y + tangential * outward.x,
        }
    }

    /// Projects `direction`, in the hole frame, to pixels from the picture's top left corner. The result may lie outside
    /// the picture. `None` if the direction has no place in the plane of the picture: in perspective unless it points
    /// ahead of the camera.
    pub fn project(&self, direction: DVec3) -> Option<DVec2> {
        let ahead = direction.dot(self.forward);
        let (right, down, pixel) = self.axes();
        let aside = DVec2::new(direction.dot(right), direction.dot(down));
        let from_centre = match self.mapping {
            Mapping::Perspective if ahead > 0.0 => aside / (ahead * pixel),
            Mapping::Perspective => return None,
            Mapping::Equirectangular => {
                let horizontal = aside.x.hypot(ahead);
                DVec2::new(aside.x.atan2(ahead), aside.y.atan2(horizontal)) / pixel
            }
            Mapping::Equidistant => {
                let angle = aside.length().atan2(ahead);
                aside.try_normalize().unwrap_or(DVec2::X) * (angle / pixel)
            }
        };
        Some(from_centre + 0.5 * DVec2::new(self.width.into(), self.height.into()))
    }

    /// The share of pixel (column, row) that the picture covers: 1 in the picture, 0 outside the disc of a fisheye.
    pub fn coverage(&self, column: u32, row: u32) -> f64 {
        self.coverage_at(self.position(column, row))
    }

    /// As [`Camera::coverage`], of a pixel around `at`, in pixels from the centre of the picture: above 1/2 where that point
    /// is in the picture.
    pub(crate) fn coverage_at(&self, at: DVec2) -> f64 {
        if self.mapping != Mapping::Equidistant {
            return 1.0;
        }
        let inside = 0.5 * f64::from(self.width) - at.length();
        (inside + 0.5).clamp(0.0, 1.0)
    }

    /// The solid angle of a pixel at `at`, in pixels from the centre of the picture, in units of that of a pixel in the
    /// centre.
    pub fn pixel_solid_angle(&self, at: DVec2) -> f64 {
        let pixel = self.right.length();
        match self.mapping {
            Mapping::Perspective => (1.0 + pixel * pixel * at.length_squared()).powf(-1.5),
            Mapping::Equirectangular => (pixel * at.y).cos().max(0.0),
            Mapping::Equidistant => sinc((pixel * at.length()).min(PI)).max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn camera(projection: Projection, width: u32, height: u32, fov_deg: f64) -> Camera {
        let view = View {
            yaw_deg: 35.0,
            pitch_deg: -20.0,
            roll_deg: 10.0,
            projection,
            fov_deg,
            width,
            height,
            ..View::default()
        };
        Camera::new(&view).unwrap()
    }

    fn any_camera() -> impl Strategy<Value = Camera> {
        prop_oneof![
            (1.0..179.0).prop_map(|fov| camera(Projection::Perspective, 64, 48, fov)),
            Just(camera(Projection::Equirectangular, 64, 32, 1.0)),
            (1.0..=360.0).prop_map(|fov| camera(Projection::Fisheye, 64, 64, fov)),
            (0.0..=90.0).prop_map(|tilt_deg| camera(Projection::Dome { tilt_deg }, 64, 64, 180.0)),
        ]
    }

    proptest! {
        #[test]
        fn a_direction_is_projected_to_where_it_came_from(
            camera in any_camera(),
            x in prop_oneof![-0.5..0.5, Just(0.0), -0.4999..-0.499],
            y in prop_oneof![-0.5..0.5, Just(0.0), 0.499..0.4999],
        ) {
            let size = DVec2::new(camera.width.into(), camera.height.into());
            let at = DVec2::new(x, y) * size;
            prop_assume!(camera.mapping != Mapping::Equidistant || at.length() < 0.4999 * size.x);
            let back = camera.project(camera.ray(at).normalize()).unwrap() - 0.5 * size;
            prop_assert!((back - at).length() < 1e-6, "{at} {back}");
        }

        #[test]
        fn the_steps_are_the_differences_of_the_ray(
            camera in any_camera(),
            x in -30.0..30.0,
            y in prop_oneof![-16.0..16.0, 15.9..15.999],
        ) {
            let (at, h) = (DVec2::new(x, y), 1e-4);
            let ray = camera.view_ray(at);
            let along = |step: DVec2| (camera.ray(at + step * h) - camera.ray(at - step * h)) / (2.0 * h);
            let pixel = camera.right.length();
            prop_assert!((ray.right - along(DVec2::X)).length() < 1e-6 * pixel);
            prop_assert!((ray.down - along(DVec2::Y)).length() < 1e-6 * pixel);
            let solid_angle = ray.right.cross(ray.down).dot(ray.direction).abs()
                / ray.direction.length().powi(3);
            let expected = camera.pixel_solid_angle(at) * pixel * pixel;
            // Beyond the rim of a fisheye there is no sky.
            prop_assume!(pixel * at.length() < PI || camera.mapping != Mapping::Equidistant);
            prop_assert!((solid_angle - expected).abs() < 1e-9 * pixel * pixel);
        }
    }

    /// In the frame of a camera that looks at the hole: X to the right, Y up, −Z ahead.
    fn looks_at_hole(projection: Projection, size: u32) -> Camera {
        let view = View {
            projection,
            fov_deg: 180.0,
            width: size,
            height: size,
            ..View::default()
        };
        Camera::new(&view).unwrap()
    }

    #[test]
    fn a_dome_has_its_zenith_in_the_middle_and_its_front_at_the_bottom() {
        for tilt_deg in [0.0, 15.0, 30.0] {
            let (sin, cos) = f64::to_radians(tilt_deg).sin_cos();
            let camera = looks_at_hole(Projection::Dome { tilt_deg }, 1000);
            let rim = 500.0;
            for (at, direction) in [
                (DVec2::ZERO, DVec3::new(0.0, cos, -sin)),
                (DVec2::new(0.0, rim), DVec3::new(0.0, -sin, -cos)),
                (DVec2::new(0.0, -rim), DVec3::new(0.0, sin, cos)),
                (DVec2::new(rim, 0.0), DVec3::X),
                (DVec2::new(-rim, 0.0), DVec3::NEG_X),
            ] {
                let off = camera.ray(at) - direction;
                assert!(off.length() < 1e-12, "{tilt_deg} {at}: {off}");
            }
            // Equidistant: half-way to the rim is 45° from the zenith.
            let half_way = camera.ray(DVec2::new(0.5 * rim, 0.0));
            assert!((half_way.angle_between(camera.forward) - 0.25 * PI).abs() < 1e-12);
            assert_eq!(camera.coverage(0, 0), 0.0);
            assert_eq!(camera.coverage(500, 500), 1.0);
            let at_rim = camera.coverage(500, 999);
            assert!(at_rim > 0.9, "{at_rim}");
        }
    }

    #[test]
    fn neighbouring_faces_of_a_cube_share_their_edge() {
        let [right, left, top, bottom, front, back] =
            CubeFace::ALL.map(|face| looks_at_hole(Projection::CubeFace(face), 100));
        // The edges of a face from its upper left or lower right corner: to the right and downwards.
        let edge = |camera: &Camera, side: &str, t: f64| {
            let t = 100.0 * t - 50.0;
            let at = match side {
                "top" => DVec2::new(t, -50.0),
                "bottom" => DVec2::new(t, 50.0),
                "left" => DVec2::new(-50.0, t),
                _ => DVec2::new(50.0, t),
            };
            camera.ray(at)
        };
        for (a, side_a, b, side_b, reversed) in [
            (&front, "right", &right, "left", false),
            (&right, "right", &back, "left", false),
            (&back, "right", &left, "left", false),
            (&left, "right", &front, "left", false),
            (&front, "top", &top, "bottom", false),
            (&front, "bottom", &bottom, "top", false),
            (&right, "top", &top, "right", true),
            (&left, "top", &top, "left", false),
            (&back, "top", &top, "top", true),
            (&right, "bottom", &bottom, "right", false),
            (&left, "bottom", &bottom, "left", true),
            (&back, "bottom", &bottom, "bottom", true),
        ] {
            for t in [0.0, 0.3, 1.0] {
                let other = if reversed { 1.0 - t } else { t };
                let off = edge(a, side_a, t) - edge(b, side_b, other);
                assert!(off.length() < 1e-12, "{side_a} {side_b} {t}: {off}");
            }
        }
    }

    #[test]
    fn what_is_no_picture_of_a_projection_is_refused() {
        let refused = |projection, width, height, fov_deg| {
            let view = View {
                projection,
                width,
                height,
                fov_deg,
                ..View::default()
            };
            Camera::new(&view).unwrap_err()
        };
        let shape = refused(Projection::Equirectangular, 1920, 1080, 90.0);
        assert_eq!(
            shape.to_string(),
            "picture size 1920x1080: an equirectangular picture is twice as wide as high"
        );
        let face = Projection::CubeFace(CubeFace::Top);
        assert!(matches!(
            refused(face, 2, 1, 90.0),
            CameraError::Shape { .. }
        ));
        for fov_deg in [0.0, -1.0, 360.1, f64::NAN] {
            assert!(matches!(
                refused(Projection::Fisheye, 8, 8, fov_deg),
                CameraError::DiscFieldOfView(_)
            ));
        }
        for tilt_deg in [-1.0, 91.0, f64::NAN] {
            assert!(matches!(
                refused(Projection::Dome { tilt_deg }, 8, 8, 180.0),
                CameraError::Tilt(_)
            ));
        }
    }
}
