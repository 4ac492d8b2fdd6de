//! `viewer render --aov`: layers beside the picture.

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
use lensbake_test_support::Program;
use std::collections::BTreeMap;
use tempfile::TempDir;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

/// A small picture of the whole shadow, with a sky that is generated quickly.
const RENDER: [&str; 7] = ["render", "--size", "64x36", "-r", "6", "-s", "grid"];

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// The channels of a picture drawn with these options.
#[track_caller]
fn channels(options: &[&str]) -> BTreeMap<String, Vec<f32>> {
    let folder = folder();
    let out = path(&folder, "out.exr");
    VIEWER
        .run(&[&RENDER[..], options, &["-o", &out]].concat())
        .succeeds();
    let all = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels();
    let picture = all
        .first_valid_layer()
        .all_attributes()
        .from_file(&out)
        .unwrap();
    let list = picture.layer_data.channel_data.list;
    let named = list.into_iter().map(|channel| match channel.sample_data {
        FlatSamples::F32(samples) => (channel.name.to_string(), samples),
        other => panic!("{other:?}"),
    });
    named.collect()
}

fn names(channels: &BTreeMap<String, Vec<f32>>) -> Vec<&str> {
    channels.keys().map(String::as_str).collect()
}

#[test]
fn a_file_has_the_layers_that_are_asked_for_and_the_same_picture() {
    let cpu = ["-d", "cpu"];
    let plain = channels(&cpu);
    assert_eq!(names(&plain), ["B", "G", "R"]);
    let some = channels(&[&cpu[..], &["--aov", "uv,captured,uv"]].concat());
    assert_eq!(names(&some), ["B", "G", "R", "captured.V", "uv.U", "uv.V"]);
    let all = channels(&[&cpu[..], &["--aov", "all"]].concat());
    assert_eq!(all.len(), 12);
    for (name, samples) in &plain {
        assert!(some[name] == *samples && all[name] == *samples, "{name}");
    }
    for name in ["captured.V", "uv.U", "uv.V"] {
        assert!(some[name] == all[name], "{name}");
    }
    // The matte is antialiased where the picture is.
    let single = channels(&[&cpu[..], &["--aov", "captured", "--sampling", "single"]].concat());
    let partial = |of: &BTreeMap<String, Vec<f32>>| {
        let captured = of["captured.V"].iter();
        captured
            .filter(|&&share| share > 0.0 && share < 1.0)
            .count()
    };
    assert_eq!(partial(&single), 0);
    assert!(partial(&all) > 20);
    // Where the matte is whole, the picture is black.
    let black = |index: usize| ["R", "G", "B"].iter().all(|name| all[*name][index] == 0.0);
    let dark = (0..64 * 36).filter(|&index| all["captured.V"][index] == 1.0);
    assert_eq!(dark.clone().filter(|&index| !black(index)).count(), 0);
    assert!(dark.count() > 100);
}

/// Layers are computed on the CPU also for a picture that the GPU draws, and by the method of the picture.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn layers_do_not_depend_on_the_device() {
    for method in ["lut", "flat"] {
        let on = |device| {
            let mut all = channels(&["-d", device, "--aov", "all", "--method", method]);
            all.retain(|name, _| name.contains('.'));
            all
        };
        let cpu = on("cpu");
        assert_eq!(cpu.len(), 9);
        assert!(cpu == on("gpu"), "{method}");
        let is_straight = cpu["magnification.V"].iter().all(|&m| m == 0.0 || m == 1.0);
        assert_eq!(is_straight, method == "flat");
    }
}

/// The layers of a disc are there with the disc, and the others stay as they are.
#[test]
fn a_disc_has_layers() {
    let cpu = ["-d", "cpu", "--aov"];
    let without = channels(&[&cpu[..], &["all"]].concat());
    let disc = ["--disc", "3,9", "--disc-opacity", "0.5"];
    let all = channels(&[&cpu[..], &["all"], &disc].concat());
    let of_disc = [
        "disc_alpha.V",
        "disc_order.V",
        "disc_radius.V",
        "disc_shift.V",
    ];
    let added: Vec<&str> = names(&all)
        .into_iter()
        .filter(|&name| !without.contains_key(name))
        .collect();
    assert_eq!(added, of_disc);
    for (name, samples) in without.iter().filter(|(name, _)| name.contains('.')) {
        assert!(all[name] == *samples, "{name}");
    }
    let one = channels(&[&cpu[..], &["disc_radius"], &disc].concat());
    assert_eq!(names(&one), ["B", "G", "R", "disc_radius.V"]);
    assert!(one["disc_radius.V"] == all["disc_radius.V"]);
    let radii = all["disc_radius.V"].iter().filter(|&&radius| radius != 0.0);
    assert!(radii.clone().all(|radius| (3.0..=9.0).contains(radius)));
    assert!(radii.count() > 500);
    // Two crossings take three quarters of the light.
    let alpha = &all["disc_alpha.V"];
    assert!(alpha.iter().all(|alpha| (0.0..0.76).contains(alpha)));
    assert!(alpha.iter().any(|&alpha| alpha > 0.7) && alpha.contains(&0.5));
}

#[test]
fn layers_of_a_disc_need_a_disc() {
    let folder = folder();
    let out = path(&folder, "1.exr");
    let film = ["film", "--path", "orbit", "--frames", "1..2"];
    for command in [&["render"][..], &film] {
        VIEWER
            .run(&[command, &["--aov", "uv,disc_order", "-o", &out]].concat())
            .refuses(&["--aov", "disc_order", "--disc"]);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn layers_need_an_exr() {
    let folder = folder();
    for out in [&path(&folder, "out.png"), "-"] {
        VIEWER
            .run(&[&RENDER[..], &["--aov", "uv", "-o", out]].concat())
            .refuses(&["--aov", out, ".exr"]);
    }
    VIEWER
        .run(&["render", "--aov", "depth", "-o", &path(&folder, "out.exr")])
        .refuses(&["--aov", "depth", "direction", "captured", "all"]);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
