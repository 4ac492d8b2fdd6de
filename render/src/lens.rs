//! The hole as a gravitational lens: the camera, the deflection method, and the map from view directions to the
//! sky. In f64; the shaders `deflect_*.wgsl` do the same in f32.

use crate::camera::{Camera, ViewAngle};
use glam::DVec3;
use lensbake_core::rk4::Stepper;
use lensbake_core::{BendAndSlope, Observer, RayOutcome, ShadowCoordinate, direct, exact};
use lensbake_tables::{Axis, Row, RowBatch, Table, TableError};
use thiserror::Error;

/// Deflection method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Deflection {
    /// Table lookup: one per pixel.
    Lut,
    /// Direct integration: RK4 along every ray, in steps of this many radians of orbital angle.
    Direct {
        /// The step, rad.
        step: f64,
    },
    /// No deflection: the undeflected sky behind the horizon as a plain sphere. The lower bound of the cost.
    Flat,
}

impl Deflection {
    /// The step at which rounding to f32 and truncation cause about equal errors in direct integration, rad.
    pub const DEFAULT_STEP: f64 = 0.05;
    /// Valid steps, rad: rounding to f32 dominates the error of shorter ones, longer ones miss the hole.
    pub const STEPS: std::ops::RangeInclusive<f64> = 1e-3..=0.5;

    /// The step of direct integration, rad: the method's own, or for the other methods that of the integration
    /// they are compared with, which is the default.
    pub fn integrator_step(self) -> f64 {
        match self {
            Deflection::Direct { step } => step,
            Deflection::Lut | Deflection::Flat => Self::DEFAULT_STEP,
        }
    }

    /// Checks a step of direct integration, rad.
    ///
    /// # Errors
    /// [`LensError::Step`] outside [`Deflection::STEPS`].
    pub fn check_step(step: f64) -> Result<(), LensError> {
        if Self::STEPS.contains(&step) {
            Ok(())
        } else {
            Err(LensError::Step { step })
        }
    }
}

/// How a shader looks up the table's row. The CPU looks up the row itself, in f64.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Lookup {
    /// In stereographic coordinates ([`StereographicRow`](lensbake_tables::StereographicRow)): the fastest, in 46 KiB.
    #[default]
    Stereographic,
    /// The row itself, in its number of texels and its format: the smallest, from 32 bytes on.
    Row,
}

/// A camera, the bending for its observer, and the deflection method.
///
/// ```
/// use lensbake_core::RayOutcome;
/// use lensbake_render::camera::{Camera, View};
/// use lensbake_render::lens::{Deflection, Lens};
/// use lensbake_tables::default_atlas;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let lens = Lens::new(Camera::new(&View::default())?, default_atlas(), Deflection::Lut)?;
/// assert_eq!(lens.ray(lens.camera.forward), RayOutcome::Captured);
/// let RayOutcome::Escapes(ray) = lens.ray(lens.camera.direction(0, 0)) else {
///     panic!("the corner of the picture sees the sky")
/// };
/// assert!((ray.direction.length() - 1.0).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Lens {
    /// The camera.
    pub camera: Camera,
    /// The table's row for the camera's observer.
    pub row: Row,
    /// Deflection method.
    pub deflection: Deflection,
    /// How a shader looks up the row.
    pub lookup: Lookup,
}

/// Why a lens cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LensError {
    /// The table has no row for the camera.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The table's axis is not the residual axis; the other axes serve charts.
    #[error("the table's axis is '{0}'; only a table on the residual axis can be drawn with")]
    Axis(&'static str),
    /// The step is outside [`Deflection::STEPS`].
    #[error(
        "step {step} is not from {} to {} rad", Deflection::STEPS.start(), Deflection::STEPS.end()
    )]
    Step {
        /// The given step, rad.
        step: f64,
    },
}

/// A ray that escapes: where the light seen in a view direction comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LensedRay {
    /// The unit direction on the sky, in the hole frame.
    pub direction: DVec3,
    /// The unwrapped sky angle ϑ = θ − Δ, rad: the angle on the sky from the direction of the hole, negative beyond
    /// the hole, and below −π where the light has gone round it more than once. See
    /// [`ImageOrder`](crate::stars::images::ImageOrder).
    pub sky_angle: f64,
    /// Derivatives of the direction on the sky with respect to the view direction.
    pub jacobian: Jacobian,
    /// ν_obs/ν_∞, the frequency at the camera divided by that at infinity: 1/√(1 − 1/r) for a camera at rest.
    pub frequency_shift: f64,
}

