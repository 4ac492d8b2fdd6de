//! `bake query`: the bending of each ray asked for, one line each, answered as it comes.

use super::{CommandError, table_or_atlas};
use crate::cli::{Method as MethodName, QueryArgs};
use bake::query::{Answers, MAX_LINE, Method, Question};
use lensbake_core::Fate;
use lensbake_report::{Outcome, Printer};
use std::io::{self, BufRead, BufReader, Read};

/// Answers are held back until so many bytes of them are ready.
const BLOCK: usize = 1 << 16;

pub fn run(args: &QueryArgs) -> Result<Outcome, CommandError> {
    let (table, name) = table_or_atlas(args.table.as_deref())?;
    let mut answers = Answers::new(match args.method {
        MethodName::Lut => Method::Lookup(&table),
        MethodName::Rk4 => Method::Rk4(args.tolerance),
        MethodName::Exact => Method::Exact,
    });
    let mut printer = Printer::new(false);
    let mut input = BufReader::with_capacity(BLOCK, io::stdin().lock());
    let (mut line, mut ready) = (Vec::new(), String::new());
    let mut number = 0;
    let asked = loop {
        // Nobody waits for an answer as long as the next question is there.
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
        match Question::parse(&line) {
            Ok(None) => {}
            Ok(Some(question)) => match answers.answer(&question) {
                Ok(bend) => ready += &text(bend),
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
    // What was asked before a bad line is answered.
    printer.print(&ready);
    asked.and(printer.finish().map_err(CommandError::Print))?;
    Ok(Outcome::Done)
}

/// Reads the next line, without its end, or of a longer one as much as shows that it is too long; false at
/// the end of input.
fn next_line(input: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<bool> {
    line.clear();
    let most = MAX_LINE as u64 + 2;
    let read = input.take(most).read_until(b'\n', line)?;
    if line.last() == Some(&b'\n') {
        line.pop();
    }
    Ok(read > 0)
}

fn text(bend: Fate) -> String {
    match bend {
        Fate::Escapes(bend) => format!("{bend:.16e}\n"),
        Fate::Captured => "captured\n".to_owned(),
    }
}
