//! A scene: a lens, the sky behind the hole, point stars in front of that sky, and a disc around the hole.

use crate::disc::Disc;
use crate::lens::Lens;
use crate::shift::{Rendition, Shift};
use crate::sky::Sky;
use crate::stars::StarField;
use std::sync::Arc;

/// How a pixel samples its area.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Sampling {
    /// The light of one ray through its centre, to judge the bending alone.
    #[default]
    Single,
    /// The mean light over its area, as a picture should show.
    Filtered,
    /// The same with the anisotropic filter of the GPU in place of our own, which looks as good as that filter is. The
    /// CPU has none and draws [`Sampling::Filtered`].
    Anisotropic,
}

impl Sampling {
    /// Whether a pixel shows the mean over its area.
    pub fn averages(self) -> bool {
        self != Sampling::Single
    }
}

/// A scene. Its sky and stars are shared, so that a clone does not copy them; on a GPU they are
/// [`crate::gpu::SkyOnDevice`] and [`crate::gpu::StarsOnDevice`].
#[derive(Debug, Clone, PartialEq)]
pub struct Scene<S = Arc<Sky>, P = Arc<StarField>> {
    /// The camera and the deflection method.
    pub lens: Lens,
    /// How a pixel samples its area.
    pub sampling: Sampling,
    /// The sky.
    pub sky: S,
    /// The point stars, if any.
    pub stars: Option<P>,
    /// How the light of the sky becomes light of the picture.
    pub rendition: Rendition,
    /// The disc of matter around the hole, if any. It must be valid ([`Disc::check`]).
    pub disc: Option<Disc>,
}

impl<S, P> Scene<S, P> {
    /// The scene of `sky` through `lens`, one ray per pixel, without stars and without frequency shift.
    pub fn new(lens: Lens, sky: impl Into<S>) -> Self {
        Scene {
            lens,
            sampling: Sampling::Single,
            sky: sky.into(),
            stars: None,
            rendition: Rendition::default(),
            disc: None,
        }
    }

    /// The same scene with another sampling.
    pub fn with_sampling(self, sampling: Sampling) -> Self {
        Scene { sampling, ..self }
    }

    /// The same scene with this kind of frequency shift, with all of its brightness.
    pub fn with_shift(self, shift: Shift) -> Self {
        Scene {
            rendition: Rendition::of(shift),
            ..self
        }
    }

    /// The same scene with this disc around the hole.
    pub fn with_disc(self, disc: Disc) -> Self {
        Scene {
            disc: Some(disc),
            ..self
        }
    }

    /// The same scene with point stars.
    pub fn with_stars(self, stars: impl Into<P>) -> Self {
        Scene {
            stars: Some(stars.into()),
            ..self
        }
    }
}

impl<S: Clone, P: Clone> Scene<S, P> {
    /// The same scene through another lens.
    pub fn with_lens(&self, lens: Lens) -> Self {
        Scene {
            lens,
            ..self.clone()
        }
    }
}
