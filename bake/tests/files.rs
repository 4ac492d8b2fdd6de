//! How the program treats files, devices, pipes and streams.
#![cfg(unix)]

use lensbake_test_support::streams::{
    Spawned, fifo_reader, full_device, is_fifo, link, mode, set_mode,
};
use lensbake_test_support::{ATLAS, Program};
use std::fs;
use std::io::Write;
use std::os::unix::fs::FileTypeExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::TempDir;

const BAKE: Program = Program::at(env!("CARGO_BIN_EXE_bake"));
/// Number of lines of the CSV file of a hundred rays.
const LINES: usize = 101;

/// A temporary folder and paths in it.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Folder(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes the atlas to a file of this name.
    fn atlas(&self, name: &str) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, ATLAS).unwrap();
        path
    }

    /// The sorted names of its files.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// `bake diff` of a hundred rays with its CSV file at `path`.
fn diff_to(path: &Path) -> lensbake_test_support::Run {
    BAKE.run(&["diff", "--rays", "100", "--csv", text(path)])
}

fn lines_of(path: &Path) -> usize {
    fs::read_to_string(path).unwrap().lines().count()
}

#[test]
fn a_device_is_written_to_and_stays_a_device() {
    let folder = Folder::new();
    let device = folder.path("n.csv");
    let made = Command::new("mknod")
        .arg(&device)
        .args(["c", "1", "3"])
        .stderr(Stdio::null())
        .status();
    if made.is_ok_and(|status| status.success()) {
        diff_to(&device).succeeds();
        let kind = fs::symlink_metadata(&device).unwrap().file_type();
        assert!(kind.is_char_device(), "{kind:?}");
    }
    // Without the permission to make a device: through a link.
    let linked = folder.path("linked.csv");
    link("/dev/null", &linked);
    diff_to(&linked).succeeds();
    assert_eq!(fs::read_link(&linked).unwrap(), Path::new("/dev/null"));
}

#[test]
fn a_fifo_is_written_to_and_stays_a_fifo() {
    let folder = Folder::new();
    let fifo = folder.path("p.csv");
    let reader = fifo_reader(&fifo);
    diff_to(&fifo).succeeds();
    assert!(is_fifo(&fifo));
    let written = String::from_utf8(reader.join().unwrap()).unwrap();
    assert_eq!(written.lines().count(), LINES);
}

#[test]
fn a_symbolic_link_is_written_through() {
    let folder = Folder::new();
    let (real, linked) = (folder.path("real.csv"), folder.path("link.csv"));
    fs::write(&real, "old").unwrap();
    link("real.csv", &linked);
    diff_to(&linked).succeeds();
    assert_eq!(fs::read_link(&linked).unwrap(), Path::new("real.csv"));
    assert_eq!(lines_of(&real), LINES);

    // A link whose target does not exist yet.
    fs::create_dir(folder.path("sub")).unwrap();
    let dangling = folder.path("dangling.csv");
    link("sub/new.csv", &dangling);
    diff_to(&dangling).succeeds();
    assert_eq!(lines_of(&folder.path("sub/new.csv")), LINES);
    assert!(dangling.is_symlink());

    // Two links that point to each other.
    link("b.csv", &folder.path("a.csv"));
    link("a.csv", &folder.path("b.csv"));
    diff_to(&folder.path("a.csv")).refuses(&["a.csv"]);
}

#[test]
fn an_existing_file_keeps_its_mode() {
    let folder = Folder::new();
    let file = folder.path("secret.csv");
    fs::write(&file, "old").unwrap();
    for bits in [0o600, 0o640, 0o755] {
        set_mode(&file, bits);
        diff_to(&file).succeeds();
        assert_eq!(mode(&file), bits);
        assert_eq!(lines_of(&file), LINES);
    }
}

