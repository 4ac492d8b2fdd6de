//! `bake`: bakes a table, measures its error, and writes it.

use super::CommandError;
use crate::cli::{AxisName, BakeArgs};
use lensbake_program::{Outcome, Progress, message};
use lensbake_tables::baking::EDGE_GAP;
use lensbake_tables::baking::measured;
use lensbake_tables::baking::{self, Recipe};
use lensbake_tables::{Axis, ContainerError, Rows, Table};
use std::time::Instant;

pub fn run(args: &BakeArgs) -> Result<Outcome, CommandError> {
    // Check the outputs before the work, not after it.
    let outputs: Vec<_> = args
        .output
        .iter()
        .map(|path| super::table_output(path))
        .collect::<Result<_, _>>()?;
    for (i, (_, output)) in outputs.iter().enumerate() {
        for (_, other) in &outputs[..i] {
            output.is_apart(other, ["--output", "--output"])?;
        }
    }
    let recipe = recipe(args);
    let table = match args.threads {
        None => bake_and_measure(&recipe)?,
        Some(count) => rayon::ThreadPoolBuilder::new()
            .num_threads(count.into())
            .build()
            .map_err(|e| CommandError::Threads(e.to_string()))?
            .install(|| bake_and_measure(&recipe))?,
    };
    let header = table.header();
    let errors = [
        ("", args.budget, Some(header.measured)),
        (
            " below the horizon",
            args.budget_below,
            header.measured_below,
        ),
    ];
    for (side, budget, measured) in errors {
        let (Some(budget), Some(measured)) = (budget, measured) else {
            continue;
        };
        if measured.max_error > budget {
            message!("the error{side} is above the budget of {budget:.3e} rad: nothing is written");
            return Ok(Outcome::Missed);
        }
    }
    for (container, output) in &outputs {
        let bytes = container
            .encode(&table)
            .map_err(|problem| ContainerError::new(output.path(), problem))?;
        output.write(&bytes)?;
        message!("wrote {}", output.name());
    }
    Ok(Outcome::Done)
}

fn recipe(args: &BakeArgs) -> Recipe {
    let Recipe { texels, rows, .. } = Recipe::default();
    let (b_min, b_max) = (args.b_min, args.b_max);
    let (axis, texels) = match args.axis {
        AxisName::Residual => (Axis::Residual, texels),
        AxisName::B => (Axis::UniformB { b_min, b_max }, 1024),
        AxisName::InverseB => (Axis::UniformInverseB { b_min, b_max }, 1024),
        AxisName::LogB => (Axis::UniformLogB { b_min, b_max }, 1024),
    };
    let far = Rows::One {
        inverse_radius: 0.0,
    };
    let rows = match args.observer {
        Some(observer) => Rows::One {
            inverse_radius: observer.inverse_radius(),
        },
        None if args.rows.is_none() && args.rows_below.is_none() && axis != Axis::Residual => far,
        None => atlas(args, rows),
    };
    Recipe {
        axis,
        rows,
        texels: args.texels.unwrap_or(texels),
        tolerance: args.tolerance,
    }
}

/// The rows of the default atlas, with the numbers of `args`.
fn atlas(args: &BakeArgs, default: Rows) -> Rows {
    let Rows::ThroughHorizon {
        above,
        below,
        r_min,
    } = default
    else {
        return default;
    };
    let (above, below) = (args.rows.unwrap_or(above), args.rows_below.unwrap_or(below));
    match below {
        0 => Rows::Chi { count: above },
        below => Rows::ThroughHorizon {
            above,
            below,
            r_min,
        },
    }
}

fn bake_and_measure(recipe: &Recipe) -> Result<Table, CommandError> {
    let rows = recipe.rows.count();
    let progress = Progress::new("baking", rows.into());
    let table = baking::bake(recipe, || progress.step())?;
    let seconds = progress.finish().as_secs_f64();
    message!(
        "baked {rows} x {} texels ({:.1} KiB) in {seconds:.3} s on {} threads",
        recipe.texels,
        table.bytes() as f64 / 1024.0,
        rayon::current_num_threads(),
    );
    let started = Instant::now();
    let table = measured(table)?;
    let measured = table.header().measured;
    if measured.rays == 0 {
        message!(
            "the error is not known: no ray was measured, since all are nearer to the shadow's edge than \
             1 - x = {EDGE_GAP:.0e}"
        );
        return Ok(table);
    }
    let seconds = started.elapsed().as_secs_f64();
    for (side, measured) in [
        ("", Some(measured)),
        (" below the horizon", table.header().measured_below),
    ] {
        let Some(measured) = measured else { continue };
        message!(
            "largest error{side} {:.3e} rad against the closed form over {} rays off the nodes, r from {:.6}, \
             1 - x from {:.1e} (measured in {seconds:.3} s)",
            measured.max_error,
            measured.rays,
            measured.r_min,
            measured.edge_gap,
        );
    }
    Ok(table)
}
