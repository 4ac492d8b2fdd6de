//! The font of all figures: one of our own, for a bare machine has none.

use plotters::style::{FontStyle, register_font};
use std::sync::OnceLock;

/// The family that figures ask for.
pub const FAMILY: &str = "sans-serif";

/// Makes [`FAMILY`] known to the drawing library.
///
/// # Errors
/// If it cannot read the font.
pub fn register() -> Result<(), &'static str> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    let readable = REGISTERED.get_or_init(|| {
        let font = epaint_default_fonts::UBUNTU_LIGHT;
        register_font(FAMILY, FontStyle::Normal, font).is_ok()
    });
    readable
        .then_some(())
        .ok_or("the built-in font cannot be read")
}
