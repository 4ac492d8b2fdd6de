//! The GPU: the device, and the renderer that draws a [`crate::scene::Scene`] on it.

mod device;
mod frame;
mod prepared;
mod renderer;
mod shader;
mod timer;

pub use device::{Gpu, GpuError};
pub use frame::Frame;
pub use prepared::{Band, Prepared};
pub use renderer::{Renderer, Trace};
pub use shader::{Output, shader_source};
pub use timer::{FrameTime, Timer};
