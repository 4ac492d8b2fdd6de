//! The uniform blocks of a picture: its camera, and the region that a pass draws. Tests compare their layouts
//! with those that naga computes for `camera.wgsl` and `region.wgsl`.

use crate::camera::Camera;
use crate::shadow::Shadow;
#[cfg(doc)]
use crate::shift::Rendition;
use glam::DVec3;
use lensbake_tables::lookup::ShadowEdge;

/// The struct `Camera` of `shaders/camera.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct CameraBlock {
    right: [f32; 3],
    inverse_radius: f32,
    down: [f32; 3],
    lapse: f32,
    forward: [f32; 3],
    away_slope: f32,
    sky_x: [f32; 3],
    half_shadow_cos: f32,
    sky_y: [f32; 3],
    half_shadow_sin: f32,
    sky_z: [f32; 3],
    tan_half_shadow: f32,
    size: [u32; 2],
    log_weight: f32,
    edge_scale: f32,
    motion: [f32; 3],
    doppler: f32,
    redshifts: [f32; 2],
    light_scale: f32,
    padding: u32,
}

impl CameraBlock {
    /// The block of a camera that sees this shadow, with the factor [`Rendition::light_scale`].
    pub fn new(camera: &Camera, shadow: Shadow, light_scale: f32) -> Self {
        let vector = |v: DVec3| v.as_vec3().to_array();
        let edge = ShadowEdge::of(&camera.observer);
        CameraBlock {
            right: vector(camera.right),
            inverse_radius: camera.observer.inverse_radius() as f32,
            down: vector(camera.down),
            lapse: camera.observer.lapse() as f32,
            forward: vector(camera.forward),
            away_slope: edge.away_slope,
            sky_x: vector(camera.sky_from_hole.x_axis),
            half_shadow_cos: shadow.half_cos as f32,
            sky_y: vector(camera.sky_from_hole.y_axis),
            half_shadow_sin: shadow.half_sin as f32,
            sky_z: vector(camera.sky_from_hole.z_axis),
            tan_half_shadow: edge.tan_half,
            size: [camera.width, camera.height],
            log_weight: edge.log_weight,
            edge_scale: edge.scale,
            motion: camera
                .boost
                .map_or([0.0; 3], |b| b.direction.map(|x| x as f32)),
            doppler: camera.boost.map_or(1.0, |b| b.doppler) as f32,
            redshifts: camera.observer.redshifts().map(|z| z as f32),
            light_scale,
            padding: 0,
        }
    }
}

/// The struct `Region` of `shaders/region.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct RegionBlock {
    pub first: [u32; 2],
    pub count: [u32; 2],
    pub queues: u32,
    pub tiles: u32,
    pub gain: f32,
    pub padding: u32,
}

/// Bytes of the uniform blocks that a frame uploads: its camera and its region.
pub const UNIFORM_BYTES: usize = size_of::<CameraBlock>() + size_of::<RegionBlock>();

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::Modules;
    use crate::shaders::layouts::assert_layout;

    #[test]
    fn the_layouts_are_the_shaders() {
        let source = Modules::new().assemble(&["region"]);
        assert_layout!(
            &source,
            "Camera",
            CameraBlock,
            right,
            inverse_radius,
            down,
            lapse,
            forward,
            away_slope,
            sky_x,
            half_shadow_cos,
            sky_y,
            half_shadow_sin,
            sky_z,
            tan_half_shadow,
            size,
            log_weight,
            edge_scale,
            motion,
            doppler,
            redshifts,
            light_scale,
        );
        assert_layout!(
            &source,
            "Region",
            RegionBlock,
            first,
            count,
            queues,
            tiles,
            gain,
        );
    }
}
