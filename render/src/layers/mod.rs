//! Layers of a picture for compositing (arbitrary output variables, AOVs): where the light of each pixel comes from and
//! what happened to it on its way. `docs/layers.md` is for those who use them.
//!
//! All of them are computed on the CPU in f64 and rounded to f32, also for a picture that a GPU has drawn.

mod layer;

pub use layer::Layer;

use crate::camera::Camera;
use crate::disc::{Disc, Hit, SeenDisc};
use crate::filter::FilteredPixels;
use crate::lens::{Lens, LensedRay};
use crate::scene::Sampling;
use crate::shift::Rendition;
use crate::sky::panorama_uv;
use crate::stars::images::ImageOrder;
use glam::{DVec3, Vec4};
use lensbake_core::RayOutcome;
use rayon::prelude::*;

/// The values of a channel at every pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// `layer.component`, as OpenEXR names the channels of a layer.
    pub name: String,
    /// Row-major `[height][width]`, row 0 at the top.
    pub samples: Vec<f32>,
}

/// What the layers say about a pixel.
#[derive(Debug, Clone, Copy)]
struct Pixel {
    /// The light at its centre; `None` in the shadow.
    light: Option<Light>,
    /// The value of [`Layer::Captured`].
    captured: f64,
    /// Where the ray through its centre meets the disc first.
    hit: Option<Hit>,
    /// The value of [`Layer::DiscAlpha`].
    disc_alpha: f64,
}

impl Pixel {
    /// The values of the components of `layer`, then zeros.
    fn values_of(&self, layer: Layer) -> [f64; 3] {
        let one = |value| DVec3::new(value, 0.0, 0.0);
        let of_light = |value: fn(&Light) -> DVec3| self.light.as_ref().map_or(DVec3::ZERO, value);
        let of_hit = |value: fn(&Hit) -> f64| one(self.hit.as_ref().map_or(0.0, value));
        let values = match layer {
            Layer::Direction => of_light(|light| light.on_sky),
            Layer::Shift => of_light(|light| light.ray.frequency_shift * DVec3::X),
            Layer::Magnification => of_light(|light| light.ray.jacobian.magnification() * DVec3::X),
            Layer::Order => of_light(|light| {
                f64::from(ImageOrder::at(light.ray.sky_angle).half_windings()) * DVec3::X
            }),
            Layer::Uv => of_light(|light| panorama_uv(light.on_sky).extend(0.0)),
            Layer::Captured => one(self.captured),
            Layer::DiscRadius => of_hit(|hit| hit.radius),
            Layer::DiscOrder => of_hit(|hit| hit.order.into()),
            Layer::DiscShift => of_hit(|hit| hit.shift),
            Layer::DiscAlpha => one(self.disc_alpha),
        };
        values.to_array()
    }
}

/// A ray that escapes.
#[derive(Debug, Clone, Copy)]
struct Light {
    ray: LensedRay,
    /// Its unit direction in the sky frame.
    on_sky: DVec3,
}

/// The channels of `layers`, each layer once, for the picture of a sky and of `disc`, if any, through `lens` with this
/// sampling. `row_done` is called after each row of pixels.
///
/// ```
/// use lensbake_render::camera::{Camera, View};
/// use lensbake_render::layers::{self, Layer};
/// use lensbake_render::lens::{Deflection, Lens};
/// use lensbake_render::scene::Sampling;
/// use lensbake_tables::default_atlas;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let view = View { radius: 10.0, width: 64, height: 36, ..View::default() };
/// let lens = Lens::new(Camera::new(&view)?, default_atlas(), Deflection::Lut)?;
/// let channels = layers::trace(&lens, &[Layer::Shift, Layer::Uv], Sampling::Single, None, || ());
/// let names: Vec<_> = channels.iter().map(|channel| channel.name.as_str()).collect();
/// assert_eq!(names, ["shift.V", "uv.U", "uv.V"]);
/// // An observer at rest sees all light blueshifted alike, by 1/√(1 − 1/r).
/// assert!((channels[0].samples[0] - 0.9f32.sqrt().recip()).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
pub fn trace(
    lens: &Lens,
    layers: &[Layer],
    sampling: Sampling,
    disc: Option<Disc>,
    row_done: impl Fn() + Sync,
) -> Vec<Channel> {
    let camera = &lens.camera;
    let wanted: Vec<Layer> = Layer::ALL
        .into_iter()
        .filter(|layer| layers.contains(layer))
        .collect();
    let mut channels: Vec<Channel> = wanted
        .iter()
        .flat_map(|layer| layer.components().iter().map(|part| (layer.name(), part)))
        .map(|(layer, part)| Channel {
            name: format!("{layer}.{part}"),
            samples: vec![0.0; camera.pixels()],
        })
        .collect();
    // It costs rays that the layers of the sky do not need.
    let disc = disc.filter(|_| wanted.iter().any(|layer| layer.is_of_disc()));
    let rendition = Rendition::default();
    let pixels = Pixels {
        lens,
        filtered: FilteredPixels::new(lens, rendition).with_disc(disc),
        disc: disc.map(|disc| SeenDisc::new(lens, disc, rendition)),
        averages: sampling.averages(),
    };
    lines(&mut channels, camera)
        .into_par_iter()
        .zip(0..camera.height)
        .for_each(|(line, row)| {
            fill(line, &wanted, |column| pixels.at(column, row));
            row_done();
        });
    channels
}

