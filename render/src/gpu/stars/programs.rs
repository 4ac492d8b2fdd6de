//! The compute pipelines that make the star lists.

use super::data::INVERSE_PAIRS;
use super::nodes::{self, Group};
use crate::gpu::bindings::{
    storage_buffer_binding, storage_texture_binding, uint_texture_binding, uniform_binding,
};
use crate::gpu::camera_key::CameraKey;
use crate::gpu::compute::ComputeShader;
use crate::gpu::source::{alias_module, define_shift};
use crate::shaders::Modules;
use crate::shift::Shift;
use lensbake_tables::inverse::INVERSE_TEXELS;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use wgpu::*;

/// Invocations per workgroup.
pub(super) const WORKGROUP: u32 = 64;

/// The modules that find the images of a star: with bending, and without.
const BENT: &str = "star_images_bent";
const FLAT: &str = "star_images_flat";

/// The compute pipelines that make a star list for each group of pixels. They do not depend on the stars.
#[derive(Debug)]
pub(in crate::gpu) struct StarPrograms {
    device: Device,
    pub(super) group: Group,
    lists: Mutex<HashMap<ListKey, Arc<ComputeShader>>>,
    pub(super) list_pieces: ComputeShader,
    pub(super) sum_overflows: ComputeShader,
    pub(super) link_sums: ComputeShader,
}

/// What the program that lists the images of the stars is specialised for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct ListKey {
    /// Whether light is deflected.
    pub(super) bent: bool,
    /// The camera's motion.
    pub(super) motion: CameraKey,
    /// What of the frequency shift is shown.
    pub(super) shift: Shift,
}

impl ListKey {
    /// The key of a camera at rest, without frequency shift.
    pub(super) const AT_REST: ListKey = ListKey {
        bent: true,
        motion: CameraKey::AT_REST,
        shift: Shift::Off,
    };

    /// The WGSL source that makes a star list for each `group` of pixels.
    pub(super) fn source(self, group: Group) -> String {
        let mut modules = modules(group);
        modules.define(
            "star_images",
            alias_module(if self.bent { BENT } else { FLAT }),
        );
        self.motion.define(&mut modules);
        define_shift(&mut modules, self.shift);
        modules.assemble(&["list_stars"])
    }
}

impl StarPrograms {
    pub(in crate::gpu) fn new(device: &Device, group: Group) -> Self {
        let uniform = uniform_binding(false);
        let (read, write) = (storage_buffer_binding(true), storage_buffer_binding(false));
        let written_nodes = storage_texture_binding(nodes::FORMAT);
        let shader = |name, bindings: &[BindingType]| {
            ComputeShader::new(device, name, bindings, modules(group).assemble(&[name]))
        };
        StarPrograms {
            lists: Mutex::default(),
            list_pieces: shader(
                "list_pieces",
                &[uniform, write, written_nodes, uniform, read],
            ),
            sum_overflows: shader(
                "sum_overflow_lists",
                &[uniform, write, uint_texture_binding()],
            ),
            link_sums: shader("link_overflow_sums", &[uniform, write, written_nodes]),
            device: device.clone(),
            group,
        }
    }

    /// The program that lists the images of the stars. Compiles it the first time.
    pub(super) fn list(&self, key: ListKey) -> Arc<ComputeShader> {
        let uniform = uniform_binding(false);
        let (read, write) = (storage_buffer_binding(true), storage_buffer_binding(false));
        let written_nodes = storage_texture_binding(nodes::FORMAT);
        let bindings = [uniform, write, written_nodes, uniform, read, read];
        let source = || key.source(self.group);
        let compile = || ComputeShader::new(&self.device, "list_stars", &bindings, source());
        let mut lists = self.lists.lock().unwrap_or_else(PoisonError::into_inner);
        lists
            .entry(key)
            .or_insert_with(|| Arc::new(compile()))
            .clone()
    }
}

/// The WGSL modules of all programs that make star lists, with the constants of `group`, the pixels that share a list.
fn modules(group: Group) -> Modules {
    let mut modules = Modules::new();
    group.define(&mut modules);
    modules.define(
        "inverse_constants",
        format!(
            "const INVERSE_PAIRS: u32 = {INVERSE_PAIRS}u;\nconst INVERSE_LAST: u32 = {}u;\n",
            INVERSE_TEXELS - 1
        ),
    );
    modules
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::gpu::source::tests::validate;

    /// The WGSL source that makes the star lists with bending.
    pub(in crate::gpu::stars) fn bent_source() -> String {
        ListKey::AT_REST.source(Group::Rows)
    }

    /// The WGSL source that puts the pieces of arcs into the star lists.
    pub(in crate::gpu::stars) fn pieces_source() -> String {
        modules(Group::Rows).assemble(&["list_pieces"])
    }

    #[test]
    fn they_are_valid() {
        for bent in [false, true] {
            for motion in [CameraKey::AT_REST, CameraKey::BOOSTED] {
                for shift in [Shift::Off, Shift::Brightness, Shift::Colour] {
                    let key = ListKey {
                        bent,
                        motion,
                        shift,
                    };
                    for group in [Group::Rows, Group::Tile] {
                        validate(&key.source(group), &["list_stars"]);
                    }
                }
            }
        }
        for name in ["list_pieces", "sum_overflow_lists", "link_overflow_sums"] {
            for group in [Group::Rows, Group::Tile] {
                validate(&modules(group).assemble(&[name]), &[name]);
            }
        }
    }
}
