//! Line numbers of a CSV text as an editor shows them: a line ends with LF, CR LF, or CR alone, and comments,
//! empty lines and line ends inside quotes count.

use csv::ByteRecord;

/// A CSV text.
pub(super) struct Lines<'b> {
    text: &'b [u8],
    comment: u8,
}

impl<'b> Lines<'b> {
    /// The lines of `text`; those that start with `comment` belong to no record.
    pub(super) fn new(text: &'b [u8], comment: u8) -> Self {
        Lines { text, comment }
    }

    /// Line number, from 1, at which the value of a field of a record begins; for a field that the record lacks,
    /// the line at which the record ends.
    pub(super) fn of_field(&self, record: &ByteRecord, field: usize) -> u64 {
        let before = record.iter().take(field).map(ends_of_line);
        let blank =
            |value: &[u8]| ends_of_line(&value[..value.len() - value.trim_ascii_start().len()]);
        let inside = record.get(field).map_or(0, blank);
        1 + ends_of_line(&self.text[..self.start(record)]) + before.sum::<u64>() + inside
    }

    /// All lines before a record.
    pub(super) fn before(&self, record: &ByteRecord) -> impl DoubleEndedIterator<Item = &'b [u8]> {
        self.text[..self.start(record)].split(|&byte| byte == b'\n' || byte == b'\r')
    }

    /// Byte offset at which a record starts. The reader's position is the end of the record before it: between the
    /// CR and the LF of its last line, and before any comments and empty lines.
    fn start(&self, record: &ByteRecord) -> usize {
        let end = self.text.len();
        let mut at = record.position().map_or(end as u64, |p| p.byte()) as usize;
        while let Some(&byte) = self.text.get(at) {
            if byte == self.comment {
                // The reader ends a comment only at LF.
                at = self.text[at..]
                    .iter()
                    .position(|&byte| byte == b'\n')
                    .map_or(end, |length| at + length);
            } else if byte == b'\n' || byte == b'\r' {
                at += 1;
            } else {
                break;
            }
        }
        at.min(end)
    }
}

fn ends_of_line(text: &[u8]) -> u64 {
    let mut ends = 0;
    let mut previous = 0;
    for &byte in text {
        ends += u64::from(byte == b'\r' || byte == b'\n' && previous != b'\r');
        previous = byte;
    }
    ends
}
