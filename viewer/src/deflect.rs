//! Who turns the light, on the CPU in f64: the twins of `shaders/deflect_*.wgsl`.

use crate::camera::Sight;
use crate::scene::{Method, Scene};
use lensbake_core::rk4::Stepper;
use lensbake_core::{BendAndSlope, Fate, Observer, direct, exact};
use lensbake_tables::Row;

/// A direction after the hole has turned it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turned {
    /// Its sight: the sky angle θ′ = θ − Δ from the direction of the hole.
    pub sight: Sight,
    /// dθ′/dθ, how much faster than the view angle the sky angle moves.
    pub stretch: f64,
}

/// What the method of `scene` makes of a view direction.
pub fn deflect(scene: &Scene, sight: Sight) -> Fate<Turned> {
    match scene.method {
        Method::Lut => look_up(&scene.row, sight),
        Method::Direct { step } => integrate(&scene.camera.observer, sight, Stepper::Fixed(step)),
        Method::Flat => undeflected(&scene.camera.observer, sight),
    }
}

/// By the row.
pub fn look_up(row: &Row, sight: Sight) -> Fate<Turned> {
    let observer = row.observer();
    let at = observer.edge_coordinate(sight.angle());
    row.bend_and_slope(at)
        .map(|bending| turn(observer, sight, at.x, bending))
}

/// By RK4.
pub fn integrate(observer: &Observer, sight: Sight, stepper: Stepper) -> Fate<Turned> {
    let at = observer.edge_coordinate(sight.angle());
    direct::bend_and_slope(observer, at, stepper)
        .map(|bending| turn(observer, sight, at.x, bending))
}

/// By the closed form, with the stretch of `row`: the reference that the others are held to.
pub fn closed_form(row: &Row, sight: Sight) -> Fate<Turned> {
    let observer = row.observer();
    let at = observer.edge_coordinate(sight.angle());
    match (exact::bend(&observer.ray_at(at)), row.bend_and_slope(at)) {
        (Fate::Escapes(bend), Fate::Escapes(BendAndSlope { slope, .. })) => {
            Fate::Escapes(turn(observer, sight, at.x, BendAndSlope { bend, slope }))
        }
        _ => Fate::Captured,
    }
}

/// Not at all: a black sphere of radius r_s before the undeflected sky.
pub fn undeflected(observer: &Observer, sight: Sight) -> Fate<Turned> {
    if sight.cos > 0.0 && sight.sin < observer.inverse_radius() {
        Fate::Captured
    } else {
        Fate::Escapes(Turned {
            sight,
            stretch: 1.0,
        })
    }
}

fn turn(observer: &Observer, sight: Sight, x: f64, bending: BendAndSlope) -> Turned {
    let (sin, cos) = bending.bend.sin_cos();
    Turned {
        sight: Sight {
            cos: sight.cos * cos + sight.sin * sin,
            sin: sight.sin * cos - sight.cos * sin,
        },
        stretch: 1.0 - bending.slope / observer.view_angle_slope(x),
    }
}
