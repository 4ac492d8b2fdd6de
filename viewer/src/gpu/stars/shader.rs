//! The shader texts of the stars, put together from the parts that differ and the parts that do not.

use super::data::INVERSE_PAIRS;
use super::nodes;
use crate::stars::images::FAINTEST;
use crate::stars::kernel::REACHES;
use lensbake_tables::inverse::{self, INVERSE_TEXELS};
use lensbake_tables::lookup;

/// Invocations of a workgroup.
pub(super) const WORKGROUP: u32 = 64;

/// The lens that bends the light.
pub(super) const BENT: &str = include_str!("../../shaders/lens_bent.wgsl");
/// The one that does not.
pub(super) const FLAT: &str = include_str!("../../shaders/lens_flat.wgsl");

const KERNEL: &str = include_str!("../../shaders/kernel.wgsl");
const FRAME: &str = include_str!("../../shaders/frame.wgsl");

/// Makes the lists, by one of the lenses.
pub(super) fn lists(lens: &str) -> String {
    let constants = format!(
        "const INVERSE_PAIRS: u32 = {INVERSE_PAIRS}u;\nconst INVERSE_LAST: u32 = {}u;\n\
         const FAINTEST: f32 = {FAINTEST:e};\n",
        INVERSE_TEXELS - 1,
    );
    [
        &constants,
        &reaches(),
        lookup::ARITHMETIC_WGSL,
        inverse::WGSL,
        FRAME,
        KERNEL,
        &nodes::wgsl(),
        include_str!("../../shaders/stars.wgsl"),
        lens,
    ]
    .join("\n")
}

/// Keeps what a pixel of a picture sees: the sky, and the stars before it if there are any.
pub(in crate::gpu) fn keep(stars: bool) -> String {
    let light = if stars {
        &[
            &reaches(),
            KERNEL,
            &nodes::wgsl(),
            include_str!("../../shaders/star_light.wgsl"),
        ]
        .join("\n")
    } else {
        "fn star_light(pixel: vec2<u32>) -> vec3<f32> { return vec3(0.0); }\n"
    };
    [light, include_str!("../../shaders/keep.wgsl")].join("\n")
}

fn reaches() -> String {
    let [core, first_halo, .., last_halo] = REACHES;
    format!(
        "const CORE: f32 = {core:e};\nconst FIRST_HALO: f32 = {first_halo:e};\n\
         const LAST_HALO: f32 = {last_halo:e};\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::tests::validate;

    #[test]
    fn they_are_valid() {
        for lens in [BENT, FLAT] {
            validate(&lists(lens), &["sort_stars"]);
        }
    }
}
