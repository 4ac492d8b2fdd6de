//! The error of the image of a disc, in image space.
//!
//! The bending moves the place where a ray meets the disc, and so the image of that place. A ray before its periapsis
//! meets it at a phase counted from the sky behind the observer, so that the place depends on the bending of the ray that
//! leaves him in the opposite direction, which the picture's own rays need not show.

use crate::camera::Camera;
use crate::disc::{Disc, Hit, MAX_OUTER, SeenDisc};
use crate::footprint::Patch;
use crate::lens::{Deflection, Lens};
use crate::shift::Rendition;
use glam::DVec2;
use lensbake_core::accretion::INNERMOST_STABLE;

/// Distance over which radii are differentiated, pixels.
const STEP: f64 = 1.0 / 256.0;

/// A disc as it should look: by direct integration, which displaces it by about 1e-8 rad.
#[derive(Debug)]
pub struct DiscReference<'a> {
    camera: &'a Camera,
    disc: Disc,
    seen: SeenDisc<'a>,
    /// Its plane through the lens of the table's row, which is fast enough to differentiate with.
    plane: SeenDisc<'a>,
}

/// Where the ray of a pixel should meet the disc: at most twice.
#[derive(Debug, Clone, Copy)]
pub struct DiscPixel {
    /// Position in the picture, pixels from its centre.
    at: DVec2,
    places: [Option<Place>; 2],
}

/// A place on the disc.
#[derive(Debug, Clone, Copy)]
struct Place {
    radius: f64,
    /// How the radius changes from pixel to pixel.
    gradient: DVec2,
}

/// The lens of `lens` by direct integration.
pub fn integrated(lens: &Lens) -> Lens {
    let step = Deflection::DEFAULT_STEP;
    lens.with_deflection(Deflection::Direct { step })
}

impl<'a> DiscReference<'a> {
    /// The disc in the picture through `lens`, whose row must be the table's; `integrated` is [`integrated`] of it.
    pub fn new(lens: &'a Lens, integrated: &'a Lens, disc: Disc) -> Self {
        DiscReference {
            camera: &lens.camera,
            disc,
            seen: SeenDisc::new(integrated, disc, Rendition::default()),
            plane: plane(disc, lens),
        }
    }

    /// Where the ray through the centre of pixel (column, row) should meet the disc; `None` if it does not.
    pub fn pixel(&self, column: u32, row: u32) -> Option<DiscPixel> {
        let at = self.camera.position(column, row);
        let hits = hits(&self.seen, self.camera, at);
        (hits != [None; 2]).then(|| DiscPixel {
            at,
            places: hits.map(|hit| self.place(at, hit?.radius)),
        })
    }

    /// The place that is seen at `at` if it has this radius. `None` if its image is too thin to say how the radius
    /// changes: that of a high order, beside the shadow's edge, which is displaced as the sky is.
    fn place(&self, at: DVec2, radius: f64) -> Option<Place> {
        let change = |step: DVec2| {
            let change = |at| nearest(hits(&self.plane, self.camera, at), radius);
            match (change(at + step), change(at - step)) {
                (Some(ahead), Some(behind)) => 0.5 * (ahead - behind) / STEP,
                (Some(ahead), None) => (ahead - radius) / STEP,
                (None, Some(behind)) => (radius - behind) / STEP,
                (None, None) => 0.0,
            }
        };
        let gradient = DVec2::new(change(DVec2::X * STEP), change(DVec2::Y * STEP));
        (gradient != DVec2::ZERO).then_some(Place { radius, gradient })
    }

    /// The plane of the disc through the lens `drawn`, to compare with.
    pub fn plane_in<'b>(&self, drawn: &'b Lens) -> SeenDisc<'b> {
        plane(self.disc, drawn)
    }
}

impl DiscPixel {
    /// The distance in pixels by which the image of a place that the pixel shows is displaced in `drawn`, the plane of
    /// the disc through the lens that draws the picture of `camera`: the larger one if the pixel shows two places.
    pub fn error_of(&self, drawn: &SeenDisc, camera: &Camera) -> f64 {
        let found = hits(drawn, camera, self.at);
        let errors = self.places.iter().flatten().map(|place| {
            // A place that is not found has moved inside the innermost orbit.
            let radius = nearest(found, place.radius).unwrap_or(INNERMOST_STABLE);
            (radius - place.radius).abs() / place.gradient.length()
        });
        errors.fold(0.0, f64::max)
    }
}

/// The plane of `disc` through `lens`, as far in and out as a disc can reach.
fn plane(disc: Disc, lens: &Lens) -> SeenDisc<'_> {
    let disc = Disc {
        inner: INNERMOST_STABLE,
        outer: MAX_OUTER,
        ..disc
    };
    SeenDisc::new(lens, disc, Rendition::default())
}

