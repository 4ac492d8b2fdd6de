//! The shipped atlas against the closed form, against the direct integrator, and against itself.

use lensbake_core::{Motion, Observer, Ray, ShadowCoordinate, exact};
use lensbake_studies::table_error::{Picture, diff};
use lensbake_tables::baking::{ObservedRay, random, random_in_motion};
use lensbake_tables::baking::{Recipe, bake};
use lensbake_tables::baking::{lookup_errors, measured};
use lensbake_tables::lookup::GpuRow;
use lensbake_tables::{ATLAS_BINARY, ATLAS_EXR, Axis, Rows, Table, container, default_atlas};

/// Error of the shipped atlas that README and docs promise, rad.
const PROMISE: f64 = 1e-7;

#[test]
fn a_million_random_lookups_keep_the_promise() {
    let atlas = default_atlas();
    let rays = random(atlas.header(), 1_000_000, 20_220_501);
    let errors = lookup_errors(atlas, &rays).unwrap();
    assert_eq!(errors.len(), 1_000_000);
    for (error, ray) in errors.iter().zip(&rays) {
        assert!(error.abs() <= PROMISE, "{error:e} at {ray:?}");
    }
    let largest = errors.iter().fold(0.0_f64, |a, e| a.max(e.abs()));
    let stated = atlas.header().measured.max_error;
    assert!(
        largest > 0.5 * stated && largest < 1.5 * stated,
        "{largest:e}, stated {stated:e}"
    );
}

/// For the observer in free fall: 2e-6 rad down to r = 0.1, 3e-5 rad below, and above the horizon as at rest.
#[test]
fn a_million_random_lookups_of_the_falling_observer_keep_the_promise() {
    let atlas = default_atlas();
    let rays = random_in_motion(atlas.header(), Motion::Fall, 1_000_000, 20_261_126).unwrap();
    let rays: Vec<ObservedRay> = rays.into_iter().map(|ray| ray.observed).collect();
    let errors = lookup_errors(atlas, &rays).unwrap();
    let mut largest = [0.0_f64; 3];
    for (error, ray) in errors.iter().zip(&rays) {
        let (range, promise) = match ray.observer.radius() {
            r if r > 1.0 => (0, PROMISE),
            r if r >= 0.1 => (1, 2e-6),
            _ => (2, 3e-5),
        };
        assert!(error.abs() <= promise, "{error:e} at {ray:?}");
        largest[range] = largest[range].max(error.abs());
    }
    println!("largest errors: {largest:?}");
    let stated = atlas.header().measured_below.unwrap().max_error;
    assert!(
        largest[2] > 0.5 * stated && largest[2] < 1.5 * stated,
        "{largest:?}, stated {stated:e}"
    );
}

#[test]
fn lookup_and_direct_integration_agree() {
    let atlas = default_atlas();
    let rays = random(atlas.header(), 20_000, 7);
    let picture = Picture {
        width: 1920,
        field_of_view: std::f64::consts::FRAC_PI_2,
    };
    let diff = diff(atlas, &rays, 1e-11, || ()).unwrap();
    let statistics = diff
        .statistics(&picture, |ray| ray.lookup - ray.direct)
        .unwrap();
    assert!(statistics.radians.max < PROMISE, "{statistics:?}");
    assert!(statistics.pixels.unwrap().max < 1e-4, "{statistics:?}");
}

#[test]
fn the_first_row_is_the_bending_from_infinity() {
    let row = default_atlas().row(Observer::at_infinity()).unwrap();
    for b in [2.5981, 2.6, 3.0, 10.0, 1e3, 1e6] {
        let closed = exact::bend(&Ray::from_infinity(b).unwrap())
            .escaped()
            .unwrap();
        let looked_up = row.bend(ShadowCoordinate::from_b(b)).escaped().unwrap();
        assert!((looked_up - closed).abs() < PROMISE, "b {b}");
    }
}

