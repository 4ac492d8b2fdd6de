//! The OpenEXR container. Channel R holds the stored value, G its slope per texel, B zero; 32-bit float, ZIP; scan
//! lines from the top, one per row. The header's fields are attributes named `lensbake.…`. There are three
//! channels because single-channel files fail in several engines, and 32 bits because half floats would cost
//! 5e-4 rad (docs/format.md).

use super::{MAX_FILE_BYTES, VERSION, Version, checksum};
use crate::error::Problem;
use crate::exr_attributes;
use crate::exr_guard::{CheckedExr, Limits};
use crate::header::{FieldError, MAX_TEXELS};
use crate::{Field, Header, Table, Texel};
use exr::prelude::*;
use std::io::Cursor;

pub(super) const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
const PREFIX: &str = "lensbake.";
const VERSION_FIELD: &str = "version";
const CHECKSUM_FIELD: &str = "crc32";

pub(super) fn encode(table: &Table) -> std::result::Result<Vec<u8>, Problem> {
    let header = table.header();
    let header_bytes = super::binary::encode_header(header, Version::NEWEST)?;
    let width = header.texels as usize;
    let texels = table.texels();
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [value, slope] = texels[at.y() * width + at.x()];
        (value, slope, 0.0_f32)
    });
    let mut attributes = LayerAttributes::named("bending table");
    let mut put = |name: &str, value: AttributeValue| {
        attributes
            .other
            .insert(Text::from(format!("{PREFIX}{name}").as_str()), value);
    };
    put(VERSION_FIELD, AttributeValue::I32(VERSION as i32));
    let crc = checksum(&header_bytes, texels);
    put(CHECKSUM_FIELD, AttributeValue::I32(crc.cast_signed()));
    for (name, field) in header.fields() {
        put(
            name,
            match field {
                Field::Count(n) => AttributeValue::I32(n.cast_signed()),
                Field::Real(x) => AttributeValue::F64(x),
                Field::Text(s) => AttributeValue::Text(exr_attributes::encode_text(&s)),
            },
        );
    }
    let layer = Layer::new(
        (width, header.row_count() as usize),
        attributes,
        // Every reader supports ZIP-compressed scan lines from the top; tinyexr reads zeros from tiles.
        Encoding::SMALL_LOSSLESS,
        channels,
    );
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(exr_problem)?;
    Ok(exr_attributes::in_order(bytes.into_inner()))
}

/// Limits for the file of a table: only lossless compression, and no larger than the largest table.
const LIMITS: Limits = Limits {
    pixels: MAX_TEXELS,
    chunk_bytes: MAX_FILE_BYTES,
    lossy: false,
};

pub(super) fn decode(bytes: &[u8]) -> std::result::Result<Table, Problem> {
    let file = CheckedExr::open(bytes, &LIMITS).map_err(|e| Problem::Exr(e.to_string()))?;
    if file.layer_count() > 1 {
        return Err(Problem::Exr("has more than one layer".into()));
    }
    let version = decode_version(&file.header().own_attributes)?;
    let header = decode_header(file.header())?;
    let texels = decode_texels(&file, &header)?;
    let computed = checksum(&super::binary::encode_header(&header, version)?, &texels);
    let stored = stored_checksum(&file.header().own_attributes)?;
    if stored != computed {
        return Err(Problem::Checksum {
            expected: stored,
            found: computed,
        });
    }
    Ok(Table::new(header, texels)?)
}

/// The texels: R and G of each pixel. The size of the picture has been checked.
fn decode_texels(
    file: &CheckedExr<'_>,
    header: &Header,
) -> std::result::Result<Vec<Texel>, Problem> {
    let width = header.texels as usize;
    let mut texels = vec![[0.0; 2]; width * header.row_count() as usize];
    for index in 0..file.chunk_count() {
        let block = file
            .rgb_block(index)
            .map_err(|e| Problem::Exr(e.to_string()))?;
        for (row, pixels) in (block.row..).zip(block.pixels.chunks_exact(block.width)) {
            let start = row * width + block.column;
            for (texel, &[r, g, _]) in texels[start..start + block.width].iter_mut().zip(pixels) {
                *texel = [r, g];
            }
        }
    }
    Ok(texels)
}

fn decode_version(attributes: &LayerAttributes) -> std::result::Result<Version, Problem> {
    match attribute(attributes, VERSION_FIELD) {
        Some(&AttributeValue::I32(found)) => Version::new(found.into()),
        _ => Err(missing(VERSION_FIELD)),
    }
}

/// Reads and checks the header alone, so that no pixels are allocated for sizes that a table cannot have.
fn decode_header(layer: &exr::meta::header::Header) -> std::result::Result<Header, Problem> {
    let attributes = &layer.own_attributes;
    let header = Header::from_fields(|name| {
        Some(match attribute(attributes, name)? {
            AttributeValue::I32(n) => Field::Count(n.cast_unsigned()),
            AttributeValue::F64(x) => Field::Real(*x),
            AttributeValue::Text(s) => Field::Text(exr_attributes::decode_text(s)),
            _ => return None,
        })
    })
    .map_err(|e| match e {
        FieldError::Missing(name) => missing(&name),
        FieldError::Bad(error) => error.into(),
    })?;
    header.validate()?;
    let size = (layer.layer_size.width(), layer.layer_size.height());
    if size != (header.texels as usize, header.row_count() as usize) {
        return Err(Problem::Exr(format!(
            "the picture is {} x {} where its attributes say {} x {}",
            size.0,
            size.1,
            header.texels,
            header.row_count()
        )));
    }
    Ok(header)
}

fn stored_checksum(attributes: &LayerAttributes) -> std::result::Result<u32, Problem> {
    match attribute(attributes, CHECKSUM_FIELD) {
        Some(&AttributeValue::I32(crc)) => Ok(crc.cast_unsigned()),
        _ => Err(missing(CHECKSUM_FIELD)),
    }
}

fn attribute<'a>(attributes: &'a LayerAttributes, name: &str) -> Option<&'a AttributeValue> {
    attributes
        .other
        .get(&Text::from(format!("{PREFIX}{name}").as_str()))
}

fn missing(name: &str) -> Problem {
    Problem::Missing(format!("{PREFIX}{name}"))
}

fn exr_problem(error: Error) -> Problem {
    Problem::Exr(error.to_string())
}
