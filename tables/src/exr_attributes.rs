//! Attributes in the header of an OpenEXR file.

use exr::prelude::Text;

/// The same `file`, which the library `exr` has written with one layer, with its attributes sorted by name. The library
/// writes them in arbitrary order, but the same content must give the same bytes. Each attribute is a name and a type, both
/// terminated by a zero, a length and a value; an empty name ends the list.
///
/// # Panics
/// If `file` has no header of that form.
pub fn in_order(mut file: Vec<u8>) -> Vec<u8> {
    const FIRST: usize = 8;
    let mut attributes: Vec<Vec<u8>> = Vec::new();
    let mut at = FIRST;
    while file[at] != 0 {
        let text_end =
            |from: usize| from + file[from..].iter().take_while(|&&b| b != 0).count() + 1;
        let length_at = text_end(text_end(at));
        let length = file[length_at..length_at + 4].iter().rev();
        let length = length.fold(0, |n, &byte| n << 8 | usize::from(byte));
        let end = length_at + 4 + length;
        attributes.push(file[at..end].to_vec());
        at = end;
    }
    attributes.sort();
    file[FIRST..at].copy_from_slice(&attributes.concat());
    file
}

/// `text` as the value of an attribute, in UTF-8.
pub fn encode_text(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

/// The text of an attribute, which is UTF-8. Files of earlier versions hold Latin-1, which is not valid UTF-8 once
/// it has a letter beyond ASCII.
pub fn decode_text(stored: &Text) -> String {
    match std::str::from_utf8(stored.as_slice()) {
        Ok(text) => text.to_owned(),
        Err(_) => stored.to_string(),
    }
}
