//! The text for Godot, in Godot 3 with software OpenGL.

use super::rays::{Errors, RADII, rays};
use super::{HINT, SIMPLE_BOUND, bytes_as, report};
use lensbake_test_support::workspace;
use std::process::Command;
use tempfile::TempDir;

/// Godot 3 rounds the literals of a shader to six digits, which moves the shadow's edge slightly. A ray between the two edges
/// has the wrong outcome; its error is its distance from the edge, in pixels.
#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn simple() {
    let folder = TempDir::new().unwrap();
    let [input, output] = ["rays", "out"].map(|name| folder.path().join(name));
    let rays = rays(&RADII);
    std::fs::write(&input, bytemuck::cast_slice(&rays)).unwrap();
    let run = Command::new(workspace().join("tests/kit/godot/run.sh"))
        .args([workspace(), folder.path(), &input, &output])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stderr) + String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success(), "{said}: {HINT}");
    let answers = bytes_as(&std::fs::read(output).unwrap());
    report("Godot 3, simple", Errors::of(&rays, &answers), SIMPLE_BOUND);
}
