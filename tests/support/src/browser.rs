//! Runs scripts that drive a browser, with Node.

use crate::{READERS_HINT, fetched, workspace};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};

/// One browser at a time: each draws on all cores, and all read the same scripts.
static BROWSER: Mutex<()> = Mutex::new(());

/// Runs `script` with the program `node`, to which the script and `arguments` are added, and returns its line of JSON. The
/// scripts of `folders` are copied beside the packages that they import, which are beside `target_tmpdir`.
///
/// # Panics
/// If the script or what it needs is missing, or it fails.
pub fn run(
    target_tmpdir: &str,
    folders: &[&str],
    mut node: Command,
    script: &str,
    arguments: &[&str],
) -> Value {
    let _alone = BROWSER.lock().unwrap_or_else(PoisonError::into_inner);
    let scripts = fetched(target_tmpdir);
    for folder in folders {
        for entry in fs::read_dir(workspace().join(folder)).unwrap() {
            copy(&entry.unwrap().path(), &scripts);
        }
    }
    let package = fs::read_to_string(scripts.join("package.json")).unwrap();
    assert!(package.contains("playwright-core"), "{READERS_HINT}");
    let output = node
        .arg(scripts.join(script))
        .args(arguments)
        .output()
        .unwrap_or_else(|e| panic!("{node:?}: {e}: {READERS_HINT}"));
    let [said, error] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    assert!(output.status.success(), "{script}: {said}{error}");
    serde_json::from_str(&said).unwrap_or_else(|e| panic!("{script}: {e}: {said}{error}"))
}

fn copy(file: &Path, folder: &Path) {
    fs::copy(file, folder.join(file.file_name().unwrap())).unwrap();
}
