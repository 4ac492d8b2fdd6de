//! The font of all figures: embedded, since bare machines have none.

use plotters::style::{FontStyle, register_font};
use std::sync::Once;

static REGISTERED: Once = Once::new();

/// The name the font goes by; in an SVG file the viewer's own font of this name is drawn.
pub const FAMILY: &str = "sans-serif";

/// Makes the built-in font known to the drawing library; to be called before any figure is drawn.
pub fn register() {
    REGISTERED.call_once(|| {
        let font = epaint_default_fonts::UBUNTU_LIGHT;
        if register_font(FAMILY, FontStyle::Normal, font).is_err() {
            unreachable!("the embedded font is one, as the tests of the figures show");
        }
    });
}
