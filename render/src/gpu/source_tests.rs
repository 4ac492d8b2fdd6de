//! Every kind of shader is valid, and every fragment shader can be written in the GLSL of WebGL2.

use super::*;
use crate::camera::Mapping;
use lensbake_tables::lookup::{HorizonSide, RowShape};
use lensbake_tables::{ChannelRanges, Interpolation, RowFormat};
use naga::back::glsl;
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// At rest, in free fall, in orbit, below the horizon and boosted there, with every kind of shift.
const OBSERVERS: [(HorizonSide, CameraKey, Shift); 5] = {
    const fn motion(radial: bool, boosted: bool) -> CameraKey {
        CameraKey {
            radial,
            boosted,
            mapping: Mapping::Perspective,
        }
    }
    [
        (HorizonSide::Above, motion(false, false), Shift::Off),
        (HorizonSide::Above, motion(true, false), Shift::Brightness),
        (HorizonSide::Above, motion(false, true), Shift::Colour),
        (HorizonSide::Below, motion(true, false), Shift::Off),
        (HorizonSide::Below, motion(true, true), Shift::Colour),
    ]
};

/// Checksum of all shaders without a disc.
const WITHOUT_DISCS: u32 = 2_166_445_833;

fn row(side: HorizonSide, format: RowFormat) -> RowShape {
    RowShape {
        texels: 64,
        interpolation: Interpolation::Hermite,
        side,
        format,
    }
}

/// Keys of every kind.
pub(in crate::gpu) fn keys() -> Vec<PipelineKey> {
    let deflections = [
        Deflection::Lut,
        Deflection::Direct { step: 0.1 },
        Deflection::Flat,
    ];
    let outputs = [
        Output::Picture(Sampling::Single),
        Output::Picture(Sampling::Filtered),
        Output::Picture(Sampling::Anisotropic),
        Output::Trace,
        Output::Difference,
    ];
    let mut keys = Vec::new();
    for deflection in deflections {
        for output in outputs {
            for store in [Store::Buffer, Store::Texture] {
                for by_row in [false, true] {
                    for stars in [false, true] {
                        for (side, motion, shift) in OBSERVERS {
                            let lookup = match by_row {
                                false => LookupShape::Stereographic(side),
                                true => LookupShape::Row(row(side, RowFormat::Float32)),
                            };
                            let key = PipelineKey::new(
                                deflection, output, store, lookup, stars, motion, shift,
                            );
                            keys.extend(
                                [Pass::Compute, Pass::Fragment].map(|pass| key.in_pass(pass)),
                            );
                        }
                    }
                }
            }
        }
    }
    keys
}

#[test]
fn every_shader_is_valid() {
    let keys = keys();
    assert_eq!(keys.len(), 1200);
    for key in keys {
        validate(&key.source(), key.entry_points());
        if key.stars && key.classifier().is_some() {
            let by_columns = key.with_group(Group::Tile);
            validate(&by_columns.source(), key.entry_points());
        }
        if let Some(classifier) = key.classifier() {
            validate(
                &classifier.classifier_source(),
                &["classify_tiles", "close_queues"],
            );
        }
    }
}

#[test]
fn every_shader_with_a_disc_is_valid() {
    let patterned = Disc {
        pattern: 0.5,
        ..Disc::default()
    };
    let discs = [Disc::default(), patterned];
    let keys = keys().into_iter();
    let keys = keys.flat_map(|key| discs.map(|disc| key.with_disc(Some(&disc))));
    let mut count = 0;
    for key in keys.filter(|key| key.disc) {
        assert_eq!(key.source().contains("fn cloud_noise"), key.pattern);
        match key.classifier() {
            // The module that the classifier shares with pictures without a disc has its entry points, too.
            Some(classifier) => {
                validate(&key.source(), key.entry_points());
                let entry_points = ["classify_disc_tiles", "classify_tiles", "close_queues"];
                validate(&classifier.classifier_source(), &entry_points);
            }
            None => validate(&key.source(), key.entry_points()),
        }
        count += 1;
    }
    assert_eq!(count, 1440);
}

