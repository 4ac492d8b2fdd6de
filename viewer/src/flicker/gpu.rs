//! The same stars as the GPU draws them.

use super::track::light_of;
use super::{Departure, FlickerError, Track};
use crate::gpu::{Gpu, Renderer};
use crate::scene::Scene;
use crate::sky::Sky;
use glam::Vec3;

/// How far the star of `track` is from the curve in its frames if `gpu` draws it as a point. `frame_done` is
/// called after each.
///
/// # Errors
/// [`FlickerError::Gpu`] if the device fails.
pub fn point_on_gpu(
    gpu: &Gpu,
    scenes: &[Scene],
    track: &Track,
    frame_done: impl Fn(),
) -> Result<Departure, FlickerError> {
    let subject = &track.subject;
    let black = Sky::from_fn(1, |_| Vec3::ZERO);
    let renderer = Renderer::new(gpu, &black)?.with_stars(&subject.field);
    let mut found = Vec::with_capacity(track.frames.len());
    for frame in &track.frames {
        let picture = renderer.picture(&scenes[frame.number], |_| ())?;
        found.push(light_of(&picture, subject.point()) / frame.expected.light);
        frame_done();
    }
    Ok(Departure::of(found))
}