/// The derivatives of the direction on the sky with respect to the view direction, along the image of the direction away
/// from the hole (radial) and across it (tangential). Their inverses are the radial
/// and tangential magnification of an image there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jacobian {
    /// Radial, along the direction away from the hole: dθ′/dθ.
    pub radial: f64,
    /// Tangential, around the hole: sin θ′ / sin θ.
    pub tangential: f64,
}

/// A view angle after deflection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deflected {
    /// The deflection angle (bending) Δ, rad.
    pub bend: f64,
    /// The angle θ′ = θ − Δ on the sky from the direction of the hole.
    pub sky: ViewAngle,
    /// Radial derivative dθ′/dθ.
    pub radial: f64,
}

impl Lens {
    /// The lens of `camera`, its row interpolated from `table`.
    ///
    /// # Errors
    /// [`LensError`] if the table has no row for the camera or is on another axis, or if the step is out of range.
    pub fn new(camera: Camera, table: &Table, deflection: Deflection) -> Result<Self, LensError> {
        if table.header().axis != Axis::Residual {
            return Err(LensError::Axis(table.header().axis.name()));
        }
        if let Deflection::Direct { step } = deflection {
            Deflection::check_step(step)?;
        }
        Ok(Lens {
            camera,
            row: table.row(camera.observer)?,
            deflection,
            lookup: Lookup::default(),
        })
    }

    /// The same lens with another deflection method.
    pub fn with_deflection(&self, deflection: Deflection) -> Self {
        Lens {
            deflection,
            ..self.clone()
        }
    }

    /// The ray outcome for a unit view `direction`, in the hole frame.
    pub fn ray(&self, direction: DVec3) -> RayOutcome<LensedRay> {
        self.lensed(direction, |angle| self.deflect(angle))
    }

    fn lensed(
        &self,
        direction: DVec3,
        deflect: impl Fn(ViewAngle) -> RayOutcome<Deflected>,
    ) -> RayOutcome<LensedRay> {
        let (seen, doppler) = self.camera.unboosted(direction);
        let angle = ViewAngle::of(seen);
        let theta = angle.radians();
        let shift = doppler * self.camera.observer.frequency_shift(theta);
        deflect(angle).map(|deflected| {
            let derivatives = Jacobian::of(angle, deflected);
            LensedRay {
                direction: angle.turn(seen, deflected.sky),
                sky_angle: theta - deflected.bend,
                jacobian: Jacobian {
                    radial: doppler * derivatives.radial,
                    tangential: doppler * derivatives.tangential,
                },
                frequency_shift: shift,
            }
        })
    }

    /// The ray outcome for a view angle.
    pub fn deflect(&self, angle: ViewAngle) -> RayOutcome<Deflected> {
        match self.deflection {
            Deflection::Lut => look_up(&self.row, angle),
            Deflection::Direct { step } => {
                integrate(&self.camera.observer, angle, Stepper::Fixed(step))
            }
            Deflection::Flat => undeflected(&self.camera.observer, angle),
        }
    }

    /// ν_obs/ν_∞ of light of the sky in the unit direction in which the observer of the row sees it, which need not be
    /// the camera (hole frame).
    pub fn frequency_shift(&self, seen: DVec3) -> f64 {
        let (_, doppler) = self.camera.boosted(seen);
        doppler
            * self
                .camera
                .observer
                .frequency_shift(ViewAngle::of(seen).radians())
    }

    /// As [`Lens::ray`], but always by the closed form: the reference for the deflection methods.
    pub fn exact_ray(&self, direction: DVec3) -> RayOutcome<LensedRay> {
        self.lensed(direction, |angle| closed_form(&self.row, angle))
    }
}

impl Jacobian {
    /// The magnification: the solid angle of an image in the picture divided by that of its source on the sky. Negative
    /// where the image is mirrored (odd image orders), infinite on the Einstein rings.
    pub fn magnification(&self) -> f64 {
        1.0 / (self.radial * self.tangential)
    }

    /// The derivatives at the view angle `angle`.
    fn of(angle: ViewAngle, Deflected { sky, radial, .. }: Deflected) -> Self {
        Jacobian {
            radial,
            // On the axis, where sin θ is 0, both derivatives are equal.
            tangential: if angle.sin > 0.0 {
                sky.sin / angle.sin
            } else {
                radial
            },
        }
    }
}

