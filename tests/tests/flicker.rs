//! During an orbit a star has the light that the closed form gives; drawn as a texel, it would flicker.

use glam::{DVec2, Vec3};
use lensbake_core::Motion;
use lensbake_render::camera::View;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::stars::{DEFAULT_DISC_RADIUS, PointStar, Star, direction};
use lensbake_studies::flicker::{BAR, Flight, Subject, Track, follow, point_on_gpu};
use lensbake_tests::renderer;
use pollster::block_on;

fn orbit(frames: u32) -> Vec<Lens> {
    flight(View::default(), frames)
}

fn flight(view: View, frames: u32) -> Vec<Lens> {
    let view = View {
        width: 480,
        height: 270,
        ..view
    };
    Flight { view, frames }.lenses().unwrap()
}

/// A star at this declination with the light of a fifth of a white pixel, so that no light is left for a halo.
fn faint_star(declination_deg: f64, lenses: &[Lens]) -> Subject {
    let star = Star {
        right_ascension: 1.0,
        declination: declination_deg.to_radians(),
        magnitude: 6.75,
        colour_index: None,
    };
    let point = PointStar {
        direction: direction(star.right_ascension, star.declination),
        light: Vec3::splat(0.2),
    };
    Subject::new(star, point, DEFAULT_DISC_RADIUS, lenses).unwrap()
}

fn followed(declination_deg: f64, lenses: &[Lens]) -> Track {
    follow(faint_star(declination_deg, lenses), lenses, || ())
}

#[test]
fn in_an_orbit_of_240_frames_a_star_does_not_flicker() {
    let lenses = orbit(240);
    for declination_deg in [2.0, 9.0, -20.0] {
        let track = followed(declination_deg, &lenses);
        let (point, nearest) = (track.point(), track.nearest());
        println!(
            "{declination_deg} degrees aside, {} frames: {point:?}; one ray {nearest:?}",
            track.frames.len()
        );
        assert!(track.frames.len() > 60, "{}", track.frames.len());
        assert!(point.worst < BAR && point.rms < BAR, "{point:?}");
        assert!(track.is_good());
        assert!(track.texel_frames().count() > 30);
        assert!(
            nearest.rms > 0.2,
            "the comparison must be able to fail: {nearest:?}"
        );
        // Filtering improves a texel, but a point star is still better.
        let filtered = track.filtered().rms;
        assert!(point.rms < filtered && filtered < nearest.rms, "{filtered}");
    }
}

/// Magnification times g⁴, for a camera in orbit at r = 6 that looks ahead, and for one that falls from r = 10 to 0.05 and
/// looks across its motion.
#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn nor_for_a_moving_camera() {
    let moving = |radius, motion, yaw_deg| {
        let view = View {
            radius,
            motion,
            yaw_deg,
            ..View::default()
        };
        flight(view, 60)
    };
    for (lenses, name) in [
        (moving(6.0, Motion::Orbit, 50.0), "orbit"),
        (moving(10.0, Motion::Fall, 90.0), "fall"),
    ] {
        for declination_deg in [9.0, -14.0] {
            let subject = match name {
                "orbit" => faint_star(declination_deg, &lenses),
                _ => star_above_middle(&lenses[30], declination_deg, &lenses),
            };
            let mut track = follow(subject, &lenses, || ());
            let off = block_on(point_on_gpu(&renderer(), &lenses, &track, || ())).unwrap();
            let light: Vec<f64> = track.frames.iter().map(|f| f.expected.light).collect();
            let least = light.iter().copied().fold(f64::INFINITY, f64::min);
            println!(
                "{name} {declination_deg}: {} frames, {least:.2} to {:.2} times: {:?}, on the GPU {off:?}",
                light.len(),
                track.peak(),
                track.point()
            );
            assert!(
                light.len() > 15 && track.peak() / least > 2.0,
                "{name}: {light:?}"
            );
            track.on_gpu = Some(off);
            assert!(track.is_good(), "{name}: {:?} {off:?}", track.point());
        }
    }
}

/// A faint star that `lens` shows this far above the middle of its picture.
fn star_above_middle(lens: &Lens, above_deg: f64, lenses: &[Lens]) -> Subject {
    let camera = &lens.camera;
    let up = above_deg.to_radians().tan() / camera.down.length();
    let view = camera.ray(DVec2::new(0.0, -up)).normalize();
    let ray = lens.ray(view).escaped().unwrap();
    let on_sky = camera.sky_from_hole * ray.direction;
    let star = Star {
        right_ascension: 0.0,
        declination: 0.0,
        magnitude: 6.75,
        colour_index: None,
    };
    let point = PointStar {
        direction: on_sky,
        light: Vec3::splat(0.2),
    };
    Subject::new(star, point, DEFAULT_DISC_RADIUS, lenses).unwrap()
}

/// The light curve is independent of the drawing: stars drawn without deflection miss it.
#[test]
fn a_star_that_is_not_lensed_misses_the_bar() {
    let lenses = orbit(48);
    let flat: Vec<Lens> = lenses
        .iter()
        .map(|lens| lens.with_deflection(Deflection::Flat))
        .collect();
    let track = follow(faint_star(9.0, &lenses), &flat, || ());
    assert!(!track.is_good(), "{:?}", track.point());
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn nor_does_it_on_the_gpu() {
    let lenses = orbit(48);
    let mut track = followed(2.0, &lenses);
    let off = block_on(point_on_gpu(&renderer(), &lenses, &track, || ())).unwrap();
    assert!(off.worst < BAR, "{off:?}");
    track.on_gpu = Some(off);
    assert!(track.is_good());
}
