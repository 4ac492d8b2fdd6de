//! The places of the lists of stars: `shaders/star_node.wgsl`.

use crate::gpu::texture::texture;
use wgpu::*;

/// Pixels across and down that share a list.
pub(super) const SHARING: [u32; 2] = [8, 2];
/// Texels across and down for the places of all lists, 32 MiB. The first is none.
const TEXELS: [u32; 2] = [2048, 1024];
/// Places of all lists.
const PLACES: u32 = TEXELS[0] * TEXELS[1];
/// The first of all places, which nobody counts list by list: counting takes time in every frame.
const UNCOUNTED: u32 = 1 << 15;
/// Places of an overflow list; so many more has the list of a group.
const LIST: u32 = 1 << 13;
/// The power of 2 that there are overflow lists.
const OVERFLOW_BITS: u32 = 9;
/// Lists for what the groups' own have no room for.
const OVERFLOWS: u32 = 1 << OVERFLOW_BITS;
/// Places for the sums of the overflow lists, the last: one a pixel of each.
const SUMS: u32 = OVERFLOWS * SHARING[0] * SHARING[1];
/// The other places.
const ROOM: u32 = PLACES - SUMS;
/// Invocations that add up the overflow lists: one a pixel of each, four lists one after the other.
pub(super) const FOLDING: u32 = SUMS / 4;
/// Format of a place.
pub(super) const FORMAT: TextureFormat = TextureFormat::Rgba32Uint;

/// The shader text of a place.
pub(super) fn wgsl() -> String {
    let ([x, y], [across, _]) = (SHARING, TEXELS);
    format!(
        "const SHARING_X: u32 = {x}u;\nconst SHARING_Y: u32 = {y}u;\n\
         const PLACES_A_ROW: u32 = {across}u;\nconst ROOM: u32 = {ROOM}u;\n\
         const UNCOUNTED: u32 = {UNCOUNTED}u;\nconst LIST: u32 = {LIST}u;\nconst OVERFLOW_BITS: u32 = {OVERFLOW_BITS}u;\n\
         const OVERFLOWS: u32 = {OVERFLOWS}u;\nconst A_GROUP: u32 = {}u;\n{}\n{}",
        ROOM / LIST,
        include_str!("../../shaders/star_node.wgsl"),
        include_str!("../../shaders/star_heads.wgsl")
    )
}

/// Bytes that say how many places were asked for and where the lists of a picture of `size` pixels begin, as
/// `shaders/star_heads.wgsl` has them.
pub(super) fn heads_bytes([width, height]: [u32; 2]) -> u64 {
    let [x, y] = SHARING;
    let overflows = u64::from(OVERFLOWS * (2 + 3 * x * y));
    let groups = u64::from(width.div_ceil(x)) * u64::from(height.div_ceil(y));
    4 * (1 + overflows + groups + groups.div_ceil(2))
}

/// Whether there are places for as many as were `asked` for.
pub(super) fn suffice(asked: u32) -> bool {
    asked < ROOM
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
    fn there_are_more_overflow_lists_than_the_places_can_fill() {
        // One for either group of a pair when their list is full, and again with each further LIST places.
        let most = 2 * ((ROOM - UNCOUNTED - 1) / LIST);
        assert!(most < OVERFLOWS, "{most}");
        // llvmpipe ends the loops of a shader after 65,535 turns: some are left to direct integration.
        let [x, y] = SHARING;
        let longest = UNCOUNTED + LIST + (ROOM / LIST) * x * y;
        assert!(longest < 65_535 - 20_000 && 4 * LIST < 65_535, "{longest}");
        // An owner is a group and which of its overflow lists, in 32 bits; a place is in 26.
        let groups = u64::from(MAX_SIDE.div_ceil(x)) * u64::from(MAX_SIDE.div_ceil(y));
        assert!((groups + 1) * u64::from(ROOM / LIST) <= u64::from(u32::MAX));
        const { assert!(PLACES < 1 << 26) };
    }

    #[test]
    fn any_device_has_room_for_the_lists_of_the_largest_picture() {
        let most = Limits::default().max_storage_buffer_binding_size;
        assert!(heads_bytes([MAX_SIDE; 2]) <= most);
    }
}
