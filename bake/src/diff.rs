//! A table against the direct integrator and against the closed form, ray by ray.

use crate::measure::for_each_sight;
use crate::rays::Sight;
use lensbake_core::rk4::Stepper;
use lensbake_core::{BendAndSlope, Fate, direct, exact};
use lensbake_tables::statistics::ErrorStatistics;
use lensbake_tables::{Table, TableError};

/// The picture in whose pixels errors are stated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picture {
    /// Its width in pixels.
    pub width: u32,
    /// Its field of view across, rad.
    pub field_of_view: f64,
}

impl Picture {
    /// Angle across the pixel in the middle, the largest, in rad: 2 tan(fov/2) / width.
    pub fn pixel_angle(&self) -> f64 {
        2.0 * (0.5 * self.field_of_view).tan() / f64::from(self.width)
    }
}

/// One ray, looked up, integrated and in closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// The ray.
    pub sight: Sight,
    /// Bending by lookup, by RK4 and in closed form, rad; NaN for a ray that one of them captures.
    pub lookup: f64,
    /// By RK4.
    pub direct: f64,
    /// In closed form.
    pub closed: f64,
    /// dθ′/dθ, how much faster than the view angle the sky angle moves; `None` at infinity.
    pub stretch: Option<f64>,
}

impl Comparison {
    /// An error in rad on the sky as pixels in image space: error ÷ dθ′/d pixel.
    pub fn in_pixels(&self, error: f64, picture: &Picture) -> Option<f64> {
        Some(error / (self.stretch?.abs() * picture.pixel_angle()))
    }
}

/// The comparison of a whole set of rays.
#[derive(Debug, Clone, PartialEq)]
pub struct Diff {
    /// The rays.
    pub rays: Vec<Comparison>,
}

/// The statistics of one difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiffStatistics {
    /// In rad on the sky.
    pub radians: ErrorStatistics,
    /// In pixels in image space; `None` for the observer at infinity, who has no picture.
    pub pixels: Option<ErrorStatistics>,
}

/// Compares `table` along `sights`; `tolerance` is the direct integrator's. `ray_done` is called after
/// each ray.
///
/// # Errors
/// [`TableError::OtherObserver`] if the table holds another observer's row.
pub fn diff(
    table: &Table,
    sights: &[Sight],
    tolerance: f64,
    ray_done: impl Fn() + Sync,
) -> Result<Diff, TableError> {
    let rays = for_each_sight(table, sights, |row, &sight| {
        let Sight { observer, at } = sight;
        let direct = match direct::bend_and_slope(&observer, at, Stepper::Adaptive(tolerance)) {
            Fate::Escapes(bending) => bending,
            Fate::Captured => BendAndSlope {
                bend: f64::NAN,
                slope: f64::NAN,
            },
        };
        ray_done();
        Comparison {
            sight,
            lookup: row.bend(at).escaped().unwrap_or(f64::NAN),
            direct: direct.bend,
            closed: exact::bend(&observer.ray_at(at))
                .escaped()
                .unwrap_or(f64::NAN),
            stretch: (!observer.is_far())
                .then(|| 1.0 - direct.slope / observer.view_angle_slope(at.x)),
        }
    })?;
    Ok(Diff { rays })
}

impl Diff {
    /// Statistics of `error` over all rays; `None` if there are none.
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

    /// One line a ray: where, the three bendings, and the lookup's error in both units.
    pub fn csv(&self, picture: &Picture) -> String {
        let head =
            "r,theta_rad,x,one_minus_x,lookup_rad,direct_rad,closed_rad,error_rad,error_px\n";
        let mut text = head.to_owned();
        for ray in &self.rays {
            let Sight { observer, at } = ray.sight;
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