/// Ray outcome by table lookup.
pub fn look_up(row: &Row, angle: ViewAngle) -> RayOutcome<Deflected> {
    let observer = row.observer();
    let at = observer.shadow_coordinate_of(angle.cos, angle.sin);
    row.bend_and_slope(at)
        .map(|bending| turn(observer, angle, at.x, bending))
}

/// Ray outcome by direct integration (RK4).
pub fn integrate(observer: &Observer, angle: ViewAngle, stepper: Stepper) -> RayOutcome<Deflected> {
    let at = observer.shadow_coordinate(angle.radians());
    direct::bend_and_slope(observer, at, stepper)
        .map(|bending| turn(observer, angle, at.x, bending))
}

/// Ray outcome by the closed form, with dθ′/dθ from `row`.
fn closed_form(row: &Row, angle: ViewAngle) -> RayOutcome<Deflected> {
    let observer = row.observer();
    let at = observer.shadow_coordinate(angle.radians());
    match (exact::bend(&observer.ray_at(at)), row.bend_and_slope(at)) {
        (RayOutcome::Escapes(bend), RayOutcome::Escapes(BendAndSlope { slope, .. })) => {
            RayOutcome::Escapes(turn(observer, angle, at.x, BendAndSlope { bend, slope }))
        }
        _ => RayOutcome::Captured,
    }
}

/// Ray outcome without deflection: a black sphere of radius r_s in front of the undeflected sky; half of the sky below
/// the horizon.
fn undeflected(observer: &Observer, angle: ViewAngle) -> RayOutcome<Deflected> {
    if angle.cos > 0.0 && angle.sin < observer.inverse_radius() {
        RayOutcome::Captured
    } else {
        RayOutcome::Escapes(Deflected {
            bend: 0.0,
            sky: angle,
            radial: 1.0,
        })
    }
}

/// The deflection of many rays in turn: by [`Lens::deflect`], or if that is a table lookup by one of many rays at once.
#[derive(Debug)]
pub(crate) struct Deflector<'a> {
    lens: &'a Lens,
    batch: Option<RowBatch<'a>>,
}

/// Rays that are deflected together.
pub(crate) const RAYS: usize = 64;

impl<'a> Deflector<'a> {
    pub(crate) fn new(lens: &'a Lens) -> Self {
        let batch = (lens.deflection == Deflection::Lut).then(|| lens.row.batch());
        Deflector { lens, batch }
    }

    /// Calls `each` with the index and the outcome of every one of `angles`, at most [`RAYS`].
    pub(crate) fn deflect(
        &self,
        angles: &[ViewAngle],
        mut each: impl FnMut(usize, RayOutcome<Deflected>),
    ) {
        let Some(batch) = &self.batch else {
            for (i, &angle) in angles.iter().enumerate() {
                each(i, self.lens.deflect(angle));
            }
            return;
        };
        let observer = self.lens.row.observer();
        let mut at = [ShadowCoordinate {
            x: 1.0,
            one_minus_x: 0.0,
        }; RAYS];
        let mut bendings = [BendAndSlope {
            bend: 0.0,
            slope: 0.0,
        }; RAYS];
        for (at, angle) in at.iter_mut().zip(angles) {
            *at = observer.shadow_coordinate_of(angle.cos, angle.sin);
        }
        let rays = angles.len().min(RAYS);
        batch.bend_and_slope(&at[..rays], &mut bendings[..rays]);
        for (i, (&angle, (&at, &bending))) in
            angles.iter().zip(at.iter().zip(&bendings)).enumerate()
        {
            let outcome = match at.one_minus_x <= 0.0 {
                true => RayOutcome::Captured,
                false => RayOutcome::Escapes(turn(observer, angle, at.x, bending)),
            };
            each(i, outcome);
        }
    }
}

fn turn(observer: &Observer, angle: ViewAngle, x: f64, bending: BendAndSlope) -> Deflected {
    let (sin, cos) = bending.bend.sin_cos();
    Deflected {
        bend: bending.bend,
        sky: ViewAngle {
            cos: angle.cos * cos + angle.sin * sin,
            sin: angle.sin * cos - angle.cos * sin,
        },
        radial: 1.0 - bending.slope / observer.view_angle_slope(x),
    }
}
