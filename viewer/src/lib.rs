//! Draws the sky as a black hole bends it.
//!
//! A [`scene::Scene`] says who looks where at what; [`cpu`] and [`gpu`] draw it. Lookup, direct
//! integration and the undeflected sky differ only in who turns the light ([`deflect`] on the CPU,
//! `shaders/deflect_*.wgsl` on the GPU): camera, sky and shading are one text, so the difference of
//! their pictures is the table's error and nothing else.

pub mod bench;
pub mod camera;
pub mod chart;
pub mod cpu;
pub mod deflect;
pub mod diff;
pub mod filtered;
pub mod flicker;
pub mod footprint;
pub mod gpu;
pub mod heat_map;
pub mod model;
pub mod picture;
pub mod reference;
pub mod scene;
pub mod shadow;
pub mod sky;
pub mod stars;
pub mod tone_map;
pub mod window;
