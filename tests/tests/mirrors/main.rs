//! Every WGSL function that has a mirror in Rust, probed on the available adapter: the mirror computes the same in
//! f32 by the same operations, so that the two agree up to rounding. (Functions whose Rust version is a reference
//! in f64 are checked in `references.rs`.)

mod display;
mod inverse;
mod lookup;
mod stereographic;
