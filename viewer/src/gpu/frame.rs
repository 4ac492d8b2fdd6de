//! The uniform block of a frame. A test holds its layout to what naga makes of `frame.wgsl`.

use crate::scene::{Method, Scene};
use glam::DVec3;
use lensbake_tables::lookup::Edge;

/// The struct `Frame` of `shaders/frame.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Frame {
    right: [f32; 3],
    width: u32,
    down: [f32; 3],
    height: u32,
    forward: [f32; 3],
    first_row: u32,
    sky_x: [f32; 3],
    u: f32,
    sky_y: [f32; 3],
    lapse: f32,
    sky_z: [f32; 3],
    step: f32,
    edge: [f32; 2],
    rows: u32,
    padding: u32,
}

impl Frame {
    /// The rows `first_row .. first_row + rows` of a scene's picture.
    pub fn new(scene: &Scene, first_row: u32, rows: u32) -> Self {
        let vector = |v: DVec3| v.as_vec3().to_array();
        let camera = &scene.camera;
        let edge = Edge::of(&camera.observer);
        Frame {
            right: vector(camera.right),
            width: camera.width,
            down: vector(camera.down),
            height: camera.height,
            forward: vector(camera.forward),
            first_row,
            sky_x: vector(camera.sky_from_hole.x_axis),
            u: camera.observer.inverse_radius() as f32,
            sky_y: vector(camera.sky_from_hole.y_axis),
            lapse: camera.observer.lapse() as f32,
            sky_z: vector(camera.sky_from_hole.z_axis),
            step: match scene.method {
                Method::Direct { step } => step as f32,
                Method::Lut | Method::Flat => 0.0,
            },
            edge: [edge.tan_half, edge.log_weight],
            rows,
            padding: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::{Output, shader_source};
    use lensbake_tables::Interpolation;
    use std::mem::offset_of;

    #[test]
    fn the_layout_is_the_shaders() {
        let source = shader_source(Method::Flat, Output::Trace, 64, Interpolation::Hermite);
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
            right, width, down, height, forward, first_row, sky_x, u, sky_y, lapse, sky_z, step,
            edge, rows
        );
        assert_eq!(span as usize, size_of::<Frame>());
    }
}
