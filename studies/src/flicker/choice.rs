//! The choice of stars: the brightest that come into the picture, and among them those for a closer look.

use super::{Expected, FlickerError, Track, expected};
use lensbake_render::lens::Lens;
use lensbake_render::stars::{Catalogue, PointStar, Star, StarField};
use rayon::prelude::*;

/// Least fraction of the frames in which a star's first image must be in the picture.
const MIN_PART: f64 = 0.1;
/// Largest number of stars that are tried per star wanted.
const TRIES: usize = 32;

/// A star and its analytic curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// The star in the catalogue.
    pub star: Star,
    /// A star field with this star alone.
    pub field: StarField,
    /// What each frame should contain of it; `None` for a frame that does not count.
    pub curve: Vec<Option<Expected>>,
}

impl Subject {
    /// `star` with the angular radius `disc_radius` (rad), drawn as `point`, in the frames `lenses`.
    ///
    /// # Errors
    /// [`FlickerError::Observer`] for an observer at infinity; a camera never is one.
    pub fn new(
        star: Star,
        point: PointStar,
        disc_radius: f64,
        lenses: &[Lens],
    ) -> Result<Self, FlickerError> {
        let curve = lenses.par_iter().map(|lens| expected(lens, &point));
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
        seen.count() as f64 >= (MIN_PART * self.curve.len() as f64).max(1.0)
    }
}

/// The `count` brightest stars of `catalogue` that come into the pictures of `lenses`, or fewer if not enough do.
/// `looked_at` is called after each star tried, with the number chosen so far.
///
/// # Errors
/// [`FlickerError::NoStar`] if no star comes into the pictures.
pub fn choose(
    catalogue: &Catalogue,
    lenses: &[Lens],
    count: usize,
    looked_at: impl Fn(usize),
) -> Result<Vec<Subject>, FlickerError> {
    let reach = half_height(lenses);
    let field = StarField::new(catalogue, 0.0);
    let mut chosen = Vec::new();
    let stars = catalogue.stars().iter().zip(field.stars);
    let near = stars.filter(|(star, _)| star.declination.abs() < reach);
    for (star, point) in near.take(TRIES * count) {
        let subject = Subject::new(*star, point, field.disc_radius, lenses)?;
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

/// Indices in `tracks` of the stars that are also drawn by the GPU and shown in the figure: those with the
/// highest, the median and the lowest peak magnification.
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

/// Half the height of the picture as an angle, rad. A star farther from the plane of the orbit is outside the
/// picture.
fn half_height(lenses: &[Lens]) -> f64 {
    lenses.first().map_or(0.0, |lens| {
        let camera = &lens.camera;
        (0.5 * f64::from(camera.height) * camera.down.length()).atan()
    })
}
