//! The places of the lists of stars: `shaders/star_node.wgsl`.

use wgpu::*;

/// Pixels across and down that share a list.
pub(super) const SHARING: [u32; 2] = [8, 2];
/// Texels across and down for the places of all lists, 32 MiB. The first is none.
const TEXELS: [u32; 2] = [2048, 1024];
/// Format of a place.
pub(super) const FORMAT: TextureFormat = TextureFormat::Rgba32Uint;

/// The shader text of a place.
pub(super) fn wgsl() -> String {
    let ([x, y], [across, down]) = (SHARING, TEXELS);
    format!(
        "const SHARING_X: u32 = {x}u;\nconst SHARING_Y: u32 = {y}u;\n\
         const PLACES_A_ROW: u32 = {across}u;\nconst PLACES: u32 = {}u;\n{}",
        across * down,
        include_str!("../../shaders/star_node.wgsl")
    )
}

/// The lists of a picture of `size` pixels.
pub(in crate::gpu) fn lists([width, height]: [u32; 2]) -> u64 {
    let [x, y] = SHARING;
    u64::from(width.div_ceil(x)) * u64::from(height.div_ceil(y))
}

/// Whether there are places for as many as were `asked` for.
pub(super) fn suffice(asked: u32) -> bool {
    let [across, down] = TEXELS;
    asked < across * down
}

/// A texture of all places.
pub(super) fn texture(device: &Device) -> Texture {
    let [width, height] = TEXELS;
    device.create_texture(&TextureDescriptor {
        label: Some("nodes"),
        size: Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format: FORMAT,
        usage: TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}
