//! Tests of the OpenEXR container: the layout of its files, and that it preserves every valid table.

use exr::meta::attribute::LineOrder;
use exr::meta::{BlockDescription, MetaData};
use fastrand::Rng;
use lensbake_tables::container::{Container, from_bytes};
use lensbake_tables::{
    ATLAS_EXR, Axis, Header, Measured, Rows, Solver, Table, TableError, Texel, default_atlas,
};

/// Valid names of a solver, from the empty name to very long ones.
fn names() -> Vec<String> {
    let mut names: Vec<String> = [
        "",
        "метод",
        "Störmer's",
        "ü",
        "龍",
        "a\0b",
        "\0",
        "\"'\\",
        "a\nb\r\t\u{1b}[31m",
    ]
    .map(String::from)
    .to_vec();
    names.push("x".repeat(4000));
    names.push("ж".repeat(2000));
    names
}

fn header(rows: Rows, texels: u32) -> Header {
    Header {
        axis: Axis::Residual,
        rows,
        texels,
        solver: Solver {
            name: "test".to_owned(),
            tolerance: 1e-9,
        },
        measured: Measured::NOTHING,
        measured_below: None,
    }
}

fn small() -> Header {
    let rows = Rows::One {
        inverse_radius: 0.1,
    };
    header(rows, 8)
}

fn named(name: &str) -> Header {
    let mut header = small();
    header.solver.name = name.to_owned();
    header
}

/// A table of random bits: it cannot be compressed, and only a lossless encoding preserves it.
fn noise(header: Header) -> Table {
    let mut rng = Rng::with_seed(1);
    let mut float = || {
        loop {
            let float = f32::from_bits(rng.u32(..));
            if float.is_finite() {
                return float;
            }
        }
    };
    let texels: Vec<Texel> = (0..header.texel_count())
        .map(|_| [float(), float()])
        .collect();
    Table::new(header, texels).unwrap()
}

/// Checks that a table read back from an OpenEXR file is the same to the bit, by comparing binary files.
#[track_caller]
fn survives_a_round_trip(table: &Table) {
    let binary = Container::Binary.encode(table).unwrap();
    let from_binary = from_bytes(&binary).unwrap();
    let exr = Container::OpenExr.encode(&from_binary).unwrap();
    let back = from_bytes(&exr).unwrap();
    assert!(
        Container::Binary.encode(&back).unwrap() == binary,
        "changed on the way: {:?}",
        table.header()
    );
}

/// The attributes in the header of an OpenEXR file, in the order of the file: name, and byte range of the value.
fn attributes(file: &[u8]) -> Vec<(String, std::ops::Range<usize>)> {
    let mut found = Vec::new();
    let mut at = 8;
    let text_end = |from: usize| from + file[from..].iter().position(|&b| b == 0).unwrap();
    while file[at] != 0 {
        let name = String::from_utf8(file[at..text_end(at)].to_vec()).unwrap();
        let length_at = text_end(text_end(at) + 1) + 1;
        let length = u32::from_le_bytes(file[length_at..length_at + 4].try_into().unwrap());
        let value = length_at + 4..length_at + 4 + length as usize;
        at = value.end;
        found.push((name, value));
    }
    found
}

#[test]
fn pictures_are_of_scan_lines_from_the_top() {
    let row = Container::OpenExr.encode(&noise(small())).unwrap();
    for file in [ATLAS_EXR, &row] {
        let meta = MetaData::read_from_buffered(file, true).unwrap();
        assert!(!meta.requirements.is_single_layer_and_tiled);
        assert_eq!(meta.headers.len(), 1);
        assert_eq!(meta.headers[0].blocks, BlockDescription::ScanLines);
        assert_eq!(meta.headers[0].line_order, LineOrder::Increasing);
    }
}

#[test]
fn the_shipped_picture_is_what_convert_writes() {
    let written = Container::OpenExr.encode(default_atlas()).unwrap();
    assert!(
        written == ATLAS_EXR,
        "write it anew: bake convert tables/assets/atlas.lbt tables/assets/atlas.exr"
    );
}

#[test]
fn attributes_are_in_the_order_of_their_names() {
    for file in [
        ATLAS_EXR,
        &Container::OpenExr.encode(&noise(small())).unwrap(),
    ] {
        let names: Vec<String> = attributes(file).into_iter().map(|(name, _)| name).collect();
        assert!(names.len() > 15, "{names:?}");
        assert!(names.is_sorted(), "{names:?}");
    }
}

