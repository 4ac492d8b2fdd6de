//! The atlas that ships with the project, in both containers, as `bake` without arguments writes it.

use crate::{Table, container};
use std::sync::LazyLock;

/// The default atlas as a binary file.
pub const ATLAS_BINARY: &[u8] = include_bytes!("../assets/atlas.lbt");
/// The default atlas as an OpenEXR file.
pub const ATLAS_EXR: &[u8] = include_bytes!("../assets/atlas.exr");

static ATLAS: LazyLock<Table> = LazyLock::new(|| {
    container::from_bytes(ATLAS_BINARY).expect("the shipped atlas is read by a test")
});

/// The default atlas: all radii above the horizon, in 64 KiB.
pub fn default_atlas() -> &'static Table {
    &ATLAS
}
