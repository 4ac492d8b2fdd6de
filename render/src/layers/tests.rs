//! The layers against the closed form, at rest and in motion, above the horizon and below it.

mod disc;

use super::*;
use crate::camera::View;
use crate::diff::{Reference, TraceStatistics};
use crate::lens::Deflection;
use lensbake_core::Motion;
use lensbake_tables::default_atlas;

const WIDTH: u32 = 160;
const HEIGHT: u32 = 90;

/// A view of a test.
fn view(radius: f64, motion: Motion, yaw_deg: f64) -> View {
    View {
        radius,
        motion,
        heading_deg: 20.0,
        orbit_deg: 30.0,
        latitude_deg: -40.0,
        yaw_deg,
        roll_deg: 10.0,
        width: WIDTH,
        height: HEIGHT,
        ..View::default()
    }
}

/// At rest from near the horizon to far away, in free fall down to r = 0.1, in orbit, and at high speed; then narrow
/// fields of view at the edge of the shadow, with several image orders in them.
fn views() -> Vec<View> {
    let fast = Motion::Velocity {
        radial: -0.2,
        tangential: 0.9,
    };
    let narrow = |radius: f64, motion, fov_deg| {
        let camera = Camera::new(&view(radius, motion, 0.0)).unwrap();
        let yaw_deg = camera.observer.shadow_angle().to_degrees();
        View {
            fov_deg,
            roll_deg: 0.0,
            ..view(radius, motion, yaw_deg)
        }
    };
    vec![
        view(1.01, Motion::Rest, 170.0),
        view(2.0, Motion::Rest, 60.0),
        view(10.0, Motion::Rest, 0.0),
        view(300.0, Motion::Rest, 0.0),
        view(8.0, Motion::Fall, 0.0),
        view(1.0, Motion::Fall, 30.0),
        view(0.5, Motion::Fall, 70.0),
        view(0.1, Motion::Fall, 100.0),
        view(3.0, Motion::Orbit, 90.0),
        view(10.0, fast, -50.0),
        view(0.6, fast, 60.0),
        narrow(10.0, Motion::Rest, 2.0),
        narrow(0.7, Motion::Fall, 3.0),
    ]
}

fn lens(view: &View) -> Lens {
    Lens::new(Camera::new(view).unwrap(), default_atlas(), Deflection::Lut).unwrap()
}

fn channels(lens: &Lens, layers: &[Layer]) -> Vec<Vec<f32>> {
    channels_of(lens, layers, None)
}

/// The channels of a picture with this disc, one ray per pixel.
fn channels_of(lens: &Lens, layers: &[Layer], disc: Option<Disc>) -> Vec<Vec<f32>> {
    let channels = trace(lens, layers, Sampling::Single, disc, || ());
    channels
        .into_iter()
        .map(|channel| channel.samples)
        .collect()
}

/// Each pixel's index, its view direction, and its ray by the closed form if it escapes.
fn exact(lens: &Lens) -> Vec<(usize, DVec3, LensedRay)> {
    let place = |index: usize| (index as u32 % WIDTH, index as u32 / WIDTH);
    let pixels = (0..lens.camera.pixels()).filter_map(|index| {
        let (column, row) = place(index);
        let view = lens.camera.direction(column, row);
        let ray = lens.exact_ray(view).escaped()?;
        Some((index, view, ray))
    });
    pixels.collect()
}

#[test]
fn directions_are_those_of_the_closed_form_within_two_thousandths_of_a_pixel() {
    let mut worst: f64 = 0.0;
    for view in views() {
        let lens = lens(&view);
        let layers = channels(&lens, &[Layer::Direction, Layer::Captured]);
        let [x, y, z, captured] = &layers[..] else {
            panic!("four channels")
        };
        let hole_from_sky = lens.camera.sky_from_hole.transpose();
        let traced: Vec<_> = (0..x.len())
            .map(|i| {
                let on_sky = DVec3::new(x[i].into(), y[i].into(), z[i].into());
                if captured[i] == 1.0 {
                    assert_eq!(on_sky, DVec3::ZERO);
                    return RayOutcome::Captured;
                }
                assert!((on_sky.length() - 1.0).abs() < 1e-7, "{on_sky}");
                RayOutcome::Escapes(hole_from_sky * on_sky)
            })
            .collect();
        let reference = Reference::new(&lens, || ());
        let errors = reference.errors(&traced, &reference.trace());
        let statistics = TraceStatistics::of(&errors).unwrap();
        worst = worst.max(statistics.pixels.max);
        assert!(statistics.pixels.max < 0.002, "{view:?}: {statistics:?}");
        assert_eq!(statistics.differing_outcomes, 0, "{view:?}");
    }
    println!("directions: {worst:.1e} px");
}

