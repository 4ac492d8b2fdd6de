//! Culling of star images. The stars are sorted into cells of the sky and, within a cell, by brightness, the brightest
//! first. For each frame and image order, a cell is skipped if its image does not fall into the picture. In the other
//! cells a binary search finds how many of the first stars are bright enough to be visible, so that a frame need not test
//! each star.

use super::frustum::{Frustum, ImageCircle};
use super::image_bounds::ImageBounds;
use super::images::{ImageOrder, MIN_LIGHT};
use super::{PointStar, StarField};
use crate::camera::{Camera, ViewAngle};
use crate::shift::Rendition;
use crate::sky::{face_coordinates, texel_direction};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::ops::Range;

/// Cells along each edge of a cube face.
const CELLS: u32 = 10;

/// The stars of a field, sorted into cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    cells: Vec<Cell>,
    /// Sorted by cell and, within a cell, the brightest first.
    stars: Vec<PointStar>,
    /// Index of each star in the field.
    in_field: Vec<u32>,
    /// Light of each star in its brightest channel.
    lights: Vec<f32>,
    disc_radius: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Cell {
    /// Unit vector to the middle of the cell, sky frame.
    middle: DVec3,
    /// Largest angle of one of its stars from `middle`, rad.
    radius: f64,
    /// Indices of its stars in [`Cells::stars`].
    stars: Range<u32>,
}

/// The star images that a frame may show.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Candidates {
    /// Images that may be visible as points.
    pub points: Vec<Candidate>,
    /// Indices in [`Cells::stars`] of the stars that may be visible as arcs.
    pub arcs: Vec<u32>,
}

/// An image of a star, packed as `shaders/list_stars.wgsl` reads it: the lower 24 bits are the index of the star
/// in [`Cells::stars`], the upper 8 bits the index of the image order in [`ImageOrder::all`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct Candidate(u32);

impl Candidate {
    fn new(star: u32, order: usize) -> Self {
        Candidate(star | (order as u32) << 24)
    }

    /// Index of its star in [`Cells::stars`].
    fn star(self) -> u32 {
        self.0 & 0xff_ffff
    }
}

impl Cells {
    /// Sorts the stars of `field` into cells.
    pub fn new(field: &StarField) -> Self {
        let placed = |(index, star): (u32, &PointStar)| (cell_of(star.direction), *star, index);
        let mut placed: Vec<(u32, PointStar, u32)> = (0..).zip(&field.stars).map(placed).collect();
        let light = |star: &PointStar| star.light.max_element();
        placed.sort_by(|(a, star, _), (b, other, _)| {
            a.cmp(b).then(light(other).total_cmp(&light(star)))
        });
        let mut next = 0;
        let cells = placed.chunk_by(|(a, ..), (b, ..)| a == b).map(|stars| {
            let first = next;
            next += stars.len() as u32;
            let middle = middle_of(stars[0].0);
            let from_middle =
                |(_, star, _): &(_, PointStar, _)| star.direction.angle_between(middle);
            Cell {
                middle,
                radius: stars.iter().map(from_middle).fold(0.0, f64::max),
                stars: first..next,
            }
        });
        let cells = cells.collect();
        let in_field = placed.iter().map(|(.., index)| *index).collect();
        let stars: Vec<PointStar> = placed.into_iter().map(|(_, star, _)| star).collect();
        Cells {
            cells,
            in_field,
            lights: stars.iter().map(light).collect(),
            stars,
            disc_radius: field.disc_radius,
        }
    }

    /// Angular radius of each star, rad.
    pub fn disc_radius(&self) -> f64 {
        self.disc_radius
    }

    /// All stars of the field; [`Candidates`] holds indices in this slice.
    pub fn stars(&self) -> &[PointStar] {
        &self.stars
    }

    /// The stars of `candidates` as indices in the field, each once and in order.
    pub(super) fn in_field(&self, candidates: &Candidates) -> Vec<u32> {
        let points = candidates.points.iter().map(|candidate| candidate.star());
        let stars = points.chain(candidates.arcs.iter().copied());
        let mut stars: Vec<u32> = stars.map(|star| self.in_field[star as usize]).collect();
        stars.sort_unstable();
        stars.dedup();
        stars
    }

    /// Finds the images that the picture of `camera` may show, and replaces the contents of `candidates` with them.
    /// `bounds` is the table of the lens. All visible images are found, and perhaps a few that are not visible.
    pub fn find(
        &self,
        camera: &Camera,
        bounds: &ImageBounds,
        rendition: Rendition,
        candidates: &mut Candidates,
    ) {
        candidates.points.clear();
        candidates.arcs.clear();
        let frustum = Frustum::of(camera, rendition);
        for cell in &self.cells {
            self.append(candidates, cell, &frustum, bounds);
        }
    }

    /// Light of the brightest star of a cell, in the brightest channel.
    fn brightest(&self, cell: &Cell) -> f32 {
        self.lights[cell.stars.start as usize]
    }

