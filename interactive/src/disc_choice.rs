//! Choice of the disc around the hole: the ranges of its sliders, and how the camera sees it.

use crate::settings::Settings;
use lensbake_core::accretion::INNERMOST_STABLE;
use lensbake_render::camera::Place;
use lensbake_render::disc::{Disc, Orientation};
use std::ops::RangeInclusive;

/// Radii on the sliders, units of r_s.
pub const RADII: RangeInclusive<f64> = INNERMOST_STABLE..=100.0;
/// Inclinations on the slider, degrees. Beyond 90° the matter moves clockwise.
pub const INCLINATIONS: RangeInclusive<f64> = 0.0..=180.0;
/// Angles of the line of nodes on the slider, degrees.
pub const NODES: RangeInclusive<f64> = -180.0..=180.0;
/// Brightnesses on the slider, which is logarithmic.
pub const BRIGHTNESSES: RangeInclusive<f64> = 0.01..=100.0;

/// The least difference between the radii that the sliders set, units of r_s.
const NARROWEST: f64 = 0.1;

/// Where the sliders of the inner and the outer radius of `disc` stop: shortly before the other radius. An end is beyond
/// [`RADII`] if the radius is.
pub fn radii(disc: &Disc) -> [RangeInclusive<f64>; 2] {
    let (least, most) = RADII.into_inner();
    let inner_most = (disc.outer - NARROWEST).max(least);
    let outer_least = disc.inner + NARROWEST;
    [
        least..=inner_most.min(most),
        outer_least..=most.max(outer_least),
    ]
}

/// From where the inclination and the node of a disc are as they are given.
pub fn seen_from(orientation: &Orientation) -> String {
    let [longitude, latitude] = orientation.seen_from_deg;
    format!("seen from longitude {longitude}°, latitude {latitude}°:")
}

/// How the disc is inclined to the camera of these settings, in words.
pub fn seen_here(settings: &Settings) -> String {
    format!("inclined by {:.1}°", settings.disc_inclination_deg())
}

impl Settings {
    /// The disc of the picture, if it has one.
    pub fn shown_disc(&self) -> Option<Disc> {
        self.disc_shown.then_some(self.disc)
    }

    /// Angle between the axis of the disc and the line from the hole to the camera, degrees: 0 shows the disc face-on,
    /// 90 edge-on.
    fn disc_inclination_deg(&self) -> f64 {
        let to_camera = Place::of(&self.view).direction();
        let axis = self.disc.orientation.axis();
        axis.angle_between(to_camera).to_degrees()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::Change;
    use crate::settings::at;
    use lensbake_core::Motion;
    use lensbake_render::camera::Camera;
    use lensbake_render::gpu::EdgeMode;
    use lensbake_render::lens::{Deflection, Lens};
    use lensbake_tables::default_atlas;
    use proptest::prelude::*;

    #[test]
    fn the_key_shows_the_disc_and_hides_it_again() {
        let mut settings = at(10.0, Motion::Rest);
        assert_eq!(settings.shown_disc(), None);
        settings.disc.outer = 20.0;
        settings.change(Change::ToggleDisc);
        assert_eq!(settings.shown_disc(), Some(settings.disc));
        settings.change(Change::ToggleDisc);
        assert_eq!((settings.shown_disc(), settings.disc.outer), (None, 20.0));
    }

    #[test]
    fn the_inclination_is_that_to_the_camera() {
        let mut settings = at(10.0, Motion::Rest);
        settings.disc.orientation.inclination_deg = 80.0;
        assert_eq!(seen_here(&settings), "inclined by 80.0°");
        // The axis points to latitude 80°.
        for (latitude_deg, seen) in [(-10.0, 90.0), (80.0, 0.0), (30.0, 50.0)] {
            settings.view.latitude_deg = latitude_deg;
            let inclination = settings.disc_inclination_deg();
            assert!((inclination - seen).abs() < 1e-6, "{inclination}");
        }
        settings.view.latitude_deg = 0.0;
        settings.view.orbit_deg = 90.0;
        assert!((settings.disc_inclination_deg() - 90.0).abs() < 1e-12);
    }

    #[test]
    fn the_edge_of_the_shadow_is_not_drawn_over_a_disc() {
        let mut settings = at(10.0, Motion::Rest);
        let camera = Camera::new(&settings.view).unwrap();
        let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
        let edge = |settings: &Settings| settings.presentation(640, &lens).edge;
        assert_ne!(edge(&settings), EdgeMode::AsDrawn);
        settings.disc_shown = true;
        assert_eq!(edge(&settings), EdgeMode::AsDrawn);
    }

    proptest! {
        /// From any disc that a flag or a typed number gives.
        #[test]
        fn the_sliders_stop_before_the_other_radius(
            inner in 3.0..1e4f64,
            width in prop_oneof![1e-6..1.0f64, 1.0..1e4f64],
            to in -1e3..1e6f64,
        ) {
            let disc = Disc { inner, outer: inner + width, ..Disc::default() };
            let [inner_range, outer_range] = radii(&disc);
            let clamped = |range: RangeInclusive<f64>| to.clamp(*range.start(), *range.end());
            let moved = Disc { inner: clamped(inner_range), ..disc };
            prop_assert_eq!(moved.check(), Ok(()));
            let moved = Disc { outer: clamped(outer_range), ..disc };
            prop_assert_eq!(moved.check(), Ok(()));
        }
    }
}
