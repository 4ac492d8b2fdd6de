//! The rays on the axis through hole and camera, where sin θ is 0: on both devices and by every method.

use glam::{DMat3, Vec3};
use lensbake_tables::default_atlas;
use lensbake_tests::gpu;
use viewer::camera::{Camera, View};
use viewer::cpu;
use viewer::filtered::Pixels;
use viewer::gpu::{Gpu, Renderer};
use viewer::picture::Picture;
use viewer::scene::{Method, Sampling, Scene};
use viewer::sky::{Sky, grid};

const METHODS: [Method; 4] = [
    Method::Lut,
    Method::Direct { step: 0.05 },
    Method::Direct { step: 0.5 },
    Method::Flat,
];

/// Views with a pixel straight away from the hole, as near as angles in degrees come to it.
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
fn draw_all(draw: impl Fn(&Scene) -> Picture, check: impl Fn(&Scene, &Picture)) -> usize {
    let mut drawn = 0;
    for view in views() {
        let camera = Camera::new(&view).unwrap();
        for method in METHODS {
            let scene = Scene::new(camera, default_atlas(), method).unwrap();
            for sampling in [Sampling::Single, Sampling::Filtered] {
                let scene = scene.sampled(sampling);
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
        scene.camera.observer.radius(),
        scene.camera.width,
        scene.camera.height,
        scene.method,
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

fn check_smooth(_: &Sky, scene: &Scene, picture: &Picture) {
    assert_eq!(picture.without_value(), None, "{}", at(scene));
    for pixel in picture.pixels() {
        assert!(pixel.iter().all(|c| c.is_finite()), "{}", at(scene));
    }
    // Of a window of some pixels the middle sees more than what is straight away.
    let window = std::f64::consts::PI - scene.camera.observer.edge_angle();
    if window < 20.0 * scene.camera.right.length() {
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

/// A pixel straight away is like one that looks a hair beside, as the CPU draws that.
fn check_grid(sky: &Sky, scene: &Scene, picture: &Picture) {
    const HAIR: f64 = 1e-5;
    let camera = &scene.camera;
    if camera.width.is_multiple_of(2) || camera.observer.edge_angle() > 2.0 {
        return;
    }
    let turned = DMat3::from_rotation_y(HAIR);
    let beside = Scene {
        camera: Camera {
            right: turned * camera.right,
            down: turned * camera.down,
            forward: turned * camera.forward,
            ..*camera
        },
        ..scene.clone()
    };
    let (x, y) = (camera.width / 2, camera.height / 2);
    let expected = match scene.sampling {
        Sampling::Single => {
            let light = cpu::light_direction(&beside, beside.camera.direction(x, y));
            let direction = camera.sky_from_hole * light.escaped().unwrap();
            sky.sample(direction.as_vec3())
        }
        Sampling::Filtered => Pixels::new(&beside).light(sky, x, y).truncate(),
    };
    let middle = Vec3::from(picture.pixels()[(y * picture.width() + x) as usize]);
    let off = (middle - expected).abs().max_element();
    assert!(off < 0.01, "{}: {middle} for {expected}", at(scene));
}

type Check = fn(&Sky, &Scene, &Picture);

fn skies() -> [(Sky, Check); 2] {
    [(smooth_sky(), check_smooth), (grid(1024), check_grid)]
}

#[test]
fn straight_away_the_cpu_draws_what_is_there() {
    for (sky, check) in skies() {
        let draw = |scene: &Scene| cpu::render(scene, &sky, || ());
        let drawn = draw_all(draw, |scene, picture| check(&sky, scene, picture));
        assert_eq!(drawn, 280);
    }
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn straight_away_the_gpu_draws_what_is_there() {
    let gpu: Gpu = gpu();
    for (sky, check) in skies() {
        let renderer = Renderer::new(&gpu, &sky).unwrap();
        let draw = |scene: &Scene| renderer.picture(scene, |_| ()).unwrap();
        let drawn = draw_all(draw, |scene, picture| check(&sky, scene, picture));
        assert_eq!(drawn, 280);
    }
}

/// What integration can't find is counted and named, and is black.
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
