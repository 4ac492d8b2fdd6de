//! A virtual screen (Xvfb) for a test, and the windows of programs on it: keys and resizes through xdotool,
//! screenshots and dropped files through the X protocol.

mod drop_file;
mod shot;

pub use shot::Shot;

use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{ConnectionExt, CreateWindowAux, ImageFormat, WindowClass};
use x11rb::rust_connection::RustConnection;

/// Longest time that a test waits for something to happen: shaders may compile for seconds before the first frame
/// on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A virtual screen.
#[derive(Debug)]
pub struct Desktop {
    server: Child,
    display: String,
    runtime: tempfile::TempDir,
}

/// A program with a window on a [`Desktop`].
pub struct WindowedProgram {
    child: Child,
    display: String,
    x: RustConnection,
    root: u32,
    window: u32,
    source: u32,
    stderr: std::path::PathBuf,
}

impl Desktop {
    /// Starts a screen of `width` × `height` pixels.
    ///
    /// # Panics
    /// If there is no Xvfb.
    pub fn new(width: u32, height: u32) -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp"])
            // Without this, the server resets between one program and the next.
            .args(["-noreset", "-screen", "0"])
            .arg(format!("{width}x{height}x24"))
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|e| {
                panic!(
                    "Xvfb: {e}; install xvfb and xdotool, or test with --features viewer/no-window"
                )
            });
        let mut number = String::new();
        let mut stdout = server.stdout.take().unwrap();
        let mut byte = [0];
        while stdout.read(&mut byte).unwrap() == 1 && byte[0] != b'\n' {
            number.push(byte[0].into());
        }
        Desktop {
            server,
            display: format!(":{number}"),
            runtime: tempfile::tempdir().unwrap(),
        }
    }

    /// Starts `program` in the folder `cwd`, and waits for its window.
    ///
    /// # Panics
    /// If no window opens.
    pub fn start<S: AsRef<OsStr>>(&self, program: &str, args: &[S], cwd: &Path) -> WindowedProgram {
        // A file, because an unread pipe fills up.
        let stderr = self.runtime.path().join("stderr");
        let child = Command::new(program)
            .args(args)
            .current_dir(cwd)
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY")
            .env("XDG_RUNTIME_DIR", self.runtime.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(File::create(&stderr).unwrap())
            .spawn()
            .unwrap();
        let (x, screen) = x11rb::connect(Some(&self.display)).unwrap();
        let root = x.setup().roots[screen].root;
        let source = x.generate_id().unwrap();
        x.create_window(
            0,
            source,
            root,
            0,
            0,
            1,
            1,
            0,
            WindowClass::INPUT_ONLY,
            0,
            &CreateWindowAux::new(),
        )
        .unwrap();
        let mut started = WindowedProgram {
            child,
            display: self.display.clone(),
            x,
            root,
            window: 0,
            source,
            stderr,
        };
        let window = started.until("its window is there", |program| {
            let found = program.xdotool_output(&["search", "--onlyvisible", "--name", "lensbake"]);
            found.lines().next_back().and_then(|id| id.parse().ok())
        });
        started.window = window;
        started
    }
}

