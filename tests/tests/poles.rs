//! The rays on the axis through hole and camera, where sin θ is 0: on both devices and by every method.

use glam::{DMat3, Vec3};
use lensbake_render::camera::{Camera, View};
use lensbake_render::cpu;
use lensbake_render::filter::FilteredPixels;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::picture::Picture;
use lensbake_render::scene::{Sampling, Scene};
use lensbake_render::shift::Rendition;
use lensbake_render::sky::{Sky, grid};
use lensbake_tables::default_atlas;
use lensbake_tests::{on_gpu, renderer};
use std::sync::Arc;

const METHODS: [Deflection; 4] = [
    Deflection::Lut,
    Deflection::Direct { step: 0.05 },
    Deflection::Direct { step: 0.5 },
    Deflection::Flat,
];

/// Views with a pixel that looks straight away from the hole, as nearly as angles in degrees permit.
fn views() -> Vec<View> {
    let away = |radius, yaw_deg, pitch_deg, roll_deg, fov_deg, (width, height)| View {
        radius,
        yaw_deg,
        pitch_deg,
        roll_deg,
        fov_deg,
        width,
        height,
        ..View::default()
    };
    let mut views = Vec::new();
    for radius in [1.0001, 1.2, 1.5, 3.0, 25.0, 1e3, 1e6] {
        views.push(away(radius, 180.0, 0.0, 0.0, 90.0, (161, 91)));
        views.push(away(radius, 0.0, 180.0, 17.0, 90.0, (33, 33)));
        views.push(away(radius, 180.0 + 1e-9, 1e-10, 0.0, 90.0, (33, 33)));
        views.push(away(radius, -180.0, 1e-4, 0.0, 10.0, (33, 33)));
        views.push(away(radius, 180.0, 0.0, 30.0, 1.0, (64, 64)));
    }
    views
}

/// A sky that changes slowly and everywhere.
fn smooth_sky() -> Sky {
    Sky::from_fn(256, |direction| 0.5 + 0.4 * direction)
}

/// Draws every view by every method and sampling and hands each picture to `check`.
fn draw_all(
    sky: &Arc<Sky>,
    draw: impl Fn(&Scene) -> Picture,
    check: impl Fn(&Scene, &Picture),
) -> usize {
    let mut drawn = 0;
    for view in views() {
        let camera = Camera::new(&view).unwrap();
        for method in METHODS {
            let lens = Lens::new(camera, default_atlas(), method).unwrap();
            for sampling in [Sampling::Single, Sampling::Filtered] {
                let scene = Scene::new(lens.clone(), sky.clone()).with_sampling(sampling);
                check(&scene, &draw(&scene));
                drawn += 1;
            }
        }
    }
    drawn
}

fn at(scene: &Scene) -> String {
    format!(
        "r {}, {} x {}, {:?}, {:?}",
        scene.lens.camera.observer.radius(),
        scene.lens.camera.width,
        scene.lens.camera.height,
        scene.lens.deflection,
        scene.sampling
    )
}

/// The pixel in the middle of an odd-sized picture, and the mean of the eight about it.
fn middle_and_neighbours(picture: &Picture) -> Option<(Vec3, Vec3)> {
    let (width, height) = (picture.width(), picture.height());
    if width.is_multiple_of(2) || height.is_multiple_of(2) {
        return None;
    }
    let pixel = |x: u32, y: u32| Vec3::from(picture.pixels()[(y * width + x) as usize]);
    let (x, y) = (width / 2, height / 2);
    let mut sum = -pixel(x, y);
    for (right, down) in (0..3).flat_map(|r| (0..3).map(move |d| (r, d))) {
        sum += pixel(x + right - 1, y + down - 1);
    }
    Some((pixel(x, y), sum / 8.0))
}

fn check_smooth(scene: &Scene, picture: &Picture) {
    assert_eq!(picture.without_value(), None, "{}", at(scene));
    for pixel in picture.pixels() {
        assert!(pixel.iter().all(|c| c.is_finite()), "{}", at(scene));
    }
    // If the visible sky is only some pixels wide, the middle pixel sees more than what is straight away.
    let window = std::f64::consts::PI - scene.lens.camera.observer.shadow_angle();
    if window < 20.0 * scene.lens.camera.right.length() {
        return;
    }
    if let Some((middle, about)) = middle_and_neighbours(picture) {
        let off = (middle - about).abs().max_element();
        assert!(off < 4e-3, "{}: {middle} among {about}", at(scene));
        let away = Vec3::new(0.5, 0.5, 0.9);
        let off = (middle - away).abs().max_element();
        assert!(off < 5e-3, "{}: {middle} for {away}", at(scene));
    }
}

/// The pixel straight away from the hole is like the same pixel of a camera turned by `HAIR`, drawn on the CPU.
fn check_grid(scene: &Scene, picture: &Picture) {
    const HAIR: f64 = 1e-5;
    let camera = &scene.lens.camera;
    if camera.width.is_multiple_of(2) || camera.observer.shadow_angle() > 2.0 {
        return;
    }
    let turned = DMat3::from_rotation_y(HAIR);
    let beside = Lens {
        camera: Camera {
            right: turned * camera.right,
            down: turned * camera.down,
            forward: turned * camera.forward,
            ..*camera
        },
        ..scene.lens.clone()
    };
    let (x, y) = (camera.width / 2, camera.height / 2);
    let expected = match scene.sampling {
        Sampling::Single => {
            let light = beside.ray(beside.camera.direction(x, y));
            let direction = camera.sky_from_hole * light.escaped().unwrap().direction;
            scene.sky.sample(direction.as_vec3())
        }
        Sampling::Filtered | Sampling::Anisotropic => {
            FilteredPixels::new(&beside, Rendition::default())
                .light(&scene.sky, x, y)
                .truncate()
        }
    };
    let middle = Vec3::from(picture.pixels()[(y * picture.width() + x) as usize]);
    let off = (middle - expected).abs().max_element();
    assert!(off < 0.01, "{}: {middle} for {expected}", at(scene));
}

type Check = fn(&Scene, &Picture);

fn skies() -> [(Arc<Sky>, Check); 2] {
    [
        (smooth_sky().into(), check_smooth),
        (grid(1024).into(), check_grid),
    ]
}

#[test]
fn straight_away_the_cpu_draws_what_is_there() {
    for (sky, check) in skies() {
        let drawn = draw_all(&sky, |scene| cpu::render(scene, || ()), check);
        assert_eq!(drawn, 280);
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn straight_away_the_gpu_draws_what_is_there() {
    let renderer = renderer();
    for (sky, check) in skies() {
        let drawn = draw_all(&sky, |scene| on_gpu(&renderer, scene), check);
        assert_eq!(drawn, 280);
    }
}

/// Pixels whose light cannot be computed are counted and black, and the first is named.
#[test]
fn a_picture_holds_no_nan() {
    let nan = f32::NAN;
    let pixels = vec![[0.1, 0.2, 0.3], [nan, 0.0, 0.0], [0.0, f32::INFINITY, 1.0]];
    let picture = Picture::new(3, 1, pixels);
    let lost = picture.without_value().unwrap();
    assert_eq!((lost.count, lost.first), (2, (1, 0)));
    assert_eq!(picture.pixels()[0], [0.1, 0.2, 0.3]);
    assert_eq!(picture.pixels()[1..], [[0.0; 3]; 2]);
    assert_eq!(Picture::new(1, 1, vec![[1.0; 3]]).without_value(), None);
}
