//! The questions that `bake query` answers.

pub mod query;