#[test]
fn a_read_only_file_is_refused_and_stays_as_it_is() {
    let folder = Folder::new();
    let file = folder.path("kept.lbt");
    fs::write(&file, "kept").unwrap();
    set_mode(&file, 0o444);
    BAKE.run(&["--texels", "8", "-o", text(&file)])
        .refuses(&[text(&file), "read-only"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "kept");
    assert_eq!(folder.names(), ["kept.lbt"]);
}

#[test]
fn a_folder_is_refused_before_the_work() {
    let folder = Folder::new();
    let inner = folder.path("folder.csv");
    fs::create_dir(&inner).unwrap();
    diff_to(&inner).refuses(&[text(&inner), "is a folder"]);
}

#[test]
fn a_dash_is_standard_output() {
    let folder = Folder::new();
    let bake = |to: &str| BAKE.run_bytes(&["--texels", "16", "-o", to]);
    let file = folder.path("a.lbt");
    bake(text(&file));
    let table = fs::read(&file).unwrap();
    assert_eq!(bake("-").stdout, table);
    let exr = folder.path("a.exr");
    BAKE.run(&["convert", text(&file), text(&exr)]).succeeds();
    assert_eq!(BAKE.run_bytes(&["convert", text(&exr), "-"]).stdout, table);

    // With the data on standard output, the report goes to standard error.
    let run = BAKE
        .run(&["diff", "--rays", "100", "--csv", "-"])
        .succeeds();
    assert_eq!(run.stdout.lines().count(), LINES);
    assert!(run.stderr.contains("table - closed form"), "{run:?}");
    BAKE.run(&["diff", "--csv", "-", "--plot", "-"])
        .refuses(&["--csv", "--plot"]);
    assert_eq!(folder.names(), ["a.exr", "a.lbt"]);
}

#[test]
fn messages_that_cannot_be_written_change_nothing() {
    let folder = Folder::new();
    let outputs = ["closed.lbt", "full.lbt"].map(|name| folder.path(name));
    let command = |output: &Path| {
        let mut command = BAKE.command();
        command.args(["--texels", "16", "-o", text(output)]);
        command
    };
    let mut closed = Spawned::start(command(&outputs[0]), "");
    closed.close_stderr();
    assert_eq!(closed.ends(), 0);
    let status = command(&outputs[1]).stderr(full_device()).status().unwrap();
    assert_eq!(status.code(), Some(0));
    for output in outputs {
        BAKE.run(&["inspect", text(&output)]).succeeds();
    }
    // An error keeps its exit code.
    let status = BAKE
        .command()
        .args(["inspect", "/nowhere.lbt"])
        .stderr(full_device())
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(2));
}

#[test]
fn an_output_over_an_input_is_refused() {
    let folder = Folder::new();
    let table = folder.atlas("table.lbt");
    let (soft, hard) = (folder.path("soft.lbt"), folder.path("hard.lbt"));
    link("table.lbt", &soft);
    fs::hard_link(&table, &hard).unwrap();
    for output in [&table, &soft, &hard] {
        let words = [text(output), "also the input"];
        BAKE.run(&["diff", text(&table), "--rays", "100", "--csv", text(output)])
            .refuses(&words);
        BAKE.run(&[
            "diff",
            text(&table),
            "--rays",
            "100",
            "--plot",
            text(output),
        ])
        .refuses(&words);
        BAKE.run(&["convert", text(&table), text(output)])
            .refuses(&words);
    }
    assert_eq!(fs::read(&table).unwrap(), ATLAS);

    // One output must not overwrite another either.
    let same = folder.path("same");
    BAKE.run(&["diff", "--csv", text(&same), "--plot", text(&same)])
        .refuses(&[text(&same), "named twice"]);
}

#[test]
fn outputs_are_checked_before_the_work() {
    let mut command = BAKE.command();
    command.args(["diff", "--rays", "50000000", "--csv", "/nonexistent/x.csv"]);
    // This many rays take a quarter of an hour.
    let run = Spawned::start(command, "").run_within_a_minute();
    run.refuses(&["/nonexistent/x.csv", "does not exist"]);
}

