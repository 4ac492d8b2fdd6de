//! A table compared with the direct integrator and with the closed form, ray by ray.

pub mod figure;
mod zone;

pub use zone::Zone;

use lensbake_core::rk4::Stepper;
use lensbake_core::{BendAndSlope, Motion, RayOutcome, direct, exact};
use lensbake_tables::baking::{FrameRay, ObservedRay, for_each_ray};
use lensbake_tables::statistics::ErrorStatistics;
use lensbake_tables::{Table, TableError};

/// The picture whose pixels are the unit of image-space errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picture {
    /// Width, pixels.
    pub width: u32,
    /// Horizontal field of view, rad.
    pub field_of_view: f64,
}

impl Picture {
    /// The angle across the middle pixel, the largest of all pixels, rad: 2 tan(fov/2) / width.
    pub fn pixel_angle(&self) -> f64 {
        2.0 * (0.5 * self.field_of_view).tan() / f64::from(self.width)
    }
}

/// The bending of one ray by lookup, by integration and in closed form, in the frame of the observer who sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// The ray.
    pub ray: FrameRay,
    /// Bending by lookup, rad; NaN if the lookup captures the ray.
    pub lookup: f64,
    /// Bending by RK4, rad; NaN if RK4 captures the ray.
    pub direct: f64,
    /// Bending in closed form, rad; NaN for a captured ray.
    pub closed: f64,
    /// Change of the sky angle θ′ with the angle in the observer's own frame, along the image of the plane of the ray
    /// (inverse radial magnification): dθ′/dθ in the frame of [`FrameRay::observed`] × the scale of the boost. `None`
    /// for the observer at infinity.
    pub sky_slope: Option<f64>,
}

impl Comparison {
    /// An error on the sky (rad) in image-space pixels: error ÷ dθ′/d pixel. `None` for the observer at infinity.
    pub fn in_pixels(&self, error: f64, picture: &Picture) -> Option<f64> {
        Some(error / (self.sky_slope?.abs() * picture.pixel_angle()))
    }
}

/// Comparisons along a set of rays.
#[derive(Debug, Clone, PartialEq)]
pub struct Diff {
    /// The rays.
    pub rays: Vec<Comparison>,
}

/// Statistics of the difference between two methods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiffStatistics {
    /// In rad on the sky.
    pub radians: ErrorStatistics,
    /// In image-space pixels; `None` for the observer at infinity, who has no picture.
    pub pixels: Option<ErrorStatistics>,
}

/// Compares `table` along the rays `rays` with the direct integrator, at this `tolerance`, and with the closed
/// form. The lookup is that of the row of [`in_row_frame`](lensbake_core::Observer::in_row_frame) with the exact
/// aberration. `ray_done` is called after each ray.
///
/// # Errors
/// [`TableError::OtherObserver`] if the table holds another observer's row, [`TableError::NoRowsBelow`] if it does not
/// reach down to an observer.
pub fn diff<R: AsRef<ObservedRay> + Into<FrameRay> + Copy + Sync>(
    table: &Table,
    rays: &[R],
    tolerance: f64,
    ray_done: impl Fn() + Sync,
) -> Result<Diff, TableError> {
    let rays = for_each_ray(table, rays, |row, &ray| {
        let ray: FrameRay = ray.into();
        let ObservedRay { observer, at } = ray.observed;
        let direct = match direct::bend_and_slope(&observer, at, Stepper::Adaptive(tolerance)) {
            RayOutcome::Escapes(bending) => bending,
            RayOutcome::Captured => BendAndSlope {
                bend: f64::NAN,
                slope: f64::NAN,
            },
        };
        ray_done();
        let own = |bend: RayOutcome| bend.escaped().unwrap_or(f64::NAN) + ray.aberration();
        Comparison {
            ray,
            lookup: own(row.bend_for(&observer, at)),
            direct: direct.bend + ray.aberration(),
            closed: own(exact::bend(&observer.ray_at(at))),
            sky_slope: (!observer.is_at_infinity())
                .then(|| ray.doppler * (1.0 - direct.slope / observer.view_angle_slope(at.x))),
        }
    })?;
    Ok(Diff { rays })
}

impl Diff {
    /// Statistics of `error` over all rays; `None` without rays.
    pub fn statistics(
        &self,
        picture: &Picture,
        error: impl Fn(&Comparison) -> f64,
    ) -> Option<DiffStatistics> {
        let pixels = self
            .rays
            .iter()
            .filter_map(|ray| ray.in_pixels(error(ray), picture));
        Some(DiffStatistics {
            radians: ErrorStatistics::of(self.rays.iter().map(&error))?,
            pixels: ErrorStatistics::of(pixels),
        })
    }

    /// The same rays in parts by [`Zone`], those that have rays, from far to near.
    pub fn by_zone(self) -> Vec<(Zone, Diff)> {
        let mut zones = Zone::ALL.map(|zone| (zone, Diff { rays: Vec::new() }));
        for ray in self.rays {
            let zone = Zone::of(&ray.ray.observed.observer);
            zones[zone as usize].1.rays.push(ray);
        }
        let has_rays = |(_, part): &(Zone, Diff)| !part.rays.is_empty();
        zones.into_iter().filter(has_rays).collect()
    }

    /// CSV text with one line per ray: its coordinates, the three bendings, and the lookup's error in both units. For
    /// observers in `motion`, the motion and the azimuth are added.
    pub fn csv(&self, picture: &Picture, motion: Motion) -> String {
        let (motion_name, azimuth_name) = match motion {
            Motion::Rest => ("", ""),
            _ => ("motion,", "azimuth_rad,"),
        };
        let mut text = format!(
            "{motion_name}r,theta_rad,{azimuth_name}x,one_minus_x,lookup_rad,direct_rad,closed_rad,error_rad,error_px\n"
        );
        let field = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
        for ray in &self.rays {
            let FrameRay {
                observed: ObservedRay { observer, at },
                theta,
                azimuth,
                ..
            } = ray.ray;
            let (motion, azimuth) = match motion {
                Motion::Rest => (String::new(), String::new()),
                // In quotation marks, because a velocity contains a comma.
                _ => (format!("\"{motion}\","), format!("{},", field(azimuth))),
            };
            let error = ray.lookup - ray.closed;
            let pixels = ray.in_pixels(error, picture);
            text += &format!(
                "{motion}{},{theta},{azimuth}{},{:e},{},{},{},{:e},{}\n",
                observer.radius(),
                at.x,
                at.one_minus_x,
                ray.lookup,
                ray.direct,
                ray.closed,
                error,
                pixels.map_or(String::new(), |p| format!("{p:e}")),
            );
        }
        text
    }
}