/// For each row of pixels its part of every channel.
fn lines<'c>(channels: &'c mut [Channel], camera: &Camera) -> Vec<Vec<&'c mut [f32]>> {
    let mut lines: Vec<Vec<&mut [f32]>> = Vec::new();
    lines.resize_with(camera.height as usize, Vec::new);
    for channel in channels {
        let parts = channel.samples.chunks_exact_mut(camera.width as usize);
        for (line, part) in lines.iter_mut().zip(parts) {
            line.push(part);
        }
    }
    lines
}

/// Writes the values of `layers` to the channels of one row of pixels.
fn fill(mut line: Vec<&mut [f32]>, layers: &[Layer], pixel: impl Fn(u32) -> Pixel) {
    let width = line.first().map_or(0, |channel| channel.len());
    for column in 0..width {
        let pixel = pixel(column as u32);
        let mut channels = line.iter_mut();
        for layer in layers {
            let values = pixel.values_of(*layer);
            for (channel, value) in channels.by_ref().take(layer.components().len()).zip(values) {
                channel[column] = finite(value);
            }
        }
    }
}

/// `value` as f32: the largest one on a ring of infinite magnification, 0 where it could not be computed.
fn finite(value: f64) -> f32 {
    if value.is_nan() {
        return 0.0;
    }
    value.clamp(f32::MIN.into(), f32::MAX.into()) as f32
}

/// The pixels of the picture through a lens.
struct Pixels<'a> {
    lens: &'a Lens,
    filtered: FilteredPixels<'a>,
    disc: Option<SeenDisc<'a>>,
    /// Whether the picture shows the mean over each pixel.
    averages: bool,
}

impl Pixels<'_> {
    fn at(&self, column: u32, row: u32) -> Pixel {
        let camera = &self.lens.camera;
        let covered = camera.coverage(column, row);
        if covered == 0.0 {
            return Pixel {
                light: None,
                captured: 1.0,
                hit: None,
                disc_alpha: 0.0,
            };
        }
        let direction = camera.direction(column, row);
        let light = match self.lens.ray(direction) {
            RayOutcome::Captured => None,
            RayOutcome::Escapes(ray) => Some(Light {
                ray,
                on_sky: camera.sky_from_hole * ray.direction,
            }),
        };
        let captured = if self.averages {
            1.0 - covered * self.filtered.sky_share(column, row)
        } else {
            1.0 - covered * f64::from(u8::from(light.is_some()))
        };
        let disc_alpha = |disc: &SeenDisc| {
            if self.averages {
                1.0 - f64::from(self.filtered.through_disc(column, row))
            } else {
                disc.before(direction, Vec4::ZERO).w.into()
            }
        };
        Pixel {
            light,
            captured,
            hit: self
                .disc
                .as_ref()
                .and_then(|disc| disc.nearest_hit(direction)),
            disc_alpha: covered * self.disc.as_ref().map_or(0.0, disc_alpha),
        }
    }
}

#[cfg(test)]
mod tests;
