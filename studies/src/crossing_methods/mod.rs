//! The methods that find the radius at which a ray crosses a disc: each computes the inverse radius u at the phase ψ (the
//! orbital angle from infinity) of a ray with the impact parameter b, the function [`lensbake_core::orbit::inverse_radius`].
//!
//! They answer in the arithmetic of f32, as on a GPU, or of f64.

pub mod integrated;
pub mod jacobi;
pub mod registry;
pub mod table;
pub mod weierstrass;

use num_traits::{Float, ToPrimitive, Zero};

/// The kind of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Weierstrass' ℘, as this project computes it.
    Weierstrass,
    /// Jacobi's elliptic functions.
    Jacobi,
    /// A table over phase and impact parameter.
    Table,
    /// An integration from infinity.
    Integrated,
}

impl Kind {
    /// All kinds, in the order of the legend.
    pub const ALL: [Kind; 4] = [
        Kind::Weierstrass,
        Kind::Jacobi,
        Kind::Table,
        Kind::Integrated,
    ];

    /// Name in the CSV file.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Weierstrass => "weierstrass",
            Kind::Jacobi => "jacobi",
            Kind::Table => "table",
            Kind::Integrated => "integrated",
        }
    }
}

/// Description of a method.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossingInfo {
    /// Kind of method.
    pub kind: Kind,
    /// Name, without arithmetic and parameters.
    pub name: &'static str,
    /// Values of its parameters.
    pub knobs: String,
    /// The publication or the code that it comes from.
    pub source: &'static str,
    /// Whether the renderer uses it.
    pub used: bool,
}

/// The inverse radius of a ray at a phase.
pub trait Orbit: Send + Sync {
    /// The arithmetic.
    type Number: Arithmetic;

    /// Description of the method.
    fn info(&self) -> CrossingInfo;

    /// u at the phase `phase` ≥ 0 (rad) of the ray with 1/b = `inv_b`, for u ≤ 1/3 and before the periapsis.
    fn inverse_radius(&self, inv_b: Self::Number, phase: Self::Number) -> Self::Number;

    /// Bytes of data that it needs.
    fn bytes(&self) -> usize {
        0
    }
}

/// f32 or f64.
pub trait Arithmetic: Float + Send + Sync + 'static {
    /// The questions in this arithmetic, as pairs of 1/b and phase.
    fn of(questions: &Questions) -> &[[Self; 2]];

    /// A constant.
    fn constant(value: f64) -> Self {
        Self::from(value).unwrap_or_else(Self::nan)
    }

    /// Bits of a number.
    fn bits() -> usize {
        8 * size_of::<Self>()
    }
}

impl Arithmetic for f32 {
    fn of(questions: &Questions) -> &[[f32; 2]] {
        &questions.single
    }
}

impl Arithmetic for f64 {
    fn of(questions: &Questions) -> &[[f64; 2]] {
        &questions.double
    }
}

/// Pairs of 1/b and phase that f32 can represent, so that all methods get the same.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Questions {
    single: Vec<[f32; 2]>,
    double: Vec<[f64; 2]>,
}

impl Questions {
    /// These pairs.
    pub fn new(pairs: Vec<[f32; 2]>) -> Self {
        Questions {
            double: pairs.iter().map(|pair| pair.map(f64::from)).collect(),
            single: pairs,
        }
    }

    /// The pairs in f64.
    pub fn pairs(&self) -> &[[f64; 2]] {
        &self.double
    }
}

/// An [`Orbit`] of either arithmetic.
pub trait CrossingMethod: Send + Sync {
    /// Description of the method.
    fn info(&self) -> CrossingInfo;

    /// Bits of the numbers it computes with.
    fn bits(&self) -> usize;

    /// Bytes of data that it needs.
    fn bytes(&self) -> usize;

    /// u for each of the questions.
    fn answers(&self, questions: &Questions) -> Vec<f64>;

    /// The sum of the answers. This is the loop that is timed; its calls of [`Orbit::inverse_radius`] are statically
    /// dispatched.
    fn sum(&self, questions: &Questions) -> f64;
}

impl<M: Orbit> CrossingMethod for M {
    fn info(&self) -> CrossingInfo {
        Orbit::info(self)
    }

    fn bits(&self) -> usize {
        M::Number::bits()
    }

    fn bytes(&self) -> usize {
        Orbit::bytes(self)
    }

    fn answers(&self, questions: &Questions) -> Vec<f64> {
        let answer = |&[inv_b, phase]: &[M::Number; 2]| self.inverse_radius(inv_b, phase).to_f64();
        let pairs = M::Number::of(questions).iter();
        pairs.map(|pair| answer(pair).unwrap_or(f64::NAN)).collect()
    }

    fn sum(&self, questions: &Questions) -> f64 {
        let pairs = M::Number::of(questions).iter();
        let sum = pairs.fold(M::Number::zero(), |sum, &[inv_b, phase]| {
            sum + self.inverse_radius(inv_b, phase)
        });
        sum.to_f64().unwrap_or(f64::NAN)
    }
}

/// Name and parameters of a method in one string.
pub fn label(method: &dyn CrossingMethod) -> String {
    let CrossingInfo { name, knobs, .. } = method.info();
    let separator = if knobs.is_empty() { "" } else { ", " };
    format!("{name}, f{}{separator}{knobs}", method.bits())
}
