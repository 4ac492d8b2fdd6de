//! Stars that the CPU draws in many pictures.

use super::cells::{Candidates, Cells};
use super::draw::{add_splats, draw, splats_of};
use super::image_bounds::ImageBounds;
use super::images::InverseLens;
use super::{PointStar, StarField};
use crate::camera::Mapping;
use crate::lens::Lens;
use crate::picture::Picture;
use crate::shift::Rendition;
use rayon::prelude::*;

/// A field of stars sorted once, so that each picture costs only the stars that it may show.
#[derive(Debug, Clone, PartialEq)]
pub struct SortedStars {
    field: StarField,
    cells: Cells,
}

impl SortedStars {
    /// Sorts the stars of `field`.
    pub fn new(field: StarField) -> Self {
        SortedStars {
            cells: Cells::new(&field),
            field,
        }
    }

    /// Adds the stars, seen through `lens`, to `picture`: to the last bit as [`draw`](super::draw()) does.
    pub fn draw(&self, picture: &mut Picture, lens: &Lens, rendition: Rendition) {
        if lens.camera.mapping != Mapping::Perspective {
            // The cells know pictures in perspective; the others show most of the sky.
            return draw(picture, lens, &self.field, rendition);
        }
        let inverse = InverseLens::of(lens);
        let mut found = Candidates::default();
        let bounds = ImageBounds::of(&inverse, self.field.disc_radius);
        self.cells
            .find(&lens.camera, &bounds, rendition, &mut found);
        // In the field's order, so that light is added up in the same order.
        let stars: Vec<&PointStar> = self
            .cells
            .in_field(&found)
            .into_iter()
            .map(|star| &self.field.stars[star as usize])
            .collect();
        let disc_radius = self.field.disc_radius;
        let splats = splats_of(
            lens,
            &inverse,
            stars.into_par_iter(),
            disc_radius,
            rendition,
        );
        add_splats(picture, &splats, &lens.camera);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::lens::Deflection;
    use crate::shift::Shift;
    use crate::stars::{self, StarSource};
    use lensbake_core::Motion;
    use lensbake_tables::default_atlas;

    #[test]
    fn they_are_drawn_as_without_sorting() {
        let field = StarField::new(&stars::load(&StarSource::Hipparcos).unwrap(), 0.0);
        let sorted = SortedStars::new(field.clone());
        for (radius, motion, yaw_deg, shift) in [
            (10.0, Motion::Rest, 0.0, Shift::Off),
            (3.0, Motion::Orbit, 60.0, Shift::Colour),
            (0.3, Motion::Fall, 70.0, Shift::Brightness),
            (200.0, Motion::Fall, 0.0, Shift::Off),
        ] {
            let view = View {
                radius,
                motion,
                yaw_deg,
                orbit_deg: 80.0,
                width: 160,
                height: 90,
                ..View::default()
            };
            let camera = Camera::new(&view).unwrap();
            let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
            let rendition = Rendition::of(shift);
            let black = || Picture::new(160, 90, vec![[0.0; 3]; camera.pixels()]);
            let (mut all, mut found) = (black(), black());
            draw(&mut all, &lens, &field, rendition);
            sorted.draw(&mut found, &lens, rendition);
            assert!(all == found, "r = {radius}");
            assert!(all != black(), "r = {radius}: no star is in the picture");
        }
    }
}
