//! The GPU: the device, and the renderer that draws a [`crate::scene::Scene`] on it.

mod canvas;
mod device;
mod frame;
mod prepared;
mod renderer;
mod shader;
mod stars;
mod timer;

pub use canvas::{Canvas, Target};
pub use device::{Gpu, GpuError};
pub use frame::{Frame, Tile};
pub use prepared::{Prepared, band_pixels};
pub use renderer::{Renderer, Trace};
pub use shader::{Output, Store, shader_source};
pub use timer::{FrameTime, Timer};
