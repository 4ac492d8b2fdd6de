//! The places of the lists of stars: `shaders/star_node.wgsl`.

use crate::gpu::texture::texture;
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

/// Bytes that say how many places were asked for and where the lists of a picture of `size` pixels begin.
pub(super) fn heads_bytes([width, height]: [u32; 2]) -> u64 {
    let [x, y] = SHARING;
    4 * (1 + u64::from(width.div_ceil(x)) * u64::from(height.div_ceil(y)))
}

/// Whether there are places for as many as were `asked` for.
pub(super) fn suffice(asked: u32) -> bool {
    let [across, down] = TEXELS;
    asked < across * down
}

/// A texture of all places.
pub(super) fn places(device: &Device) -> Texture {
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
    texture(device, "nodes", TEXELS, FORMAT, usage)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::MAX_SIDE;

    #[test]
    fn any_device_has_room_for_the_lists_of_the_largest_picture() {
        let most = Limits::default().max_storage_buffer_binding_size;
        assert!(heads_bytes([MAX_SIDE; 2]) <= most);
    }
}
