//! `bake query`: the bending of each ray asked for, one line each.

use super::{CommandError, table_or_atlas};
use crate::cli::{Method, QueryArgs};
use bake::rays::Sight;
use lensbake_core::rk4::Stepper;
use lensbake_core::{EdgeCoordinate, Fate, Observer, Ray, direct, exact};
use lensbake_report::Outcome;
use lensbake_tables::{Row, Table, TableError};
use std::io::{self, BufRead, BufWriter, Write};

pub fn run(args: &QueryArgs) -> Result<Outcome, CommandError> {
    let (table, name) = table_or_atlas(args.table.as_deref())?;
    let mut lookup = Lookup {
        table: &table,
        row: None,
    };
    let mut out = BufWriter::new(io::stdout().lock());
    for (index, line) in io::stdin().lock().lines().enumerate() {
        let line = line.map_err(CommandError::Stdin)?;
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let (sight, ray) = parse(&line).map_err(|problem| CommandError::Line {
            line: index + 1,
            problem,
        })?;
        let bend = match args.method {
            Method::Exact => exact::bend(&ray),
            Method::Rk4 => direct::bend(&ray, Stepper::Adaptive(args.tolerance)),
            Method::Lut => lookup
                .bend(sight)
                .map_err(|problem| CommandError::InTable {
                    path: name.clone(),
                    problem,
                })?,
        };
        match bend {
            Fate::Escapes(bend) => writeln!(out, "{bend:.16e}"),
            Fate::Captured => writeln!(out, "captured"),
        }
        .map_err(CommandError::Stdout)?;
    }
    out.flush().map_err(CommandError::Stdout)?;
    Ok(Outcome::Done)
}

/// A table and the row last mixed from it: questions often come from one observer.
struct Lookup<'a> {
    table: &'a Table,
    row: Option<Row>,
}

impl Lookup<'_> {
    fn bend(&mut self, sight: Sight) -> Result<Fate, TableError> {
        let row = match self.row.take() {
            Some(row) if *row.observer() == sight.observer => row,
            _ => self.table.row(sight.observer)?,
        };
        let bend = row.bend(sight.at);
        self.row = Some(row);
        Ok(bend)
    }
}

/// A line `R THETA_DEG` or `inf B`.
fn parse(line: &str) -> Result<(Sight, Ray), String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [first, second] = words[..] else {
        return Err(format!("'{line}' is not `R THETA_DEG` or `inf B`"));
    };
    let number = |word: &str| {
        word.parse::<f64>()
            .map_err(|_| format!("'{word}' is not a number"))
    };
    let observer = Observer::at(number(first)?).map_err(|e| e.to_string())?;
    let second = number(second)?;
    let (at, ray) = if observer.is_far() {
        let ray = Ray::from_infinity(second).map_err(|e| e.to_string())?;
        (EdgeCoordinate::from_b(second), ray)
    } else {
        if !(0.0..=180.0).contains(&second) {
            return Err(format!("view angle {second} is outside 0 to 180 degrees"));
        }
        let theta = second.to_radians();
        let ray = observer.ray(theta).map_err(|e| e.to_string())?;
        (observer.edge_coordinate(theta), ray)
    };
    Ok((Sight { observer, at }, ray))
}
