//! The disc of a picture on the device: its uniform block and its bind group. A test compares its layout with the one
//! that naga computes for `disc_block.wgsl`.

use super::bindings::{bind_group, uniform_buffer};
use crate::disc::{COEFFICIENTS, Disc, SeenDisc};
use crate::lens::Lens;
use crate::shift::{Rendition, Shift};
use lensbake_core::accretion::{BRIGHTEST_RADIUS, page_thorne};
use wgpu::*;

/// The struct `Disc` of `shaders/disc_block.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct DiscBlock {
    axis: [f32; 3],
    opacity: f32,
    inner_u: f32,
    inner_least: f32,
    outer_u: f32,
    outer_least: f32,
    phases: [f32; 3 * COEFFICIENTS],
    luminance: f32,
    relative: f32,
    inverse_kelvin: f32,
    shifts_brightness: f32,
    shifts_colour: f32,
    contrast: f32,
    padding: [f32; 2],
    node: [f32; 3],
    padding_of_node: f32,
    ages: [f32; 2],
    weights: [f32; 2],
    seeds: [u32; 2],
    padding_of_end: [f32; 2],
}

/// Bytes of the uniform block of a disc.
pub const DISC_BYTES: usize = size_of::<DiscBlock>();

impl DiscBlock {
    fn new(lens: &Lens, disc: Disc, rendition: Rendition) -> Self {
        let seen = SeenDisc::new(lens, disc, rendition);
        let [inner, outer] = seen.rims();
        let mut phases = [0.0; 3 * COEFFICIENTS];
        // An observer within the inner rim sees no leg before its periapsis, so that his circle is not needed.
        let circles = [inner, outer, seen.observer_circle().unwrap_or(inner)];
        let coefficients = circles.iter().flat_map(|rim| rim.coefficients);
        for (phase, coefficient) in phases.iter_mut().zip(coefficients) {
            *phase = coefficient as f32;
        }
        let (pattern, node) = seen.pattern().unwrap_or_default();
        let relative = 1.0 / page_thorne(BRIGHTEST_RADIUS);
        let shows = |shift: bool| if shift { 1.0 } else { 0.0 };
        DiscBlock {
            axis: seen.axis().as_vec3().to_array(),
            opacity: disc.opacity as f32,
            inner_u: inner.u as f32,
            inner_least: inner.least_sq as f32,
            outer_u: outer.u as f32,
            outer_least: outer.least_sq as f32,
            phases,
            luminance: (disc.brightness * relative) as f32 * seen.scale(),
            relative: relative as f32,
            inverse_kelvin: (1.0 / disc.peak_kelvin) as f32,
            shifts_brightness: shows(disc.shift != Shift::Off),
            shifts_colour: shows(disc.shift == Shift::Colour),
            contrast: pattern.contrast as f32,
            padding: [0.0; 2],
            node: node.as_vec3().to_array(),
            padding_of_node: 0.0,
            ages: pattern.layers.map(|layer| layer.age as f32),
            weights: pattern.layers.map(|layer| layer.weight as f32),
            seeds: pattern.layers.map(|layer| layer.seed),
            padding_of_end: [0.0; 2],
        }
    }
}

/// The disc of one picture.
#[derive(Debug)]
pub(super) struct DiscOnDevice {
    block: Buffer,
    bind_group: BindGroup,
}

impl DiscOnDevice {
    /// Room for a disc.
    pub(super) fn new(device: &Device, layout: &BindGroupLayout) -> Self {
        let block = uniform_buffer(device, "disc", size_of::<DiscBlock>() as u64);
        DiscOnDevice {
            bind_group: bind_group(device, "disc", layout, [block.as_entire_binding()]),
            block,
        }
    }

    /// Uploads `disc` as it is seen through `lens`.
    pub(super) fn show(&self, queue: &Queue, lens: &Lens, disc: Disc, rendition: Rendition) {
        let block = DiscBlock::new(lens, disc, rendition);
        queue.write_buffer(&self.block, 0, bytemuck::bytes_of(&block));
    }

    /// The bind group with which programs read it.
    pub(super) fn bind_group(&self) -> &BindGroup {
        &self.bind_group
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::layouts::assert_layout;
    use crate::shaders::wgsl;

    #[test]
    fn the_layout_is_the_shader_s() {
        assert_layout!(
            &wgsl(&["disc_block"]),
            "Disc",
            DiscBlock,
            axis,
            opacity,
            inner_u,
            inner_least,
            outer_u,
            outer_least,
            phases,
            luminance,
            relative,
            inverse_kelvin,
            shifts_brightness,
            shifts_colour,
            contrast,
            node,
            ages,
            weights,
            seeds,
        );
    }
}
