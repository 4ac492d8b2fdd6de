//! What the cross-checks share: the real programs, and the GPU that must be there.

mod damaged;
#[cfg(target_os = "linux")]
pub mod desktop;
pub mod probe;
pub mod screen;

pub use damaged::{Damaged, damaged_tables};

use bake::baker::{Recipe, bake};
use lensbake_tables::{Rows, Table};
use std::ffi::OsStr;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use viewer::gpu::Gpu;

/// One of the project's programs.
#[derive(Debug, Clone, Copy)]
pub struct Program {
    path: &'static str,
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
    /// The program at `path`, which Cargo gives a package's own tests as `CARGO_BIN_EXE_…`.
    pub const fn at(path: &'static str) -> Self {
        Program { path }
    }

    /// Runs the program with `input` on its standard input.
    ///
    /// # Panics
    /// If it does not start, or dies of a signal.
    pub fn run_with<S: AsRef<OsStr>>(&self, args: &[S], input: &str) -> Run {
        let mut child = Command::new(self.path)
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
    Gpu::open().unwrap_or_else(|e| {
        panic!("{e}; or test with --features lensbake-tests/no-gpu,viewer/no-gpu")
    })
}

impl Run {
    /// The run again, if the program says that all is done.
    ///
    /// # Panics
    /// If its exit code is not 0.
    #[track_caller]
    pub fn succeeds(self) -> Self {
        assert_eq!(self.code, 0, "{self:?}");
        self
    }

    /// Checks that the program refused: exit code 2, nothing on standard output, and one line on
    /// standard error with all of `words` in it.
    ///
    /// # Panics
    /// If it did anything else.
    #[track_caller]
    pub fn refuses(self, words: &[&str]) {
        assert_eq!(self.code, 2, "{self:?}");
        assert_eq!(self.stdout, "", "{self:?}");
        assert_eq!(self.stderr.lines().count(), 1, "{self:?}");
        for word in words {
            assert!(
                self.stderr.contains(word),
                "no '{word}' in: {}",
                self.stderr
            );
        }
        assert!(!self.stderr.contains("panicked"), "{self:?}");
    }
}

/// A freshly baked table of one row, for the static observer at `radius`.
///
/// # Panics
/// If it does not bake.
pub fn one_row(radius: f64) -> Table {
    let recipe = Recipe {
        rows: Rows::One {
            inverse_radius: 1.0 / radius,
        },
        ..Recipe::default()
    };
    bake(&recipe, || ()).unwrap()
}

/// A freshly baked atlas of every observer, so coarse that its error is seen.
///
/// # Panics
/// If it does not bake.
pub fn coarse_atlas() -> Table {
    let recipe = Recipe {
        rows: Rows::Chi { count: 8 },
        texels: 8,
        ..Recipe::default()
    };
    bake(&recipe, || ()).unwrap()
}
