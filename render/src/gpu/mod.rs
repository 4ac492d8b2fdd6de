//! The GPU renderer: opens the device and draws a [`crate::scene::Scene`] on it.

mod backend;
mod bindings;
mod camera_block;
mod camera_key;
mod compute;
mod compute_pass;
mod device;
mod disc_block;
mod failure;
mod fragment_pass;
mod frame_resources;
mod layouts;
mod lights;
mod lookup_shape;
mod needs;
mod pass;
mod passes;
mod pipelines;
mod prepared;
mod present;
mod realtime;
mod region;
mod render_pipeline;
mod renderer;
mod row_texture;
mod sky;
mod source;
mod stars;
mod stopwatch;
mod target;
mod texture;
mod tile_queues;
mod timestamps;

pub use camera_block::{CameraBlock, UNIFORM_BYTES};
pub use camera_key::CameraKey;
pub use device::{Gpu, GpuError};
pub use disc_block::DISC_BYTES;
pub use lookup_shape::LookupShape;
pub use pass::Pass;
pub use passes::Passes;
pub use prepared::Prepared;
pub use present::{EdgeMode, Presentation, Presenter};
pub use realtime::{FrameContent, RealtimeRenderer};
pub use region::Region;
pub use renderer::{Renderer, Trace};
pub use row_texture::row_texture_format;
pub use sky::{SkyOnDevice, SkyUpload};
pub use source::{Output, PipelineKey, Store};
pub use stars::{StarLight, StarsOnDevice};
pub use stopwatch::{Lap, Stopwatch, Timed};
pub use texture::texture;
pub use timestamps::{PassTimestamps, Timestamps, elapsed};

/// A scene whose sky and stars are on the device.
pub type ResidentScene = crate::scene::Scene<SkyOnDevice, StarsOnDevice>;
