//! The GPU: the device, and the renderer that draws a [`crate::scene::Scene`] on it.

mod device;
mod frame;
mod renderer;
mod shader;

pub use device::{Gpu, GpuError};
pub use frame::Frame;
pub use renderer::{Renderer, Trace};
pub use shader::{Output, shader_source};
