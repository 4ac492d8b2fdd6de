//! Stars sorted into cells of the sky, so that a frame looks only at those that it may show: a cell is left
//! out if none of its images falls into the picture, and of each cell all stars that are too faint there.

use super::StarField;
use super::images::{FAINTEST, Lens, Way, point_distance, view_direction};
use super::kernel::REACHES;
use crate::camera::{Camera, Sight};
use crate::sky::{face_coordinates, texel_direction};
use glam::{DVec2, DVec3};
use lensbake_tables::inverse::Image;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Cells along the edge of each face of a cube.
const CELLS: u32 = 10;
/// Cells that a thread takes at a time.
const CELLS_A_TASK: usize = 50;

/// The stars of a field by cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    cells: Vec<Cell>,
}

#[derive(Debug, Clone, PartialEq)]
struct Cell {
    /// A unit vector in the sky frame, and the greatest angle of a star from it, rad.
    middle: DVec3,
    radius: f64,
    /// Light in the brightest channel and index of each star, the brightest first.
    stars: Vec<(f32, u32)>,
}

/// What a frame may show.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Candidates {
    /// Images that may be seen as points.
    pub points: Vec<Candidate>,
    /// Indices of the stars that may be seen as arcs.
    pub arcs: Vec<u32>,
}

/// An image of a star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The star's index.
    pub star: u32,
    /// The way its light takes.
    pub way: Way,
}

impl Cells {
    /// The cells of `field`.
    pub fn new(field: &StarField) -> Self {
        let mut cells: Vec<Cell> = (0..6 * CELLS * CELLS)
            .map(|i| {
                let (face, in_face) = (i / (CELLS * CELLS), i % (CELLS * CELLS));
                let (row, column) = (in_face / CELLS, in_face % CELLS);
                let middle = texel_direction(CELLS, face as usize, column, row);
                Cell {
                    middle: middle.as_dvec3().normalize(),
                    radius: 0.0,
                    stars: Vec::new(),
                }
            })
            .collect();
        for (index, star) in (0..).zip(&field.stars) {
            let (face, u, v) = face_coordinates(star.direction.as_vec3());
            let place = |unit: f32| ((unit * CELLS as f32) as u32).min(CELLS - 1);
            let cell = (face as u32 * CELLS + place(v)) * CELLS + place(u);
            let cell = &mut cells[cell as usize];
            cell.radius = cell.radius.max(star.direction.angle_between(cell.middle));
            cell.stars.push((star.light.max_element(), index));
        }
        cells.retain_mut(|cell| {
            cell.stars.sort_by(|a, b| b.0.total_cmp(&a.0));
            !cell.stars.is_empty()
        });
        Cells { cells }
    }

    /// What the picture of `camera` may show through `lens`, and perhaps a few images that it does not.
    pub fn candidates(&self, camera: &Camera, lens: &Lens, disc_radius: f64) -> Candidates {
        let frustum = Frustum::of(camera);
        let least = point_distance(disc_radius);
        let parts: Vec<Candidates> = self
            .cells
            .par_chunks(CELLS_A_TASK)
            .map(|cells| {
                let mut candidates = Candidates::default();
                for cell in cells {
                    cell.append(&mut candidates, camera, &frustum, lens, least);
                }
                candidates
            })
            .collect();
        Candidates {
            points: parts
                .iter()
                .flat_map(|part| &part.points)
                .copied()
                .collect(),
            arcs: parts.iter().flat_map(|part| &part.arcs).copied().collect(),
        }
    }
}

impl Cell {
    /// Appends what of it may be seen; nearer than `least` to the axis, rad, there are no points.
    fn append(
        &self,
        candidates: &mut Candidates,
        camera: &Camera,
        frustum: &Frustum,
        lens: &Lens,
        least: f64,
    ) {
        let direction = camera.sky_from_hole.transpose() * self.middle;
        let beta = Sight::of(direction).angle();
        if beta.min(PI - beta) - self.radius < 2.0 * least {
            let stars = self.stars.iter().map(|(_, star)| *star);
            candidates.arcs.extend(stars);
        }
        let angles = [
            (beta - self.radius).max(least),
            beta,
            (beta + self.radius).min(PI - least),
        ];
        for way in Way::all().flatten() {
            let Some(stars) = self.seen(frustum, lens, direction, angles, way) else {
                break;
            };
            let images = stars.iter().map(|&(_, star)| Candidate { star, way });
            candidates.points.extend(images);
        }
    }

    /// Those of its stars that may be seen by `way`; `None` if no star is bright enough for this way or a
    /// longer one. The cell reaches over `angles` from the direction of the hole: least, middle, most.
    fn seen(
        &self,
        frustum: &Frustum,
        lens: &Lens,
        direction: DVec3,
        angles: [f64; 3],
        way: Way,
    ) -> Option<&[(f32, u32)]> {
        let [Some(near), Some(middle), Some(far)] =
            angles.map(|angle| lens.image(way.sky_angle(angle)))
        else {
            // The undeflected sky: beside the black sphere, or another way than the straight one.
            return way.is_straight().then_some(&self.stars);
        };
        // How much the cell is stretched about the axis, at the most; along the view angle it is squeezed.
        let about_axis = |image: Image, angle: f64| image.theta.sin() / angle.sin();
        let stretch = about_axis(near, angles[0]).max(about_axis(far, angles[2]));
        let brightest = stretch * near.stretch.max(far.stretch);
        let bright = |light: f32| f64::from(light) * brightest >= f64::from(FAINTEST);
        let bright = self.stars.partition_point(|(light, _)| bright(*light));
        if bright == 0 && !way.is_straight() {
            return None;
        }
        let azimuth = direction.truncate().normalize_or(DVec2::X) * way.side;
        let seen = frustum.may_see(
            view_direction(azimuth, middle.theta),
            self.radius * stretch.max(1.0),
        );
        Some(if seen { &self.stars[..bright] } else { &[] })
    }
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
        let counted: usize = cells.cells.iter().map(|cell| cell.stars.len()).sum();
        assert_eq!(counted, field.stars.len());
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
            let candidates = cells.candidates(&camera, &lens, field.disc_radius);
            let kept: HashSet<(u32, u32)> = candidates.points.iter().map(key).collect();
            assert_eq!(
                kept.len(),
                candidates.points.len(),
                "an image is there twice"
            );
            for (star, way) in images_seen(&camera, &lens, &field) {
                assert!(
                    kept.contains(&key(&Candidate { star, way })),
                    "r {radius}, yaw {yaw_deg}: {:?} by {way:?}",
                    field.stars[star as usize]
                );
                seen += 1;
            }
            looked_at += kept.len();
        }
        assert!(seen > 20_000, "{seen}");
        assert!(looked_at < 3 * seen, "{looked_at} for {seen}");
    }

    fn key(candidate: &Candidate) -> (u32, u32) {
        let turn = 2 * candidate.way.windings + u32::from(candidate.way.side < 0.0);
        (candidate.star, turn)
    }

    /// The images that fall into the picture and are bright enough.
    fn images_seen(camera: &Camera, lens: &Lens, field: &StarField) -> Vec<(u32, Way)> {
        let mut seen = Vec::new();
        for (index, star) in (0..).zip(&field.stars) {
            let direction = camera.sky_from_hole.transpose() * star.direction;
            let images = lens.images(direction, field.disc_radius);
            for (image, way) in images.flatten().zip(Way::all().flatten()) {
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
