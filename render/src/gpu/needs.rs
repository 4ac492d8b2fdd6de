//! What is asked of an adapter when its device is opened.

use wgpu::*;

/// What is asked of an adapter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Needs {
    /// Whatever of it the renderer can use.
    Most,
    /// What WebGL2 has.
    WebGl2,
}

impl Needs {
    /// Features of the device.
    pub(super) fn features(self, adapter: &Adapter) -> Features {
        match self {
            // For timing frames and for rows of 16-bit integers, if the adapter can.
            Needs::Most => {
                adapter.features()
                    & (Features::TIMESTAMP_QUERY | Features::TEXTURE_FORMAT_16BIT_NORM)
            }
            Needs::WebGl2 => Features::empty(),
        }
    }

    /// Limits that the adapter meets. A window may be as large as its largest texture.
    pub(super) fn limits(self, adapter: &Adapter) -> Limits {
        let has = adapter.limits();
        let asked = if self == Needs::Most && has_compute(&has) {
            Limits {
                max_texture_dimension_2d: has.max_texture_dimension_2d,
                ..Limits::default()
            }
        } else {
            Limits::downlevel_webgl2_defaults().using_resolution(has.clone())
        };
        asked.or_worse_values_from(&has)
    }
}

/// Whether a device with these limits has compute shaders and what they write: storage buffers and storage textures.
pub(super) fn has_compute(limits: &Limits) -> bool {
    limits.max_compute_workgroups_per_dimension > 0
        && limits.max_storage_buffers_per_shader_stage > 0
        && limits.max_storage_textures_per_shader_stage > 0
}
