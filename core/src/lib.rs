//! Deflection of light by a non-rotating (Schwarzschild) black hole, in f64.
//!
//! Units: the Schwarzschild radius is 1 (2GM = 1) and c = 1; angles are in radians; u = 1/r.
//!
//! A light ray moves in a plane through the hole and obeys the Binet equation
//!
//! ```text
//! d²u/dφ² = −u + (3/2) u²,     (du/dφ)² = 1/b² − u² + u³
//! ```
//!
//! with φ the orbital angle and b the impact parameter. An observer at r looks in the direction at the view angle θ
//! from the hole. Without the hole, the sky at θ is seen there; with it, the sky at θ′ = θ − Δ. This crate computes the
//! deflection angle Δ, called the *bending*:
//!
//! - [`direct`] integrates the Binet equation by RK4; the bending tables are computed with it;
//! - [`exact`] evaluates the closed form in elliptic integrals: the reference that [`direct`] is checked against;
//! - [`series`] holds the weak-field and the strong-deflection limit for an observer at infinity.
//!
//! The first two take a [`Ray`], which an [`Observer`] creates: at rest, or in any radial motion, above or below the
//! horizon. A [`MovingFrame`] is the frame of an observer in any motion; it adds the aberration of the view direction and
//! the frequency shift. [`orbit`] has the orbit of a ray by its phase, [`accretion`] the light and the frequency of
//! matter in a thin disc, [`thin_disc`] its place, and [`disc_crossing`] where a ray crosses it. [`geodesic`] has
//! the free fall and the circular orbit by proper time.
//!
//! ```
//! use lensbake_core::rk4::Stepper;
//! use lensbake_core::{Observer, direct, exact};
//!
//! # fn main() -> Result<(), lensbake_core::CoreError> {
//! // From ten Schwarzschild radii the shadow has a radius of 14.27°. Looking 15° beside the centre of the hole, one sees
//! // light from 139° on the other side; looking straight away from the hole, light that is not bent.
//! let observer = Observer::at(10.0)?;
//! assert!((observer.shadow_angle().to_degrees() - 14.269).abs() < 1e-3);
//! for (theta, bend) in [(15.0, 153.537), (30.0, 29.575), (90.0, 6.356), (180.0, 0.0)] {
//!     let ray = observer.ray(f64::to_radians(theta))?;
//!     let closed = exact::bend(&ray).escaped().unwrap();
//!     let integrated = direct::bend(&ray, Stepper::Adaptive(1e-9)).escaped().unwrap();
//!     assert!((closed.to_degrees() - bend).abs() < 1e-3);
//!     assert!((integrated - closed).abs() < 1e-8);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! The crate depends on no other crate of the project and contains nothing about files, tables or GPUs.

pub mod accretion;
mod boost;
pub mod direct;
pub mod disc_crossing;
mod error;
pub mod exact;
pub mod geodesic;
mod motion;
mod moving_frame;
mod observer;
pub mod orbit;
mod ray;
mod ray_outcome;
pub mod rk4;
pub mod series;
pub mod thin_disc;

pub use boost::Boost;
pub use direct::BendAndSlope;
pub use error::CoreError;
pub use motion::{Motion, ParseMotionError};
pub use moving_frame::{MovingFrame, UnboostedDirection};
pub use observer::{Observer, ShadowCoordinate};
pub use ray::{Path, Ray};
pub use ray_outcome::RayOutcome;
pub use thin_disc::ThinDisc;

/// Critical impact parameter b_c = 3√3/2, in units of r_s: a ray from infinity with smaller b is captured.
pub const B_CRIT: f64 = 2.598_076_211_353_316;

/// Largest finite radius and impact parameter that are supported, in units of r_s: beyond it the squares of 1/r
/// and 1/b lose precision.
pub const MAX_DISTANCE: f64 = 1e150;

/// Smallest radius that is supported, in units of r_s.
pub const MIN_RADIUS: f64 = 1e-6;

/// Radius of the photon sphere, 3/2 in units of r_s.
pub const R_PHOTON: f64 = 1.5;

/// 1/r at the photon sphere.
pub const U_PHOTON: f64 = 2.0 / 3.0;
