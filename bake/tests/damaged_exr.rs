#![cfg(unix)]
//! Damaged EXR tables are refused with one line and exit code 2, in little memory, whatever sizes the file states.

use lensbake_tables::{ATLAS_EXR, container};
use lensbake_test_support::Program;
use lensbake_test_support::exr_files::{attribute, first_chunk, table_of_chunks, with};

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));
/// Values of the attribute `compression`.
const NONE: u8 = 0;
const RLE: u8 = 1;
const ZIP: [u8; 2] = [2, 3];
const PXR24: u8 = 5;
const DWAA: u8 = 8;
const AFTER_THE_LAST: u8 = 12;

#[track_caller]
fn refused(bytes: &[u8], words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("table.exr");
    std::fs::write(&file, bytes).unwrap();
    let file = file.to_str().unwrap();
    let run = BAKE.run_in_little_memory(&["inspect", file]);
    run.refuses(&[words, &[file]].concat());
}

/// Offset of the size of the first chunk: after its line number, or after the four numbers of its tile.
fn first_chunk_size(file: &[u8]) -> usize {
    let tiled = file[5] & 2 != 0;
    first_chunk(file) + if tiled { 16 } else { 4 }
}

fn with_compression(compression: u8) -> Vec<u8> {
    let at = attribute(ATLAS_EXR, "compression");
    with(ATLAS_EXR.to_vec(), at, &[compression])
}

#[test]
fn a_table_in_another_compression_is_refused() {
    for compression in NONE..=AFTER_THE_LAST {
        // The two ZIP values differ only in the number of lines per chunk, and a tile has a height of its own.
        if !ZIP.contains(&compression) {
            refused(&with_compression(compression), &[]);
        }
    }
    refused(&with_compression(PXR24), &["pxr24", "ZIP"]);
}

#[test]
fn a_table_as_dwa_allocates_nothing() {
    let file = with_compression(DWAA);
    let data = first_chunk_size(&file) + 4;
    let packed = &ATLAS_EXR[data..data + 1000];
    // Eleven counters, the second of which is a size; then an empty list of rules; then the packed data.
    let counters = [2, 1 << 50, 1000, 0, 0, 0, 0, 0, 0, 0, 0_u64];
    let counters = counters.map(u64::to_le_bytes).concat();
    let chunk = [&counters[..], &2_u16.to_le_bytes(), packed].concat();
    refused(&with(file.clone(), data, &chunk), &[]);
}

#[test]
fn chunks_that_cannot_be_allocate_nothing() {
    let size = first_chunk_size(ATLAS_EXR);
    for length in [i32::MAX, 1 << 20, 0, -1] {
        refused(
            &with(ATLAS_EXR.to_vec(), size, &length.to_le_bytes()),
            &["chunk 0"],
        );
    }
    let table = table_of_chunks(ATLAS_EXR);
    for place in [0, 1 << 40, u64::MAX, ATLAS_EXR.len() as u64 - 1] {
        let damaged = with(ATLAS_EXR.to_vec(), table, &place.to_le_bytes());
        refused(&damaged, &["chunk 0"]);
    }
    // The first chunk has the offset of the second.
    let count = attribute(ATLAS_EXR, "chunkCount");
    if ATLAS_EXR[count..count + 4] != 1_u32.to_le_bytes() {
        let second = ATLAS_EXR[table + 8..table + 16].to_vec();
        let damaged = with(ATLAS_EXR.to_vec(), table, &second);
        refused(&damaged, &["chunk 1", "has the place of another"]);
    }
}

/// A table that an image tool has rewritten without loss is still a table: here with its chunks uncompressed.
#[test]
fn a_table_that_was_rewritten_without_loss_is_read() {
    let table = container::from_bytes(ATLAS_EXR).unwrap();
    for compression in [NONE, RLE] {
        let rewritten = unpacked(compression);
        assert!(container::from_bytes(&rewritten).unwrap() == table);
    }
}

/// The atlas with one line per chunk, uncompressed, which every compression with one line per chunk allows.
fn unpacked(compression: u8) -> Vec<u8> {
    let table = container::from_bytes(ATLAS_EXR).unwrap();
    let (width, rows) = (table.header().texels, table.header().row_count());
    let end = table_of_chunks(ATLAS_EXR);
    let mut file = with_compression(compression)[..end].to_vec();
    // Scan lines have neither the flag nor the attribute of tiles.
    file[5] &= !2;
    if let Some(at) = file
        .windows(15)
        .position(|bytes| bytes == b"tiles\0tiledesc\0")
    {
        file.drain(at..at + 15 + 4 + 9);
    }
    if let Some(at) = file.windows(10).position(|bytes| bytes == b"tiledimage") {
        file.splice(at..at + 10, *b"scanlineimage");
        file[at - 4..at].copy_from_slice(&13_u32.to_le_bytes());
    }
    let count = attribute(&file, "chunkCount");
    file[count..count + 4].copy_from_slice(&rows.to_le_bytes());
    let length = 12 * width as usize;
    let first = file.len() + 8 * rows as usize;
    for row in 0..rows as usize {
        file.extend(((first + row * (8 + length)) as u64).to_le_bytes());
    }
    for (row, texels) in table.texels().chunks_exact(width as usize).enumerate() {
        file.extend((row as i32).to_le_bytes());
        file.extend((length as i32).to_le_bytes());
        // The channels in the order of their names: B, which is zero, then G and R.
        file.extend(vec![0; length / 3]);
        for channel in [1, 0] {
            file.extend(texels.iter().flat_map(|texel| texel[channel].to_le_bytes()));
        }
    }
    file
}
