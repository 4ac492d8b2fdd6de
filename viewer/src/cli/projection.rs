//! Options of the projection of a picture.

use clap::{Args, ValueEnum};
use lensbake_render::camera::{CubeFace, Projection};

/// The field of view of a fisheye or dome unless the user asks for another, degrees; `None` for the other projections.
pub fn disc_fov_deg(projection: Projection) -> Option<f64> {
    match projection {
        Projection::Fisheye | Projection::Dome { .. } => Some(180.0),
        Projection::Perspective | Projection::Equirectangular | Projection::CubeFace(_) => None,
    }
}

/// Default tilt of a dome, degrees: none.
const TILT: f64 = 0.0;

/// What a picture shows of all directions.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct ProjectionArgs {
    /// What the picture shows of all directions.
    #[arg(long, value_enum, default_value_t = ProjectionName::Perspective)]
    pub projection: ProjectionName,
    /// Tilt of the dome towards the front, from 0 to 90, for --projection dome [default: 0].
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    pub tilt: Option<f64>,
}

/// Names of the projections.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum ProjectionName {
    /// A camera: straight lines stay straight.
    #[default]
    Perspective,
    /// A 360° panorama, twice as wide as high; the view direction is in its centre.
    Equirectangular,
    /// An equidistant fisheye, 180° across unless --fov says otherwise; the view direction is in its centre.
    Fisheye,
    /// A dome master: an equidistant fisheye with the zenith of the dome in its centre and the view direction, the front
    /// of the horizon, at its bottom.
    Dome,
    /// The six faces of a cube, each to a file of its own: NAME_right.png and so on.
    Cube,
}

impl ProjectionArgs {
    /// The projection of each of the pictures, with the ending of its name if there are several.
    pub fn all(self) -> Vec<(Option<&'static str>, Projection)> {
        let one = |projection| vec![(None, projection)];
        match self.projection {
            ProjectionName::Perspective => one(Projection::Perspective),
            ProjectionName::Equirectangular => one(Projection::Equirectangular),
            ProjectionName::Fisheye => one(Projection::Fisheye),
            ProjectionName::Dome => one(Projection::Dome {
                tilt_deg: self.tilt.unwrap_or(TILT),
            }),
            ProjectionName::Cube => CubeFace::ALL
                .map(|face| (Some(face.name()), Projection::CubeFace(face)))
                .to_vec(),
        }
    }

    /// Size of a picture unless the user asks for another, pixels.
    pub fn default_size(self) -> (u32, u32) {
        match self.projection {
            ProjectionName::Perspective => (1920, 1080),
            ProjectionName::Equirectangular => (4096, 2048),
            ProjectionName::Fisheye | ProjectionName::Dome => (2048, 2048),
            ProjectionName::Cube => (1024, 1024),
        }
    }

    /// Checks that no option is given that the projection does not have.
    ///
    /// # Errors
    /// A line that names the option.
    pub fn check(self, has_fov: bool) -> Result<(), &'static str> {
        let is_whole = matches!(
            self.projection,
            ProjectionName::Equirectangular | ProjectionName::Cube
        );
        if is_whole && has_fov {
            return Err(
                "--fov: this projection shows all directions; leave it out, or use --projection fisheye",
            );
        }
        if self.tilt.is_some() && self.projection != ProjectionName::Dome {
            return Err("--tilt is for --projection dome; use --pitch to look up");
        }
        Ok(())
    }
}