impl Drop for Desktop {
    fn drop(&mut self) {
        // The server may have exited already.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl WindowedProgram {
    /// Calls `ask` until there is an answer.
    ///
    /// # Panics
    /// If none comes for a minute, or the program ends.
    #[track_caller]
    pub fn until<T>(&mut self, what: &str, mut ask: impl FnMut(&mut Self) -> Option<T>) -> T {
        let since = Instant::now();
        loop {
            if let Some(answer) = ask(self) {
                return answer;
            }
            self.still_runs(what);
            assert!(since.elapsed() < PATIENCE, "waited in vain until {what}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Checks that the program has not ended.
    ///
    /// # Panics
    /// If it has, with its standard error.
    #[track_caller]
    pub fn still_runs(&mut self, until: &str) {
        if let Some(status) = self.child.try_wait().unwrap() {
            panic!("ended with {status} before {until}: {}", self.stderr());
        }
    }

    /// Presses keys one after the other, by their X names.
    pub fn press(&self, keys: &[&str]) {
        self.focus();
        self.xdotool(&[&["key", "--delay", "30"], keys].concat());
    }

    /// Holds a key for a while.
    pub fn hold(&self, key: &str, time: Duration) {
        self.focus();
        self.xdotool(&["keydown", key]);
        std::thread::sleep(time);
        self.xdotool(&["keyup", key]);
    }

    /// Turns the wheel by notches, upwards if positive, over the window.
    pub fn scroll(&self, notches: i32) {
        self.xdotool(&[
            "mousemove",
            "--window",
            &self.window.to_string(),
            "200",
            "200",
        ]);
        let button = if notches > 0 { "4" } else { "5" };
        let times = notches.unsigned_abs().to_string();
        self.xdotool(&["click", "--repeat", &times, "--delay", "5", button]);
    }

    /// Clicks at a pixel of the window.
    pub fn click(&self, x: u32, y: u32) {
        self.focus();
        let (window, x, y) = (self.window.to_string(), x.to_string(), y.to_string());
        self.xdotool(&["mousemove", "--sync", "--window", &window, &x, &y]);
        self.xdotool(&["click", "1"]);
    }

    /// Resizes the window.
    pub fn resize(&self, width: u32, height: u32) {
        let sizes = [width, height].map(|side| side.to_string());
        self.xdotool(&["windowsize", &self.window.to_string(), &sizes[0], &sizes[1]]);
    }

    /// Hides (unmaps) the window.
    pub fn hide(&self) {
        self.xdotool(&["windowunmap", "--sync", &self.window.to_string()]);
    }

    /// Shows (maps) the window again.
    pub fn unhide(&self) {
        self.xdotool(&["windowmap", "--sync", &self.window.to_string()]);
    }

    /// Runs xdotool.
    ///
    /// # Panics
    /// If there is no xdotool.
    pub fn xdotool(&self, args: &[&str]) {
        self.xdotool_output(args);
    }

    fn xdotool_output(&self, args: &[&str]) -> String {
        let output = Command::new("xdotool")
            .args(args)
            .env("DISPLAY", &self.display)
            .output()
            .unwrap_or_else(|e| panic!("xdotool: {e}; install it"));
        String::from_utf8(output.stdout).unwrap()
    }

    fn focus(&self) {
        self.xdotool(&["windowfocus", "--sync", &self.window.to_string()]);
    }

    /// Text of the title bar.
    pub fn title(&self) -> String {
        let name = self.xdotool_output(&["getwindowname", &self.window.to_string()]);
        name.trim().to_owned()
    }

    /// Presses a key and waits until the title bar contains `says`.
    ///
    /// # Panics
    /// If it never does.
    #[track_caller]
    pub fn press_until(&mut self, key: &str, says: &str) {
        self.press(&[key]);
        self.until(says, |program| program.title().contains(says).then_some(()));
    }

    /// What the window shows; `None` while it has no pixels.
    pub fn shot(&self) -> Option<Shot> {
        let size = self.x.get_geometry(self.window).unwrap().reply().ok()?;
        let (width, height) = (size.width, size.height);
        let image = self
            .x
            .get_image(ImageFormat::Z_PIXMAP, self.window, 0, 0, width, height, !0)
            .unwrap()
            .reply()
            .ok()?;
        // 32 bits per pixel, of which 24 are used, blue first.
        let pixels = image.data.chunks_exact(4).map(|p| [p[2], p[1], p[0]]);
        Some(Shot {
            width: width.into(),
            height: height.into(),
            pixels: pixels.collect(),
        })
    }

    /// Waits until the window shows the same picture for half a second, and returns it.
    ///
    /// # Panics
    /// If it does not come to rest.
    #[track_caller]
    pub fn at_rest(&mut self) -> Shot {
        const REST: Duration = Duration::from_millis(500);
        let mut last = (self.shot(), Instant::now());
        self.until("the window is at rest", |program| {
            let shot = program.shot();
            if shot != last.0 {
                last = (shot, Instant::now());
            }
            (last.1.elapsed() > REST).then(|| last.0.clone()).flatten()
        })
    }

    /// Waits until the window shows a picture that is `wanted`, and returns it.
    ///
    /// # Panics
    /// If it never does.
    #[track_caller]
    pub fn shows(&mut self, what: &str, wanted: impl Fn(&Shot) -> bool) -> Shot {
        self.until(what, |program| program.shot().filter(&wanted))
    }

    /// Resident memory of the program, bytes.
    ///
    /// # Panics
    /// If the program is gone.
    pub fn memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let line = status.lines().find(|l| l.starts_with("VmRSS:")).unwrap();
        let kib: u64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
        1024 * kib
    }

    /// CPU time that the program uses during `time`, as a part of it: 1 is one core.
    ///
    /// # Panics
    /// If the program is gone.
    pub fn processor_share(&self, time: Duration) -> f64 {
        let (since, before) = (Instant::now(), self.processor_time());
        std::thread::sleep(time);
        (self.processor_time() - before) / since.elapsed().as_secs_f64()
    }

    /// CPU time that the program has used so far, s.
    fn processor_time(&self) -> f64 {
        // Clock ticks of `/proc` per second, the same on every Linux.
        const TICKS_PER_S: f64 = 100.0;
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.child.id())).unwrap();
        // The second field is the program's name in parentheses; user and system time are the 14th and 15th.
        let (_, fields) = stat.rsplit_once(')').unwrap();
        let fields = fields.split_whitespace().skip(11).take(2);
        let ticks: f64 = fields.map(|ticks| ticks.parse::<f64>().unwrap()).sum();
        ticks / TICKS_PER_S
    }

    /// Whether the program still runs after `time`.
    pub fn is_alive_after(&mut self, time: Duration) -> bool {
        std::thread::sleep(time);
        self.child.try_wait().unwrap().is_none()
    }

    /// Waits for the program to end; returns its exit code and what it wrote to standard error.
    ///
    /// # Panics
    /// If it does not end, or is ended by a signal.
    pub fn ends(mut self) -> (i32, String) {
        let since = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                let stderr = self.stderr();
                return (status.code().expect("ended by a signal"), stderr);
            }
            assert!(since.elapsed() < PATIENCE, "the program does not end");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// What it has written to standard error.
    ///
    /// # Panics
    /// If that cannot be read.
    pub fn stderr(&self) -> String {
        std::fs::read_to_string(&self.stderr).unwrap()
    }
}

impl Drop for WindowedProgram {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
