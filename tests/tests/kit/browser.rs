//! The texts in GLSL and WGSL, and the module for three.js, in Chromium; and the pages.

use super::rays::{Errors, RADII, Ray, rays, rows};
use super::{F32_BOUND, SIMPLE_BOUND, bytes_as, report};
use half::f16;
use lensbake_render::camera::View;
use lensbake_render::cpu;
use lensbake_render::lens::Deflection;
use lensbake_render::picture::PictureFormat;
use lensbake_render::scene::Scene;
use lensbake_render::sky::{self, SkySource};
use lensbake_test_support::{browser, workspace};
use lensbake_tests::lens;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use tempfile::TempDir;

/// Runs a script of tests/kit/browser with its arguments. Returns its line of JSON.
fn run(script: &str, arguments: &[&str]) -> Value {
    browser::run(
        env!("CARGO_TARGET_TMPDIR"),
        &["tests/browser", "tests/kit/browser"],
        Command::new("node"),
        script,
        arguments,
    )
}

/// A file in `folder` with these bytes.
fn file(folder: &TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    path
}

/// The texture of each observer's row, for the spans of its rays.
fn rows_of(folder: &TempDir, rays: &[Ray], with_data: bool) -> Value {
    let mut first = 0;
    let mut spans = Vec::new();
    for (i, (of_one, row)) in rays
        .chunk_by(|a, b| a.r == b.r)
        .zip(rows(&RADII).chunks(64))
        .enumerate()
    {
        let mut span = json!({ "r": of_one[0].r, "first": first, "count": of_one.len() });
        if with_data {
            span["data"] = json!(file(folder, &format!("row{i}"), bytemuck::cast_slice(row)));
        }
        first += of_one.len();
        spans.push(span);
    }
    json!(spans)
}

