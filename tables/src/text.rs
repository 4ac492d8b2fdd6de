//! Text out of a file, made fit to be shown: a file may hold any characters, also those that a terminal
//! obeys.

/// How much of a text a message repeats, in characters.
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

/// The beginning of `text` on one line, short enough for a message.
pub fn excerpt(text: &str) -> String {
    match text.char_indices().nth(EXCERPT) {
        None => on_one_line(text),
        Some((end, _)) => on_one_line(&text[..end]) + "...",
    }
}
