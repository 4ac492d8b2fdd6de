//! The tables: the bits of the binary file, with the first row at the top.

use crate::programs::{READERS, RGB, words};
use lensbake_tables::baking::measured;
use lensbake_tables::baking::{Recipe, bake};
use lensbake_tables::{Header, Rows, Table, Texel, default_atlas};
use lensbake_test_support::{one_row, workspace};
use std::path::Path;
use tempfile::TempDir;

/// The bits of the texels in a binary file, decoded by docs/format.md and not by our own reader.
fn bits_of_the_texels(file: &Path) -> Vec<[u32; 2]> {
    let bytes = std::fs::read(file).unwrap();
    let header_length = words(&bytes[12..16])[0] as usize;
    let texels = &bytes[16 + header_length..bytes.len() - 4];
    words(texels).as_chunks().0.to_vec()
}

/// Checks that every reader sees in `exr` the texels of `binary`, and zero in the third channel.
fn all_see_the_same(binary: &Path, exr: &Path, header: &Header) {
    let texels = bits_of_the_texels(binary);
    let (width, height) = (header.texels, header.row_count());
    assert_eq!(texels.len(), width as usize * height as usize);
    for reader in READERS.iter() {
        let picture = reader.read(exr, &RGB);
        let whose = format!("{}, {}", reader.name, exr.display());
        assert_eq!((picture.width, picture.height), (width, height), "{whose}");
        let pixels = picture.pixels();
        assert_eq!(pixels.len(), texels.len(), "{whose}");
        for (i, (pixel, [value, slope])) in pixels.zip(&texels).enumerate() {
            let (row, texel) = (i as u32 / width, i as u32 % width);
            let expected = [*value, *slope, 0];
            assert!(
                *pixel == expected,
                "{whose}: texel {texel} of row {row} is {pixel:08x?}, not {expected:08x?}"
            );
        }
    }
}

/// Writes `table` into both containers and checks what the readers see.
fn readers_see(table: &Table) {
    let folder = TempDir::new().unwrap();
    let [binary, exr] = ["table.lbt", "table.exr"].map(|name| folder.path().join(name));
    lensbake_test_support::write_table(&binary, table);
    lensbake_test_support::write_table(&exr, table);
    all_see_the_same(&binary, &exr, table.header());
}

/// A table of random bits, which cannot be compressed, and which half floats cannot represent.
fn noise(rows: u32, texels: u32) -> Table {
    let mut rng = fastrand::Rng::with_seed(5);
    let mut float = || {
        loop {
            let float = f32::from_bits(rng.u32(..));
            if float.is_finite() {
                return float;
            }
        }
    };
    let header = Header {
        rows: Rows::Chi { count: rows },
        texels,
        ..default_atlas().header().clone()
    };
    let texels: Vec<Texel> = (0..header.texel_count())
        .map(|_| [float(), float()])
        .collect();
    Table::new(header, texels).unwrap()
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn the_shipped_atlas_is_the_same_to_every_reader() {
    let assets = workspace().join("tables/assets");
    let [binary, exr] = ["atlas.lbt", "atlas.exr"].map(|name| assets.join(name));
    all_see_the_same(&binary, &exr, default_atlas().header());
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn what_is_baked_is_the_same_to_every_reader() {
    readers_see(&measured(bake(&Recipe::default(), || ()).unwrap()).unwrap());
    for radius in [1.5, 10.0, f64::INFINITY] {
        readers_see(&one_row(radius));
    }
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn every_bit_of_any_table_is_the_same_to_every_reader() {
    for (rows, texels) in [(4, 4), (16, 1000), (37, 300), (64, 65_536), (4096, 64)] {
        readers_see(&noise(rows, texels));
    }
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn no_name_of_a_solver_keeps_a_reader_from_the_picture() {
    let table = one_row(10.0);
    for name in ["", "метод", "a\0b", "\"\n", &"x".repeat(4000)] {
        let mut header = table.header().clone();
        header.solver.name = name.to_owned();
        readers_see(&table.clone().with_header(header).unwrap());
    }
}
