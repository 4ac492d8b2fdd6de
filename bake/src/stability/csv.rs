//! The atlas as CSV: one line a cell, `regime;method;verdict`.

use super::{Atlas, Verdict};
use std::collections::BTreeMap;

const HEAD: &str = "regime;method;verdict";

/// The whole atlas; semicolons part the fields, since names hold commas.
pub fn text(atlas: &Atlas) -> String {
    let mut text = format!("{HEAD}\n");
    for line in &atlas.lines {
        let title = line.regime.title();
        for (card, verdict) in atlas.columns.iter().zip(&line.verdicts) {
            text += &format!("{title};{};{verdict}\n", card.label());
        }
    }
    text
}

/// The verdict of each (regime, method) in such a text; `None` if it is none.
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
