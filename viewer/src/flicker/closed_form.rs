//! A star's images by root-finding on the closed form of the bending: neither a table nor its inverse has
//! a part in them.

use crate::stars::images::Way;
use lensbake_core::{CoreError, Observer, exact};
use std::f64::consts::PI;

/// Halvings of the bracket, after which ln(θ − θ_c) is as good as f64.
const HALVINGS: u32 = 100;
/// ln(θ − θ_c) at the lower end of the bracket: further in than any image with three further turns.
const INNERMOST: f64 = -25.0;
/// Half the step in ln(θ − θ_c) over which the slope is a difference.
const HALF_STEP: f64 = 1e-4;

/// An image of a point of the sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactImage {
    /// +1: it is seen on the star's own side of the hole; −1: on the other.
    pub side: f64,
    /// The angle from the direction of the hole at which it is seen, rad.
    pub theta: f64,
    /// How many times brighter it is than without the hole: sin θ dθ / (sin β dβ).
    pub magnification: f64,
}

/// The image that the light of a star at `beta` (rad) from the direction of the hole makes by `way`: θ with
/// θ − Δ(θ) = ϑ, by bisection of ln(θ − θ_c), and the magnification by differences. `beta` is neither 0
/// nor π: there the image is a ring.
///
/// # Errors
/// [`CoreError::FarHasNoAngle`] for an observer at infinity.
pub fn exact_image(observer: &Observer, beta: f64, way: Way) -> Result<ExactImage, CoreError> {
    let edge = observer.edge_angle();
    let sky_angle = way.sky_angle(beta);
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
        side: way.side,
        theta,
        magnification: theta.sin() / beta.sin() * offset * 2.0 * HALF_STEP / rise,
    })
}

/// ϑ = θ − Δ(θ), in rad, from ln(θ − θ_c). It grows strictly; what the hole captures comes from −∞.
fn sky_angle_seen(observer: &Observer, log_offset: f64) -> Result<f64, CoreError> {
    let theta = observer.edge_angle() + log_offset.exp();
    let bend = exact::bend(&observer.ray(theta)?).escaped();
    Ok(bend.map_or(f64::NEG_INFINITY, |bend| theta - bend))
}
