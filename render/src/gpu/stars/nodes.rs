//! Sizes of the star lists, which are linked lists, the pixels that share one, and of the texture that holds their nodes.
//! `shaders/star_node.wgsl` and `shaders/star_list_heads.wgsl` describe both.

use crate::gpu::texture::texture;
use crate::shaders::{Modules, TILE};
use wgpu::*;

/// The pixels that share a list. `shaders/star_node.wgsl` calls them a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in crate::gpu) enum Group {
    /// 8 × 2 pixels. Each pixel sums up the list by itself.
    Rows,
    /// A tile of 8 × 8 pixels. Each of its columns sums up the list once for its 8 pixels.
    Tile,
}

/// Width and height of the texture that holds the nodes of all lists, 32 MiB. Node 0 is null.
const TEXELS: [u32; 2] = [2048, 1024];
/// Number of nodes.
const NODES: u32 = TEXELS[0] * TEXELS[1];
/// Largest number of nodes of an overflow list, and of counted nodes in the list of a group.
const LIST: u32 = 1 << 13;
/// Binary logarithm of the number of overflow lists.
const OVERFLOW_BITS: u32 = 9;
/// Number of overflow lists, for the nodes that do not fit into the groups' own lists.
const OVERFLOWS: u32 = 1 << OVERFLOW_BITS;
/// The heads of a row of groups are padded to a multiple of this number: a buffer that is copied to a texture must have rows
/// of a multiple of 256 bytes.
const LISTS_ALIGNMENT: u32 = COPY_BYTES_PER_ROW_ALIGNMENT / size_of::<u32>() as u32;
/// Texture format of a list head.
const HEAD_FORMAT: TextureFormat = TextureFormat::R32Uint;
/// Texture format of a node.
pub(super) const FORMAT: TextureFormat = TextureFormat::Rgba32Uint;

impl Group {
    /// Width and height, pixels.
    const fn size(self) -> [u32; 2] {
        match self {
            Group::Rows => [TILE, 2],
            Group::Tile => [TILE, TILE],
        }
    }

    /// Number of nodes that are not counted list by list, because counting takes time in every frame. They are the first nodes
    /// of a picture.
    const fn uncounted(self) -> u32 {
        match self {
            Group::Rows => 1 << 15,
            Group::Tile => 1 << 14,
        }
    }

    /// Number of nodes that are reserved for the sums of the overflow lists: one for each pixel of each list. They are the last
    /// nodes of the texture.
    const fn sums(self) -> u32 {
        OVERFLOWS * self.size()[0] * self.size()[1]
    }

    /// Number of the other nodes, which hold star images.
    const fn capacity(self) -> u32 {
        NODES - self.sums()
    }

    /// Invocations that sum up the overflow lists: each sums up one pixel of four lists, one after the other.
    pub(super) fn sum_invocations(self) -> u32 {
        self.sums() / 4
    }

    /// Whether there are enough nodes if `requested` were requested.
    pub(super) fn fits(self, requested: u32) -> bool {
        requested < self.capacity()
    }

    /// Defines the shader module `star_node_constants`: these sizes as WGSL constants.
    pub(in crate::gpu) fn define(self, modules: &mut Modules) {
        let [width, height] = self.size();
        let constants = [
            ("GROUP_WIDTH", width),
            ("GROUP_HEIGHT", height),
            ("NODES_PER_ROW", TEXELS[0]),
            ("LISTS_ALIGNMENT", LISTS_ALIGNMENT),
            ("CAPACITY", self.capacity()),
            ("UNCOUNTED", self.uncounted()),
            ("LIST", LIST),
            ("OVERFLOW_BITS", OVERFLOW_BITS),
            ("OVERFLOWS", OVERFLOWS),
            // One more than the number of overflow lists that a group can have.
            ("OVERFLOWS_PER_GROUP", self.capacity() / LIST),
        ];
        let text = constants.map(|(name, value)| format!("const {name}: u32 = {value}u;\n"));
        modules.define("star_node_constants", text.concat());
    }

    /// Number of groups in a row and in a column of a picture of `width` × `height` pixels.
    fn groups(self, [width, height]: [u32; 2]) -> [u32; 2] {
        let [x, y] = self.size();
        [width.div_ceil(x), height.div_ceil(y)]
    }

    /// Number of u32 before the heads of the groups' lists: see `shaders/star_list_heads.wgsl`.
    fn first_head(self) -> u32 {
        1 + OVERFLOWS * (2 + 3 * self.size()[0] * self.size()[1])
    }

