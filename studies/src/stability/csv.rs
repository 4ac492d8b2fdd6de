//! The stability atlas as CSV: one line per cell, `regime;method;verdict`.

use super::{Atlas, Verdict};
use std::collections::BTreeMap;

const HEAD: &str = "regime;method;verdict";

/// The whole atlas as CSV text. Semicolons separate the fields, since names contain commas.
pub fn text(atlas: &Atlas) -> String {
    let mut text = format!("{HEAD}\n");
    for line in &atlas.lines {
        let title = line.regime.title();
        for (info, verdict) in atlas.columns.iter().zip(&line.verdicts) {
            text += &format!("{title};{};{verdict}\n", info.label());
        }
    }
    text
}

/// The verdict of each (regime, method) in a text made by [`text`]; `None` if it is malformed.
pub fn read(text: &str) -> Option<BTreeMap<(String, String), Verdict>> {
    let mut lines = text.lines();
    if lines.next() != Some(HEAD) {
        return None;
    }
    lines
        .map(|line| {
            let fields: Vec<&str> = line.split(';').collect();
            let [regime, method, verdict] = fields[..] else {
                return None;
            };
            let key = (regime.to_owned(), method.to_owned());
            Some((key, verdict.parse().ok()?))
        })
        .collect()
}
