//! The binary container. Only this module uses bincode.
//!
//! ```text
//! magic "LENSBAKE" | version u32 | header length u32 | header (bincode) | texels f32 … | CRC-32 u32
//! ```
//!
//! All numbers are little-endian. The checksum covers the header and the texels.

use super::{Version, checksum};
use crate::error::Problem;
use crate::header::MAX_SOLVER_NAME;
use crate::{Axis, Header, Measured, Rows, Solver, Table};
use serde::{Deserialize, Serialize};

pub(super) const MAGIC: [u8; 8] = *b"LENSBAKE";
const PREFIX: usize = MAGIC.len() + 4 + 4;
/// Most bytes of a header: the solver's name is its only part of arbitrary length, and the other parts have at
/// most 124 bytes.
const MAX_HEADER: usize = MAX_SOLVER_NAME + 124;
const TEXEL: u64 = 8;
const CHECKSUM: u64 = 4;

fn layout() -> impl bincode::config::Config {
    bincode::config::standard()
        .with_little_endian()
        .with_fixed_int_encoding()
        .with_limit::<MAX_HEADER>()
}

/// The header of version 1, which has no error below the horizon.
#[derive(Debug, Serialize, Deserialize)]
struct HeaderV1 {
    axis: Axis,
    rows: Rows,
    texels: u32,
    solver: Solver,
    measured: Measured,
}

pub(super) fn encode_header(header: &Header, version: Version) -> Result<Vec<u8>, Problem> {
    let encoded = match version {
        Version::One => bincode::serde::encode_to_vec(
            HeaderV1 {
                axis: header.axis,
                rows: header.rows,
                texels: header.texels,
                solver: header.solver.clone(),
                measured: header.measured,
            },
            layout(),
        ),
        Version::Two => bincode::serde::encode_to_vec(header, layout()),
    };
    encoded.map_err(|e| Problem::Header(e.to_string()))
}

pub(super) fn encode(table: &Table) -> Result<Vec<u8>, Problem> {
    let header = encode_header(table.header(), Version::NEWEST)?;
    let mut bytes = Vec::with_capacity(PREFIX + header.len() + table.bytes() + 4);
    bytes.extend(MAGIC);
    bytes.extend(Version::NEWEST.number().to_le_bytes());
    bytes.extend((header.len() as u32).to_le_bytes());
    bytes.extend(&header);
    for texel in table.texels() {
        bytes.extend(texel[0].to_le_bytes());
        bytes.extend(texel[1].to_le_bytes());
    }
    bytes.extend(checksum(&header, table.texels()).to_le_bytes());
    Ok(bytes)
}

pub(super) fn decode(bytes: &[u8]) -> Result<Table, Problem> {
    let found = bytes.len() as u64;
    let too_short = |expected: u64| Problem::Length { expected, found };
    let version = word(bytes, MAGIC.len()).ok_or(too_short(PREFIX as u64))?;
    let version = Version::new(version.into())?;
    let header_length = word(bytes, MAGIC.len() + 4).ok_or(too_short(PREFIX as u64))? as usize;
    if header_length > MAX_HEADER {
        let message = format!("{header_length} bytes long, more than {MAX_HEADER}");
        return Err(Problem::Header(message));
    }
    let header_end = PREFIX + header_length;
    let header_bytes = bytes
        .get(PREFIX..header_end)
        .ok_or(too_short(header_end as u64))?;
    let header = decode_header(header_bytes, version)?;
    header.validate()?;

    let expected = header_end as u64 + header.texel_count() * TEXEL + CHECKSUM;
    if found != expected {
        return Err(Problem::Length { expected, found });
    }
    let (texel_bytes, stored) = bytes[header_end..].split_at(bytes.len() - header_end - 4);
    let texels: Vec<_> = texel_bytes
        .chunks_exact(TEXEL as usize)
        .map(|t| [float(&t[..4]), float(&t[4..])])
        .collect();
    let (stored, computed) = (word(stored, 0), checksum(header_bytes, &texels));
    if stored != Some(computed) {
        return Err(Problem::Checksum {
            expected: stored.unwrap_or_default(),
            found: computed,
        });
    }
    Ok(Table::new(header, texels)?)
}

fn decode_header(bytes: &[u8], version: Version) -> Result<Header, Problem> {
    match version {
        Version::Two => decode_all(bytes),
        Version::One => {
            let header: HeaderV1 = decode_all(bytes)?;
            Ok(Header {
                axis: header.axis,
                rows: header.rows,
                texels: header.texels,
                solver: header.solver,
                measured: header.measured,
                measured_below: None,
            })
        }
    }
}

fn decode_all<T: for<'a> Deserialize<'a>>(bytes: &[u8]) -> Result<T, Problem> {
    let (value, read) = bincode::serde::decode_from_slice(bytes, layout())
        .map_err(|e| Problem::Header(e.to_string()))?;
    if read != bytes.len() {
        return Err(Problem::Header(format!(
            "{} bytes too long",
            bytes.len() - read
        )));
    }
    Ok(value)
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}

fn float(four: &[u8]) -> f32 {
    f32::from_le_bytes([four[0], four[1], four[2], four[3]])
}
