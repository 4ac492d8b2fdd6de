//! Makes text from a file safe to display: it may contain control characters that a terminal would obey.

/// Most characters of a text that a message quotes.
const EXCERPT: usize = 40;

/// `text` on one line: control characters are escaped as in Rust (`\n`, `\0`, `\u{1b}`).
pub fn on_one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_control() {
            line.extend(character.escape_debug());
        } else {
            line.push(character);
        }
    }
    line
}

/// The first 40 characters of `text` on one line, followed by `...` if it is longer.
pub fn excerpt(text: &str) -> String {
    match text.char_indices().nth(EXCERPT) {
        None => on_one_line(text),
        Some((end, _)) => on_one_line(&text[..end]) + "...",
    }
}
