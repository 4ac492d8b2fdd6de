//! Flags and environment variables that the program cannot use: one line says which, and what to do.

use lensbake_test_support::{Program, one_row_of};
use std::path::Path;
use std::process::Command;

const VIEWER: Program = Program::at(env!("CARGO_BIN_EXE_viewer"));

/// The window's flags are checked before there is a window: these need no screen.
#[test]
fn invalid_views_are_refused_by_the_name_of_their_flag() {
    let cases: &[(&[&str], &[&str])] = &[
        (&["-r", "nan"], &["--radius", "NaN"]),
        (&["-r", "1"], &["--radius", "greater than 1"]),
        (&["-r", "inf"], &["--radius", "at most"]),
        (&["-r", "2e6"], &["--radius", "at most"]),
        (&["--fov", "nan"], &["--fov", "NaN"]),
        (&["--fov", "180"], &["--fov", "between 0 and 180"]),
        (&["--yaw", "nan"], &["--yaw", "NaN"]),
        (&["--pitch", "inf"], &["--pitch", "inf"]),
        (&["--roll", "nan"], &["--roll", "NaN"]),
        (&["--orbit", "nan"], &["--orbit", "NaN"]),
        (&["--latitude=-inf"], &["--latitude", "inf"]),
        (&["--size", "0x0"], &["--size", "0x0", "1x1"]),
        (
            &["--size", "99999x99999"],
            &["--size", "99999x99999", "16384"],
        ),
        (&["--step", "nan"], &["--step", "NaN"]),
    ];
    for (args, words) in cases {
        VIEWER.run(args).refuses(words);
        let render = [
            &[
                "render",
                "-d",
                "cpu",
                "-o",
                "never.png",
                "--method",
                "direct",
            ],
            *args,
        ];
        VIEWER.run(&render.concat()).refuses(words);
        assert!(!Path::new("never.png").exists());
    }
}

#[test]
fn the_cpu_is_not_asked_for_what_only_a_gpu_has() {
    let render = ["render", "-o", "never.png", "-d", "cpu"];
    let refused = |more: &[&str], words: &[&str]| {
        VIEWER.run(&[&render, more].concat()).refuses(words);
        assert!(!Path::new("never.png").exists());
    };
    let anisotropic = ["--sampling", "anisotropic"];
    refused(
        &anisotropic,
        &["--sampling anisotropic", "--sampling filtered"],
    );
    refused(&["--pass", "fragment"], &["--pass fragment", "GPU"]);
    refused(&["--pass", "compute"], &["--pass compute", "GPU"]);
    // Without a GPU, and in a field of view that is too narrow for one.
    let auto = [
        "render",
        "-o",
        "never.png",
        "--size",
        "64x36",
        "--fov",
        "1e-5",
        "-r",
        "1e6",
    ];
    let run = Command::new(env!("CARGO_BIN_EXE_viewer"))
        .args([&auto[..], &anisotropic].concat())
        .output()
        .unwrap();
    let stderr = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("--sampling filtered"), "{stderr}");
    assert!(!Path::new("never.png").exists());
}

/// Runs the viewer with WGPU_BACKEND set; returns its exit code and standard error.
fn with_backend(backend: &str, args: &[&str]) -> (Option<i32>, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_viewer"))
        .args(args)
        .env("WGPU_BACKEND", backend)
        .output()
        .unwrap();
    let stderr = String::from_utf8(run.stderr).unwrap();
    (run.status.code(), stderr)
}

#[test]
fn an_unknown_backend_is_named_with_those_that_are_known() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    let out = out.to_str().unwrap();
    let draw = ["render", "--size", "16x9", "-s", "grid", "-o", out, "-d"];
    // An unknown backend; one of another platform; a list of a valid and an unknown one.
    let other = if cfg!(target_os = "macos") {
        "dx12"
    } else {
        "metal"
    };
    for backend in ["foo", other, "vulkan,foo"] {
        let ways: [&[&str]; 4] = [
            &[],
            &[&draw[..], &["gpu"]].concat(),
            &[&draw[..], &["auto"]].concat(),
            &["bench"],
        ];
        for args in ways {
            let (code, stderr) = with_backend(backend, args);
            assert_eq!(code, Some(2), "{args:?}: {stderr}");
            assert_eq!(stderr.lines().count(), 1, "{args:?}: {stderr}");
            let mut words = vec!["WGPU_BACKEND", backend];
            words.extend(cfg!(target_os = "linux").then_some("vulkan"));
            for word in words {
                assert!(stderr.contains(word), "no {word} in: {stderr}");
            }
            assert!(!stderr.contains("install"), "{stderr}");
        }
        // Drawing on the CPU needs no backend.
        let (code, stderr) = with_backend(backend, &[&draw[..], &["cpu"]].concat());
        assert_eq!(code, Some(0), "{stderr}");
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn an_empty_backend_counts_as_unset() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    let draw = ["render", "--size", "16x9", "-s", "grid", "-d", "gpu", "-o"];
    let (code, stderr) = with_backend("", &[&draw[..], &[out.to_str().unwrap()]].concat());
    assert_eq!(code, Some(0), "{stderr}");
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn tables_of_any_length_are_drawn_with_on_a_gpu() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    for texels in [8192, 8193, 65_536] {
        let table = file("long.lbt");
        lensbake_test_support::write_table(&table, &one_row_of(4.0, texels));
        let draw = |device: &str, name: &str| {
            let (table, out) = (table.to_str().unwrap(), file(name));
            let args = [
                "render",
                "--size",
                "160x90",
                "-s",
                "grid",
                "-r",
                "4",
                "-t",
                table,
                "-d",
                device,
                "-o",
                out.to_str().unwrap(),
            ];
            VIEWER.run(&args).succeeds();
            image::open(out).unwrap().into_rgb8()
        };
        let (gpu, cpu) = (draw("gpu", "gpu.png"), draw("cpu", "cpu.png"));
        let pairs = gpu.iter().zip(cpu.iter());
        let largest = pairs.map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(largest <= 2, "{texels} texels: {largest} of 255");
    }
}