/// ν_obs/ν_∞ from the redshift factors and the Doppler factor of the motion, not by the code under test.
fn shift_by_hand(view: &View, camera: &Camera, seen: DVec3) -> f64 {
    let u = 1.0 / view.radius;
    // cos of the angle from the direction of the hole.
    let towards = -seen.z;
    match view.motion {
        Motion::Rest => 1.0 / (1.0 - u).sqrt(),
        // Painlevé–Gullstrand: ν_∞/ν_obs = 1 − β cos θ, with β = √u, of light that comes from the hole's side.
        Motion::Fall => 1.0 / (1.0 - u.sqrt() * towards),
        Motion::Orbit | Motion::Velocity { .. } => {
            // Relative to the observer at rest, whose light has 1/√(1 − u), or below the horizon to the one in fall.
            let (radial, tangential) = match view.motion {
                Motion::Velocity { radial, tangential } => (radial, tangential),
                _ => (0.0, (0.5 * u / (1.0 - u)).sqrt()),
            };
            let (north, east) = view.heading_deg.to_radians().sin_cos();
            let velocity = DVec3::new(tangential * east, tangential * north, radial);
            let gamma = 1.0 / (1.0 - velocity.length_squared()).sqrt();
            let doppler = 1.0 / (gamma * (1.0 - velocity.dot(seen)));
            let (unboosted, _) = camera.unboosted(seen);
            let base = View {
                motion: if u < 1.0 { Motion::Rest } else { Motion::Fall },
                ..*view
            };
            doppler * shift_by_hand(&base, camera, unboosted)
        }
    }
}

#[test]
fn the_shift_is_that_of_gravity_and_motion() {
    let mut compared = 0;
    for view in views() {
        let lens = lens(&view);
        let [shift] = &channels(&lens, &[Layer::Shift])[..] else {
            panic!("one channel")
        };
        for (index, seen, _) in exact(&lens) {
            let expected = shift_by_hand(&view, &lens.camera, seen);
            let off = f64::from(shift[index]) / expected - 1.0;
            assert!(off.abs() < 1e-6, "{view:?}, pixel {index}: {off:e}");
            compared += 1;
        }
    }
    assert!(compared > 100_000, "{compared}");
}

/// The magnification by numerical differentiation: the area of the image on the sky of a small square of view
/// directions, all by the closed form.
fn magnification_by_hand(lens: &Lens, seen: DVec3, size: f64) -> Option<f64> {
    let right = seen.any_orthonormal_vector();
    // right × down = seen, as in a picture.
    let down = seen.cross(right);
    let at = |x: f64, y: f64| {
        let ray = (seen + right * x * size + down * y * size).normalize();
        Some(lens.exact_ray(ray).escaped()?.direction)
    };
    let along = (at(1.0, 0.0)? - at(-1.0, 0.0)?) / (2.0 * size);
    let across = (at(0.0, 1.0)? - at(0.0, -1.0)?) / (2.0 * size);
    Some(1.0 / along.cross(across).dot(at(0.0, 0.0)?))
}

#[test]
fn the_magnification_is_the_ratio_of_areas_and_its_sign_the_parity() {
    let mut compared = [0, 0];
    let mut worst: f64 = 0.0;
    for view in views() {
        let lens = lens(&view);
        let [magnification, order] = &channels(&lens, &[Layer::Magnification, Layer::Order])[..]
        else {
            panic!("two channels")
        };
        for (index, seen, ray) in exact(&lens).into_iter().step_by(7) {
            // Steps that are small against the distance from the edge, and against that from the ring of infinite
            // magnification.
            let (unboosted, doppler) = lens.camera.unboosted(seen);
            let theta = unboosted.angle_between(DVec3::NEG_Z);
            let from_edge = (theta - lens.camera.observer.shadow_angle()).abs() / doppler;
            let from_ring = (ray.jacobian.tangential / ray.jacobian.radial).abs();
            let size = 1e-3 * from_edge.min(from_ring).min(0.1);
            let Some(expected) = magnification_by_hand(&lens, seen, size) else {
                continue;
            };
            // Rounding of the differences.
            if size * ray.jacobian.tangential.abs() < 1e-9 {
                continue;
            }
            let found = f64::from(magnification[index]);
            let off = (found / expected - 1.0).abs();
            worst = worst.max(off);
            assert!(
                off < 1e-4,
                "{view:?}, pixel {index}: {found} for {expected}"
            );
            let is_odd = order[index] as u32 % 2 == 1;
            assert_eq!(found < 0.0, is_odd, "{view:?}, pixel {index}");
            compared[usize::from(is_odd)] += 1;
        }
    }
    println!("magnification: {worst:.1e}, {compared:?} pixels");
    assert!(compared[0] > 8000 && compared[1] > 500, "{compared:?}");
}

