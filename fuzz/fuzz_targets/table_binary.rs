//! The binary table: any bytes, and the same bytes with a checksum that fits.

#![no_main]

use lensbake_fuzz::{exercise_table, repaired};
use lensbake_tables::container;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Whole and with the mark in front, so that no mutation is lost on it.
    for file in [
        bytes.to_vec(),
        [b"LENSBAKE", bytes.get(8..).unwrap_or(&[])].concat(),
    ] {
        if let Some(table) = repaired(file, |bytes| container::from_bytes(bytes)) {
            exercise_table(&table);
        }
    }
});
