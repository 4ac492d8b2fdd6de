//! The programs that read OpenEXR files.

use lensbake_test_support::{READERS_HINT, workspace};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// The channels of a picture.
pub const RGB: [&str; 3] = ["R", "G", "B"];

/// A program that writes a picture to standard output: width and height as u32, then the channels that its arguments name
/// at each pixel as f32, from the top row to the bottom one.
pub struct Reader {
    /// Name of what it reads with.
    pub name: &'static str,
    command: Vec<PathBuf>,
    /// Whether it knows channels other than R, G and B.
    pub knows_layers: bool,
}

/// OpenEXR's own library, tinyexr and three.js.
pub static READERS: LazyLock<[Reader; 3]> = LazyLock::new(|| {
    let sources = workspace().join("tests/readers");
    let fetched = lensbake_test_support::fetched(env!("CARGO_TARGET_TMPDIR"));
    let tinyexr = Path::new(env!("CARGO_TARGET_TMPDIR")).join("read_tinyexr");
    build(&sources.join("read_tinyexr.cc"), &tinyexr);
    // Node looks for packages beside the script.
    let three = fetched.join("read_three.mjs");
    std::fs::copy(sources.join("read_three.mjs"), &three).unwrap();
    let reader = |name, command, knows_layers| Reader {
        name,
        command,
        knows_layers,
    };
    let python = fetched.join("venv/bin/python");
    let openexr = vec![python, sources.join("read_openexr.py")];
    [
        reader("OpenEXR", openexr, true),
        reader("tinyexr", vec![tinyexr], true),
        reader("three.js", vec!["node".into(), three], false),
    ]
});

fn build(source: &Path, program: &Path) {
    let compiler = Command::new("g++")
        .args(["-O1", "-o"])
        .args([program, source])
        .arg("-ltinyexr")
        .status();
    let built = compiler.is_ok_and(|status| status.success());
    assert!(
        built,
        "{} does not compile: {READERS_HINT}",
        source.display()
    );
}

/// A picture as a reader sees it.
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The bits of the channels of each pixel, row by row from the top.
    pub samples: Vec<u32>,
}

impl Picture {
    /// The pixels, if it was read as R, G and B.
    pub fn pixels(&self) -> std::slice::Iter<'_, [u32; 3]> {
        let (pixels, rest) = self.samples.as_chunks();
        assert!(rest.is_empty(), "{} samples left over", rest.len());
        pixels.iter()
    }
}

impl Reader {
    /// Reads these channels of `file`.
    pub fn read(&self, file: &Path, channels: &[&str]) -> Picture {
        let output = Command::new(&self.command[0])
            .args(&self.command[1..])
            .arg(file)
            .args(channels)
            .output()
            .unwrap_or_else(|e| panic!("{}: {e}: {READERS_HINT}", self.name));
        assert!(
            output.status.success(),
            "{}, {}: {}",
            self.name,
            file.display(),
            String::from_utf8_lossy(&output.stderr)
        );
        let mut words = words(&output.stdout);
        let samples = words.split_off(2);
        Picture {
            width: words[0],
            height: words[1],
            samples,
        }
    }
}

/// Little-endian words.
pub fn words(bytes: &[u8]) -> Vec<u32> {
    let (words, rest) = bytes.as_chunks();
    assert!(rest.is_empty(), "{} bytes left over", rest.len());
    words.iter().map(|word| u32::from_le_bytes(*word)).collect()
}
