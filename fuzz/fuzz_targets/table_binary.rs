//! Fuzz target: the binary table, from any bytes, and with the checksum corrected.

#![no_main]

use lensbake_fuzz::{exercise_table, repaired};
use lensbake_tables::container;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // As they are, and with the magic number in front, so that no mutation of it is wasted.
    for file in [
        bytes.to_vec(),
        [b"LENSBAKE", bytes.get(8..).unwrap_or(&[])].concat(),
    ] {
        if let Some(table) = repaired(file, |bytes| container::from_bytes(bytes)) {
            exercise_table(&table);
        }
    }
});