/// The value of each texel of a table of the kit.
fn values(table: &str) -> impl Iterator<Item = f32> {
    super::values_and_slopes(table).into_iter().step_by(2)
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn texts_give_the_directions_in_webgl_and_in_webgpu() {
    let folder = TempDir::new().unwrap();
    let (all, one) = (rays(&RADII), rays(&[10.0]));
    let [all_file, one_file] = [("all", &all), ("one", &one)]
        .map(|(name, rays)| file(&folder, name, bytemuck::cast_slice(rays)));
    let halves: Vec<f16> = values("tables/simple.exr").map(f16::from_f32).collect();
    let halves = file(&folder, "halves", bytemuck::cast_slice(&halves));
    // What a texture of 16-bit integers is read as; the software renderer has none.
    let unorm16: Vec<f32> = values("tables/simple.png").collect();
    let unorm16 = file(&folder, "unorm16", bytemuck::cast_slice(&unorm16));
    let row = json!({ "width": 64, "height": 1, "channels": 2, "type": "f32", "filter": "nearest",
        "rows": rows_of(&folder, &all, true), "rays": all_file, "call": "lensbake(d, hole, r, data)" });
    let array = json!({ "rays": one_file, "call": "lensbake_r10(d, hole)" });
    let simple = json!({ "width": 64, "height": 128, "channels": 1, "type": "f16", "filter": "linear",
        "data": halves, "rays": all_file, "call": "lensbake_simple(d, hole, r, data)" });
    let mut of_integers = simple.clone();
    of_integers["type"] = json!("f32");
    of_integers["data"] = json!(unorm16);
    of_integers["call"] = json!("lensbake_simple16(d, hole, r, data)");
    let mut simple_wgsl = simple.clone();
    simple_wgsl["call"] = json!("lensbake_simple(d, hole, r, data, data_sampler)");
    let mut three = row.clone();
    three["rows"] = rows_of(&folder, &all, false);
    let texts = [
        ("WebGL2, row", "glsl", "glsl/lensbake.glsl", &row, F32_BOUND),
        (
            "WebGL2, array",
            "glsl",
            "glsl/lensbake_r10.glsl",
            &array,
            F32_BOUND,
        ),
        (
            "WebGL2, simple",
            "glsl",
            "glsl/lensbake_simple.glsl",
            &simple,
            SIMPLE_BOUND,
        ),
        (
            "WebGL2, simple, integers",
            "glsl",
            "glsl/lensbake_simple16.glsl",
            &of_integers,
            SIMPLE_BOUND,
        ),
        (
            "three.js, row",
            "three",
            "three/lensbake.js",
            &three,
            F32_BOUND,
        ),
        ("WebGPU, row", "wgsl", "wgsl/lensbake.wgsl", &row, F32_BOUND),
        (
            "WebGPU, array",
            "wgsl",
            "wgsl/lensbake_r10.wgsl",
            &array,
            F32_BOUND,
        ),
        (
            "WebGPU, simple",
            "wgsl",
            "wgsl/lensbake_simple.wgsl",
            &simple_wgsl,
            SIMPLE_BOUND,
        ),
    ];
    let mut jobs = Vec::new();
    for (i, (name, kind, source, job, _)) in texts.iter().enumerate() {
        let mut job = (*job).clone();
        job["name"] = json!(name);
        job["kind"] = json!(kind);
        job["source"] = json!(workspace().join("kit").join(source));
        job["out"] = json!(folder.path().join(format!("out{i}")));
        jobs.push(job);
    }
    let list = file(&folder, "jobs.json", json!(jobs).to_string().as_bytes());
    let said = run("run.mjs", &[list.to_str().unwrap()]);
    println!(
        "{}, {}, WebGPU on {}",
        said["browser"], said["webgl"], said["webgpu"]
    );
    for (i, (name, kind, _, _, bound)) in texts.iter().enumerate() {
        let job = &said["jobs"][i];
        assert_eq!(job["status"], "ok", "{name}: {job}");
        let rays = if jobs[i]["rays"] == json!(one_file) {
            &one
        } else {
            &all
        };
        let out = fs::read(folder.path().join(format!("out{i}"))).unwrap();
        assert!(!kind.is_empty());
        report(name, Errors::of(rays, &bytes_as(&out)), *bound);
    }
}

/// A panorama that changes slowly and everywhere, below the light that the tone map compresses.
fn panorama(folder: &TempDir) -> PathBuf {
    let picture = image::RgbImage::from_fn(1024, 512, |x, y| {
        let (longitude, latitude) = (
            f64::from(x) / 1024.0 * std::f64::consts::TAU,
            f64::from(y) / 512.0,
        );
        let wave = |k: f64, phase: f64| {
            112.0 + 100.0 * (k * longitude + phase).sin() * (3.0 * latitude + phase).cos()
        };
        image::Rgb([wave(1.0, 0.0), wave(2.0, 1.0), wave(3.0, 2.0)].map(|light| light as u8))
    });
    let path = folder.path().join("panorama.png");
    picture.save(&path).unwrap();
    path
}

/// The view from r = 10 before `panorama`, one ray a pixel, as the viewer draws it.
fn viewer_picture(folder: &TempDir, panorama: &Path) -> PathBuf {
    let view = View {
        radius: 10.0,
        fov_deg: 90.0,
        width: 960,
        height: 540,
        ..View::default()
    };
    let sky = sky::load(&SkySource::Panorama(panorama.to_owned())).unwrap();
    let scene = Scene::new(lens(&view, Deflection::Lut), Arc::new(sky));
    let picture = cpu::render(&scene, || ());
    file(
        folder,
        "viewer.png",
        &picture.encode(PictureFormat::Png, 0.0).unwrap(),
    )
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn the_page_draws_what_the_viewer_draws() {
    let folder = TempDir::new().unwrap();
    let panorama = panorama(&folder);
    let viewer = viewer_picture(&folder, &panorama);
    let page = workspace().join("kit/three");
    let [page, panorama, viewer] = [&page, &panorama, &viewer].map(|path| path.to_str().unwrap());
    let said = run(
        "compare_page.mjs",
        &[page, panorama, viewer, "r=10&fov=90&mipmaps=0"],
    );
    println!("{said}");
    let number = |name: &str| {
        said[name]
            .as_f64()
            .unwrap_or_else(|| panic!("{name}: {said}"))
    };
    assert!(number("mean") < 0.2, "{said}");
    assert!(number("p999") <= 2.0, "{said}");
    assert_eq!(number("black"), 0.0, "{said}");
}

#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn the_page_answers_and_its_readme_and_the_text_for_shadertoy_draw() {
    let folder = TempDir::new().unwrap();
    let kit = workspace().join("kit");
    let [three, shadertoy] = ["three", "shadertoy/lensbake.glsl"].map(|name| kit.join(name));
    let [page, toy] = ["page.png", "toy.png"].map(|name| folder.path().join(name));
    println!(
        "{}",
        run(
            "page.mjs",
            &[
                three.to_str().unwrap(),
                page.to_str().unwrap(),
                "r=10&fov=90&sky=grid"
            ]
        )
    );
    println!("{}", run("readme.mjs", &[three.to_str().unwrap()]));
    println!(
        "{}",
        run(
            "shadertoy.mjs",
            &[shadertoy.to_str().unwrap(), toy.to_str().unwrap()]
        )
    );
    let drawn = image::open(toy).unwrap().into_rgb8();
    let kept = image::open(kit.join("shadertoy/picture.png"))
        .unwrap()
        .into_rgb8();
    let far = drawn
        .iter()
        .zip(kept.iter())
        .filter(|(a, b)| a.abs_diff(**b) > 8);
    let share = far.count() as f64 / drawn.len() as f64;
    assert!(
        drawn.dimensions() == kept.dimensions() && share < 1e-3,
        "{share}"
    );
}