/// The order grows by one from ring to ring towards the shadow, and past each ring the direction on the sky has gone
/// through the axis.
#[test]
fn the_order_counts_the_crossings_of_the_axis() {
    let view = View {
        roll_deg: 0.0,
        heading_deg: 0.0,
        ..view(10.0, Motion::Rest, 0.0)
    };
    let camera = Camera::new(&view).unwrap();
    let edge = camera.observer.shadow_angle();
    let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
    let mut last = 0;
    let mut jumps = 0;
    // From straight away to the edge, closer by a hundredth each step.
    let mut from_edge = std::f64::consts::PI - edge;
    while from_edge > 1e-9 {
        let (sin, cos) = (edge + from_edge).sin_cos();
        let ray = lens.ray(DVec3::new(sin, 0.0, -cos)).escaped().unwrap();
        let order = ImageOrder::at(ray.sky_angle).half_windings();
        // The light of even orders comes from the side on which it is seen.
        assert_eq!(
            ray.direction.x > 0.0,
            order.is_multiple_of(2),
            "{from_edge}"
        );
        assert!(order == last || order == last + 1, "{last} {order}");
        jumps += u32::from(order > last);
        last = order;
        from_edge *= 0.99;
    }
    assert_eq!(last, jumps);
    assert!(last >= 6, "{last}");
}

#[test]
fn the_places_in_a_panorama_are_those_of_the_directions() {
    let lens = lens(&view(5.0, Motion::Rest, 20.0));
    let layers = channels(&lens, &[Layer::Direction, Layer::Uv, Layer::Captured]);
    let [x, y, z, u, v, captured] = &layers[..] else {
        panic!("six channels")
    };
    let mut seen = 0;
    for i in 0..x.len() {
        if captured[i] == 1.0 {
            assert_eq!([u[i], v[i]], [0.0; 2]);
            continue;
        }
        let longitude = std::f32::consts::TAU * (u[i] - 0.5);
        let latitude = std::f32::consts::PI * (v[i] - 0.5);
        let from_uv = [
            latitude.cos() * longitude.sin(),
            latitude.sin(),
            -latitude.cos() * longitude.cos(),
        ];
        for (a, b) in from_uv.into_iter().zip([x[i], y[i], z[i]]) {
            assert!((a - b).abs() < 2e-6, "pixel {i}: {a} {b}");
        }
        seen += 1;
    }
    assert!(seen > 1000 && seen < x.len());
}

/// The shadow as its share of each pixel's area adds up to the disc.
#[test]
fn the_share_of_the_shadow_is_antialiased_where_the_picture_is() {
    let lens = lens(&View {
        yaw_deg: 0.0,
        ..view(10.0, Motion::Rest, 0.0)
    });
    let captured = |sampling| {
        let mut channels = trace(&lens, &[Layer::Captured], sampling, None, || ());
        channels.remove(0).samples
    };
    let (share, at_centre) = (captured(Sampling::Filtered), captured(Sampling::Single));
    let partial = share.iter().filter(|&&c| c > 0.0 && c < 1.0).count();
    assert!(at_centre.iter().all(|&c| c == 0.0 || c == 1.0));
    // The disc looks ahead: its radius in pixels is tan θ_c / tan 45° of half the width.
    let radius = 0.5 * f64::from(WIDTH) * lens.camera.observer.shadow_angle().tan();
    let area: f64 = share.iter().map(|&c| f64::from(c)).sum();
    let disc = std::f64::consts::PI * radius * radius;
    assert!((area - disc).abs() < 1e-3 * disc, "{area} {disc}");
    assert!(
        partial as f64 > 2.0 * std::f64::consts::PI * radius,
        "{partial}"
    );
}

#[test]
fn layers_come_once_each_and_in_their_order() {
    let lens = lens(&view(10.0, Motion::Rest, 0.0));
    let asked = [Layer::Captured, Layer::Uv, Layer::Captured];
    let names = trace(&lens, &asked, Sampling::Single, None, || ());
    let names: Vec<_> = names.into_iter().map(|channel| channel.name).collect();
    assert_eq!(names, ["uv.U", "uv.V", "captured.V"]);
    assert_eq!(channels(&lens, &[]), Vec::<Vec<f32>>::new());
    assert_eq!(finite(f64::NEG_INFINITY), f32::MIN);
    assert_eq!(finite(f64::NAN), 0.0);
}
