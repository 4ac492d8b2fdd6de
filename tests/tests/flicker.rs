//! In an orbit a star keeps the light that the closed form says; and what it would do as a texel.

use glam::Vec3;
use lensbake_tests::gpu;
use viewer::camera::View;
use viewer::flicker::{BAR, Orbit, Subject, Track, follow, point_on_gpu};
use viewer::scene::{Method, Scene};
use viewer::stars::{DEFAULT_DISC_RADIUS, PointStar, Star, direction};

fn orbit(frames: u32) -> Vec<Scene> {
    let view = View {
        width: 480,
        height: 270,
        ..View::default()
    };
    Orbit { view, frames }.scenes().unwrap()
}

/// A star at this declination that has the light of a fifth of a white pixel: none is left to a halo.
fn faint_star(declination_deg: f64, scenes: &[Scene]) -> Subject {
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
    Subject::new(star, point, DEFAULT_DISC_RADIUS, scenes).unwrap()
}

fn followed(declination_deg: f64, scenes: &[Scene]) -> Track {
    follow(faint_star(declination_deg, scenes), scenes, || ()).unwrap()
}

#[test]
fn in_an_orbit_of_240_frames_a_star_does_not_flicker() {
    let scenes = orbit(240);
    for declination_deg in [2.0, 9.0, -20.0] {
        let track = followed(declination_deg, &scenes);
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
        // Filtering helps a texel, but a point it is not.
        let filtered = track.filtered().rms;
        assert!(point.rms < filtered && filtered < nearest.rms, "{filtered}");
    }
}

/// The curve is no mirror of the drawing: stars that are drawn where they are without the hole miss it.
#[test]
fn a_star_that_is_not_lensed_misses_the_bar() {
    let scenes = orbit(48);
    let flat: Vec<Scene> = scenes.iter().map(|scene| scene.by(Method::Flat)).collect();
    let track = follow(faint_star(9.0, &scenes), &flat, || ()).unwrap();
    assert!(!track.is_good(), "{:?}", track.point());
}

#[test]
#[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
fn nor_does_it_on_the_gpu() {
    let scenes = orbit(48);
    let mut track = followed(2.0, &scenes);
    let off = point_on_gpu(&gpu(), &scenes, &track, || ()).unwrap();
    assert!(off.worst < BAR, "{off:?}");
    track.on_gpu = Some(off);
    assert!(track.is_good());
}
