//! A star through the orbit: what the pictures hold of it.

use super::{Departure, Expected, FlickerError, Subject, Texel, filtered_sky, nearest_sample};
use crate::picture::Picture;
use crate::scene::Scene;
use crate::sky::Sky;
use crate::stars::{self, PointStar};
use rayon::prelude::*;

/// The departure from the curve that is allowed, root mean square.
pub const BAR: f64 = 0.02;

/// A star and what was found of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// The star.
    pub subject: Subject,
    /// The frames that count: one of its images is seen, and none is cut by the border.
    pub frames: Vec<Frame>,
    /// How far it is from the curve as the GPU draws it, if one did.
    pub on_gpu: Option<Departure>,
}

/// A frame that counts. All light is found over expected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Its number in the orbit, from 0.
    pub number: usize,
    /// What it should hold.
    pub expected: Expected,
    /// The star drawn as a point.
    pub point: f64,
    /// The star as a texel, if the frame has its first image. The others are so small that a texel of them
    /// falls between the rays of most frames: nobody would judge a method by those.
    pub texel: Option<TexelFrame>,
}

/// A star as a texel of a sky, in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TexelFrame {
    /// A pixel shows the texel that its ray meets.
    pub nearest: f64,
    /// A pixel shows the mean over its area.
    pub filtered: f64,
}

impl Track {
    /// How far the point is from the curve.
    pub fn point(&self) -> Departure {
        Departure::of(self.frames.iter().map(|frame| frame.point))
    }

    /// How far the texel is, if a pixel shows the one that its ray meets.
    pub fn nearest(&self) -> Departure {
        Departure::of(self.texel_frames().map(|texel| texel.nearest))
    }

    /// How far the texel is, if a pixel shows the mean over its area.
    pub fn filtered(&self) -> Departure {
        Departure::of(self.texel_frames().map(|texel| texel.filtered))
    }

    /// The frames in which the star is judged as a texel.
    pub fn texel_frames(&self) -> impl Iterator<Item = TexelFrame> {
        self.frames.iter().filter_map(|frame| frame.texel)
    }

    /// Whether the point keeps the bar, whoever drew it.
    pub fn is_good(&self) -> bool {
        let drawn = [Some(self.point()), self.on_gpu];
        drawn.iter().flatten().all(|off| off.rms <= BAR)
    }

    /// The light at its brightest, in units of the star's light without the hole.
    pub fn peak(&self) -> f64 {
        let light = self.frames.iter().map(|frame| frame.expected.light);
        light.fold(0.0, f64::max)
    }
}

/// Follows a star through the frames `scenes` on the CPU. `frame_done` is called after each.
///
/// # Errors
/// [`FlickerError::Observer`] for an observer at infinity, which no camera is.
pub fn follow(
    subject: Subject,
    scenes: &[Scene],
    frame_done: impl Fn() + Sync,
) -> Result<Track, FlickerError> {
    let texel = Texel::at(subject.point().direction.as_vec3());
    let sky = texel.sky();
    let pairs = scenes.par_iter().zip(&subject.curve).enumerate();
    let frames = pairs.map(|(number, (scene, expected))| {
        let frame = expected.map(|expected| {
            Ok(Frame {
                number,
                expected,
                point: point(scene, &subject)? / expected.light,
                texel: expected
                    .has_first
                    .then(|| as_texel(scene, texel, &sky, expected)),
            })
        });
        frame_done();
        frame.transpose()
    });
    let frames: Vec<_> = frames.collect::<Result<_, FlickerError>>()?;
    Ok(Track {
        subject,
        frames: frames.into_iter().flatten().collect(),
        on_gpu: None,
    })
}

fn as_texel(scene: &Scene, texel: Texel, sky: &Sky, expected: Expected) -> TexelFrame {
    TexelFrame {
        nearest: nearest_sample(scene, texel) / expected.light,
        filtered: filtered_sky(scene, texel, sky) / expected.light,
    }
}

/// The light of a star drawn as a point, alone, in units of its light without the hole.
fn point(scene: &Scene, subject: &Subject) -> Result<f64, FlickerError> {
    let (width, height) = (scene.camera.width, scene.camera.height);
    let mut picture = Picture::new(width, height, vec![[0.0; 3]; scene.camera.pixels()]);
    stars::draw(&mut picture, scene, &subject.field)?;
    Ok(light_of(&picture, subject.point()))
}

/// The light of a picture in units of that of `star`.
pub(super) fn light_of(picture: &Picture, star: &PointStar) -> f64 {
    let channels = picture.pixels().iter().flatten();
    let sum: f64 = channels.map(|&light| f64::from(light)).sum();
    sum / f64::from(star.light.element_sum())
}
