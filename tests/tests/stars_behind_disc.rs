//! Point stars behind a disc: it takes its share of their light, whatever adds the stars to the picture.

use glam::Vec3;
use lensbake_render::camera::{Projection, View};
use lensbake_render::cpu;
use lensbake_render::disc::{Disc, Orientation, SeenDisc};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::Rendition;
use lensbake_render::stars::{PointStar, StarField};
use lensbake_tests::{lens, on_gpu, renderer, stars};

const HEIGHT: u32 = 128;

/// A disc without light of its own, seen face-on.
fn dark_disc(opacity: f64) -> Disc {
    Disc {
        orientation: Orientation {
            inclination_deg: 0.0,
            ..Disc::default().orientation
        },
        opacity,
        brightness: 0.0,
        ..Disc::default()
    }
}

/// Views of the hole: the stars of the first are drawn by the device, those of the others on the CPU.
fn views() -> impl Iterator<Item = View> {
    let projections = [
        (Projection::Perspective, HEIGHT, 60.0),
        (Projection::Equirectangular, 2 * HEIGHT, 60.0),
        (Projection::Fisheye, HEIGHT, 180.0),
    ];
    projections
        .into_iter()
        .map(|(projection, width, fov_deg)| View {
            radius: 25.0,
            projection,
            fov_deg,
            width,
            height: HEIGHT,
            ..View::default()
        })
}

/// Columns to the right of the hole, in the middle row: one in the middle of the disc's direct image, one well outside.
fn behind_and_beside(lens: &Lens) -> [u32; 2] {
    let seen = SeenDisc::new(lens, dark_disc(1.0), Rendition::default());
    let width = lens.camera.width;
    let radius = |column: &u32| {
        let hit = seen.nearest_hit(lens.camera.direction(*column, HEIGHT / 2));
        hit.filter(|hit| hit.order == 0).map(|hit| hit.radius)
    };
    let mut to_the_right = width / 2..width;
    let behind = to_the_right.find(|column| radius(column).is_some_and(|radius| radius > 7.0));
    let rim = to_the_right.find(|column| radius(column).is_none());
    [behind.unwrap(), rim.unwrap() + 5]
}

/// The stars that are seen in the middle of the pixels in these columns of the middle row, each as bright as a white pixel.
fn stars_seen_in(lens: &Lens, columns: &[u32]) -> StarField {
    let star = |column: &u32| {
        let ray = lens.ray(lens.camera.direction(*column, HEIGHT / 2));
        let ray = ray.escaped().unwrap();
        PointStar {
            direction: lens.camera.sky_from_hole * ray.direction,
            light: Vec3::splat(ray.jacobian.magnification().abs().recip() as f32),
        }
    };
    StarField {
        stars: columns.iter().map(star).collect(),
        disc_radius: 1e-8,
    }
}

fn check(draw: impl Fn(&Scene) -> Picture) {
    for view in views() {
        let lens = lens(&view, Deflection::Lut);
        let columns = behind_and_beside(&lens);
        let field = stars_seen_in(&lens, &columns);
        for sampling in [Sampling::Single, Sampling::Filtered] {
            let scene = stars::scene(&lens, &field).with_sampling(sampling);
            let seen = |scene: &Scene| {
                let picture = draw(scene);
                let row = (HEIGHT / 2 * view.width) as usize;
                columns.map(|column| picture.pixels()[row + column as usize][1])
            };
            let bare = seen(&scene);
            assert!(bare.iter().all(|&light| light > 0.1), "{view:?}: {bare:?}");
            for opacity in [1.0, 0.5, 0.0] {
                let [behind, beside] = seen(&scene.clone().with_disc(dark_disc(opacity)));
                let what =
                    format!("{view:?}, {sampling:?}, {opacity}: {behind} and {beside} of {bare:?}");
                let expected = (1.0 - opacity as f32) * bare[0];
                assert!((behind - expected).abs() < 1e-3 * bare[0], "{what}");
                assert!((beside / bare[1] - 1.0).abs() < 1e-3, "{what}");
            }
        }
    }
}

#[test]
fn on_the_cpu_a_disc_takes_its_share_of_a_star() {
    check(|scene| cpu::render(scene, || ()));
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn on_the_gpu_a_disc_takes_its_share_of_a_star() {
    let renderer = renderer();
    check(|scene| on_gpu(&renderer, scene));
}
