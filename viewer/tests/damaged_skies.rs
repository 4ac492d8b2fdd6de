#![cfg(unix)]
//! Damaged sky files: the program ends with one line and exit code 2, and allocates nothing because of a size that
//! the file claims.

use exr::prelude::{Blocks, Compression, Vec2};
use lensbake_render::sky::{self, SkySource};
use lensbake_test_support::Program;
use lensbake_test_support::exr_files::{
    COMPRESSIONS, HEIGHT, Samples, WIDTH, attribute, first_chunk, picture, table_of_chunks, with,
};
use std::path::Path;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));
/// Indices of those of the eleven counters at the start of a DWA chunk that may set the size of an allocation in a
/// file with lossy channels only: all but the version, the two run lengths of alpha, and the kind of coding.
const DWA_COUNTERS: [usize; 7] = [1, 2, 3, 4, 5, 8, 9];

/// Draws with this file as the sky, and checks that the program refuses it in one line that names it.
#[track_caller]
fn refused(bytes: &[u8], what: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (sky, out) = (path("sky.exr"), path("out.png"));
    std::fs::write(&sky, bytes).unwrap();
    let args = [
        "render", "-d", "cpu", "--size", "16x8", "-s", &sky, "-o", &out,
    ];
    let run = VIEWER.run_in_little_memory(&args);
    assert_eq!(run.code, 2, "{what}: {run:?}");
    run.refuses(&[&sky]);
}

#[test]
fn a_counter_of_a_dwa_chunk_allocates_nothing() {
    for compression in [Compression::DWAA(None), Compression::DWAB(None)] {
        let file = picture(compression, Blocks::ScanLines, Samples::Half);
        let counters = first_chunk(&file) + 8;
        for counter in DWA_COUNTERS {
            for value in [1 << 30, 1 << 40, 36_028_797_018_963_968_u64] {
                let damaged = with(file.clone(), counters + 8 * counter, &value.to_le_bytes());
                refused(
                    &damaged,
                    &format!("{compression:?}, counter {counter}: {value}"),
                );
            }
        }
    }
}

#[test]
fn a_window_of_data_that_the_file_cannot_fill_allocates_nothing() {
    for compression in COMPRESSIONS {
        for samples in [Samples::Half, Samples::Float, Samples::Uint] {
            let file = picture(compression, Blocks::ScanLines, samples);
            let window = attribute(&file, "dataWindow");
            // As wide as possible; the display window is unchanged.
            let wide = with(file.clone(), window + 8, &0x3fff_ff00_u32.to_le_bytes());
            refused(&wide, &format!("{compression:?} {samples:?}, wide"));
            let high = with(file, window + 12, &0x3fff_ff00_u32.to_le_bytes());
            refused(&high, &format!("{compression:?} {samples:?}, high"));
        }
    }
}

#[test]
fn a_chunk_longer_than_the_file_allocates_nothing() {
    for compression in COMPRESSIONS {
        let file = picture(compression, Blocks::ScanLines, Samples::Float);
        let size = first_chunk(&file) + 4;
        for length in [i32::MAX, 1 << 20, -1] {
            let damaged = with(file.clone(), size, &length.to_le_bytes());
            refused(&damaged, &format!("{compression:?}, {length} bytes"));
        }
    }
}

#[test]
fn tiles_as_large_as_can_be_allocate_nothing() {
    let tiles = Blocks::Tiles(Vec2(16, 16));
    for compression in COMPRESSIONS {
        let file = picture(compression, tiles, Samples::Float);
        let chunk_size = first_chunk(&file) + 16;
        let mut damaged = with(file, chunk_size, &i32::MAX.to_le_bytes());
        let size = attribute(&damaged, "tiles");
        for side in [size, size + 4] {
            damaged = with(damaged, side, &0x1fff_fff0_u32.to_le_bytes());
        }
        damaged = with_chunk_count(damaged, 1);
        refused(&damaged, &format!("{compression:?}"));
    }
}

#[test]
fn a_picture_larger_than_its_file_can_hold_allocates_nothing() {
    // Both windows declare 16384 x 8192 pixels, a valid size for a sky. All 512 entries of the chunk table point
    // to the same chunk of 32 x 16 pixels.
    let mut damaged = picture(Compression::ZIP16, Blocks::ScanLines, Samples::Float);
    let corner = [16383_u32.to_le_bytes(), 8191_u32.to_le_bytes()].concat();
    for window in ["dataWindow", "displayWindow"] {
        let at = attribute(&damaged, window) + 8;
        damaged = with(damaged, at, &corner);
    }
    damaged = with_chunk_count(damaged, 512);
    let (table, chunk) = (table_of_chunks(&damaged), first_chunk(&damaged));
    let moved = (chunk as u64 + 511 * 8).to_le_bytes();
    damaged.splice(table..table + 8, moved.repeat(512));
    refused(&damaged, "16384 x 8192");
}

fn with_chunk_count(file: Vec<u8>, count: u32) -> Vec<u8> {
    let at = attribute(&file, "chunkCount");
    with(file, at, &count.to_le_bytes())
}

