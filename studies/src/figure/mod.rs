//! Figures and the numbers beside them: drawing, the log–log plane, labels, CSV fields, times, and the Pareto front.

pub mod csv;
pub mod drawing;
mod font;
mod labels;
mod pareto;
mod pixel_box;
mod plane;
mod time;

pub use labels::Labels;
pub use pareto::front;
pub use pixel_box::PixelBox;
pub use plane::{LogAxis, Plane, Ticks};
pub use time::{Time, median};
