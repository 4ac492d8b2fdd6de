//! Stars sorted into cells of the sky, so that a frame looks only at those that it may show: a cell is left
//! out if none of its images falls into the picture, and of each cell all stars that are too faint there.

use super::images::{FAINTEST, Lens, Way, view_direction};
use super::kernel::REACHES;
use super::ways::{Seen, Ways};
use super::{PointStar, StarField};
use crate::camera::{Camera, Sight};
use crate::sky::{face_coordinates, texel_direction};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::ops::Range;

/// Cells along the edge of each face of a cube.
const CELLS: u32 = 10;
/// Places along the edge of a cell by which its stars are sorted.
const PLACES: u32 = 256;

/// The stars of a field by cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    cells: Vec<Cell>,
    /// Cell by cell; and in a cell neighbours stand near each other: so do their images in the memory of who
    /// draws them in this order.
    stars: Vec<PointStar>,
    /// The light of each in its brightest channel.
    lights: Vec<f32>,
    disc_radius: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Cell {
    /// A unit vector in the sky frame, and the greatest angle of a star from it, rad.
    middle: DVec3,
    radius: f64,
    /// Which stars are in it.
    stars: Range<u32>,
    /// The most light of a star.
    brightest: f32,
}

/// What a frame may show.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Candidates {
    /// Images that may be seen as points.
    pub points: Vec<Candidate>,
    /// Which of [`Cells::stars`] may be seen as arcs.
    pub arcs: Vec<u32>,
}

/// An image of a star, as `shaders/stars.wgsl` reads it: in the lower 24 bits which of [`Cells::stars`] the
/// star is, above them the way of its light as [`Way::all`] counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct Candidate(u32);

impl Candidate {
    fn new(star: u32, way: usize) -> Self {
        Candidate(star | (way as u32) << 24)
    }
}

impl Cells {
    /// The cells of `field`.
    pub fn new(field: &StarField) -> Self {
        let place = |direction: DVec3| {
            let (face, u, v) = face_coordinates(direction.as_vec3());
            let fine = [v, u].map(|unit| {
                let fine = (unit * (CELLS * PLACES) as f32) as u32;
                fine.min(CELLS * PLACES - 1)
            });
            let [row, column] = fine.map(|fine| fine / PLACES);
            let cell = (face as u32 * CELLS + row) * CELLS + column;
            (cell, interleaved(fine.map(|fine| fine % PLACES)))
        };
        let placed = |star: &PointStar| (place(star.direction), *star);
        let mut placed: Vec<((u32, u32), PointStar)> = field.stars.iter().map(placed).collect();
        placed.sort_by_key(|(place, _)| *place);
        let mut next = 0;
        let cells = placed.chunk_by(|(a, _), (b, _)| a.0 == b.0).map(|stars| {
            let first = next;
            next += stars.len() as u32;
            let middle = middle_of(stars[0].0.0);
            let from_middle = |(_, star): &(_, PointStar)| star.direction.angle_between(middle);
            let lights = stars.iter().map(|(_, star)| star.light.max_element());
            Cell {
                middle,
                radius: stars.iter().map(from_middle).fold(0.0, f64::max),
                stars: first..next,
                brightest: lights.fold(0.0, f32::max),
            }
        });
        let cells = cells.collect();
        let stars: Vec<PointStar> = placed.into_iter().map(|(_, star)| star).collect();
        Cells {
            cells,
            lights: stars.iter().map(|star| star.light.max_element()).collect(),
            stars,
            disc_radius: field.disc_radius,
        }
    }

    /// The angular radius of each star, rad.
    pub fn disc_radius(&self) -> f64 {
        self.disc_radius
    }

    /// All stars of the field, in the order in which candidates name them.
    pub fn stars(&self) -> &[PointStar] {
        &self.stars
    }

    /// Puts into `candidates`, in place of what is there, what the picture of `camera` may show through `lens`,
    /// and perhaps a few images that it does not.
    pub fn find(&self, camera: &Camera, lens: &Lens, candidates: &mut Candidates) {
        candidates.points.clear();
        candidates.arcs.clear();
        let frustum = Frustum::of(camera);
        let ways = Ways::of(lens, self.disc_radius);
        for cell in &self.cells {
            self.append(candidates, cell, camera, &frustum, &ways);
        }
    }

    /// Appends what may be seen of a cell.
    fn append(
        &self,
        candidates: &mut Candidates,
        cell: &Cell,
        camera: &Camera,
        frustum: &Frustum,
        ways: &Ways,
    ) {
        let direction = camera.sky_from_hole.transpose() * cell.middle;
        let beta = Sight::of(direction).angle();
        if ways.may_be_arc(beta.min(PI - beta) - cell.radius) {
            candidates.arcs.extend(cell.stars.clone());
        }
        let azimuth = direction.truncate().normalize_or(DVec2::X);
        for (index, way) in Way::all().flatten().enumerate() {
            let seen = ways.seen(index, beta - cell.radius, beta + cell.radius);
            let Some(seen) = seen else {
                // The undeflected sky: beside the black sphere, or another way than the straight one.
                if way.is_straight() {
                    self.append_brighter(&mut candidates.points, cell, index, 0.0);
                }
                break;
            };
            let least = (f64::from(FAINTEST) / seen.brightness) as f32 * (1.0 - 1e-6);
            if cell.brightest < least && !way.is_straight() {
                break;
            }
            if frustum.may_see_cell(azimuth * way.side, &seen, cell.radius) {
                self.append_brighter(&mut candidates.points, cell, index, least);
            }
        }
    }

