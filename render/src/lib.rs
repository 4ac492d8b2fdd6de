//! Renders the sky past a black hole: gravitational lensing on the CPU and the GPU.
//!
//! A [`scene::Scene`] is a lens (a camera, and how the hole deflects its light: [`lens::Lens`]), a sky and stars;
//! [`cpu::render`] and [`gpu::Renderer::picture`] draw the same scene. Table lookup, direct integration and the
//! undeflected sky differ only in the deflection: camera, sky and shading are the same code, so the difference
//! between two of their pictures comes from the deflection alone.
//!
//! Nothing here waits for a GPU, reads a clock or starts a thread of its own: functions that talk to the device
//! are `async`, and the caller decides how to wait.

pub mod camera;
pub mod cpu;
pub mod diff;
pub mod disc;
pub mod exposure;
pub mod filter;
pub mod footprint;
pub mod gpu;
pub mod layers;
pub mod lens;
pub mod model;
pub mod openexr;
pub mod picture;
pub mod scene;
pub mod shaders;
pub mod shadow;
pub mod shift;
pub mod sky;
pub mod stars;
pub mod tone_map;