    /// Bytes of the buffer of the list heads of a picture of `size` pixels: see `shaders/star_list_heads.wgsl`.
    pub(super) fn list_heads_bytes(self, size: [u32; 2]) -> u64 {
        let [across, down] = self.groups(size);
        let across = across.next_multiple_of(LISTS_ALIGNMENT);
        let lists = u64::from(across) * u64::from(down);
        4 * (u64::from(self.first_head()) + lists + lists.div_ceil(2))
    }

    /// Creates the texture to which the heads of the groups' lists are copied, for pictures of at most `size` pixels.
    pub(super) fn head_texture(self, device: &Device, size: [u32; 2]) -> Texture {
        let usage = TextureUsages::COPY_DST | TextureUsages::TEXTURE_BINDING;
        texture(
            device,
            "heads of lists",
            self.groups(size),
            HEAD_FORMAT,
            usage,
        )
    }

    /// Encodes the copy of the heads of the groups' lists of a picture of `size` pixels to the texture.
    pub(super) fn copy_heads(
        self,
        encoder: &mut CommandEncoder,
        heads: &Buffer,
        to: &Texture,
        size: [u32; 2],
    ) {
        let [width, height] = self.groups(size);
        let lists = width.next_multiple_of(LISTS_ALIGNMENT);
        let layout = TexelCopyBufferLayout {
            offset: 4 * u64::from(self.first_head()),
            bytes_per_row: Some(4 * lists),
            rows_per_image: None,
        };
        let size = Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let heads = TexelCopyBufferInfo {
            buffer: heads,
            layout,
        };
        encoder.copy_buffer_to_texture(heads, to.as_image_copy(), size);
    }
}

/// Creates the texture that holds all nodes.
pub(super) fn node_texture(device: &Device) -> Texture {
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
    texture(device, "nodes", TEXELS, FORMAT, usage)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::MAX_SIDE;
    use crate::stars::kernel::REACHES;

    const GROUPS: [Group; 2] = [Group::Rows, Group::Tile];

    #[test]
    fn there_are_more_overflow_lists_than_the_nodes_can_fill() {
        for group in GROUPS {
            // Each time that the count of a pair of groups reaches another LIST nodes, both groups may claim an
            // overflow list.
            let most = 2 * ((group.capacity() - group.uncounted() - 1) / LIST);
            assert!(most < OVERFLOWS, "{most}");
            // llvmpipe ends the loops of a shader after 65,535 iterations in total: 20,000 are left for direct
            // integration.
            let [x, y] = group.size();
            let longest = group.uncounted() + LIST + (group.capacity() / LIST) * x * y;
            assert!(longest < 65_535 - 20_000 && 4 * LIST < 65_535, "{longest}");
            // An owner combines a group and the number of one of its overflow lists in 32 bits. The index of a node
            // has 26 bits.
            let [across, down] = group.groups([MAX_SIDE; 2]);
            let lists = u64::from(across.next_multiple_of(LISTS_ALIGNMENT)) * u64::from(down);
            assert!((lists + 1) * u64::from(group.capacity() / LIST) <= u64::from(u32::MAX));
        }
        const { assert!(NODES < 1 << 26) };
    }

    #[test]
    fn any_device_has_room_for_the_lists_of_the_largest_picture() {
        let most = Limits::default();
        for group in GROUPS {
            let bytes = group.list_heads_bytes([MAX_SIDE; 2]);
            assert!(bytes <= most.max_storage_buffer_binding_size, "{bytes}");
            let groups = group.groups([MAX_SIDE; 2]);
            assert!(
                groups.iter().max() <= Some(&most.max_texture_dimension_2d),
                "{groups:?}"
            );
        }
    }

    #[test]
    fn the_halos_are_those_of_the_shader_and_a_node_can_hold_how_far_away_an_image_is() {
        for (kernel, reach) in (1..).zip(&REACHES[1..]) {
            assert_eq!(*reach, 2f64.powi(kernel + 1));
        }
        // star_node.wgsl stores a coordinate in 20 bits, in steps of 1/8192 pixel from 64 pixels before the group.
        let farthest = REACHES.into_iter().fold(0.0, f64::max) + 1.0;
        assert!(farthest < 64.0);
        assert!(f64::from(TILE) + farthest < 128.0 - 64.0);
    }
}