    /// Appends those stars of a cell by one way that have at least this light: without a branch, for there is
    /// no telling which have.
    fn append_brighter(&self, points: &mut Vec<Candidate>, cell: &Cell, way: usize, least: f32) {
        let mut end = points.len();
        points.resize(end + cell.stars.len(), Candidate(0));
        for star in cell.stars.clone() {
            points[end] = Candidate::new(star, way);
            end += usize::from(self.lights[star as usize] >= least);
        }
        points.truncate(end);
    }
}

/// The unit vector to the middle of the cell of this index, sky frame.
fn middle_of(cell: u32) -> DVec3 {
    let (face, in_face) = (cell / (CELLS * CELLS), cell % (CELLS * CELLS));
    let (row, column) = (in_face / CELLS, in_face % CELLS);
    let middle = texel_direction(CELLS, face as usize, column, row);
    middle.as_dvec3().normalize()
}

/// The bits of both by turns (Morton's order).
fn interleaved([row, column]: [u32; 2]) -> u32 {
    (0..PLACES.ilog2()).fold(0, |bits, i| {
        bits | (column >> i & 1) << (2 * i) | (row >> i & 1) << (2 * i + 1)
    })
}

/// The directions that a picture shows, and a margin for the widest kernel.
struct Frustum {
    /// Unit normals of its sides, inwards.
    sides: [DVec3; 4],
    margin: f64,
}

impl Frustum {
    fn of(camera: &Camera) -> Self {
        let half = |step: DVec3, side: u32| step * (0.5 * f64::from(side));
        let (right, down) = (
            half(camera.right, camera.width),
            half(camera.down, camera.height),
        );
        let forward = camera.forward;
        let side = |towards: DVec3| {
            // Perpendicular to the plane through the camera and an edge of the picture.
            let edge = forward + towards;
            (forward * towards.length_squared() - towards * forward.dot(edge)).normalize()
        };
        Frustum {
            sides: [side(right), side(-right), side(down), side(-down)],
            margin: REACHES[REACHES.len() - 1] * camera.right.length(),
        }
    }

    /// Whether the image of a cell of this `radius` may be in the picture.
    fn may_see_cell(&self, azimuth: DVec2, seen: &Seen, radius: f64) -> bool {
        let along = 0.5 * (seen.farthest - seen.nearest);
        let middle = 0.5 * (seen.farthest + seen.nearest);
        let about = radius * seen.about_axis.max(1.0);
        self.may_see(view_direction(azimuth, middle), along.hypot(about))
    }

    /// Whether a circle of `radius` (rad) about a unit `direction` may be in the picture.
    fn may_see(&self, direction: DVec3, radius: f64) -> bool {
        let reach = (radius + self.margin).min(0.5 * PI).sin();
        self.sides.iter().all(|side| side.dot(direction) > -reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::View;
    use crate::scene::{Method, Scene};
    use crate::stars::hipparcos;
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
        let (mut seen, mut looked_at) = (0, 0);
        for (radius, yaw_deg, pitch_deg, roll_deg, fov_deg, method) in [
            (25.0, 0.0, 0.0, 0.0, 90.0, Method::Lut),
            (25.0, 100.0, 30.0, 20.0, 60.0, Method::Lut),
            (2.0, 70.0, 0.0, 0.0, 100.0, Method::Lut),
            (1.2, 180.0, 10.0, 0.0, 170.0, Method::Lut),
            (1000.0, 0.0, 0.0, 45.0, 10.0, Method::Lut),
            (3.0, 20.0, 0.0, 0.0, 90.0, Method::Flat),
        ] {
            let view = View {
                radius,
                orbit_deg: 40.0,
                latitude_deg: 20.0,
                yaw_deg,
                pitch_deg,
                roll_deg,
                fov_deg,
                width: 480,
                height: 270,
            };
            let camera = Camera::new(&view).unwrap();
            let scene = Scene::new(camera, default_atlas(), method).unwrap();
            let lens = Lens::of(&scene).unwrap();
            let mut candidates = Candidates::default();
            cells.find(&camera, &lens, &mut candidates);
            let kept: HashSet<Candidate> = candidates.points.iter().copied().collect();
            assert_eq!(
                kept.len(),
                candidates.points.len(),
                "an image is there twice"
            );
            for (star, way) in images_seen(&camera, &lens, &cells) {
                assert!(
                    kept.contains(&Candidate::new(star, way)),
                    "r {radius}, yaw {yaw_deg}: {:?} by way {way}",
                    cells.stars[star as usize]
                );
                seen += 1;
            }
            looked_at += kept.len();
        }
        assert!(seen > 20_000, "{seen}");
        assert!(looked_at < 3 * seen, "{looked_at} for {seen}");
    }

    /// The images that fall into the picture and are bright enough.
    fn images_seen(camera: &Camera, lens: &Lens, cells: &Cells) -> Vec<(u32, usize)> {
        let mut seen = Vec::new();
        for (index, star) in (0..).zip(&cells.stars) {
            let direction = camera.sky_from_hole.transpose() * star.direction;
            let images = lens.images(direction, cells.disc_radius);
            for (way, image) in images.flatten().enumerate() {
                let Some(image) = image else { continue };
                let light = star.light.max_element() * image.magnification as f32;
                if light >= FAINTEST && camera.pixel(image.direction).is_some() {
                    seen.push((index, way));
                }
            }
        }
        seen
    }
}