/// Where the ray at `at` meets the disc.
fn hits(disc: &SeenDisc, camera: &Camera, at: DVec2) -> [Option<Hit>; 2] {
    disc.hits(&Patch::seen_by(camera, at, 0.0))
}

/// Of the radii of `hits`, the one nearest to `radius`.
fn nearest(hits: [Option<Hit>; 2], radius: f64) -> Option<f64> {
    let found = hits.into_iter().flatten().map(|hit| hit.radius);
    let off = |r: &f64| (r - radius).abs();
    found.min_by(|a, b| off(a).total_cmp(&off(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::View;
    use crate::disc::Orientation;
    use crate::model::{Model, Precision, choose};
    use lensbake_tables::Interpolation::{Hermite, Linear};
    use lensbake_tables::{Interpolation, default_atlas};

    fn lens(radius: f64, yaw_deg: f64) -> Lens {
        let view = View {
            radius,
            yaw_deg,
            fov_deg: 60.0,
            width: 96,
            height: 64,
            ..View::default()
        };
        let camera = Camera::new(&view).unwrap();
        Lens::new(camera, default_atlas(), Deflection::Lut).unwrap()
    }

    fn inclined(inclination_deg: f64) -> Disc {
        let orientation = Orientation {
            inclination_deg,
            ..Disc::default().orientation
        };
        Disc {
            orientation,
            ..Disc::default()
        }
    }

    fn row(texels: u32, interpolation: Interpolation) -> Model {
        Model::Row {
            texels,
            interpolation,
        }
    }

    fn pixels() -> impl Iterator<Item = (u32, u32)> {
        (0..64).flat_map(|row| (0..96).map(move |column| (column, row)))
    }

    /// Where a pixel is moved by its error, the disc that is drawn shows the place that the pixel should show.
    #[test]
    fn the_error_is_the_distance_between_the_images_of_a_place() {
        let mut tried = 0;
        for (radius, yaw, inclination) in [
            (25.0, 0.0, 0.0),
            (25.0, 0.0, 80.0),
            (25.0, 0.0, 90.0),
            (6.0, 0.0, 80.0),
            (6.0, 120.0, 80.0),
            (2.0, 90.0, 60.0),
        ] {
            let lens = lens(radius, yaw);
            let exact = integrated(&lens);
            let reference = DiscReference::new(&lens, &exact, inclined(inclination));
            let drawn = row(4, Linear).lens(&lens).unwrap();
            let plane = reference.plane_in(&drawn);
            let shown = pixels().filter_map(|(column, row)| reference.pixel(column, row));
            for pixel in shown {
                let ([Some(place), None] | [None, Some(place)]) = pixel.places else {
                    continue;
                };
                let error = pixel.error_of(&plane, &lens.camera);
                // Where the image of the plane is thin, its radius is not linear within the error.
                if error > 0.1 || place.gradient.length() > 1.0 {
                    continue;
                }
                let step = place.gradient.normalize() * error;
                let off = |at| {
                    nearest(hits(&plane, &lens.camera, at), place.radius)
                        .map(|r| (r - place.radius).abs())
                };
                let nearer = [off(pixel.at + step), off(pixel.at - step)];
                let nearer = nearer.into_iter().flatten().fold(f64::INFINITY, f64::min);
                let before = off(pixel.at).unwrap();
                assert!(
                    nearer <= 0.1 * before + 1e-9,
                    "{radius} {inclination}: {pixel:?} {before} {nearer}"
                );
                tried += 1;
            }
        }
        assert!(tried > 3000, "{tried}");
    }

    #[test]
    fn the_whole_row_displaces_nothing() {
        for (radius, yaw, inclination) in [(25.0, 0.0, 80.0), (6.0, 120.0, 80.0), (2.0, 90.0, 90.0)]
        {
            let lens = lens(radius, yaw);
            let exact = integrated(&lens);
            let reference = DiscReference::new(&lens, &exact, inclined(inclination));
            let plane = reference.plane_in(&lens);
            let shown = pixels().filter_map(|(column, row)| reference.pixel(column, row));
            let errors = shown.map(|pixel| pixel.error_of(&plane, &lens.camera));
            let worst = errors.fold(0.0, f64::max);
            assert!(
                worst > 0.0 && worst < 1e-5,
                "{radius} {inclination}: {worst:e}"
            );
        }
    }

    /// A row that is good enough for the sky of a picture may not be for a disc in it.
    #[test]
    fn a_disc_may_need_a_longer_row() {
        let lens = lens(6.0, 120.0);
        let least = |disc| {
            let choice = choose(&lens, disc, 0.12, Precision::F64).unwrap();
            choice.chosen.unwrap().model
        };
        assert_eq!(least(None), row(4, Hermite));
        assert_eq!(least(Some(inclined(80.0))), row(8, Hermite));
    }
}
