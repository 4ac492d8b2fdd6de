//! The two kinds of passes that draw a picture.

use super::Gpu;
use super::source::Output;
use crate::scene::Sampling;

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
    /// The faster kind for `output` on this device, which [`super::Renderer::new`] chooses: compute passes where there are
    /// compute shaders, but render passes for pictures of one ray per pixel on a software adapter. `docs/bench.md` has the
    /// measurements.
    pub fn fastest_on(gpu: &Gpu, output: Output) -> Self {
        let single = output == Output::Picture(Sampling::Single);
        if gpu.has_compute() && !(single && gpu.is_software()) {
            Pass::Compute
        } else {
            Pass::Fragment
        }
    }
}
