//! The analytic curve: the light of a star that each picture of a flight should contain. The star's images come
//! from root-finding on the closed form of the bending, without the table and its inverse row. For a moving camera the
//! light of an image is its magnification times g⁴, g being the frequency shift.

use super::shift;
use glam::{DVec2, Vec3};
use lensbake_core::{CoreError, Observer, exact};
use lensbake_render::lens::Lens;
use lensbake_render::shift::Shift;
use lensbake_render::stars::PointStar;
use lensbake_render::stars::images::{ImageOrder, MIN_LIGHT, view_direction};
use lensbake_render::stars::kernel::spread;
use std::f64::consts::PI;

/// What a picture should contain of one star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// The light of all images in the picture, in units of the star's light without the hole (the sum of their
    /// magnifications, times g⁴ for a moving camera).
    pub light: f64,
    /// Whether its first image, the brightest, is among them.
    pub has_first: bool,
}

/// What the picture of `lens` should contain of `star`, by the closed form; `None` if the picture's border cuts an
/// image, or no image is in the picture. Images fainter than [`MIN_LIGHT`] are left out, because they are never
/// drawn.
///
/// # Errors
/// [`CoreError`] for an observer at infinity; a camera never is one.
pub fn expected(lens: &Lens, star: &PointStar) -> Result<Option<Expected>, CoreError> {
    let camera = &lens.camera;
    let direction = camera.sky_from_hole.transpose() * star.direction;
    let beta = direction.truncate().length().atan2(-direction.z);
    let azimuth = direction.truncate().normalize_or(DVec2::X);
    let size = DVec2::new(camera.width.into(), camera.height.into());
    let mut sum = Expected {
        light: 0.0,
        has_first: false,
    };
    for pair in ImageOrder::all() {
        let mut bright = false;
        for order in pair {
            let image = exact_image(&camera.observer, beta, order)?;
            let seen = view_direction(azimuth * image.side, image.theta);
            let (direction, doppler) = camera.boosted(seen);
            let by_shift = match shift(lens) {
                Shift::Off => 1.0,
                _ => (doppler * camera.observer.frequency_shift(image.theta)).powi(4),
            };
            let gain = image.magnification / (doppler * doppler) * by_shift;
            let light = star.light * gain as f32;
            if light.max_element() < MIN_LIGHT {
                continue;
            }
            bright = true;
            let Some(at) = camera.project(direction) else {
                continue;
            };
            let inside = at.min(size - at).min_element();
            if inside.abs() < reach(light) {
                return Ok(None);
            }
            if inside > 0.0 {
                sum.light += gain;
                sum.has_first |= order.is_straight();
            }
        }
        // Images of higher order are fainter still.
        if !bright {
            break;
        }
    }
    Ok((sum.light > 0.0).then_some(sum))
}

/// How far from its position an image of this light spreads, pixels.
fn reach(light: Vec3) -> f64 {
    spread(light).last().map_or(0.0, |(reach, _)| reach)
}

/// Bisection steps; they determine ln(θ − θ_c) to the precision of f64.
const HALVINGS: u32 = 100;
/// Lower end of the bracket in ln(θ − θ_c): nearer to the shadow's edge than any image with three further turns.
const INNERMOST: f64 = -25.0;
/// Half the step in ln(θ − θ_c) of the central difference for the slope.
const HALF_STEP: f64 = 1e-4;

/// An image of a point of the sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactImage {
    /// +1 if the image is on the star's own side of the hole, −1 if it is on the other.
    pub side: f64,
    /// View angle of the image from the direction of the hole, rad.
    pub theta: f64,
    /// Magnification: sin θ dθ / (sin β dβ).
    pub magnification: f64,
}

/// The image of order `order` of a star at `beta` (rad) from the direction of the hole: θ, the root of
/// θ − Δ(θ) = ϑ with the order's sky angle ϑ, by bisection in ln(θ − θ_c), and the magnification by a central
/// difference. `beta` must be neither 0 nor π: there the image is an Einstein ring.
///
/// # Errors
/// [`CoreError::NoViewAngle`] for an observer at infinity.
pub fn exact_image(
    observer: &Observer,
    beta: f64,
    order: ImageOrder,
) -> Result<ExactImage, CoreError> {
    let edge = observer.shadow_angle();
    let sky_angle = order.sky_angle(beta);
    let (mut low, mut high) = (INNERMOST, (PI - edge).ln() - 1e-12);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if sky_angle_seen(observer, middle)? < sky_angle {
            low = middle;
        } else {
            high = middle;
        }
    }
    let rise =
        sky_angle_seen(observer, low + HALF_STEP)? - sky_angle_seen(observer, low - HALF_STEP)?;
    let offset = low.exp();
    let theta = edge + offset;
    Ok(ExactImage {
        side: order.side,
        theta,
        magnification: theta.sin() / beta.sin() * offset * 2.0 * HALF_STEP / rise,
    })
}

/// ϑ = θ − Δ(θ), rad, as a function of ln(θ − θ_c). It increases strictly; −∞ for a captured ray.
fn sky_angle_seen(observer: &Observer, log_offset: f64) -> Result<f64, CoreError> {
    let theta = observer.shadow_angle() + log_offset.exp();
    let bend = exact::bend(&observer.ray(theta)?).escaped();
    Ok(bend.map_or(f64::NEG_INFINITY, |bend| theta - bend))
}
