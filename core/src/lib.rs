//! The bending of light by a non-rotating (Schwarzschild) black hole, in f64.
//!
//! Units: the Schwarzschild radius is 1 (2GM = 1) and c = 1; angles are radians; u = 1/r.
//!
//! A light ray moves in a plane through the hole and obeys the Binet equation
//!
//! ```text
//! d²u/dφ² = −u + (3/2) u²,     (du/dφ)² = 1/b² − u² + u³
//! ```
//!
//! with φ the orbital angle and b the impact parameter. A static observer at r who looks at the
//! angle θ from the direction of the hole sees, in the absence of the hole, the sky at θ; the hole
//! shows him the sky at θ′ = θ − Δ. This crate computes the bending Δ:
//!
//! - [`direct`] integrates the Binet equation by RK4: the product's own path;
//! - [`exact`] evaluates the closed form in elliptic integrals: the oracle that checks it;
//! - [`series`] holds the weak and the strong limit.
//!
//! All start from the same [`Ray`], which an [`Observer`] launches. It depends on no other package
//! of the project and knows no file, no table and no GPU.

pub mod direct;
mod error;
pub mod exact;
mod fate;
mod observer;
mod ray;
pub mod rk4;
pub mod series;

pub use direct::BendAndSlope;
pub use error::CoreError;
pub use fate::Fate;
pub use observer::{EdgeCoordinate, Observer};
pub use ray::{Path, Ray};

/// Critical impact parameter b_c = 3√3/2, in units of r_s: from infinity, smaller b is captured.
pub const B_CRIT: f64 = 2.598_076_211_353_316;

/// The largest finite radius and impact parameter that is computed with, in units of r_s: beyond it the
/// squares of 1/r and 1/b lose their digits.
pub const MAX_DISTANCE: f64 = 1e150;

/// Radius of the photon sphere, 3/2 in units of r_s.
pub const R_PHOTON: f64 = 1.5;

/// 1/r at the photon sphere.
pub const U_PHOTON: f64 = 2.0 / 3.0;