#[test]
fn a_side_output_that_fails_does_not_swallow_the_report() {
    let folder = Folder::new();
    let (csv, plot) = (folder.path("full.csv"), folder.path("plot.svg"));
    link("/dev/full", &csv);
    let args = ["diff", "--rays", "100", "--csv", text(&csv), "--plot"];
    let run = BAKE.run(&[&args[..], &[text(&plot)]].concat());
    assert_eq!(run.code, 2, "{run:?}");
    assert!(run.stdout.contains("table - closed form"), "{run:?}");
    assert!(run.stderr.contains(text(&csv)), "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
    assert!(plot.exists(), "the other output is written all the same");
    // A report that fails does not swallow an output either.
    let (csv, mut command) = (folder.path("d.csv"), BAKE.command());
    command.args(["diff", "--rays", "100", "--csv", text(&csv)]);
    let status = command.stdout(full_device()).status().unwrap();
    assert_eq!(status.code(), Some(2));
    assert_eq!(lines_of(&csv), LINES);
}

#[test]
fn query_answers_each_line_as_it_comes() {
    let mut command = BAKE.command();
    command.arg("query");
    let mut child = Spawned::start_interactive(command);
    for (question, answer) in [
        ("10 30\n", "5.161830"),
        ("inf 3\n", "1.719388"),
        ("10 1\n", "captured"),
        ("# a comment\n\n10 150\n", "2.904501"),
    ] {
        child.stdin().write_all(question.as_bytes()).unwrap();
        child.stdin().flush().unwrap();
        let line = child.line_within_a_minute();
        assert!(line.starts_with(answer), "{question:?}: {line:?}");
    }
    child.close_stdin();
    assert_eq!(child.ends(), 0);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = Folder::new();
    let table = folder.atlas("table.lbt");
    let questions = "10 30\n".repeat(100_000);
    for (args, input) in [
        (vec!["query"], questions.as_str()),
        (vec!["diff", "--rays", "100"], ""),
        (vec!["inspect", text(&table)], ""),
        (vec!["--texels", "8", "-o", "-"], ""),
    ] {
        let mut command = BAKE.command();
        command.args(&args);
        let mut child = Spawned::start(command, input);
        child.close_stdout();
        let run = child.run_within_a_minute();
        assert_eq!(run.code, 0, "{args:?}: {run:?}");
        assert!(!run.stderr.contains("panicked"), "{args:?}: {run:?}");
    }
}

#[test]
fn an_endless_line_is_refused_in_a_short_one() {
    for line in [
        "x".repeat(5_000_000),
        "x".repeat(300),
        "1 ".repeat(2_000_000),
    ] {
        let run = BAKE.run_with(&["query"], &line);
        assert!(run.stderr.len() < 200, "{} bytes", run.stderr.len());
        run.refuses(&["standard input, line 1"]);
    }
    let run = BAKE.run_with_bytes(&["query"], b"10 30\n\xff\xfe 3\n");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("line 2"), "{run:?}");
}

#[test]
fn an_endless_file_does_not_fill_the_memory() {
    for args in [
        "inspect /dev/zero",
        "query --table /dev/zero",
        "convert /dev/zero a.lbt",
    ] {
        // A limit on memory, in KiB, so that a failure does not exhaust the machine's.
        let script = format!("ulimit -v 4000000; exec \"$0\" {args}");
        let mut command = Command::new("sh");
        command.args(["-c", &script, BAKE.path()]);
        Spawned::start(command, "")
            .run_within_a_minute()
            .refuses(&["/dev/zero", "no bending table is larger"]);
    }
}

#[test]
fn a_table_is_read_from_a_pipe() {
    let mut child = BAKE
        .command()
        .args(["inspect", "/dev/stdin"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(ATLAS).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    assert!(
        String::from_utf8(output.stdout)
            .unwrap()
            .contains("residual")
    );
}

#[test]
fn an_interruption_leaves_the_old_file_or_the_new_one() {
    let folder = Folder::new();
    let file = folder.path("table.lbt");
    let bake = |texels: &str| {
        let mut command = BAKE.command();
        command.args(["--texels", texels, "-o", text(&file)]);
        command.stderr(Stdio::null());
        command
    };
    assert!(bake("16").status().unwrap().success());
    let old = fs::read(&file).unwrap();
    let uninterrupted = folder.path("uninterrupted.lbt");
    BAKE.run(&["--texels", "512", "-o", text(&uninterrupted)])
        .succeeds();
    let new = fs::read(&uninterrupted).unwrap();
    for delay in 0..40 {
        fs::write(&file, &old).unwrap();
        let mut child = bake("512").spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(10 * delay));
        child.kill().unwrap();
        child.wait().unwrap();
        let left = fs::read(&file).unwrap();
        assert!(left == old || left == new, "after {} ms", 10 * delay);
    }
}
