//! The contenders of the benchmark.

use lensbake_core::Motion;
use lensbake_render::gpu::{Output, Pass, Renderer};
use lensbake_render::lens::Deflection;
use lensbake_render::scene::Sampling;
use std::f64::consts::PI;

/// A deflection method with its sampling, its kind of pass and the camera's motion, with or without stars and a disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contender {
    /// Deflection method.
    pub deflection: Deflection,
    /// How a pixel samples its area.
    pub sampling: Sampling,
    /// Whether the Hipparcos stars are drawn.
    pub stars: bool,
    /// Whether a disc is drawn, seen from 10° above its plane.
    pub disc: bool,
    /// How the camera moves.
    pub motion: Motion,
    /// Whether it is drawn in the other kind of pass than the renderer's.
    pub other_pass: bool,
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

/// The table, the mean over each pixel by the anisotropic filter of the hardware.
pub const ANISOTROPIC: Contender = Contender {
    sampling: Sampling::Anisotropic,
    ..LUT
};

/// The table for a camera in free fall: the motion is in the row.
pub const LUT_FALL: Contender = LUT.in_motion(Motion::Fall);
/// The table for a camera in orbit: the shader maps the view direction (aberration).
pub const LUT_ORBIT: Contender = LUT.in_motion(Motion::Orbit);
/// As [`LUT_FALL`], the mean over each pixel.
pub const FILTERED_FALL: Contender = FILTERED.in_motion(Motion::Fall);
/// As [`LUT_ORBIT`], the mean over each pixel.
pub const FILTERED_ORBIT: Contender = FILTERED.in_motion(Motion::Orbit);

/// As [`FILTERED`], with a disc around the hole.
pub const FILTERED_DISC: Contender = FILTERED.with_disc();
/// The same picture by direct integration.
pub const FINEST_DISC: Contender = Contender {
    deflection: FINEST.deflection,
    ..FILTERED_DISC
};

/// All contenders; direct integration in the order of its number of steps. Those that are compared with one another follow
/// one another: star lists leave cold caches behind.
pub const CONTENDERS: [Contender; 18] = [
    FLAT,
    LUT,
    LUT_FALL,
    LUT_ORBIT,
    FILTERED,
    FILTERED_FALL,
    FILTERED_ORBIT,
    FILTERED_DISC,
    ANISOTROPIC,
    LUT.in_other_pass(),
    FILTERED.in_other_pass(),
    ANISOTROPIC.in_other_pass(),
    LUT.with_stars(),
    FILTERED.with_stars(),
    plain(Deflection::Direct { step: 0.2 }),
    plain(Deflection::Direct { step: 0.1 }),
    FINEST,
    FINEST_DISC,
];

const fn plain(deflection: Deflection) -> Contender {
    Contender {
        deflection,
        sampling: Sampling::Single,
        stars: false,
        disc: false,
        motion: Motion::Rest,
        other_pass: false,
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

    /// The same with a disc.
    pub const fn with_disc(self) -> Self {
        Contender { disc: true, ..self }
    }

    /// The same in the other kind of pass than the renderer's.
    pub const fn in_other_pass(self) -> Self {
        Contender {
            other_pass: true,
            ..self
        }
    }

    /// The kind of pass in which the benchmark draws it with `renderer`.
    pub fn pass(self, renderer: &Renderer) -> Pass {
        match (
            self.other_pass,
            renderer.pass(Output::Picture(self.sampling)),
        ) {
            (false, pass) => pass,
            (true, Pass::Compute) => Pass::Fragment,
            (true, Pass::Fragment) => Pass::Compute,
        }
    }

    /// The same for a camera in motion.
    const fn in_motion(self, motion: Motion) -> Self {
        Contender { motion, ..self }
    }

    /// Its name, drawn in this kind of pass.
    pub fn name(self, pass: Pass) -> String {
        let deflection = match self.deflection {
            Deflection::Flat => "flat".into(),
            Deflection::Lut => "lut".into(),
            // A ray that is hardly bent turns by about π.
            Deflection::Direct { step } => format!("direct {:.0} steps", PI / step),
        };
        let filtered = match self.sampling {
            Sampling::Single => "",
            Sampling::Filtered => " filtered",
            Sampling::Anisotropic => " anisotropic",
        };
        let stars = if self.stars { " with stars" } else { "" };
        let disc = if self.disc { " with disc" } else { "" };
        let motion = match self.motion {
            Motion::Rest => String::new(),
            motion => format!(" in {motion}"),
        };
        let pass = match (self.other_pass, pass) {
            (false, _) => "",
            (true, Pass::Compute) => " by compute",
            (true, Pass::Fragment) => " by fragments",
        };
        format!("{deflection}{filtered}{stars}{disc}{motion}{pass}")
    }
}