#[test]
fn the_f32_lookup_is_good_away_from_the_edge() {
    let atlas = default_atlas();
    let mut compared = 0;
    for ray in random(atlas.header(), 20_000, 3) {
        let observer = ray.observer;
        if ray.at.one_minus_x < 0.05 || observer.radius() > 100.0 {
            continue;
        }
        let row = GpuRow::new(&atlas.row(observer).unwrap());
        let (sin, cos) = observer.view_angle(ray.at.x).sin_cos();
        let bend = row.bending(cos as f32, sin as f32).escaped().unwrap().bend;
        let closed = exact::bend(&observer.ray_at(ray.at)).escaped().unwrap();
        assert!((f64::from(bend) - closed).abs() < 2e-5, "{ray:?}");
        compared += 1;
    }
    assert!(compared > 5_000, "{compared}");
}

#[test]
fn both_shipped_files_hold_the_same_table_in_96_kib() {
    let binary = container::from_bytes(ATLAS_BINARY).unwrap();
    let exr = container::from_bytes(ATLAS_EXR).unwrap();
    assert_eq!(binary, exr);
    assert_eq!(binary.bytes(), 96 * 1024);
    for (file, bytes) in [("atlas.lbt", ATLAS_BINARY), ("atlas.exr", ATLAS_EXR)] {
        let path = lensbake_test_support::workspace()
            .join("tables/assets")
            .join(file);
        assert_eq!(std::fs::read(path).unwrap(), bytes, "{file}");
    }
}

#[test]
fn the_shipped_atlas_is_what_bake_writes() {
    let recipe = Recipe::default();
    let fresh = measured(bake(&recipe, || ()).unwrap()).unwrap();
    let shipped = default_atlas();
    // Another machine's mathematics library may round the last bit differently.
    for (a, b) in fresh.texels().iter().zip(shipped.texels()) {
        assert!(
            (a[0] - b[0]).abs() <= 2.5e-7 && (a[1] - b[1]).abs() <= 2.5e-7,
            "{a:?} {b:?}"
        );
    }
    let error = |table: &Table| table.header().measured.max_error;
    assert!((error(&fresh) / error(shipped) - 1.0).abs() < 0.1);
    let shape = |table: &Table| {
        let header = table.header().clone();
        (header.axis, header.rows, header.texels, header.solver)
    };
    assert_eq!(shape(&fresh), shape(shipped));
}

#[test]
fn fewer_texels_are_worse_and_the_header_says_so() {
    let error = |texels| {
        let recipe = Recipe {
            texels,
            ..Recipe::default()
        };
        let table = measured(bake(&recipe, || ()).unwrap()).unwrap();
        table.header().measured.max_error
    };
    let (coarse, fine) = (error(16), error(32));
    assert!(coarse > 1e-6 && coarse < 1e-5, "{coarse:e}");
    assert!(fine < 0.2 * coarse, "{fine:e}");
}

#[test]
fn naive_axes_are_as_bad_as_their_reputation() {
    let far = Rows::One {
        inverse_radius: 0.0,
    };
    let (b_min, b_max) = (2.5981, 100.0);
    let error = |axis| {
        let recipe = Recipe {
            axis,
            rows: far,
            texels: 1024,
            tolerance: 1e-9,
        };
        let table = measured(bake(&recipe, || ()).unwrap()).unwrap();
        table.header().measured.max_error
    };
    let uniform = error(Axis::UniformB { b_min, b_max });
    assert!(uniform > 0.1, "uniform in b: {uniform:e}");
    let inverse = error(Axis::UniformInverseB { b_min, b_max });
    assert!(inverse > 0.1, "uniform in 1/b: {inverse:e}");
    let logarithmic = error(Axis::UniformLogB { b_min, b_max });
    assert!(
        logarithmic < 1e-4,
        "uniform in ln(b/b_c - 1): {logarithmic:e}"
    );
}
