//! Sliders into which numbers can be typed.

use egui::{Slider, SliderClamping};

/// A slider that also accepts typed numbers beyond its ends. A typed number takes effect when it is complete,
/// because its first digits alone may be invalid.
pub fn typed(slider: Slider<'_>) -> Slider<'_> {
    slider
        .clamping(SliderClamping::Never)
        .update_while_editing(false)
}
