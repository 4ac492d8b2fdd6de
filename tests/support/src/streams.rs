//! Programs run with pipes that close, full devices, and files of every kind.

use crate::{Run, without_driver_lines};
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Time after which a program is taken to hang; no test measures it.
const HANGS: Duration = Duration::from_secs(60);

/// A running program.
#[derive(Debug)]
pub struct Spawned {
    child: Child,
    /// Lines of standard output, if they are read one by one.
    lines: Option<Receiver<String>>,
}

impl Spawned {
    /// Starts `command` with `input` on its standard input; standard output and error are pipes.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start(mut command: Command, input: &str) -> Self {
        let mut child = piped(&mut command);
        let mut stdin = child.stdin.take().expect("a pipe");
        let input = input.to_owned();
        // The program may stop reading early.
        std::thread::spawn(move || stdin.write_all(input.as_bytes()).is_ok());
        Spawned { child, lines: None }
    }

    /// Starts `command` for a dialogue: its standard input stays open.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start_interactive(mut command: Command) -> Self {
        let mut child = piped(&mut command);
        let stdout = BufReader::new(child.stdout.take().expect("a pipe"));
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            for line in stdout.lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Spawned {
            child,
            lines: Some(lines),
        }
    }

    /// Its standard input.
    ///
    /// # Panics
    /// If it was closed.
    pub fn stdin(&mut self) -> &mut ChildStdin {
        self.child.stdin.as_mut().expect("standard input is open")
    }

    /// The next line of its standard output.
    ///
    /// # Panics
    /// If none comes.
    #[track_caller]
    pub fn line_within_a_minute(&self) -> String {
        let lines = self.lines.as_ref().expect("started for a dialogue");
        lines.recv_timeout(HANGS).expect("a line of output")
    }

    /// Closes its standard input.
    pub fn close_stdin(&mut self) {
        self.child.stdin = None;
    }

    /// Closes the reading end of its standard output.
    pub fn close_stdout(&mut self) {
        self.child.stdout = None;
    }

    /// Closes the reading end of its standard error.
    pub fn close_stderr(&mut self) {
        self.child.stderr = None;
    }

    /// Waits for its end; returns its exit code.
    ///
    /// # Panics
    /// If it hangs or is ended by a signal.
    #[track_caller]
    pub fn ends(self) -> i32 {
        self.run_within_a_minute().code
    }

    /// Waits for its end; returns its exit code and output.
    ///
    /// # Panics
    /// If it hangs or is ended by a signal.
    #[track_caller]
    pub fn run_within_a_minute(mut self) -> Run {
        let stdout = self.child.stdout.take().map(read_all);
        let stderr = self.child.stderr.take().map(read_all);
        let started = Instant::now();
        let status = loop {
            match self.child.try_wait().unwrap() {
                Some(status) => break status,
                None if started.elapsed() > HANGS => {
                    self.child.kill().unwrap();
                    panic!("the program hangs");
                }
                None => std::thread::sleep(Duration::from_millis(5)),
            }
        };
        let text = |read: Option<JoinHandle<Vec<u8>>>| {
            let bytes = read.map_or(Vec::new(), |read| read.join().unwrap());
            String::from_utf8_lossy(&bytes).into_owned()
        };
        Run {
            code: status.code().expect("ended by a signal"),
            stdout: text(stdout),
            stderr: without_driver_lines(&text(stderr)),
        }
    }
}

fn piped(command: &mut Command) -> Child {
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn read_all(mut from: impl Read + Send + 'static) -> JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        from.read_to_end(&mut bytes).unwrap();
        bytes
    })
}

/// A device on which every write fails with "no space left".
///
/// # Panics
/// If there is none.
pub fn full_device() -> Stdio {
    let device = OpenOptions::new().write(true).open("/dev/full").unwrap();
    device.into()
}

/// Creates a FIFO at `path` and reads from it on a thread until it is closed.
///
/// # Panics
/// If it cannot be created.
pub fn fifo_reader(path: &Path) -> JoinHandle<Vec<u8>> {
    make_fifo(path);
    let path = path.to_owned();
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        File::open(path).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    })
}

/// Creates a FIFO at `path` and writes `text` to its first reader, on a thread.
///
/// # Panics
/// If it cannot be created.
pub fn fifo_writer(path: &Path, text: &str) -> JoinHandle<io::Result<()>> {
    make_fifo(path);
    let (path, text) = (path.to_owned(), text.to_owned());
    std::thread::spawn(move || fs::write(path, text))
}

fn make_fifo(path: &Path) {
    let made = Command::new("mkfifo").arg(path).status().unwrap();
    assert!(made.success());
}

/// Whether `path` itself is a FIFO.
///
/// # Panics
/// If nothing is there.
pub fn is_fifo(path: &Path) -> bool {
    fs::symlink_metadata(path).unwrap().file_type().is_fifo()
}

/// Creates a symbolic link at `path` to `target`.
///
/// # Panics
/// If it cannot be created.
pub fn link(target: &str, path: &Path) {
    symlink(target, path).unwrap();
}

/// The permission bits of a file.
///
/// # Panics
/// If it is not there.
pub fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o7777
}

/// Sets the permission bits of a file.
///
/// # Panics
/// If it is not there.
pub fn set_mode(path: &Path, bits: u32) {
    fs::set_permissions(path, Permissions::from_mode(bits)).unwrap();
}
