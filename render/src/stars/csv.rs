//! Reads a user's catalogue: CSV whose header names the columns `ra`, `dec` (degrees), `mag` and, if known, `bv`,
//! in any order and among any others. Lines that start with `#` are comments. If the first line that is not a
//! comment is not a header either, the last comment before it that names the columns is the header.

use super::lines::Lines;
use super::{Catalogue, DEFAULT_DISC_RADIUS, MAX_STARS, Star, StarsProblem};
use csv::{ByteRecord, ErrorKind, Reader, ReaderBuilder, StringRecord};

const COMMENT: u8 = b'#';

/// Parses the CSV text `bytes`.
///
/// # Errors
/// [`StarsProblem`] says which column is missing or which line is bad.
pub(super) fn read(bytes: &[u8]) -> Result<Catalogue, StarsProblem> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let lines = Lines::new(bytes, COMMENT);
    let mut reader = reader(bytes);
    let mut record = ByteRecord::new();
    let first_is_there = next(&mut reader, &mut record)?;
    let (columns, first_is_star) = match Columns::of(&record) {
        Ok(columns) => (columns, false),
        Err(missing) => match header_in_comments(&lines, &record) {
            Some(columns) => (columns, first_is_there),
            None => return Err(missing),
        },
    };
    let mut stars = Vec::new();
    if first_is_star {
        stars.push(columns.star(&record, &lines)?);
    }
    while next(&mut reader, &mut record)? {
        if stars.len() == MAX_STARS {
            return Err(StarsProblem::TooMany { max: MAX_STARS });
        }
        stars.push(columns.star(&record, &lines)?);
    }
    Catalogue::new(stars, DEFAULT_DISC_RADIUS)
}

fn reader(bytes: &[u8]) -> Reader<&[u8]> {
    ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(COMMENT))
        .from_reader(bytes)
}

/// Reads the next record and returns whether there was one. The reader accepts any number of fields, of any length
/// and with any bytes, so reading from memory cannot fail.
fn next(reader: &mut Reader<&[u8]>, record: &mut ByteRecord) -> Result<bool, StarsProblem> {
    reader
        .read_byte_record(record)
        .map_err(|error| match error.into_kind() {
            ErrorKind::Io(error) => StarsProblem::Io(error),
            _ => StarsProblem::Line {
                line: 1,
                reason: "its fields cannot be told apart",
            },
        })
}

/// The columns of the last comment before the first record that names them.
fn header_in_comments(lines: &Lines<'_>, first: &ByteRecord) -> Option<Columns> {
    let comments = lines.before(first).rev();
    let comments = comments.filter_map(|line| line.strip_prefix(&[COMMENT]));
    let mut headers = comments.filter_map(|comment| {
        let mut record = ByteRecord::new();
        next(&mut reader(comment), &mut record).ok()?;
        Columns::of(&record).ok()
    });
    headers.next()
}

/// The index of each column.
struct Columns {
    ra: usize,
    dec: usize,
    mag: usize,
    bv: Option<usize>,
}

impl Columns {
    fn of(header: &ByteRecord) -> Result<Self, StarsProblem> {
        let find = |name: &str| {
            header
                .iter()
                .position(|field| field.trim_ascii().eq_ignore_ascii_case(name.as_bytes()))
        };
        let need = |name| find(name).ok_or(StarsProblem::Column(name));
        Ok(Columns {
            ra: need("ra")?,
            dec: need("dec")?,
            mag: need("mag")?,
            bv: find("bv"),
        })
    }

