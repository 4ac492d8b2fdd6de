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
        &kernels(),
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

/// Adds up the overflow lists.
pub(super) fn folding() -> String {
    [
        &kernels(),
        FRAME,
        KERNEL,
        &nodes::wgsl(),
        include_str!("../../shaders/star_list.wgsl"),
        include_str!("../../shaders/fold_stars.wgsl"),
    ]
    .join("\n")
}

/// Puts their sums into the lists of the groups.
pub(super) fn linking() -> String {
    [
        &kernels(),
        FRAME,
        KERNEL,
        &nodes::wgsl(),
        include_str!("../../shaders/link_stars.wgsl"),
    ]
    .join("\n")
}

/// Keeps what a pixel of a picture sees: the sky, and the stars before it if there are any.
pub(in crate::gpu) fn keep(stars: bool) -> String {
    if !stars {
        return include_str!("../../shaders/keep.wgsl").into();
    }
    [
        &kernels(),
        KERNEL,
        &nodes::wgsl(),
        include_str!("../../shaders/star_list.wgsl"),
        include_str!("../../shaders/star_light.wgsl"),
        include_str!("../../shaders/keep_stars.wgsl"),
    ]
    .join("\n")
}

fn kernels() -> String {
    let [core, halos @ ..] = REACHES;
    format!(
        "const CORE: f32 = {core:e};\nconst HALOS: u32 = {}u;\n",
        halos.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::tests::validate;

    #[test]
    fn the_halos_are_those_of_the_shader_and_a_place_can_tell_how_far_away_an_image_is() {
        for (kernel, reach) in (1..).zip(&REACHES[1..]) {
            assert_eq!(*reach, 2f64.powi(kernel + 1));
        }
        // The constants of star_node.wgsl: 20 bits of 1/8192 pixel, from 64 pixels before the group.
        let farthest = REACHES.into_iter().fold(0.0, f64::max) + 1.0;
        assert!(farthest < 64.0);
        assert!(f64::from(nodes::SHARING[0].max(nodes::SHARING[1])) + farthest < 128.0 - 64.0);
    }

    #[test]
    fn they_are_valid() {
        for lens in [BENT, FLAT] {
            validate(&lists(lens), &["sort_stars"]);
        }
        validate(&folding(), &["fold_stars"]);
        validate(&linking(), &["link_stars"]);
    }
}
