//! The bind groups of what a picture shows: sky, stars and disc.

use super::SkyOnDevice;
use crate::filter::TileClass;
use crate::scene::Sampling;
use wgpu::BindGroup;

/// What a program draws; a program binds only what it draws, in this order, from group 1 on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lights<'a> {
    pub(super) on_sky: Option<&'a SkyOnDevice>,
    /// How a pixel samples the sky.
    pub(super) sampling: Sampling,
    /// The star lists.
    pub(super) stars: Option<&'a BindGroup>,
    pub(super) disc: Option<&'a BindGroup>,
}

impl<'a> Lights<'a> {
    /// The sky.
    pub(super) fn sky(&self) -> Option<&'a BindGroup> {
        Some(self.on_sky?.bind_group(self.sampling))
    }

    /// The sky as the program of a tile class samples it: the first mip level alone, where no other is needed.
    pub(super) fn sky_of(&self, class: TileClass) -> Option<&'a BindGroup> {
        let sampling = match (class, self.sampling) {
            (TileClass::Shadow | TileClass::OneTap, _)
            | (TileClass::FirstLevel, Sampling::Filtered) => Sampling::Single,
            (_, sampling) => sampling,
        };
        Some(self.on_sky?.bind_group(sampling))
    }

    /// All groups, in the order of their indices.
    pub(super) fn groups(&self) -> impl Iterator<Item = &'a BindGroup> {
        [self.sky(), self.stars, self.disc].into_iter().flatten()
    }
}