/// `tiled.exr` is of format version 1, of a program that wrote tiles instead of scan lines: it has two tiles, lines in any order,
/// and a solver's name in Latin-1. `tiled.lbt` holds the same table.
#[test]
fn tiled_files_of_earlier_versions_are_read() {
    let tiled = include_bytes!("files/tiled.exr");
    let meta = MetaData::read_from_buffered(tiled.as_slice(), true).unwrap();
    assert!(meta.requirements.is_single_layer_and_tiled);
    let table = from_bytes(tiled).unwrap();
    assert_eq!(
        table,
        from_bytes(include_bytes!("files/tiled.lbt")).unwrap()
    );
    assert_eq!(table.header().solver.name, "Störmer's method");
}

#[test]
fn a_solver_may_have_any_name() {
    for name in names() {
        survives_a_round_trip(&noise(named(&name)));
    }
}

#[test]
fn a_name_that_no_file_could_hold_is_refused_before_it_is_written() {
    let longest = "x".repeat(4016);
    survives_a_round_trip(&noise(named(&longest)));
    let (b_min, b_max) = (3.0, 4.0);
    let far = Rows::One {
        inverse_radius: 0.0,
    };
    let mut longest_header = header(far, 8);
    longest_header.axis = Axis::UniformB { b_min, b_max };
    longest_header.solver.name = longest.clone();
    survives_a_round_trip(&noise(longest_header));
    let refused = Table::new(named(&(longest + "x")), vec![[0.0; 2]; 8]);
    assert!(matches!(refused, Err(TableError::Size { found: 4017, .. })));
}

#[test]
fn the_largest_tables_go_there_and_back() {
    for (rows, texels) in [(64, 65_536), (4096, 1024)] {
        survives_a_round_trip(&noise(header(Rows::Chi { count: rows }, texels)));
    }
}

#[test]
fn special_floats_survive_a_round_trip() {
    for number in [
        f64::NAN,
        -f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        -0.0,
        5e-324,
    ] {
        let mut header = small();
        header.solver.tolerance = number;
        header.measured = Measured {
            max_error: number,
            rays: u32::MAX,
            r_min: number,
            edge_gap: number,
        };
        survives_a_round_trip(&noise(header));
    }
    for inverse_radius in [0.0, -0.0, 5e-324, 1.0 - f64::EPSILON] {
        survives_a_round_trip(&noise(header(Rows::One { inverse_radius }, 4)));
    }
}

#[test]
fn no_bytes_of_an_attribute_end_the_program_or_change_the_table() {
    let table = noise(named("0123456789"));
    let file = Container::OpenExr.encode(&table).unwrap();
    let mut rng = Rng::with_seed(3);
    let mut refused = 0;
    for (name, place) in attributes(&file) {
        for round in 0..200 {
            let mut damaged = file.clone();
            damaged[place.clone()].fill_with(|| match round {
                0 => 0xff,
                1 => 0,
                2 => b'\n',
                _ => rng.u8(..),
            });
            match from_bytes(&damaged) {
                Ok(read) => assert!(read == table, "{name}, {round}: {read:?}"),
                Err(problem) => {
                    let message = problem.to_string();
                    assert!(!message.contains(char::is_control), "{name}: {message:?}");
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > 2000, "{refused}");
}

#[test]
fn a_message_repeats_no_long_text_whole() {
    let mut long = Vec::from(ATLAS_EXR);
    let (_, axis) = attributes(&long)
        .into_iter()
        .find(|(name, _)| name == "lensbake.axis")
        .unwrap();
    long[axis.start - 4..axis.start].copy_from_slice(&1_000_008_u32.to_le_bytes());
    long.splice(axis.end..axis.end, vec![b'x'; 1_000_000]);
    // The chunks, of 16 lines each, have moved; their offsets, which follow the header, must change too.
    let header_end = attributes(&long).last().unwrap().1.end + 1;
    for chunk in 0..192 / 16 {
        let at = header_end + 8 * chunk..header_end + 8 * chunk + 8;
        let offset = u64::from_le_bytes(long[at.clone()].try_into().unwrap());
        long[at].copy_from_slice(&(offset + 1_000_000).to_le_bytes());
    }
    let message = from_bytes(&long).unwrap_err().to_string();
    assert!(message.contains("'axis'"), "{message:.200}");
    assert!(message.len() < 300, "{} bytes", message.len());
}
