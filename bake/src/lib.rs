//! The questions that `bake query` answers, and the texts that `bake export` writes.

pub mod export;
pub mod query;
