//! Records, whole and damaged.

use super::*;
use crate::cli::Cli;
use crate::cli::read::RENDER;
use lensbake_program::arguments;
use lensbake_render::openexr::{Metadata, Value, encode};
use lensbake_render::picture::Picture;
use proptest::prelude::*;

/// The matches of `viewer render` with these options.
fn given(options: &[&str]) -> ArgMatches {
    let arguments = ["viewer", RENDER]
        .into_iter()
        .chain(options.iter().copied());
    let matches = arguments::matches::<Cli>(arguments.map(OsString::from)).unwrap();
    matches.subcommand_matches(RENDER).unwrap().clone()
}

/// A picture of one pixel that records these options.
fn recording(options: &[&str]) -> Vec<u8> {
    let recorded = RecordedOptions::of(&given(options)).unwrap();
    let json = serde_json::to_string(&recorded).unwrap();
    let metadata = Metadata {
        attributes: vec![(ATTRIBUTE, Value::Text(json))],
        ..Metadata::default()
    };
    let picture = Picture::new(1, 1, vec![[0.0; 3]]);
    encode(&picture, Vec::new(), &metadata).unwrap()
}

/// The arguments of the picture in `bytes` beside these options.
fn inherited(bytes: &[u8], options: &[&str]) -> Result<Vec<OsString>, LikeError> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("picture.exr");
    std::fs::write(&file, bytes).unwrap();
    Inherited::read(&file)?.beside(&given(options))
}

#[test]
fn a_record_has_every_option_of_a_picture_but_those_that_are_excluded() {
    let all = inherited(&recording(&["-r", "7", "--hole=1,-2"]), &["-o", "a.exr"]).unwrap();
    let has = |argument: &str| all.iter().any(|found| found == argument);
    assert!(has("--radius=7") && has("--hole=1,-2") && has("--step=0.05"));
    for name in ["output", "like", "explain", "orbit", "latitude", "help"] {
        let prefix = format!("--{name}");
        let found = all.iter().filter_map(|argument| argument.to_str());
        assert_eq!(
            found.filter(|f| f.starts_with(&prefix)).count(),
            0,
            "{name}"
        );
    }
    let arguments = ["viewer", RENDER].into_iter().map(OsString::from);
    let matches = arguments::matches::<Cli>(arguments.chain(all)).unwrap();
    let again = RecordedOptions::of(matches.subcommand_matches(RENDER).unwrap());
    assert_eq!(
        again,
        RecordedOptions::of(&given(&["-r", "7", "--hole=1,-2"]))
    );
}

#[test]
fn another_device_or_format_leaves_out_what_it_does_not_have() {
    let picture = recording(&["--pass", "fragment", "--aov", "uv,order", "--fov", "50"]);
    let has = |options: &[&str], argument: &str| {
        let arguments = inherited(&picture, options).unwrap();
        arguments.iter().any(|found| found == argument)
    };
    assert!(has(&[], "--pass=fragment"));
    assert!(!has(&["-d", "cpu"], "--pass=fragment"));
    assert!(has(&["-o", "a.exr"], "--aov=uv") && has(&["-o", "a.exr"], "--aov=order"));
    assert!(!has(&["-o", "a.png"], "--aov=uv"));
    assert!(has(&["-r", "3"], "--fov=50"));
    assert!(!has(&["--projection", "cube"], "--fov=50"));
}

proptest! {
    /// Damage anywhere in a file gives options or one line, never a panic.
    #[test]
    fn damage_gives_options_or_one_line(
        damage in prop::collection::vec((0.0..1.0_f64, any::<u8>()), 1..4),
        kept in 0.0..1.0_f64,
        is_cut in any::<bool>(),
    ) {
        let mut bytes = recording(&["--motion", "fall", "-r", "0.5"]);
        for (place, byte) in damage {
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = byte;
        }
        if is_cut {
            bytes.truncate((kept * bytes.len() as f64) as usize);
        }
        if let Err(error) = inherited(&bytes, &[]) {
            prop_assert_eq!(error.to_string().lines().count(), 1, "{}", error);
        }
    }
}
