//! The contenders of the benchmark.

use lensbake_render::lens::Deflection;
use lensbake_render::scene::Sampling;
use std::f64::consts::PI;

/// A deflection method with its sampling, with or without stars.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contender {
    /// Deflection method.
    pub deflection: Deflection,
    /// How a pixel samples its area.
    pub sampling: Sampling,
    /// Whether the Hipparcos stars are drawn.
    pub stars: bool,
}

/// No deflection: the lower bound of the cost.
pub const FLAT: Contender = plain(Deflection::Flat);
/// The table, one ray per pixel.
pub const LUT: Contender = plain(Deflection::Lut);
/// Direct integration with as many steps as improve its accuracy in f32; its error is the nearest to the table's.
pub const FINEST: Contender = plain(Deflection::Direct { step: 0.05 });
/// The table, the mean over each pixel.
pub const FILTERED: Contender = Contender {
    sampling: Sampling::Filtered,
    ..LUT
};

/// All contenders; direct integration in the order of its number of steps.
pub const CONTENDERS: [Contender; 8] = [
    FLAT,
    LUT,
    FILTERED,
    LUT.with_stars(),
    FILTERED.with_stars(),
    plain(Deflection::Direct { step: 0.2 }),
    plain(Deflection::Direct { step: 0.1 }),
    FINEST,
];

const fn plain(deflection: Deflection) -> Contender {
    Contender {
        deflection,
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

    /// Its name.
    pub fn name(self) -> String {
        let deflection = match self.deflection {
            Deflection::Flat => "flat".into(),
            Deflection::Lut => "lut".into(),
            // A ray that is hardly bent turns by about π.
            Deflection::Direct { step } => format!("direct {:.0} steps", PI / step),
        };
        let filtered = match self.sampling {
            Sampling::Single => "",
            Sampling::Filtered => " filtered",
        };
        let stars = if self.stars { " with stars" } else { "" };
        format!("{deflection}{filtered}{stars}")
    }
}
