//! The methods that the chart and the atlas of stability compare, each a small type behind one trait.
//!
//! The product's own path depends on none of them: it is listed among them
//! ([`closed_form`], [`rk4_adaptive`], [`default_row`]) as any other.

pub mod closed_form;
pub mod default_row;
pub mod dormand_prince;
pub mod far_model;
mod launch;
pub mod leapfrog;
mod outcome;
pub mod quadrature;
pub mod registry;
pub mod rk4_adaptive;
pub mod rk4_fixed;
pub mod row_axis;
pub mod row_table;
pub mod seed_search;
pub mod semi_implicit_euler;
pub mod series;
mod textbook;

pub use launch::Launch;
pub use outcome::Outcome;

use lensbake_core::Observer;

/// What kind of method it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Integrates the ray's equation.
    Direct,
    /// Evaluates a formula.
    Closed,
    /// Looks up a row of texels.
    Table,
    /// Exact in itself, for another observer than the one who looks.
    Model,
}

impl Family {
    /// Its name in the CSV files and the figures.
    pub fn name(self) -> &'static str {
        match self {
            Family::Direct => "direct",
            Family::Closed => "closed",
            Family::Table => "table",
            Family::Model => "model",
        }
    }
}

/// What a method says of itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// Its name.
    pub name: String,
    /// The values of its knobs; empty if it has none.
    pub knobs: String,
    /// Where it is from.
    pub source: &'static str,
    /// What kind it is.
    pub family: Family,
    /// Whether readers will look for it in the figure.
    pub landmark: bool,
}

impl Card {
    /// Name and knobs in one.
    pub fn label(&self) -> String {
        if self.knobs.is_empty() {
            self.name.clone()
        } else {
            format!("{}, {}", self.name, self.knobs)
        }
    }
}

/// A way to find the bending of a ray.
pub trait Method: Send + Sync {
    /// What it says of itself.
    fn card(&self) -> Card;

    /// The bending of one ray.
    fn bend(&self, launch: &Launch) -> Outcome;

    /// Bytes that a frame needs beside the code.
    fn bytes(&self) -> usize {
        0
    }

    /// Whether it can answer for this observer at all.
    fn serves(&self, _observer: &Observer) -> bool {
        true
    }

    /// The sum of the bendings of all `launches`, in rad: the loop that is timed, in which the call of
    /// [`Method::bend`] is a direct one.
    fn bend_sum(&self, launches: &[Launch]) -> f64 {
        launches
            .iter()
            .map(|launch| self.bend(launch).bend().unwrap_or(0.0))
            .sum()
    }
}
