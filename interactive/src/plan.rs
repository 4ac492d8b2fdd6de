//! Plan of a frame, computed on the CPU from the settings.

use crate::settings::Settings;
use lensbake_render::camera::{Camera, CameraError, View};
use lensbake_render::disc::Disc;
use lensbake_render::gpu::{FrameContent, Presentation};
use lensbake_render::lens::{Lens, LensError};
use lensbake_render::scene::Sampling;
use lensbake_render::shift::Rendition;
use lensbake_tables::Table;
use thiserror::Error;

/// A frame to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The lens, at the resolution of the picture.
    pub lens: Lens,
    /// How a pixel samples its area.
    pub sampling: Sampling,
    /// How the light of the sky becomes light of the picture.
    pub rendition: Rendition,
    /// The disc around the hole, if any.
    pub disc: Option<Disc>,
    /// What the frame shows: one method, a split view, or a difference.
    pub show: FrameContent,
    /// The camera at the resolution of the window.
    pub window: Camera,
    /// How the picture is shown in the window.
    pub presentation: Presentation,
}

/// Why a frame cannot be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlanError {
    /// The view is not a valid camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The table cannot be used for the camera.
    #[error(transparent)]
    Lens(#[from] LensError),
}

impl Plan {
    /// The plan for a window of `window` pixels, with `scale` pixels of the picture per pixel of the window along
    /// each side.
    ///
    /// # Errors
    /// [`PlanError`] if the view is not a valid camera, or the table has no row for it.
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
        let lens = Lens::new(camera(picture)?, table, settings.method())?;
        Ok(Plan {
            show: settings.show(picture[0]),
            window: camera(window)?,
            presentation: settings.presentation(window[0], &lens),
            sampling: settings.sampling,
            rendition: settings.rendition(&lens),
            disc: settings.shown_disc(),
            lens,
        })
    }

    /// Width and height of the picture in pixels.
    pub fn picture(&self) -> [u32; 2] {
        [self.lens.camera.width, self.lens.camera.height]
    }
}

/// Width and height of a picture for a window of `window` pixels, at least 1 each.
pub fn scaled(window: [u32; 2], scale: f64) -> [u32; 2] {
    window.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
}
