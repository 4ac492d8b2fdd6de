//! The methods that the chart and the stability atlas compare. Each is a type that implements [`BendingMethod`].
//!
//! Four of them call the project's own code: [`closed_form`], [`rk4_adaptive`], [`default_row`] and [`row_batch`]. That code
//! does not depend on this module.

pub mod atlas_fetch;
pub mod bholetrace;
pub mod closed_form;
pub mod default_row;
pub mod dormand_prince;
pub mod far_model;
pub mod filter_weight;
mod initial_conditions;
pub mod leapfrog;
mod outcome;
pub mod quadrature;
pub mod registry;
pub mod rk4_adaptive;
pub mod rk4_fixed;
pub mod row_axis;
pub mod row_batch;
pub mod row_store;
pub mod row_table;
pub mod semi_implicit_euler;
pub mod series;
mod textbook;

pub use initial_conditions::InitialConditions;
pub use outcome::MethodOutcome;

use lensbake_core::Observer;
use std::hint::black_box;

/// The kind of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Integrates the ray's equation of motion.
    Direct,
    /// Evaluates a formula.
    Closed,
    /// Looks up a row of texels.
    Table,
    /// Computes the exact bending for another observer than the actual one.
    Model,
}

impl Family {
    /// Name in the CSV files and the figures.
    pub fn name(self) -> &'static str {
        match self {
            Family::Direct => "direct",
            Family::Closed => "closed",
            Family::Table => "table",
            Family::Model => "model",
        }
    }
}

/// Description of a method.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodInfo {
    /// Name.
    pub name: String,
    /// Values of its parameters; empty without parameters.
    pub knobs: String,
    /// The publication or the code that it comes from.
    pub source: &'static str,
    /// Kind of method.
    pub family: Family,
    /// Whether the figure labels it, because readers will look for it.
    pub landmark: bool,
}

impl MethodInfo {
    /// Name and parameters in one string.
    pub fn label(&self) -> String {
        if self.knobs.is_empty() {
            self.name.clone()
        } else {
            format!("{}, {}", self.name, self.knobs)
        }
    }
}

/// A method that computes the bending of a ray.
pub trait BendingMethod: Send + Sync {
    /// Description of the method.
    fn info(&self) -> MethodInfo;

    /// The outcome of one ray, with its bending.
    fn bend(&self, initial: &InitialConditions) -> MethodOutcome;

    /// Bytes of data that a frame needs.
    fn bytes(&self) -> usize {
        0
    }

    /// Whether the method can answer for this observer.
    fn serves(&self, _observer: &Observer) -> bool {
        true
    }

    /// The work that is timed: the bendings of all `initial_conditions`, once. What a method needs before, such as its input
    /// in another layout, it prepares here.
    fn timed<'a>(&'a self, initial_conditions: &'a [InitialConditions]) -> Box<dyn Fn() + 'a> {
        Box::new(|| {
            black_box(self.bend_sum(black_box(initial_conditions)));
        })
    }

    /// The sum of the bendings of all `initial_conditions`, rad. This is the loop that is timed unless the method has
    /// another; its calls of [`BendingMethod::bend`] are statically dispatched.
    fn bend_sum(&self, initial_conditions: &[InitialConditions]) -> f64 {
        initial_conditions
            .iter()
            .map(|initial| self.bend(initial).bend().unwrap_or(0.0))
            .sum()
    }
}
