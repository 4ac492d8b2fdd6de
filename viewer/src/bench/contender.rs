//! What takes part in the benchmark.

use crate::scene::{Method, Sampling};
use std::f64::consts::PI;

/// A way to draw the flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contender {
    /// Who turns the light.
    pub method: Method,
    /// What of its area a pixel shows.
    pub sampling: Sampling,
    /// Whether the Hipparcos stars stand before the sky.
    pub stars: bool,
}

/// The floor.
pub const FLAT: Contender = plain(Method::Flat);
/// The table, one ray a pixel.
pub const LUT: Contender = plain(Method::Lut);
/// Direct integration with as many steps as serve its accuracy in 32-bit floats: it comes nearest to the
/// table's error.
pub const FINEST: Contender = plain(Method::Direct { step: 0.05 });
/// The table, the mean over each pixel.
pub const FILTERED: Contender = Contender {
    sampling: Sampling::Filtered,
    ..LUT
};

/// All of them; direct integration from few steps on.
pub const CONTENDERS: [Contender; 8] = [
    FLAT,
    LUT,
    FILTERED,
    LUT.with_stars(),
    FILTERED.with_stars(),
    plain(Method::Direct { step: 0.2 }),
    plain(Method::Direct { step: 0.1 }),
    FINEST,
];

const fn plain(method: Method) -> Contender {
    Contender {
        method,
        sampling: Sampling::Single,
        stars: false,
    }
}

impl Contender {
    /// The same with the stars.
    pub const fn with_stars(self) -> Self {
        Contender {
            stars: true,
            ..self
        }
    }

    /// What it is called.
    pub fn name(self) -> String {
        let method = match self.method {
            Method::Flat => "flat".into(),
            Method::Lut => "lut".into(),
            // A ray that is hardly bent turns by about π.
            Method::Direct { step } => format!("direct {:.0} steps", PI / step),
        };
        let filtered = match self.sampling {
            Sampling::Single => "",
            Sampling::Filtered => " filtered",
        };
        let stars = if self.stars { " with stars" } else { "" };
        format!("{method}{filtered}{stars}")
    }
}