    fn star(&self, record: &ByteRecord, lines: &Lines<'_>) -> Result<Star, StarsProblem> {
        let record = &StringRecord::from_byte_record(record.clone()).map_err(|error| {
            let field = error.utf8_error().field();
            StarsProblem::Line {
                line: lines.of_field(record, field),
                reason: "it is not UTF-8",
            }
        })?;
        let number = |column, index, range: std::ops::RangeInclusive<f64>, expected| {
            let text = record.get(index).unwrap_or("").trim();
            match text.parse::<f64>() {
                Ok(value) if range.contains(&value) => Ok(value),
                _ => Err(StarsProblem::Value {
                    line: lines.of_field(record.as_byte_record(), index),
                    column,
                    found: text.escape_debug().take(30).collect(),
                    expected,
                }),
            }
        };
        let degrees = "degrees from -360 to 360";
        let magnitudes = "a magnitude from -30 to 30";
        let colour = |index| {
            number(
                "bv",
                index,
                -5.0..=20.0,
                "a colour index from -5 to 20, or empty",
            )
        };
        let has_colour = |index: &usize| {
            let text = record.get(*index);
            text.is_some_and(|text| !text.trim().is_empty())
        };
        Ok(Star {
            right_ascension: number("ra", self.ra, -360.0..=360.0, degrees)?.to_radians(),
            declination: number("dec", self.dec, -90.0..=90.0, "degrees from -90 to 90")?
                .to_radians(),
            magnitude: number("mag", self.mag, -30.0..=30.0, magnitudes)?,
            colour_index: self.bv.filter(has_colour).map(colour).transpose()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        read(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn columns_may_stand_in_any_order_among_others() {
        let text = "name, Mag ,DEC,bv,RA\n# a comment\nA,1.5,-30,0.6,90\r\n\"B, too\",-2,10,,-10\n";
        let catalogue = read(text.as_bytes()).unwrap();
        let [b, a] = catalogue.stars() else { panic!() };
        assert_eq!((a.magnitude, a.colour_index), (1.5, Some(0.6)));
        assert_eq!(a.right_ascension, 90f64.to_radians());
        assert_eq!(a.declination, (-30f64).to_radians());
        assert_eq!((b.magnitude, b.colour_index), (-2.0, None));
        assert!(read(b"\xef\xbb\xbfra,dec,mag\n1,2,3\n").is_ok(), "a BOM");
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, said) in [
            ("", "no column 'ra'"),
            ("ra,dec,mag\n", "no star"),
            ("ra,mag\n1,2\n", "no column 'dec'"),
            ("ra,dec,bv\n1,2,3\n", "no column 'mag'"),
            ("ra,dec,mag\n1,2,3\n1,2,NaN\n", "line 3: mag is 'NaN'"),
            ("ra,dec,mag\n1,inf,3\n", "line 2: dec is 'inf'"),
            ("ra,dec,mag\n1,91,3\n", "line 2: dec is '91'"),
            ("ra,dec,mag\nx,1,3\n", "line 2: ra is 'x'"),
            ("ra,dec,mag\n1,2\n", "line 2: mag is ''"),
            ("ra,dec,mag,bv\n1,2,3,blue\n", "line 2: bv is 'blue'"),
        ] {
            let told = refused(text);
            assert!(told.contains(said), "{text:?}: {told}");
            assert_eq!(told.lines().count(), 1, "{told}");
        }
        assert!(matches!(
            read(b"ra,dec,mag\n\xff\xfe,2,3\n"),
            Err(StarsProblem::Line { line: 2, .. })
        ));
    }

    #[test]
    fn the_line_named_is_the_one_that_an_editor_shows() {
        for (text, line) in [
            ("ra,dec,mag\n1,2,3\n1,2,x\n", 3),
            ("ra,dec,mag\r\n1,2,3\r\n1,2,x\r\n", 3),
            ("ra,dec,mag\r1,2,3\r1,2,x\r", 3),
            ("\u{feff}ra,dec,mag\r\n1,2,3\r\n1,2,x\r\n", 3),
            ("ra,dec,mag\n# one\n\n# two\n1,2,x\n", 5),
            ("ra,dec,mag\r\n# one\r\n\r\n# two\r\n1,2,x\r\n", 5),
            ("# one\n\nra,dec,mag\n\n\n1,2,x\n", 6),
            ("\n\r\nra,dec,mag\n1,2,x", 4),
            ("name,ra,dec,mag\n\"A\nB\",1,2,3\n\"C\",1,2,x\n", 4),
            ("name,ra,dec,mag\r\n\"A\r\nB\r\n\",1,2,3\r\nC,1,2,x\r\n", 5),
            // A field of the bad record spans several lines.
            ("name,ra,dec,mag\n\"A\nB\",1,2,x\n", 3),
            ("ra,dec,mag,name\n1,2,x,\"A\nB\"\n", 2),
            ("ra,dec,mag\n1,2,\"\n\nx\"\n", 4),
            // '#' inside a quoted field does not start a comment.
            ("name,ra,dec,mag\n\"A\n# B\",1,2,3\n1,1,2,x\n", 4),
            ("#ra,dec,mag\r\n1,2,3\r\n1,2,x\r\n", 3),
            ("#ra,dec,mag\n1,2,x\n", 2),
        ] {
            let told = refused(text);
            assert!(
                told.contains(&format!("line {line}: mag is 'x'")),
                "{text:?}: {told}"
            );
        }
        for (bytes, line) in [
            (&b"ra,dec,mag\r\n# one\r\n1,2,3\r\n\xff\xfe,2,3\r\n"[..], 4),
            (b"name,ra,dec,mag\n\"A\nB\",1,2,\xff\n", 3),
        ] {
            let told = read(bytes).unwrap_err().to_string();
            assert!(told.contains(&format!("line {line}")), "{told}");
        }
    }

    /// Astronomers' tools write the column names as a comment.
    #[test]
    fn a_header_may_be_a_comment() {
        for text in [
            "#ra,dec,mag\n10,20,3\n",
            "# RA, Dec ,mag\r\n10,20,3\r\n",
            "\u{feff}#ra,dec,mag\n10,20,3\n",
            "# from a survey\n\n#ra,dec,mag\n# more\n10,20,3\n",
            // A header line takes precedence over a header in a comment.
            "#dec,ra,mag\nra,dec,mag\n10,20,3\n",
        ] {
            let catalogue = read(text.as_bytes()).unwrap_or_else(|e| panic!("{text:?}: {e}"));
            let [star] = catalogue.stars() else {
                panic!("{text:?}")
            };
            assert_eq!(star.right_ascension, 10f64.to_radians(), "{text:?}");
        }
        assert!(refused("#ra,dec\n10,20,3\n").contains("no column"));
        assert!(refused("#ra,dec,mag\n").contains("no star"));
    }
}
