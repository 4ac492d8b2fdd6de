//! Frames that are prepared and only need to be submitted.

use super::timestamps::PassTimestamps;
use wgpu::*;

/// A frame in several passes, which are submitted one by one because a driver resets a GPU that is busy for
/// seconds.
pub trait Passes {
    /// Number of passes.
    fn count(&self) -> usize;

    /// Encodes one pass; `timestamps` records when it begins and ends.
    fn encode(&self, encoder: &mut CommandEncoder, pass: usize, timestamps: Option<PassTimestamps>);
}
