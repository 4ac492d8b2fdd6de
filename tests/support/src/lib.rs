//! Shared by the tests of several packages: running the real programs, their windows and pipes, damaged files, and
//! tables made for a test.

pub mod browser;
mod damaged;
#[cfg(target_os = "linux")]
pub mod desktop;
pub mod exr_files;
#[cfg(unix)]
pub mod streams;

pub use damaged::{Damaged, damaged_tables};
pub use lensbake_tables::ATLAS_BINARY as ATLAS;

use lensbake_tables::baking::{Recipe, bake};
use lensbake_tables::container::Container;
use lensbake_tables::{Rows, Table};
use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// One of the project's programs.
#[derive(Debug, Clone, Copy)]
pub struct Program {
    path: &'static str,
}

/// What a program run returned.
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

    /// Path of the program.
    pub fn path(&self) -> &'static str {
        self.path
    }

    /// A command that runs the program, for a test that sets more than its arguments.
    pub fn command(&self) -> Command {
        Command::new(self.path)
    }

    /// Runs the program with `input` on its standard input.
    ///
    /// # Panics
    /// If it does not start, or is ended by a signal.
    pub fn run_with<S: AsRef<OsStr>>(&self, args: &[S], input: &str) -> Run {
        self.run_with_bytes(args, input.as_bytes())
    }

    /// Runs the program with these bytes on its standard input.
    ///
    /// # Panics
    /// As [`Program::run_with`], and if its output is not UTF-8.
    pub fn run_with_bytes<S: AsRef<OsStr>>(&self, args: &[S], input: &[u8]) -> Run {
        let output = self.output(args, input);
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        Run {
            code: output.status.code().expect("ended by a signal"),
            stdout: text(&output.stdout),
            stderr: without_driver_lines(&text(&output.stderr)),
        }
    }

    /// Runs the program, which must succeed, and returns its output as bytes.
    ///
    /// # Panics
    /// If it fails.
    #[track_caller]
    pub fn run_bytes<S: AsRef<OsStr>>(&self, args: &[S]) -> Output {
        let output = self.output(args, b"");
        assert!(output.status.success(), "{output:?}");
        output
    }

    fn output<S: AsRef<OsStr>>(&self, args: &[S], input: &[u8]) -> Output {
        let mut child = self
            .command()
            .args(args)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut stdin = child.stdin.take().unwrap();
        let input = input.to_owned();
        // The program may stop reading early, so a broken pipe is no error.
        let feeder = std::thread::spawn(move || stdin.write_all(&input).is_ok());
        let output = child.wait_with_output().unwrap();
        feeder.join().unwrap();
        output
    }

    /// Runs the program without input and with 1 GiB of address space, so that a large allocation ends it with a
    /// signal.
    ///
    /// # Panics
    /// As [`Program::run_with`].
    #[cfg(unix)]
    pub fn run_in_little_memory(&self, args: &[&str]) -> Run {
        const LIMITED: &str = "ulimit -v 1048576 && exec \"$0\" \"$@\"";
        let shell = Program::at("/bin/sh");
        shell.run(&[&["-c", LIMITED, self.path], args].concat())
    }

    /// Runs the program without input.
    ///
    /// # Panics
    /// As [`Program::run_with`].
    pub fn run<S: AsRef<OsStr>>(&self, args: &[S]) -> Run {
        self.run_with(args, "")
    }
}

/// `text` without the lines that graphics drivers print.
fn without_driver_lines(text: &str) -> String {
    text.lines()
        .filter(|line| !line.contains("XDG_RUNTIME_DIR"))
        .map(|line| line.to_owned() + "\n")
        .collect()
}

/// The workspace's folder.
pub fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .unwrap()
}

impl Run {
    /// The run, if the program succeeded.
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
        assert_eq!(self.stderr.lines().count(), 1, "{self:?}");
        self.refuses_after_messages(words);
    }

    /// Checks that the program refused as [`Run::refuses`] says, but allows other messages before the error.
    ///
    /// # Panics
    /// If it did anything else.
    #[track_caller]
    pub fn refuses_after_messages(self, words: &[&str]) {
        assert_eq!(self.code, 2, "{self:?}");
        assert_eq!(self.stdout, "", "{self:?}");
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
/// If it cannot be baked.
pub fn one_row(radius: f64) -> Table {
    one_row_of(radius, Recipe::default().texels)
}

/// A freshly baked table of one row of `texels` texels, for the static observer at `radius`.
///
/// # Panics
/// If it cannot be baked.
pub fn one_row_of(radius: f64, texels: u32) -> Table {
    let recipe = Recipe {
        rows: Rows::One {
            inverse_radius: 1.0 / radius,
        },
        texels,
        ..Recipe::default()
    };
    bake(&recipe, || ()).unwrap()
}

/// Writes a table to `path`, in the container of its file extension.
///
/// # Panics
/// If it cannot be written.
pub fn write_table(path: impl AsRef<Path>, table: &Table) {
    let path = path.as_ref();
    let bytes = Container::of(path).unwrap().encode(table).unwrap();
    std::fs::write(path, bytes).unwrap();
}

/// A freshly baked atlas of all observers, so coarse that its error is visible.
///
/// # Panics
/// If it cannot be baked.
pub fn coarse_atlas() -> Table {
    let recipe = Recipe {
        rows: Rows::Chi { count: 8 },
        texels: 8,
        ..Recipe::default()
    };
    bake(&recipe, || ()).unwrap()
}

/// What to do if a program or a package is missing that other readers and compilers need.
pub const READERS_HINT: &str = "run scripts/test.sh once, which installs what this test reads with; or test with \
                                --features lensbake-tests/no-readers";

/// The folder beside Cargo's folder for tests, `target_tmpdir`, that `scripts/fetch-readers.sh` fills with packages for
/// Python and Node.
///
/// # Panics
/// If they are not there.
pub fn fetched(target_tmpdir: &str) -> PathBuf {
    let folder = Path::new(target_tmpdir).with_file_name("readers");
    assert!(
        folder.join("node_modules").is_dir() && folder.join("venv").is_dir(),
        "{} lacks packages: {READERS_HINT}",
        folder.display()
    );
    folder
}
