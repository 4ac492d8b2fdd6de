//! What is drawn: a camera, and who turns its light.

use crate::camera::Camera;
use lensbake_tables::{Axis, Row, Table, TableError};
use thiserror::Error;

/// Who turns the light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The table: one lookup a pixel.
    Lut,
    /// RK4 along every ray, in steps of this many radians of orbital angle.
    Direct {
        /// The step, rad.
        step: f64,
    },
    /// Nobody: the undeflected sky behind the horizon as a plain sphere. The floor of the cost.
    Flat,
}

impl Method {
    /// The step with which the direct integrator's f32 rounding and truncation are about equal.
    pub const DEFAULT_STEP: f64 = 0.05;
    /// The steps that make sense: f32 rounding drowns shorter ones, longer ones miss the hole.
    pub const STEPS: std::ops::RangeInclusive<f64> = 1e-3..=0.5;

    /// The step of the direct integrator: the method's own, or the default one of the integrator that
    /// another method is compared with, rad.
    pub fn integrator_step(self) -> f64 {
        match self {
            Method::Direct { step } => step,
            Method::Lut | Method::Flat => Self::DEFAULT_STEP,
        }
    }

    /// Checks a step of direct integration, rad.
    ///
    /// # Errors
    /// [`SceneError::Step`] outside [`Method::STEPS`].
    pub fn check_step(step: f64) -> Result<(), SceneError> {
        if Self::STEPS.contains(&step) {
            Ok(())
        } else {
            Err(SceneError::Step { step })
        }
    }
}

/// A camera with the row that serves it.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// Its observer's row.
    pub row: Row,
    /// Who turns the light.
    pub method: Method,
}

/// A scene that cannot be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SceneError {
    /// The table has no row for the camera.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The table's axis is one for charts.
    #[error("the table's axis is '{0}'; only a table on the residual axis can be drawn with")]
    Axis(&'static str),
    /// The step.
    #[error(
        "step {step} is not from {} to {} rad", Method::STEPS.start(), Method::STEPS.end()
    )]
    Step {
        /// What was given, rad.
        step: f64,
    },
}

impl Scene {
    /// The scene of `camera`, its row mixed from `table`.
    ///
    /// # Errors
    /// [`SceneError`] if the table does not serve the camera or the method's step makes no sense.
    pub fn new(camera: Camera, table: &Table, method: Method) -> Result<Self, SceneError> {
        if table.header().axis != Axis::Residual {
            return Err(SceneError::Axis(table.header().axis.name()));
        }
        if let Method::Direct { step } = method {
            Method::check_step(step)?;
        }
        Ok(Scene {
            camera,
            row: table.row(camera.observer)?,
            method,
        })
    }

    /// The same scene drawn by another method.
    pub fn by(&self, method: Method) -> Self {
        Scene {
            method,
            ..self.clone()
        }
    }
}
