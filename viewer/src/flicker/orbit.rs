//! The orbit: frames evenly about the hole.

use super::FlickerError;
use crate::camera::{Camera, View};
use crate::scene::{Method, Scene};
use lensbake_tables::default_atlas;

/// A camera's way once about the hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// The view; the longitude is the frame's own, 0 in the first.
    pub view: View,
    /// Frames in all.
    pub frames: u32,
}

impl Orbit {
    /// The scenes of its frames, in order, by the built-in atlas.
    ///
    /// # Errors
    /// [`FlickerError`] if the view makes no camera.
    pub fn scenes(&self) -> Result<Vec<Scene>, FlickerError> {
        (0..self.frames).map(|frame| self.scene(frame)).collect()
    }

    fn scene(&self, frame: u32) -> Result<Scene, FlickerError> {
        let camera = Camera::new(&View {
            orbit_deg: 360.0 * f64::from(frame) / f64::from(self.frames),
            ..self.view
        })?;
        Ok(Scene::new(camera, default_atlas(), Method::Lut)?)
    }
}