/// Pictures of 16384 x 8192 pixels, a valid size for a sky, in files that end after their headers.
#[test]
fn large_pictures_that_are_not_there_are_no_end() {
    refused(b"#?RADIANCE\n\n-Y 8192 +X 16384\n\x02\x02\x40\x00", "HDR");
    refused(&png([16384, 8192], &[]), "PNG");
}

/// A colour profile of 13 MB that unpacks to 2 GiB.
#[test]
fn a_colour_profile_takes_no_more_memory_than_a_picture() {
    let profile = [&b"bomb\0\0"[..], &two_gibibytes_of_zeros()].concat();
    refused(&png([32, 16], &profile), "iCCP");
}

/// A PNG with 16 bits and four channels, without any pixels.
fn png(size: [u32; 2], profile: &[u8]) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |name: &[u8], content: &[u8]| {
        let body = [name, content].concat();
        file.extend((content.len() as u32).to_be_bytes());
        file.extend(&body);
        file.extend(crc32fast::hash(&body).to_be_bytes());
    };
    let [width, height] = size.map(u32::to_be_bytes);
    chunk(b"IHDR", &[&width[..], &height, &[16, 6, 0, 0, 0]].concat());
    if !profile.is_empty() {
        chunk(b"iCCP", profile);
    }
    chunk(b"IDAT", b"\x78\x01");
    file
}

/// A zlib stream: a literal zero, then 2^31 / 258 times "repeat the last byte 258 times", in 13 bits each.
fn two_gibibytes_of_zeros() -> Vec<u8> {
    // From the lowest bit on: 1 for the last block, 01 for fixed Huffman codes, and the code of the literal 0.
    let (mut bits, mut count) = (0b000_0110_0011_u64, 11);
    let mut packed = vec![0x78, 0x01];
    let mut put = |code: u64, length: u32| {
        bits |= code << count;
        count += length;
        while count >= 8 {
            packed.push(bits as u8);
            bits >>= 8;
            count -= 8;
        }
    };
    for _ in 0..(1_u32 << 31) / 258 {
        // The code of length 258, 11000101 from its first bit on, and five zeros for the distance 1.
        put(0b1010_0011, 13);
    }
    put(0, 16);
    packed
}

/// Random damage with a fixed seed: single bytes and bits, 32-bit words, and truncation.
#[test]
fn random_damage_never_ends_the_program() {
    let mut random = fastrand::Rng::with_seed(17);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    let mut refused = 0;
    for compression in COMPRESSIONS {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(16, 8))] {
            for samples in [Samples::Half, Samples::Float] {
                let file = picture(compression, blocks, samples);
                for _ in 0..60 {
                    let mut damaged = file.clone();
                    for _ in 0..random.usize(1..4) {
                        damage(&mut damaged, &mut random);
                    }
                    refused += usize::from(is_refused(&path, &damaged));
                }
            }
        }
    }
    assert!(refused > 800, "{refused}");
}

fn damage(file: &mut Vec<u8>, random: &mut fastrand::Rng) {
    let at = random.usize(0..file.len() - 8);
    match random.u8(0..4) {
        0 => file[at] = random.u8(..),
        1 => file[at] ^= 1 << random.u8(0..8),
        2 => file[at..at + 4].copy_from_slice(&random.u32(..).to_le_bytes()),
        _ => file.truncate(at + 8),
    }
}

fn is_refused(path: &Path, bytes: &[u8]) -> bool {
    std::fs::write(path, bytes).unwrap();
    match sky::load(&SkySource::Panorama(path.to_owned())) {
        Ok(_) => false,
        Err(error) => {
            let line = error.to_string();
            assert_eq!(line.lines().count(), 1, "{line}");
            assert!(line.starts_with(path.to_str().unwrap()), "{line}");
            true
        }
    }
}

/// The guard must not refuse any encoding that the decoder supports.
#[test]
fn every_encoding_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    let read = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        sky::load(&SkySource::Panorama(path.clone())).unwrap()
    };
    let truth = read(&picture(
        Compression::Uncompressed,
        Blocks::ScanLines,
        Samples::Float,
    ));
    for compression in COMPRESSIONS {
        let lossy = match compression {
            Compression::B44 | Compression::B44A => 3.0,
            Compression::DWAA(_) | Compression::DWAB(_) => 3.0,
            _ => 0.0,
        };
        let tiles = [(16, 8), (WIDTH, HEIGHT), (64, 64), (10, 7)];
        let tiles = tiles.map(|(width, height)| Blocks::Tiles(Vec2(width, height)));
        for blocks in [Blocks::ScanLines].into_iter().chain(tiles) {
            for samples in [Samples::Half, Samples::Float, Samples::Uint] {
                let sky = read(&picture(compression, blocks, samples));
                let texels = |sky: &sky::Sky| sky.levels()[0].texels().to_vec();
                for (found, expected) in texels(&sky).iter().zip(texels(&truth)) {
                    for channel in 0..3 {
                        let off = found[channel].to_f32() - expected[channel].to_f32();
                        assert!(
                            off.abs() <= lossy,
                            "{compression:?} {blocks:?} {samples:?}: {found:?} {expected:?}"
                        );
                    }
                }
            }
        }
    }
}
