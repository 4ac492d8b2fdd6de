//! Scenes of stars in front of a black sky.

use glam::Vec3;
use lensbake_render::lens::Lens;
use lensbake_render::scene::Scene;
use lensbake_render::sky::Sky;
use lensbake_render::stars::StarField;
use std::sync::Arc;

/// A sky without light.
pub fn black() -> Arc<Sky> {
    Arc::new(Sky::from_fn(1, |_| Vec3::ZERO))
}

/// The stars of `field` seen through `lens`, one ray per pixel.
pub fn scene(lens: &Lens, field: &StarField) -> Scene {
    Scene::new(lens.clone(), black()).with_stars(field.clone())
}
