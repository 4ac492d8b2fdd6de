//! Fuzz target: the EXR table, from any bytes, and with the checksum corrected.

#![no_main]

use lensbake_fuzz::{exercise_table, repaired};
use lensbake_tables::container;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Some(table) = repaired(bytes.to_vec(), |bytes| container::from_bytes(bytes)) {
        exercise_table(&table);
    }
});
