//! A table compared with the direct integrator and with the closed form, ray by ray.

pub mod figure;

use lensbake_core::rk4::Stepper;
use lensbake_core::{BendAndSlope, RayOutcome, direct, exact};
use lensbake_tables::baking::ObservedRay;
use lensbake_tables::baking::for_each_ray;
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

/// The bending of one ray by lookup, by integration and in closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// The ray.
    pub ray: ObservedRay,
    /// Bending by lookup, rad; NaN if the lookup captures the ray.
    pub lookup: f64,
    /// Bending by RK4, rad; NaN if RK4 captures the ray.
    pub direct: f64,
    /// Bending in closed form, rad; NaN for a captured ray.
    pub closed: f64,
    /// dθ′/dθ, the change of the sky angle with the view angle (inverse radial magnification); `None` for the
    /// observer at infinity.
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
/// form. `ray_done` is called after each ray.
///
/// # Errors
/// [`TableError::OtherObserver`] if the table holds another observer's row.
pub fn diff(
    table: &Table,
    rays: &[ObservedRay],
    tolerance: f64,
    ray_done: impl Fn() + Sync,
) -> Result<Diff, TableError> {
    let rays = for_each_ray(table, rays, |row, &ray| {
        let ObservedRay { observer, at } = ray;
        let direct = match direct::bend_and_slope(&observer, at, Stepper::Adaptive(tolerance)) {
            RayOutcome::Escapes(bending) => bending,
            RayOutcome::Captured => BendAndSlope {
                bend: f64::NAN,
                slope: f64::NAN,
            },
        };
        ray_done();
        Comparison {
            ray,
            lookup: row.bend(at).escaped().unwrap_or(f64::NAN),
            direct: direct.bend,
            closed: exact::bend(&observer.ray_at(at))
                .escaped()
                .unwrap_or(f64::NAN),
            sky_slope: (!observer.is_at_infinity())
                .then(|| 1.0 - direct.slope / observer.view_angle_slope(at.x)),
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

    /// CSV text with one line per ray: its coordinates, the three bendings, and the lookup's error in both units.
    pub fn csv(&self, picture: &Picture) -> String {
        let head =
            "r,theta_rad,x,one_minus_x,lookup_rad,direct_rad,closed_rad,error_rad,error_px\n";
        let mut text = head.to_owned();
        for ray in &self.rays {
            let ObservedRay { observer, at } = ray.ray;
            let error = ray.lookup - ray.closed;
            let pixels = ray.in_pixels(error, picture);
            text += &format!(
                "{},{},{},{:e},{},{},{},{:e},{}\n",
                observer.radius(),
                observer.view_angle(at.x),
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
