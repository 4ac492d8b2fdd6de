//! What a frame draws, worked out on the CPU from the settings.

use super::settings::Settings;
use crate::camera::{Camera, CameraError, View};
use crate::gpu::{Show, Showing};
use crate::scene::{Scene, SceneError};
use lensbake_tables::Table;
use thiserror::Error;

/// A frame to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The picture, in its own pixels.
    pub scene: Scene,
    /// What of it.
    pub show: Show,
    /// The window as a picture of its own.
    pub window: Camera,
    /// How the picture gets into it.
    pub showing: Showing,
}

/// A frame that cannot be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlanError {
    /// The view.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The table does not serve it.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl Plan {
    /// The frame of a window of `window` pixels, drawn in `scale` pixels for each of them each way.
    ///
    /// # Errors
    /// [`PlanError`] if the table has no row for the camera.
    pub fn new(
        settings: &Settings,
        table: &Table,
        window: [u32; 2],
        scale: f64,
    ) -> Result<Self, PlanError> {
        let picture = scaled(window, scale);
        let camera = |[width, height]: [u32; 2]| {
            Camera::new(&View {
                width,
                height,
                ..settings.view
            })
        };
        let scene = Scene::new(camera(picture)?, table, settings.method())?;
        Ok(Plan {
            scene: scene.sampled(settings.sampling),
            show: settings.show(picture[0]),
            window: camera(window)?,
            showing: settings.showing(window[0]),
        })
    }

    /// Width and height of the picture, its own pixels.
    pub fn picture(&self) -> [u32; 2] {
        [self.scene.camera.width, self.scene.camera.height]
    }
}

/// Pixels of a picture for a window of `window` pixels.
pub fn scaled(window: [u32; 2], scale: f64) -> [u32; 2] {
    window.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
}
