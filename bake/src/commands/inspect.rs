//! `bake inspect`: prints a table's header and size.

use super::CommandError;
use lensbake_program::{Outcome, Printer};
use lensbake_tables::text::on_one_line;
use lensbake_tables::{Field, container};
use std::path::Path;

pub fn run(file: &Path) -> Result<Outcome, CommandError> {
    let table = container::read(file)?;
    let mut lines = vec![("version".to_owned(), container::VERSION.to_string())];
    for (name, field) in table.header().fields() {
        lines.push((name.to_owned(), show(&field)));
    }
    lines.push(("bytes".into(), table.bytes().to_string()));
    let line = |(name, value): &(String, String)| format!("{name:18} {value}\n");
    let mut printer = Printer::new(false);
    printer.print(&lines.iter().map(line).collect::<String>());
    printer.finish()?;
    Ok(Outcome::Done)
}

fn show(field: &Field) -> String {
    match field {
        Field::Count(n) => n.to_string(),
        Field::Real(x) if *x != 0.0 && x.abs() < 1e-3 => format!("{x:e}"),
        Field::Real(x) => x.to_string(),
        Field::Text(text) => on_one_line(text),
    }
}
