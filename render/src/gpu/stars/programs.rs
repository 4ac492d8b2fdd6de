//! The compute pipelines that make the star lists.

use super::data::INVERSE_PAIRS;
use super::nodes;
use crate::gpu::bindings::{
    storage_buffer_binding, storage_texture_binding, uint_texture_binding, uniform_binding,
};
use crate::gpu::compute::ComputeShader;
use crate::shaders::Modules;
use lensbake_tables::inverse::INVERSE_TEXELS;
use wgpu::*;

/// Invocations per workgroup.
pub(super) const WORKGROUP: u32 = 64;

/// The modules that find the images of a star: with bending, and without.
const BENT: &str = "star_images_bent";
const FLAT: &str = "star_images_flat";

/// The compute pipelines that make the star lists. They do not depend on the stars.
#[derive(Debug)]
pub(in crate::gpu) struct StarPrograms {
    pub(super) bent: ComputeShader,
    pub(super) flat: ComputeShader,
    pub(super) sum_overflows: ComputeShader,
    pub(super) link_sums: ComputeShader,
}

impl StarPrograms {
    pub(in crate::gpu) fn new(device: &Device) -> Self {
        let uniform = uniform_binding(false);
        let (read, write) = (storage_buffer_binding(true), storage_buffer_binding(false));
        let written_nodes = storage_texture_binding(nodes::FORMAT);
        let list = |images| {
            let bindings = [uniform, uniform, read, read, read, write, written_nodes];
            ComputeShader::new(device, "list_stars", &bindings, list_source(images))
        };
        let overflow = |name, nodes| {
            ComputeShader::new(
                device,
                name,
                &[uniform, write, nodes],
                overflow_source(name),
            )
        };
        StarPrograms {
            bent: list(BENT),
            flat: list(FLAT),
            sum_overflows: overflow("sum_overflow_lists", uint_texture_binding()),
            link_sums: overflow("link_overflow_sums", written_nodes),
        }
    }
}

/// The WGSL source that makes the star lists; `images` is the module that finds the images of a star.
pub(super) fn list_source(images: &str) -> String {
    let mut modules = Modules::new();
    nodes::define(&mut modules);
    modules.define("star_images", format!("// #import {images}\n"));
    modules.define(
        "inverse_constants",
        format!(
            "const INVERSE_PAIRS: u32 = {INVERSE_PAIRS}u;\nconst INVERSE_LAST: u32 = {}u;\n",
            INVERSE_TEXELS - 1
        ),
    );
    modules.assemble(&["list_stars"])
}

fn overflow_source(root: &str) -> String {
    let mut modules = Modules::new();
    nodes::define(&mut modules);
    modules.assemble(&[root])
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::gpu::source::tests::validate;

    /// The WGSL source that makes the star lists with bending.
    pub(in crate::gpu::stars) fn bent_source() -> String {
        list_source(BENT)
    }

    #[test]
    fn they_are_valid() {
        for images in [BENT, FLAT] {
            validate(&list_source(images), &["list_stars"]);
        }
        for name in ["sum_overflow_lists", "link_overflow_sums"] {
            validate(&overflow_source(name), &[name]);
        }
    }
}
