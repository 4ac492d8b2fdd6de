//! Where the renderer's rays meet a disc, by the legs of [`SeenDisc`] and the table, and where `bake query --disc` says they
//! do, by the geometry of core and the closed form.

use glam::DVec3;
use lensbake_core::disc_crossing::{Crossing, TracedRay};
use lensbake_core::{Motion, MovingFrame, ThinDisc};
use lensbake_render::camera::{Camera, View};
use lensbake_render::disc::{Disc, Hit, SeenDisc};
use lensbake_render::footprint::Patch;
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::shift::Rendition;
use lensbake_tables::default_atlas;
use std::f64::consts::{PI, TAU};

/// View angles and azimuths over the whole sky, closer together near the hole.
fn directions() -> impl Iterator<Item = (f64, f64)> {
    const ANGLES: u32 = 200;
    const AZIMUTHS: u32 = 30;
    (0..ANGLES).flat_map(|i| {
        let theta = PI * ((f64::from(i) + 0.37) / f64::from(ANGLES)).powi(2);
        (0..AZIMUTHS).map(move |j| (theta, TAU * (f64::from(j) + 0.21) / f64::from(AZIMUTHS)))
    })
}

/// A camera, the same observer as a frame of core, and the lens.
struct Sight {
    camera: Camera,
    frame: MovingFrame,
    lens: Lens,
}

impl Sight {
    fn new(radius: f64, motion: Motion) -> Self {
        let view = View {
            radius,
            motion,
            ..View::default()
        };
        let camera = Camera::new(&view).unwrap();
        Sight {
            camera,
            frame: MovingFrame::new(radius, motion).unwrap(),
            lens: Lens::new(camera, default_atlas(), Deflection::Lut).unwrap(),
        }
    }

    /// The view direction of the same light for the camera's observer.
    fn direction(&self, theta: f64, azimuth: f64) -> DVec3 {
        let across = theta.sin();
        let own = DVec3::new(across * azimuth.cos(), across * azimuth.sin(), -theta.cos());
        self.camera.unboosted(own).0
    }

    fn drawn(&self, disc: Disc, direction: DVec3) -> Vec<Hit> {
        let patch = Patch::new(direction, DVec3::ZERO, DVec3::ZERO);
        let seen = SeenDisc::new(&self.lens, disc, Rendition::default());
        seen.hits(&patch).into_iter().flatten().collect()
    }

    fn known(&self, disc: &ThinDisc, theta: f64, azimuth: f64, shift: f64) -> Vec<Crossing> {
        let seen = self.frame.unboosted(theta, azimuth);
        let observer = self.frame.observer();
        let at = observer.shadow_coordinate(seen.theta);
        let ray = TracedRay::in_closed_form(disc, observer, at, seen.azimuth);
        disc.crossings(&TracedRay { shift, ..ray }).collect()
    }
}

#[test]
fn the_renderer_meets_the_disc_where_the_closed_form_does() {
    let mut disc = Disc::default();
    disc.orientation.node_deg = 20.0;
    let angles = disc.orientation;
    let thin = ThinDisc::new(
        disc.inner,
        disc.outer,
        angles.inclination_deg,
        angles.node_deg,
    );
    let sideways = Motion::Velocity {
        radial: 0.2,
        tangential: 0.6,
    };
    for (radius, motion, allowed) in [
        (4.0, Motion::Rest, 1e-6),
        (10.0, Motion::Rest, 1e-6),
        (25.0, Motion::Rest, 1e-6),
        (10.0, Motion::Fall, 1e-6),
        (0.5, Motion::Fall, 1e-5),
        (6.0, Motion::Orbit, 1e-6),
        (10.0, sideways, 1e-6),
    ] {
        let sight = Sight::new(radius, motion);
        let mut compared = 0;
        for (theta, azimuth) in directions() {
            let direction = sight.direction(theta, azimuth);
            let drawn = sight.drawn(disc, direction);
            let shift = sight.lens.frequency_shift(direction);
            let known = sight.known(&thin.unwrap(), theta, azimuth, shift);
            let what = format!("r {radius} {motion} {theta} {azimuth}: {known:?} {drawn:?}");
            assert_eq!(known.len(), drawn.len(), "{what}");
            for (known, drawn) in known.iter().zip(&drawn) {
                assert!(
                    (known.radius / drawn.radius - 1.0).abs() < allowed,
                    "{what}"
                );
                assert!((known.shift / drawn.shift - 1.0).abs() < allowed, "{what}");
                assert_eq!(known.order, drawn.order, "{what}");
                compared += 1;
            }
        }
        assert!(compared > 40, "r {radius} {motion}: {compared}");
    }
}
