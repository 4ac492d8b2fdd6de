//! A star through the flight: its light in the pictures of CPU and GPU, and the departure from the analytic curve.

use super::{Expected, FlickerError, Subject, Texel, filtered_sky, nearest_sample, shift};
use glam::Vec3;
use lensbake_render::gpu::Renderer;
use lensbake_render::lens::Lens;
use lensbake_render::picture::Picture;
use lensbake_render::scene::Scene;
use lensbake_render::shift::Rendition;
use lensbake_render::sky::Sky;
use lensbake_render::stars::{self, PointStar};
use rayon::prelude::*;
use std::sync::Arc;

/// Largest allowed departure from the analytic curve, root mean square.
pub const BAR: f64 = 0.02;

/// A star and its measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// The star.
    pub subject: Subject,
    /// The frames that count: at least one image is in the picture, and the picture's border cuts none.
    pub frames: Vec<FlickerFrame>,
    /// Departure from the curve as the GPU draws the star, if one did.
    pub on_gpu: Option<Departure>,
}

/// A frame that counts. Light is stated as found over expected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlickerFrame {
    /// Number of the frame in the flight, from 0.
    pub number: usize,
    /// What the frame should contain.
    pub expected: Expected,
    /// The light of the star drawn as a point.
    pub point: f64,
    /// The light of the star drawn as a texel, if the frame contains its first image. The other images are so
    /// small that the texel falls between the rays of most frames, which says nothing about a method.
    pub texel: Option<TexelFrame>,
}

/// The light of a star drawn as a texel of a sky, in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TexelFrame {
    /// If each pixel shows the texel that its ray meets.
    pub nearest: f64,
    /// If each pixel shows the mean over its area.
    pub filtered: f64,
}

impl Track {
    /// Departure of the star drawn as a point.
    pub fn point(&self) -> Departure {
        Departure::of(self.frames.iter().map(|frame| frame.point))
    }

    /// Departure of the texel if each pixel shows the texel that its ray meets.
    pub fn nearest(&self) -> Departure {
        Departure::of(self.texel_frames().map(|texel| texel.nearest))
    }

    /// Departure of the texel if each pixel shows the mean over its area.
    pub fn filtered(&self) -> Departure {
        Departure::of(self.texel_frames().map(|texel| texel.filtered))
    }

    /// The light of the texel, in the frames that contain the star's first image.
    pub fn texel_frames(&self) -> impl Iterator<Item = TexelFrame> {
        self.frames.iter().filter_map(|frame| frame.texel)
    }

    /// Whether the star drawn as a point is within [`BAR`], on the CPU and, if one drew it, on the GPU.
    pub fn is_good(&self) -> bool {
        let drawn = [Some(self.point()), self.on_gpu];
        drawn.iter().flatten().all(|off| off.rms <= BAR)
    }

    /// The largest light expected in any frame, in units of the star's light without the hole.
    pub fn peak(&self) -> f64 {
        let light = self.frames.iter().map(|frame| frame.expected.light);
        light.fold(0.0, f64::max)
    }
}

/// Measures a star in the frames of `lenses`, drawn by the CPU. `frame_done` is called after each frame.
pub fn follow(subject: Subject, lenses: &[Lens], frame_done: impl Fn() + Sync) -> Track {
    let texel = Texel::at(subject.point().direction.as_vec3());
    let sky = Arc::new(texel.sky());
    let pairs = lenses.par_iter().zip(&subject.curve).enumerate();
    let frames = pairs.map(|(number, (lens, expected))| {
        let frame = expected.map(|expected| FlickerFrame {
            number,
            expected,
            point: point(lens, &subject) / expected.light,
            texel: expected
                .has_first
                .then(|| as_texel(lens, texel, &sky, expected)),
        });
        frame_done();
        frame
    });
    let frames: Vec<Option<FlickerFrame>> = frames.collect();
    Track {
        subject,
        frames: frames.into_iter().flatten().collect(),
        on_gpu: None,
    }
}

fn as_texel(lens: &Lens, texel: Texel, sky: &Arc<Sky>, expected: Expected) -> TexelFrame {
    TexelFrame {
        nearest: nearest_sample(lens, texel) / expected.light,
        filtered: filtered_sky(lens, texel, sky) / expected.light,
    }
}

/// The light of a star drawn alone as a point, in units of its light without the hole.
fn point(lens: &Lens, subject: &Subject) -> f64 {
    let camera = &lens.camera;
    let mut picture = Picture::new(camera.width, camera.height, vec![[0.0; 3]; camera.pixels()]);
    let rendition = Rendition::of(shift(lens));
    stars::draw(&mut picture, lens, &subject.field, rendition);
    light_of(&picture, subject.point())
}

/// The total light of a picture, in units of that of `star`.
fn light_of(picture: &Picture, star: &PointStar) -> f64 {
    let channels = picture.pixels().iter().flatten();
    let sum: f64 = channels.map(|&light| f64::from(light)).sum();
    sum / f64::from(star.light.element_sum())
}

/// Departure from the curve of the star of `track` in its frames, drawn as a point by a GPU. `frame_done` is
/// called after each frame.
///
/// # Errors
/// [`FlickerError::Gpu`] if the device fails.
pub async fn point_on_gpu(
    renderer: &Renderer,
    lenses: &[Lens],
    track: &Track,
    frame_done: impl Fn(),
) -> Result<Departure, FlickerError> {
    let subject = &track.subject;
    let black = Arc::new(Sky::from_fn(1, |_| Vec3::ZERO));
    let stars = Arc::new(subject.field.clone());
    let mut found = Vec::with_capacity(track.frames.len());
    for frame in &track.frames {
        let lens = lenses[frame.number].clone();
        let shift = shift(&lens);
        let scene = Scene::new(lens, black.clone())
            .with_stars(stars.clone())
            .with_shift(shift);
        let picture = renderer.picture(&scene, |_| ()).await?;
        found.push(light_of(&picture, subject.point()) / frame.expected.light);
        frame_done();
    }
    Ok(Departure::of(found))
}

/// Departure of the light found from the light expected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// Root mean square over the frames of found / expected − 1.
    pub rms: f64,
    /// The largest |found / expected − 1| of any frame.
    pub worst: f64,
}

impl Departure {
    /// The departure for the ratios found / expected, one per frame; 0 without frames.
    pub fn of(ratios: impl IntoIterator<Item = f64>) -> Self {
        let (mut squares, mut worst, mut count) = (0.0, 0.0_f64, 0_u32);
        for ratio in ratios {
            let off = (ratio - 1.0).abs();
            squares += off * off;
            worst = worst.max(off);
            count += 1;
        }
        Departure {
            rms: (squares / f64::from(count.max(1))).sqrt(),
            worst,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_mean_square_is_about_one_and_not_about_the_mean() {
        let off = Departure::of([1.1, 0.9, 1.1, 1.3]);
        assert!((off.rms - 0.03_f64.sqrt()).abs() < 1e-12, "{off:?}");
        assert!((off.worst - 0.3).abs() < 1e-12, "{off:?}");
        assert!((Departure::of([2.0; 7]).rms - 1.0).abs() < 1e-12);
        assert_eq!(Departure::of([]).rms, 0.0);
    }
}
