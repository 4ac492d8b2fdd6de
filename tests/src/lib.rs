//! What the cross-checks share: the real programs, and the GPU that must be there.

use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use viewer::gpu::Gpu;

/// One of the project's programs, freshly built.
#[derive(Debug, Clone)]
pub struct Program {
    path: PathBuf,
}

/// What a program did.
#[derive(Debug, Clone)]
pub struct Run {
    /// Its exit code.
    pub code: i32,
    /// Its standard output.
    pub stdout: String,
    /// Its standard error, without what graphics drivers print there.
    pub stderr: String,
}

impl Program {
    /// The program of package `name`.
    ///
    /// # Panics
    /// If it does not build.
    pub fn build(name: &str) -> Self {
        let built = escargot::CargoBuild::new()
            .package(name)
            .bin(name)
            .current_target()
            .manifest_path(workspace().join("Cargo.toml"))
            .run()
            .unwrap_or_else(|e| panic!("{name} does not build: {e}"));
        Program {
            path: built.path().to_owned(),
        }
    }

    /// Runs the program with `input` on its standard input.
    ///
    /// # Panics
    /// If it does not start, or dies of a signal.
    pub fn run_with<S: AsRef<OsStr>>(&self, args: &[S], input: &str) -> Run {
        let mut child = Command::new(&self.path)
            .args(args)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut stdin = child.stdin.take().unwrap();
        let input = input.to_owned();
        // The program may stop reading early, so a broken pipe here is none of our business.
        let feeder = std::thread::spawn(move || stdin.write_all(input.as_bytes()).is_ok());
        let output = child.wait_with_output().unwrap();
        feeder.join().unwrap();
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        let from_driver = |line: &&str| !line.contains("XDG_RUNTIME_DIR");
        Run {
            code: output.status.code().expect("ended by a signal"),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr)
                .lines()
                .filter(from_driver)
                .map(|line| line.to_owned() + "\n")
                .collect(),
        }
    }

    /// Runs the program without input.
    ///
    /// # Panics
    /// As [`Program::run_with`].
    pub fn run<S: AsRef<OsStr>>(&self, args: &[S]) -> Run {
        self.run_with(args, "")
    }
}

/// The workspace's folder.
pub fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The GPU, software or not.
///
/// # Panics
/// Without one: nothing skips quietly. `--features no-gpu` makes the tests that call this visible
/// ignored ones.
pub fn gpu() -> Gpu {
    Gpu::open().unwrap_or_else(|e| panic!("{e}; or test with --features lensbake-tests/no-gpu"))
}
