//! `bake query`: prints the bending, the point of the sky, or the crossings with a disc of each ray asked for on a line of
//! its own, before it waits for the next question.

use super::{CommandError, table_or_atlas};
use crate::cli::{MethodName, QueryArgs, Radii};
use bake::query::{Answers, MAX_LINE, QueryMethod, Question, SkyPoint};
use lensbake_core::disc_crossing::Crossing;
use lensbake_core::{RayOutcome, ThinDisc};
use lensbake_program::{Outcome, Printer};
use lensbake_tables::TableError;
use std::io::{self, BufRead, BufReader, Read};

/// Size of the input buffer, and of the answers that may be held back, bytes.
const BLOCK: usize = 1 << 16;

pub fn run(args: &QueryArgs) -> Result<Outcome, CommandError> {
    let wanted = Wanted::of(args)?;
    let (table, name) = table_or_atlas(args.table.as_deref())?;
    let mut answers = Answers::new(match args.method {
        MethodName::Lut => QueryMethod::Lookup(&table),
        MethodName::Rk4 => QueryMethod::Rk4(args.tolerance),
        MethodName::Exact => QueryMethod::Exact,
    });
    let mut printer = Printer::new(false);
    let mut input = BufReader::with_capacity(BLOCK, io::stdin().lock());
    let (mut line, mut ready) = (Vec::new(), String::new());
    let mut number = 0;
    let asked = loop {
        // Answers may be held back while the next question is already in the buffer, not while waiting for it.
        if ready.len() > BLOCK || !input.buffer().contains(&b'\n') {
            printer.print(&ready);
            ready.clear();
        }
        if !printer.is_read() {
            break Ok(());
        }
        match next_line(&mut input, &mut line) {
            Ok(true) => number += 1,
            Ok(false) => break Ok(()),
            Err(error) => break Err(CommandError::Stdin(error)),
        }
        match Question::parse(&line, args.motion) {
            Ok(None) => {}
            Ok(Some(question)) => match wanted.line(&mut answers, &question) {
                Ok(answer) => ready += &answer,
                Err(problem) => {
                    break Err(CommandError::InTable {
                        path: name,
                        problem,
                    });
                }
            },
            Err(problem) => {
                break Err(CommandError::Line {
                    line: number,
                    problem,
                });
            }
        }
    };
    // Questions before a bad line are still answered.
    printer.print(&ready);
    asked.and(printer.finish().map_err(CommandError::Print))?;
    Ok(Outcome::Done)
}

/// What is printed of a ray.
enum Wanted {
    Bending,
    Sky,
    Crossings(ThinDisc),
}

impl Wanted {
    fn of(args: &QueryArgs) -> Result<Self, CommandError> {
        Ok(match args.disc {
            Some(Radii { inner, outer }) => {
                let disc = ThinDisc::new(inner, outer, args.inclination, args.node);
                Wanted::Crossings(disc.map_err(CommandError::Disc)?)
            }
            None if args.sky => Wanted::Sky,
            None => Wanted::Bending,
        })
    }

    /// The line that answers `question`.
    fn line(&self, answers: &mut Answers, question: &Question) -> Result<String, TableError> {
        if let Wanted::Crossings(disc) = self {
            return Ok(crossings_text(&answers.crossings(question, disc)?));
        }
        let outcome = answers.answer(question)?;
        Ok(text(outcome, matches!(self, Wanted::Sky)))
    }
}

/// Reads the next line without its end; of a line that is too long, only as much as shows it. False at the end of
/// input.
fn next_line(input: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<bool> {
    line.clear();
    let most = MAX_LINE as u64 + 2;
    let read = input.take(most).read_until(b'\n', line)?;
    if line.last() == Some(&b'\n') {
        line.pop();
    }
    Ok(read > 0)
}

fn text(outcome: RayOutcome<SkyPoint>, sky: bool) -> String {
    match outcome {
        RayOutcome::Captured => "captured\n".to_owned(),
        RayOutcome::Escapes(SkyPoint { bend, .. }) if !sky => format!("{bend:.16e}\n"),
        RayOutcome::Escapes(SkyPoint {
            theta,
            azimuth,
            shift,
            ..
        }) => format!("{theta:.16e} {azimuth:.16e} {shift:.16e}\n"),
    }
}

/// `RADIUS ORDER SHIFT` of each crossing; `-` if there is none.
fn crossings_text(crossings: &[Crossing]) -> String {
    if crossings.is_empty() {
        return "-\n".to_owned();
    }
    let words = crossings.iter().map(|crossing| {
        let Crossing {
            radius,
            order,
            shift,
            ..
        } = crossing;
        format!("{radius:.16e} {order} {shift:.16e}")
    });
    words.collect::<Vec<_>>().join(" ") + "\n"
}