/// A scene without a disc pays nothing for those that have one: not a byte of its shaders.
#[test]
fn without_a_disc_no_shader_has_a_part_of_it() {
    let mut checksum = crc32fast::Hasher::new();
    for key in keys() {
        let mut sources = vec![key.source()];
        sources.extend(key.classifier().map(PipelineKey::classifier_source));
        for source in sources {
            assert!(!source.contains("struct Disc"));
            checksum.update(source.as_bytes());
        }
    }
    // The shaders as they were before there were discs. A change of shaders that is meant changes it, too.
    assert_eq!(checksum.finalize(), WITHOUT_DISCS);
}

#[test]
fn shaders_of_every_row_format_are_valid() {
    let ranges = ChannelRanges::of(&[[-0.4, 0.0], [0.0, 1e-9]]);
    for format in [
        RowFormat::Float32,
        RowFormat::Float16,
        RowFormat::Unorm16(ranges),
        RowFormat::Coefficients,
    ] {
        for interpolation in [Interpolation::Linear, Interpolation::Hermite] {
            for key in keys() {
                let LookupShape::Row(row) = key.lookup else {
                    continue;
                };
                let row = RowShape {
                    interpolation,
                    format,
                    ..row
                };
                let lookup = LookupShape::Row(row);
                let key = PipelineKey { lookup, ..key };
                if key.deflection == DeflectionKey::Lut && key.store == Store::Buffer {
                    validate(&key.source(), key.entry_points());
                }
            }
        }
    }
}

pub(in crate::gpu) fn validate(source: &str, entry_points: &[&str]) {
    let module = naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{e:?} in\n{source}"));
    let names: Vec<&str> = module
        .entry_points
        .iter()
        .map(|e| e.name.as_str())
        .collect();
    assert_eq!(names, entry_points);
}
/// Checks that the entry points can be written in the GLSL of WebGL2, with these values of overridable constants.
pub(in crate::gpu) fn assert_webgl2(
    source: &str,
    entry_points: &[&str],
    constants: &[(&str, f64)],
) {
    let module = naga::front::wgsl::parse_str(source).unwrap();
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap();
    let constants = constants
        .iter()
        .map(|&(name, value)| (name.to_owned(), value));
    let (module, info) = naga::back::pipeline_constants::process_overrides(
        &module,
        &info,
        None,
        &constants.collect(),
    )
    .unwrap();
    for entry in &module.entry_points {
        assert!(entry_points.contains(&entry.name.as_str()));
        let options = glsl::Options {
            version: glsl::Version::new_gles(300),
            ..Default::default()
        };
        let pipeline = glsl::PipelineOptions {
            shader_stage: entry.stage,
            entry_point: entry.name.clone(),
            multiview: None,
        };
        let mut text = String::new();
        let policies = BoundsCheckPolicies::default();
        glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
            .and_then(|mut writer| writer.write())
            .unwrap_or_else(|e| panic!("{}: {e} in\n{source}", entry.name));
        assert!(!text.contains("buffer"), "{text}");
    }
}

#[test]
fn fragment_shaders_without_stars_can_be_written_for_webgl2() {
    let keys = keys();
    let keys = keys
        .iter()
        .filter(|key| key.pass == Pass::Fragment && !key.stars);
    let mut written = 0;
    for key in keys {
        assert_webgl2(&key.source(), key.entry_points(), &[]);
        written += 1;
    }
    // Only pictures have stars.
    assert_eq!(written, 420);
}

#[test]
fn shaders_of_every_mapping_are_valid() {
    let mut checked = 0;
    for key in keys() {
        for mapping in [Mapping::Equirectangular, Mapping::Equidistant] {
            let camera = CameraKey {
                mapping,
                ..key.camera
            };
            let key = PipelineKey { camera, ..key };
            // Those pictures have their stars from the CPU.
            if key.deflection != DeflectionKey::Lut || key.stars {
                continue;
            }
            validate(&key.source(), key.entry_points());
            if let Some(classifier) = key.classifier() {
                let entry_points = ["classify_tiles", "close_queues"];
                validate(&classifier.classifier_source(), &entry_points);
            }
            checked += 1;
        }
    }
    assert!(checked > 100, "{checked}");
}