    /// Appends the images of a cell that may be visible.
    fn append(
        &self,
        candidates: &mut Candidates,
        cell: &Cell,
        frustum: &Frustum,
        bounds: &ImageBounds,
    ) {
        let direction = frustum.hole_from_sky * cell.middle;
        let beta = ViewAngle::of(direction).radians();
        if bounds.may_be_arc((beta.min(PI - beta) - cell.radius).sin()) {
            self.append_arcs(&mut candidates.arcs, cell, frustum, bounds);
        }
        let azimuth = direction.truncate().normalize_or(DVec2::X);
        for (index, order) in ImageOrder::all().flatten().enumerate() {
            let seen = bounds.seen(index, beta - cell.radius, beta + cell.radius);
            let Some(seen) = seen else {
                // Only without bending: the black sphere hides part of the cell, or this image order does not
                // exist.
                if order.is_straight() {
                    self.append_brighter(&mut candidates.points, cell, index, 0.0);
                }
                break;
            };
            let least = |brightness: f64| (f64::from(MIN_LIGHT) / brightness) as f32 * (1.0 - 1e-6);
            let is_faint = |least: f32| self.brightest(cell) < least && !order.is_straight();
            // The higher image orders are fainter, unless motion or shift brighten another part of the view. Without
            // these the brightness is known before the circle is computed.
            if frustum.is_even() && is_faint(least(seen.brightness)) {
                break;
            }
            let image = ImageCircle::around(azimuth * order.side, &seen, cell.radius);
            let least = least(seen.brightness * frustum.largest_factor(&image));
            if is_faint(least) {
                continue;
            }
            if frustum.may_see(&image) {
                self.append_brighter(&mut candidates.points, cell, index, least);
            }
        }
    }

    /// Appends the stars of a cell that are drawn as arcs, at least in part.
    fn append_arcs(
        &self,
        arcs: &mut Vec<u32>,
        cell: &Cell,
        frustum: &Frustum,
        bounds: &ImageBounds,
    ) {
        let axis = frustum.hole_from_sky.row(2);
        arcs.extend(cell.stars.clone().filter(|&star| {
            let direction = self.stars[star as usize].direction;
            bounds.may_be_arc(axis.cross(direction).length())
        }));
    }

    /// Appends the images, in this image order, of the stars of a cell with at least this light.
    fn append_brighter(&self, points: &mut Vec<Candidate>, cell: &Cell, order: usize, least: f32) {
        let Range { start, end } = cell.stars;
        let lights = &self.lights[start as usize..end as usize];
        let seen = start..start + lights.partition_point(|light| *light >= least) as u32;
        points.extend(seen.map(|star| Candidate::new(star, order)));
    }
}

/// Index of the cell that contains `direction`, sky frame.
fn cell_of(direction: DVec3) -> u32 {
    let (face, u, v) = face_coordinates(direction.as_vec3());
    let [row, column] = [v, u].map(|unit| ((unit * CELLS as f32) as u32).min(CELLS - 1));
    (face as u32 * CELLS + row) * CELLS + column
}

