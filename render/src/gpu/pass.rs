//! The two kinds of passes that draw a picture.

use super::Gpu;

/// How a picture is drawn on a GPU. Both kinds draw the same light, up to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Pass {
    /// By compute passes. The tiles of a filtered picture are classified, and each class is drawn by a program of its
    /// own.
    Compute,
    /// By render passes: one triangle over each region, whose fragments are the pixels. One program draws all of
    /// them. This is the only way on a device without compute shaders, such as one of WebGL2.
    Fragment,
}

impl Pass {
    /// The kind that [`super::Renderer::new`] chooses: compute passes where the device has them.
    pub fn default_on(gpu: &Gpu) -> Self {
        if gpu.has_compute() {
            Pass::Compute
        } else {
            Pass::Fragment
        }
    }
}
