//! `bake query`: prints the bending, or the point of the sky, of each ray asked for on a line of its own, before it waits for the next
//! question.

use super::{CommandError, table_or_atlas};
use crate::cli::{MethodName, QueryArgs};
use bake::query::{Answers, MAX_LINE, QueryMethod, Question, SkyPoint};
use lensbake_core::RayOutcome;
use lensbake_program::{Outcome, Printer};
use std::io::{self, BufRead, BufReader, Read};

/// Size of the input buffer, and of the answers that may be held back, bytes.
const BLOCK: usize = 1 << 16;

pub fn run(args: &QueryArgs) -> Result<Outcome, CommandError> {
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
            Ok(Some(question)) => match answers.answer(&question) {
                Ok(outcome) => ready += &text(outcome, args.sky),
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