/// Unit vector to the middle of the cell with this index, sky frame.
fn middle_of(cell: u32) -> DVec3 {
    let (face, in_face) = (cell / (CELLS * CELLS), cell % (CELLS * CELLS));
    let (row, column) = (in_face / CELLS, in_face % CELLS);
    let middle = texel_direction(CELLS, face as usize, column, row);
    middle.as_dvec3().normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::View;
    use crate::lens::{Deflection, Lens};
    use crate::shift::Shift;
    use crate::stars::draw::observed;
    use crate::stars::hipparcos;
    use crate::stars::images::{InverseLens, arc_share};
    use lensbake_core::Motion;
    use lensbake_tables::default_atlas;
    use std::collections::HashSet;

    #[test]
    fn no_star_that_is_seen_is_left_out() {
        let field = StarField::new(&hipparcos(), 0.0);
        let cells = Cells::new(&field);
        let in_cells: usize = cells.cells.iter().map(|cell| cell.stars.len()).sum();
        assert_eq!(in_cells, field.stars.len());
        let sorted = |stars: &[PointStar]| {
            let bits = |star: &PointStar| {
                (
                    star.direction.to_array().map(f64::to_bits),
                    star.light.x.to_bits(),
                )
            };
            let mut all: Vec<_> = stars.iter().map(bits).collect();
            all.sort_unstable();
            all
        };
        assert_eq!(sorted(cells.stars()), sorted(&field.stars));
        let (mut seen, mut looked_at, mut arcs) = (0, 0, 0);
        let velocity = |radial, tangential| Motion::Velocity { radial, tangential };
        for (radius, yaw_deg, pitch_deg, roll_deg, fov_deg, method, motion, shift) in [
            (
                25.0,
                0.0,
                0.0,
                0.0,
                90.0,
                Deflection::Lut,
                Motion::Rest,
                Shift::Off,
            ),
            (
                25.0,
                100.0,
                30.0,
                20.0,
                60.0,
                Deflection::Lut,
                Motion::Rest,
                Shift::Off,
            ),
            (
                2.0,
                70.0,
                0.0,
                0.0,
                100.0,
                Deflection::Lut,
                Motion::Rest,
                Shift::Colour,
            ),
            (
                1.2,
                180.0,
                10.0,
                0.0,
                170.0,
                Deflection::Lut,
                Motion::Rest,
                Shift::Off,
            ),
            (
                1000.0,
                0.0,
                0.0,
                45.0,
                10.0,
                Deflection::Lut,
                Motion::Rest,
                Shift::Off,
            ),
            (
                3.0,
                20.0,
                0.0,
                0.0,
                90.0,
                Deflection::Flat,
                Motion::Rest,
                Shift::Off,
            ),
            (
                3.0,
                90.0,
                0.0,
                0.0,
                90.0,
                Deflection::Lut,
                Motion::Orbit,
                Shift::Colour,
            ),
            (
                3.0,
                270.0,
                0.0,
                0.0,
                90.0,
                Deflection::Lut,
                Motion::Orbit,
                Shift::Off,
            ),
            (
                1.0,
                120.0,
                0.0,
                0.0,
                90.0,
                Deflection::Lut,
                Motion::Fall,
                Shift::Brightness,
            ),
            (
                0.1,
                180.0,
                20.0,
                0.0,
                120.0,
                Deflection::Lut,
                Motion::Fall,
                Shift::Off,
            ),
            (
                6.0,
                80.0,
                0.0,
                0.0,
                90.0,
                Deflection::Lut,
                velocity(-0.3, 0.9),
                Shift::Brightness,
            ),
            (
                0.5,
                100.0,
                0.0,
                0.0,
                90.0,
                Deflection::Lut,
                velocity(0.2, -0.7),
                Shift::Off,
            ),
        ] {
            let view = View {
                radius,
                motion,
                heading_deg: 15.0,
                orbit_deg: 40.0,
                latitude_deg: 20.0,
                yaw_deg,
                pitch_deg,
                roll_deg,
                fov_deg,
                width: 480,
                height: 270,
                ..View::default()
            };
            let camera = Camera::new(&view).unwrap();
            let lens = Lens::new(camera, default_atlas(), method).unwrap();
            let inverse = InverseLens::of(&lens);
            let mut candidates = Candidates::default();
            let rendition = Rendition::of(shift);
            let bounds = ImageBounds::of(&inverse, cells.disc_radius);
            cells.find(&camera, &bounds, rendition, &mut candidates);
            let kept: HashSet<Candidate> = candidates.points.iter().copied().collect();
            assert_eq!(
                kept.len(),
                candidates.points.len(),
                "an image is there twice"
            );
            let from_axis = |star: &PointStar| {
                ViewAngle::of(camera.sky_from_hole.transpose() * star.direction).sin
            };
            for (index, star) in (0..).zip(&cells.stars) {
                let is_arc = arc_share(from_axis(star), cells.disc_radius) > 0.0;
                assert_eq!(candidates.arcs.contains(&index), is_arc, "{star:?}");
                arcs += usize::from(is_arc);
            }
            for (star, order) in images_seen(&lens, &inverse, rendition, &cells) {
                assert!(
                    kept.contains(&Candidate::new(star, order)),
                    "r {radius}, yaw {yaw_deg}, {motion}: {:?} by order {order}",
                    cells.stars[star as usize]
                );
                seen += 1;
            }
            println!(
                "r {radius} {motion} {}: {} for {seen}",
                shift.name(),
                kept.len()
            );
            looked_at += kept.len();
        }
        assert!(seen > 20_000, "{seen}");
        assert!(arcs > 10, "{arcs}");
        assert!(looked_at < 3 * seen, "{looked_at} for {seen}");
    }

    /// The images in the picture with at least the light [`MIN_LIGHT`], as (index of the star, index of the image
    /// order).
    fn images_seen(
        lens: &Lens,
        inverse: &InverseLens,
        rendition: Rendition,
        cells: &Cells,
    ) -> Vec<(u32, usize)> {
        let camera = &lens.camera;
        let mut seen = Vec::new();
        for (index, star) in (0..).zip(&cells.stars) {
            let direction = camera.sky_from_hole.transpose() * star.direction;
            let images = inverse.images(direction, cells.disc_radius);
            for (order, image) in images.flatten().enumerate() {
                let Some(image) = image else { continue };
                let light = star.light * image.magnification as f32;
                let (direction, light) = observed(lens, rendition, image.direction, light);
                if light.max_element() >= MIN_LIGHT && camera.pixel(direction).is_some() {
                    seen.push((index, order));
                }
            }
        }
        seen
    }
}
