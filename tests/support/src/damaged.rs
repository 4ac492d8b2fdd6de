//! Damaged table files, which every program must refuse.

use lensbake_tables::ATLAS_BINARY;

/// A damaged table file, and the error that it must give.
#[derive(Debug, Clone)]
pub struct Damaged {
    /// A name for the file.
    pub name: &'static str,
    /// Its contents.
    pub bytes: Vec<u8>,
    /// Words that the error must contain.
    pub words: &'static [&'static str],
}

/// Offset of the texel count in the binary atlas: after the prefix, the axis and the rows.
const TEXELS_FIELD: usize = 16 + 4 + 20;
/// Bytes of the atlas's texels, which end before the checksum.
const TEXEL_BYTES: usize = 96 * 1024;

/// The binary atlas with each kind of damage.
pub fn damaged_tables() -> Vec<Damaged> {
    let end = ATLAS_BINARY.len();
    let mut flipped = ATLAS_BINARY.to_vec();
    flipped[end / 2] ^= 0x10;
    let nan = with_word(end - 4 - TEXEL_BYTES / 2, f32::NAN.to_bits());
    let case = |name, bytes, words| Damaged { name, bytes, words };
    vec![
        case(
            "truncated.lbt",
            ATLAS_BINARY[..end - 1000].to_vec(),
            &["bytes long", "truncated"],
        ),
        case("stub.lbt", ATLAS_BINARY[..10].to_vec(), &["truncated"]),
        case(
            "longer.lbt",
            [ATLAS_BINARY, b"more"].concat(),
            &["bytes long"],
        ),
        case(
            "version.lbt",
            with_word(8, 7),
            &["format version 7", "bake it again"],
        ),
        case(
            "header.lbt",
            with_word(12, u32::MAX),
            &["header cannot be decoded"],
        ),
        case("flipped.lbt", flipped, &["checksum", "damaged"]),
        case(
            "nan.lbt",
            with_checksum(nan),
            &["texel", "not a finite number"],
        ),
        case(
            "absurd.lbt",
            with_checksum(with_word(TEXELS_FIELD, u32::MAX)),
            &["texels in a row is 4294967295"],
        ),
        case(
            "none.lbt",
            with_checksum(with_word(TEXELS_FIELD, 0)),
            &["texels in a row is 0"],
        ),
        case("empty.lbt", Vec::new(), &["not a bending table"]),
        case(
            "text.lbt",
            b"hello, I am no table".to_vec(),
            &["not a bending table"],
        ),
    ]
}

/// The atlas with the four bytes at `at` replaced, its checksum left as it was.
fn with_word(at: usize, word: u32) -> Vec<u8> {
    let mut bytes = ATLAS_BINARY.to_vec();
    bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
    bytes
}

/// The file with its checksum corrected, as a faulty or hostile writer would correct it.
fn with_checksum(mut bytes: Vec<u8>) -> Vec<u8> {
    let end = bytes.len() - 4;
    let crc = crc32fast::hash(&bytes[16..end]);
    bytes[end..].copy_from_slice(&crc.to_le_bytes());
    bytes
}
