//! Layers of a picture for compositing (arbitrary output variables, AOVs): where the light of each pixel comes from and
//! what happened to it on its way. `docs/layers.md` is for those who use them.
//!
//! All of them are computed on the CPU in f64 and rounded to f32, also for a picture that a GPU has drawn.

use crate::camera::Camera;
use crate::filter::FilteredPixels;
use crate::lens::{Lens, LensedRay};
use crate::scene::Sampling;
use crate::shift::Rendition;
use crate::sky::panorama_uv;
use crate::stars::images::ImageOrder;
use glam::DVec3;
use lensbake_core::RayOutcome;
use rayon::prelude::*;

/// A layer. All of its values are finite, and 0 where the ray through the pixel's centre is captured, except for
/// [`Layer::Captured`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Layer {
    /// The unit direction on the sky that the ray through the pixel's centre comes from, in the sky frame: X, Y, Z.
    Direction,
    /// The frequency ratio ν_obs/ν_∞ of that light.
    Shift,
    /// The magnification: the pixel's solid angle divided by that of its source on the sky, negative where the image is
    /// mirrored; see [`crate::lens::Jacobian::magnification`].
    Magnification,
    /// The image order: how often the light crosses the axis through the camera and the hole; see
    /// [`ImageOrder::half_windings`].
    Order,
    /// The place of that direction in a panorama: U, V; see [`panorama_uv`].
    Uv,
    /// How much of the pixel shows no sky, because it lies in the shadow or outside the disc of a fisheye: the share of its
    /// area if the picture shows the mean over it, else 1 or 0 at its centre.
    Captured,
}

/// The values of a channel at every pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// `layer.component`, as OpenEXR names the channels of a layer.
    pub name: String,
    /// Row-major `[height][width]`, row 0 at the top.
    pub samples: Vec<f32>,
}

impl Layer {
    /// All layers.
    pub const ALL: [Layer; 6] = [
        Layer::Direction,
        Layer::Shift,
        Layer::Magnification,
        Layer::Order,
        Layer::Uv,
        Layer::Captured,
    ];

    /// Its name, the first part of the names of its channels.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Direction => "direction",
            Layer::Shift => "shift",
            Layer::Magnification => "magnification",
            Layer::Order => "order",
            Layer::Uv => "uv",
            Layer::Captured => "captured",
        }
    }

    /// Its components, the last part of the names of its channels. One letter each, because Blender takes no others; V
    /// for a single value; never R, G, B or A, which tinyexr would take for the picture.
    pub fn components(self) -> &'static [&'static str] {
        match self {
            Layer::Direction => &["X", "Y", "Z"],
            Layer::Uv => &["U", "V"],
            Layer::Shift | Layer::Magnification | Layer::Order | Layer::Captured => &["V"],
        }
    }

    /// The values of its components, then zeros.
    fn values(self, pixel: &Pixel) -> [f64; 3] {
        let Pixel { light, captured } = *pixel;
        let Some(light) = light else {
            let shadow = if self == Layer::Captured {
                captured
            } else {
                0.0
            };
            return [shadow, 0.0, 0.0];
        };
        let one = |value| [value, 0.0, 0.0];
        match self {
            Layer::Direction => light.on_sky.to_array(),
            Layer::Shift => one(light.ray.frequency_shift),
            Layer::Magnification => one(light.ray.jacobian.magnification()),
            Layer::Order => one(ImageOrder::at(light.ray.sky_angle).half_windings().into()),
            Layer::Uv => panorama_uv(light.on_sky).extend(0.0).to_array(),
            Layer::Captured => one(captured),
        }
    }
}

/// What the layers say about a pixel.
#[derive(Debug, Clone, Copy)]
struct Pixel {
    /// The light at its centre; `None` in the shadow.
    light: Option<Light>,
    /// The value of [`Layer::Captured`].
    captured: f64,
}

/// A ray that escapes.
#[derive(Debug, Clone, Copy)]
struct Light {
    ray: LensedRay,
    /// Its unit direction in the sky frame.
    on_sky: DVec3,
}

/// The channels of `layers`, each layer once, for the picture through `lens` with this sampling. `row_done` is called
/// after each row of pixels.
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
/// let channels = layers::trace(&lens, &[Layer::Shift, Layer::Uv], Sampling::Single, || ());
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
    let pixels = Pixels {
        lens,
        filtered: FilteredPixels::new(lens, Rendition::default()),
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
            let values = layer.values(&pixel);
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
            };
        }
        let light = match self.lens.ray(camera.direction(column, row)) {
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
        Pixel { light, captured }
    }
}

#[cfg(test)]
mod tests;
