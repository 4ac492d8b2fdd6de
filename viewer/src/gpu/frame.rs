//! The uniform block of a frame. A test holds its layout to what naga makes of `frame.wgsl`.

use crate::camera::Camera;
use crate::shadow::Shadow;
use glam::DVec3;
use lensbake_tables::lookup::Edge;

/// A rectangle of pixels: what one dispatch draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tile {
    /// Column and row of its first pixel.
    pub first: [u32; 2],
    /// Its width and height, pixels.
    pub count: [u32; 2],
}

/// The struct `Frame` of `shaders/frame.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Frame {
    right: [f32; 3],
    u: f32,
    down: [f32; 3],
    lapse: f32,
    forward: [f32; 3],
    gain: f32,
    sky_x: [f32; 3],
    away_slope: f32,
    sky_y: [f32; 3],
    half_edge_cos: f32,
    sky_z: [f32; 3],
    half_edge_sin: f32,
    edge: [f32; 2],
    size: [u32; 2],
    first: [u32; 2],
    count: [u32; 2],
    lists: u32,
    blocks: u32,
    padding: [u32; 2],
}

impl Frame {
    /// One tile of a camera's picture. `gain` amplifies a difference; nothing else reads it.
    pub fn new(camera: &Camera, tile: Tile, gain: f32) -> Self {
        let vector = |v: DVec3| v.as_vec3().to_array();
        let edge = Edge::of(&camera.observer);
        Frame {
            right: vector(camera.right),
            u: camera.observer.inverse_radius() as f32,
            down: vector(camera.down),
            lapse: camera.observer.lapse() as f32,
            forward: vector(camera.forward),
            gain,
            sky_x: vector(camera.sky_from_hole.x_axis),
            away_slope: edge.away_slope,
            sky_y: vector(camera.sky_from_hole.y_axis),
            half_edge_cos: 0.0,
            sky_z: vector(camera.sky_from_hole.z_axis),
            half_edge_sin: 0.0,
            edge: [edge.tan_half, edge.log_weight],
            size: [camera.width, camera.height],
            first: tile.first,
            count: tile.count,
            lists: 0,
            blocks: 0,
            padding: [0; 2],
        }
    }

    /// The same tile of a filtered picture: with this shadow, its first list of blocks and its first block.
    pub fn filtered(self, shadow: Shadow, lists: u32, blocks: u32) -> Self {
        Frame {
            half_edge_cos: shadow.half_cos as f32,
            half_edge_sin: shadow.half_sin as f32,
            lists,
            blocks,
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::{Output, Store, shader_source};
    use crate::scene::{Method, Sampling};
    use lensbake_tables::Interpolation;
    use std::mem::offset_of;

    #[test]
    fn the_layout_is_the_shaders() {
        let source = shader_source(
            Method::Flat,
            Sampling::Single,
            Output::Trace,
            Store::Buffer,
            64,
            Interpolation::Hermite,
            false,
        );
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let (members, span) = module
            .types
            .iter()
            .find_map(|(_, t)| match &t.inner {
                naga::TypeInner::Struct { members, span } if t.name.as_deref() == Some("Frame") => {
                    Some((members, *span))
                }
                _ => None,
            })
            .unwrap();
        let offset = |name: &str| {
            let member = members.iter().find(|m| m.name.as_deref() == Some(name));
            member.unwrap_or_else(|| panic!("no member {name}")).offset as usize
        };
        macro_rules! same_offsets {
            ($($name:ident),*) => {
                $(assert_eq!(offset(stringify!($name)), offset_of!(Frame, $name), stringify!($name));)*
                assert_eq!(members.len(), [$(stringify!($name)),*].len());
            };
        }
        same_offsets!(
            right,
            u,
            down,
            lapse,
            forward,
            sky_x,
            away_slope,
            gain,
            sky_y,
            half_edge_cos,
            sky_z,
            half_edge_sin,
            edge,
            size,
            first,
            count,
            lists,
            blocks
        );
        assert_eq!(span as usize, size_of::<Frame>());
    }
}
