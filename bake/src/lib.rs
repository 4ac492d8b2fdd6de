//! Baking bending tables and checking them: what the `bake` program is made of.

pub mod baker;
pub mod chart;
pub mod diff;
pub mod measure;
pub mod methods;
pub mod plot;
pub mod query;
pub mod rays;
pub mod stability;
