//! Baking bending tables and checking them: what the `bake` program is made of.

pub mod baker;
pub mod diff;
pub mod font;
pub mod measure;
pub mod plot;
pub mod rays;
