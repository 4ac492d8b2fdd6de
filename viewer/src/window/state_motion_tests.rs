//! Tests of the state with observers in motion: motions that are impossible at a radius, and tables that do not reach
//! below the horizon.

use super::state_tests::{ABOVE_ONLY, at, named};
use lensbake_core::Motion;
use lensbake_interactive::fall::END;
use lensbake_interactive::keys::Change;
use lensbake_interactive::state::State;
use lensbake_tables::default_atlas;

/// Index of the table of the observer at r = 0.5.
const HALF: usize = 5;

/// Runs frames of a sixtieth of a second; returns what was said, each message once.
fn run(state: &mut State, seconds: f64) -> Vec<String> {
    let mut said = Vec::new();
    for _ in 0..(60.0 * seconds) as usize {
        said.extend(state.settings.advance(1.0 / 60.0));
        said.extend(state.settle());
        state.plan([64, 36], 1.0).unwrap();
    }
    said.dedup();
    said
}

fn falling_at(radius: f64) -> State {
    let mut state = at(25.0, 0);
    state.settings.choose_motion(Motion::Fall);
    state.settings.view.radius = radius;
    assert_eq!(state.settle(), None);
    state
}

#[test]
fn every_frame_of_a_fall_is_drawn() {
    let mut state = at(1.2, 0);
    state.settings.let_go();
    let said = run(&mut state, 3.0);
    assert!(
        said.len() == 1 && said[0].contains("You have reached"),
        "{said:?}"
    );
    assert_eq!(state.settings.view.radius, END);
    assert!(!state.settings.moves());
}

#[test]
fn what_is_impossible_here_is_refused_and_the_fall_goes_on() {
    for (radius, motion, words) in [
        (0.9, Motion::Rest, "radius 0.9 is not above the horizon"),
        (0.9, Motion::Orbit, "radius 0.9 is not above the horizon"),
        (1.2, Motion::Orbit, "no circular orbit at radius 1.2"),
    ] {
        let mut state = falling_at(radius);
        state.settings.choose_motion(motion);
        let said = state.settle().unwrap();
        assert!(said.contains(words), "{said}");
        assert_eq!(state.settings.view.motion, Motion::Fall);
    }
    let mut state = falling_at(0.9);
    state.settings.let_go();
    run(&mut state, 0.1);
    let (before, clock) = (state.settings.view.radius, state.settings.fall);
    assert!(before < 0.9);
    // The key has no other motion to go to.
    state.settings.change(Change::NextMotion);
    assert!(state.settle().unwrap().contains("not above the horizon"));
    assert_eq!(
        (state.settings.view.radius, state.settings.fall),
        (before, clock)
    );
    run(&mut state, 0.1);
    assert!(state.settings.view.radius < before);
}

#[test]
fn a_radius_that_the_motion_excludes_is_refused() {
    for (motion, radius, words) in [
        (Motion::Rest, 0.5, "unless the observer falls"),
        (Motion::Orbit, 1.4, "no circular orbit at radius 1.4"),
        (Motion::Fall, 0.001, "rows down to r = 0.01"),
    ] {
        let mut state = at(25.0, 0);
        state.settings.choose_motion(motion);
        assert_eq!(state.settle(), None);
        state.settings.view.radius = radius;
        let said = state.settle().unwrap();
        assert!(said.contains(words), "{said}");
        assert_eq!(state.settings.view.radius, 25.0);
    }
}

#[test]
fn a_radius_and_a_motion_that_need_each_other_are_taken_together() {
    let mut state = falling_at(0.5);
    for (radius, motion) in [(2.0, Motion::Orbit), (0.3, Motion::Fall)] {
        state.settings.view.radius = radius;
        state.settings.choose_motion(motion);
        // Something else is refused at the same time.
        state.settings.view.fov_deg = 180.0;
        assert!(state.settle().unwrap().contains("field of view"));
        let view = state.settings.view;
        assert_eq!((view.radius, view.motion), (radius, motion));
    }
}

#[test]
fn a_fall_stops_where_the_table_ends() {
    let mut state = at(1.2, ABOVE_ONLY);
    state.settings.let_go();
    let said = run(&mut state, 3.0);
    assert!(said.len() == 1, "{said:?}");
    assert!(said[0].contains("rows down to r = 1"), "{said:?}");
    let radius = state.settings.view.radius;
    assert!((1.0..1.03).contains(&radius), "{radius}");
    assert!(!state.settings.moves());
    // From there it can go back.
    state.settings.back_to_let_go();
    assert_eq!(state.settle(), None);
    assert_eq!(state.settings.view.radius, 1.2);
}

#[test]
fn below_the_horizon_a_table_without_rows_there_is_refused() {
    let mut state = falling_at(0.5);
    let refusal = state.take_table(named(ABOVE_ONLY)).unwrap_err().to_string();
    assert!(
        refusal.contains("table-4.lbt: the table holds rows down to r = 1"),
        "{refusal}"
    );
    assert_eq!(state.table().short_name(), "table-0.lbt");
}

#[test]
fn the_error_is_that_of_the_rows_on_this_side_of_the_horizon() {
    let header = default_atlas().header();
    let [above, below] = [2.0, 0.5].map(|radius| named(0).error_at(radius).unwrap());
    assert_eq!(above, header.measured.max_error);
    assert_eq!(below, header.measured_below.unwrap().max_error);
    assert_ne!(above, below);
}

#[test]
fn a_table_below_the_horizon_takes_the_camera_there_in_free_fall() {
    let mut state = at(25.0, 0);
    let said = state.take_table(named(HALF)).unwrap();
    assert!(
        said.contains("r = 0.50 only: the camera went there in free fall"),
        "{said}"
    );
    assert_eq!(state.settings.view.motion, Motion::Fall);
    state.settings.let_go();
    let said = run(&mut state, 1.0);
    assert!(
        said.len() == 1 && said[0].contains("holds r = 0.50 only"),
        "{said:?}"
    );
    assert!(!state.settings.moves());
    state.reset();
    assert_eq!(state.settings.view.motion, Motion::Rest);
}
