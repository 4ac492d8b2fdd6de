//! The layers of a disc against where rays cross it by the closed form.

use super::{HEIGHT, WIDTH, channels_of, lens, shift_by_hand, view, views};
use crate::camera::{Projection, View};
use crate::disc::{Disc, Orientation};
use crate::layers::{Layer, trace};
use crate::lens::Lens;
use crate::scene::Sampling;
use glam::DVec3;
use lensbake_core::disc_crossing::{Crossing, TracedRay};
use lensbake_core::{Motion, ThinDisc};

const INCLINATION_DEG: f64 = 75.0;
const NODE_DEG: f64 = 20.0;

/// The layers of the disc, which are in this order in the tests.
const LAYERS: [Layer; 4] = [
    Layer::DiscRadius,
    Layer::DiscOrder,
    Layer::DiscShift,
    Layer::DiscAlpha,
];

/// A disc of which half the light behind passes, inclined to the line of sight of `view`.
fn disc(view: &View) -> Disc {
    Disc {
        orientation: Orientation {
            inclination_deg: INCLINATION_DEG,
            node_deg: NODE_DEG,
            seen_from_deg: [view.orbit_deg, view.latitude_deg],
        },
        opacity: 0.5,
        ..Disc::default()
    }
}

/// The views of the other layers, and others that show the whole sky.
fn all_views() -> Vec<View> {
    let projected = |projection, height| View {
        projection,
        height,
        fov_deg: 180.0,
        ..view(10.0, Motion::Orbit, 0.0)
    };
    let mut all = views();
    all.push(projected(Projection::Equirectangular, WIDTH / 2));
    all.push(projected(Projection::Fisheye, WIDTH));
    all
}

/// The crossings of the ray with the unit view `direction`, the nearest first.
fn exact(lens: &Lens, view: &View, direction: DVec3) -> Vec<Crossing> {
    let disc = Disc::default();
    let thin = ThinDisc::new(disc.inner, disc.outer, INCLINATION_DEG, NODE_DEG).unwrap();
    let observer = &lens.camera.observer;
    let (seen, _) = lens.camera.unboosted(direction);
    let theta = seen.truncate().length().atan2(-seen.z);
    let azimuth = seen.y.atan2(seen.x);
    let at = observer.shadow_coordinate(theta);
    let ray = TracedRay::in_closed_form(&thin, observer, at, azimuth);
    let shift = shift_by_hand(view, &lens.camera, direction);
    thin.crossings(&TracedRay { shift, ..ray }).collect()
}

/// Largest relative difference. Deep inside the horizon rays come to the outer rim almost along the disc.
fn allowed(view: &View) -> f64 {
    if view.radius < 0.2 { 1e-4 } else { 1e-5 }
}

#[test]
fn the_layers_of_a_disc_are_those_of_the_nearest_crossing() {
    let (mut compared, mut secondary, mut twice, mut worst) = (0, 0, 0, 0.0_f64);
    for view in all_views() {
        let lens = lens(&view);
        let layers = channels_of(&lens, &LAYERS, Some(disc(&view)));
        let [radius, order, shift, alpha] = &layers[..] else {
            panic!("four channels")
        };
        for index in 0..lens.camera.pixels() {
            let (column, row) = (index as u32 % WIDTH, index as u32 / WIDTH);
            let covered = lens.camera.coverage(column, row);
            let found = [radius, order, shift, alpha].map(|channel| f64::from(channel[index]));
            if covered == 0.0 {
                assert_eq!(found, [0.0; 4]);
                continue;
            }
            let known = exact(&lens, &view, lens.camera.direction(column, row));
            let what = format!("{view:?}, pixel {index}: {found:?} for {known:?}");
            let through = 0.5_f64.powi(known.len() as i32);
            assert!(
                (found[3] - covered * (1.0 - through)).abs() < 1e-6,
                "{what}"
            );
            let Some(nearest) = known.first() else {
                assert_eq!(found, [0.0; 4], "{what}");
                continue;
            };
            let off = (found[0] / nearest.radius - 1.0)
                .abs()
                .max((found[2] / nearest.shift - 1.0).abs());
            worst = worst.max(off);
            assert!(off < allowed(&view), "{what}");
            assert_eq!(found[1], f64::from(nearest.order), "{what}");
            compared += 1;
            secondary += usize::from(nearest.order > 0);
            twice += usize::from(known.len() > 1);
        }
    }
    println!(
        "disc: {worst:.1e} over {compared} pixels, {secondary} of a secondary image, {twice} with two crossings"
    );
    assert!(
        compared > 20_000 && secondary > 300 && twice > 100,
        "{compared} {secondary} {twice}"
    );
}

/// The mean over a picture does not depend on its sampling, and the shares of pixels at a rim are neither 0 nor whole.
#[test]
fn the_alpha_of_a_disc_is_antialiased_where_the_picture_is() {
    let coarse = View {
        yaw_deg: 0.0,
        ..view(20.0, Motion::Rest, 0.0)
    };
    let fine = View {
        width: 8 * WIDTH,
        height: 8 * HEIGHT,
        ..coarse
    };
    let alpha = |view: &View, sampling| -> Vec<f32> {
        let disc = Disc {
            opacity: 1.0,
            ..disc(view)
        };
        trace(
            &lens(view),
            &[Layer::DiscAlpha],
            sampling,
            Some(disc),
            || (),
        )
        .remove(0)
        .samples
    };
    let mean = |of: &[f32]| of.iter().map(|&share| f64::from(share)).sum::<f64>() / of.len() as f64;
    let filtered = alpha(&coarse, Sampling::Filtered);
    let (found, known) = (mean(&filtered), mean(&alpha(&fine, Sampling::Single)));
    println!("alpha: {found} for {known}");
    assert!((found / known - 1.0).abs() < 5e-3, "{found} {known}");
    let partial = filtered
        .iter()
        .filter(|&&share| share > 0.01 && share < 0.99);
    assert!(partial.count() > 100);
}

/// The layers of the sky are the same behind a disc, and those of a disc 0 without one.
#[test]
fn the_layers_of_the_sky_do_not_depend_on_a_disc() {
    let view = view(10.0, Motion::Rest, 0.0);
    let lens = lens(&view);
    let with = channels_of(&lens, &Layer::ALL, Some(disc(&view)));
    let without = channels_of(&lens, &Layer::ALL, None);
    let of_sky = with.len() - LAYERS.len();
    assert!(with[..of_sky] == without[..of_sky]);
    assert!(
        without[of_sky..]
            .iter()
            .flatten()
            .all(|&value| value == 0.0)
    );
    assert!(
        with[of_sky..]
            .iter()
            .all(|channel| channel.iter().any(|&value| value != 0.0))
    );
}
