//! The GPU: the device, and the renderer that draws a [`crate::scene::Scene`] on it.

mod backend;
mod bindings;
mod blocks;
mod canvas;
mod device;
mod frame;
mod live;
mod prepared;
mod present;
mod renderer;
mod shader;
mod stamps;
mod stars;
mod step;
mod stopwatch;
mod texture;
mod timer;

pub use canvas::{Canvas, Target};
pub use device::{Gpu, GpuError};
pub use frame::{Frame, Tile};
pub use live::{Live, Show};
pub use prepared::{Prepared, band_pixels};
pub use present::{Edge, Presenter, Showing};
pub use renderer::{Program, Renderer, SkyOnDevice, Trace};
pub use shader::{Output, Store, entry_points, shader_source};
pub use stars::StarLight;
pub use stopwatch::{Lap, Stopwatch, Timed};
pub(crate) use texture::texture;
pub use timer::{FrameTime, Passes, Timer};
