//! Which stars are looked at: the brightest that come into the picture; and which of them closer.

use super::{Expected, FlickerError, Track, expected};
use crate::scene::Scene;
use crate::stars::{Catalogue, PointStar, Star, StarField};
use rayon::prelude::*;

/// The part of the frames in which a star's first image is in the picture, at the least.
const LEAST_PART: f64 = 0.1;
/// Stars that are looked at for each that is wanted, before the rest is given up.
const TRIES: usize = 4;

/// A star and its analytic curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// The star as the catalogue has it.
    pub star: Star,
    /// The field that has it alone.
    pub field: StarField,
    /// What each frame should hold of it; `None` where that is not said.
    pub curve: Vec<Option<Expected>>,
}

impl Subject {
    /// `star` of an angular radius (rad), drawn as `point`, in the frames `scenes`.
    ///
    /// # Errors
    /// [`FlickerError::Observer`] for an observer at infinity, which no camera is.
    pub fn new(
        star: Star,
        point: PointStar,
        disc_radius: f64,
        scenes: &[Scene],
    ) -> Result<Self, FlickerError> {
        let curve = scenes.par_iter().map(|scene| expected(scene, &point));
        Ok(Subject {
            star,
            curve: curve.collect::<Result<_, _>>()?,
            field: StarField {
                stars: vec![point],
                disc_radius,
            },
        })
    }

    /// The star as it is drawn.
    pub fn point(&self) -> &PointStar {
        &self.field.stars[0]
    }

    fn comes_into_view(&self) -> bool {
        let seen = self.curve.iter().flatten().filter(|at| at.has_first);
        seen.count() as f64 >= (LEAST_PART * self.curve.len() as f64).max(1.0)
    }
}

/// The `count` brightest stars of `catalogue` that come into the pictures of `scenes`, or as many as there
/// are. `looked_at` is called after each star, with how many were chosen so far.
///
/// # Errors
/// [`FlickerError::NoStar`] if there is none.
pub fn choose(
    catalogue: &Catalogue,
    scenes: &[Scene],
    count: usize,
    looked_at: impl Fn(usize),
) -> Result<Vec<Subject>, FlickerError> {
    let reach = half_height(scenes);
    let field = StarField::new(catalogue, 0.0);
    let mut chosen = Vec::new();
    let stars = catalogue.stars().iter().zip(field.stars);
    let near = stars.filter(|(star, _)| star.declination.abs() < reach);
    for (star, point) in near.take(TRIES * count) {
        let subject = Subject::new(*star, point, field.disc_radius, scenes)?;
        if subject.comes_into_view() {
            chosen.push(subject);
        }
        looked_at(chosen.len());
        if chosen.len() == count {
            break;
        }
    }
    if chosen.is_empty() {
        return Err(FlickerError::NoStar);
    }
    Ok(chosen)
}

/// The places in `tracks` of those that are drawn by the GPU too and shown in the figure: the star that the
/// hole brightens the most, the one in the middle, and the one that it brightens the least.
pub fn closer_look(tracks: &[Track]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..tracks.len()).collect();
    order.sort_by(|&a, &b| tracks[b].peak().total_cmp(&tracks[a].peak()));
    let mut chosen: Vec<usize> = [0, order.len() / 2, order.len().saturating_sub(1)]
        .into_iter()
        .filter_map(|place| order.get(place).copied())
        .collect();
    chosen.dedup();
    chosen
}

/// Half the height of the picture, rad: a star farther from the plane of the orbit is not in it.
fn half_height(scenes: &[Scene]) -> f64 {
    scenes.first().map_or(0.0, |scene| {
        let camera = &scene.camera;
        (0.5 * f64::from(camera.height) * camera.down.length()).atan()
    })
}
