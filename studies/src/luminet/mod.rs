//! Luminet's picture: a thin disc as an observer far away sees it (Luminet 1979, Astron. Astrophys. 75, 228). Curves of
//! constant radius, redshift and flux of the direct and the secondary image, by the closed form of the orbit.
//!
//! Lengths in the curves are in units of M, as in the literature: M is half of the Schwarzschild radius.

mod compare;
mod contour;
pub mod csv;
pub mod figure;
mod image;
mod labels;

pub use compare::{Comparison, comparisons};
pub use image::{FarDisc, Image, Seen};

use contour::Grid;
use lensbake_core::accretion::INNERMOST_STABLE;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, TAU};

/// r/M in units of r/r_s.
pub const M_PER_RADIUS: f64 = 2.0;
/// The radii whose images are drawn, M. The last one is the outer rim of the disc.
pub const RADII_M: [f64; 4] = [6.0, 10.0, 20.0, 30.0];
/// The redshifts z whose curves are drawn.
pub const REDSHIFTS: [f64; 10] = [-0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0];
/// The fluxes whose curves are drawn, in units of the greatest flux that the disc emits.
pub const FLUXES: [f64; 12] = [
    0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1,
];

/// Columns of the grid, along the azimuth.
const COLUMNS: usize = 241;
/// Rows of the grid, along the radius.
const ROWS: usize = 81;
/// Points of an isoradial curve.
const POINTS: usize = 180;
/// The images are about this much wider than high; points along them are the denser by it on the left and right.
const FLATTENING: f64 = 3.0;

/// What is constant along a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The radius in the disc, M.
    Radius,
    /// The redshift z.
    Redshift,
    /// The flux that is seen, in units of the greatest flux that the disc emits.
    Flux,
}

/// A curve in the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What is constant along it.
    pub kind: Kind,
    /// The image that it belongs to.
    pub image: Image,
    /// The constant value.
    pub level: f64,
    /// Its points, to the right and up from the hole, M.
    pub points: Vec<[f64; 2]>,
}

/// The brightest point of the direct image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Brightest {
    /// Its radius in the disc, M.
    pub radius: f64,
    /// Its place in the picture, M.
    pub place: [f64; 2],
    /// Its redshift z.
    pub redshift: f64,
    /// The flux that is seen of it, in units of the greatest flux that the disc emits.
    pub flux: f64,
}

/// The curves of a disc.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// All curves. Those of redshift and flux in the secondary image are left out where the disc hides it.
    pub curves: Vec<Curve>,
    /// The brightest point.
    pub brightest: Brightest,
}

impl Kind {
    /// Name.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Radius => "radius",
            Kind::Redshift => "redshift",
            Kind::Flux => "flux",
        }
    }
}

/// The curves of the disc from 6 M to the last of [`RADII_M`], whose axis is inclined by `inclination` (rad) to the line
/// of sight, above 0 and below π/2.
pub fn curves(inclination: f64) -> Curves {
    let disc = FarDisc { inclination };
    let mut curves = Vec::new();
    for image in [Image::Direct, Image::Secondary] {
        curves.extend(RADII_M.map(|level| isoradial(&disc, image, level)));
        let sheet = Sheet::new(&disc, image);
        let redshift = |seen: &Seen| seen.redshift - 1.0;
        curves.extend(sheet.curves(Kind::Redshift, &REDSHIFTS, redshift));
        curves.extend(sheet.curves(Kind::Flux, &FLUXES, |seen| seen.flux));
    }
    Curves {
        curves,
        brightest: brightest(&disc),
    }
}

/// The image of the circle of radius `level` (M).
fn isoradial(disc: &FarDisc, image: Image, level: f64) -> Curve {
    let azimuths = (0..=POINTS).map(|i| azimuth(i as f64 / POINTS as f64));
    let seen = azimuths.map(|azimuth| disc.seen(image, level / M_PER_RADIUS, azimuth));
    Curve {
        kind: Kind::Radius,
        image,
        level,
        points: seen.map(|seen| in_m(seen.place)).collect(),
    }
}

/// The azimuth after this part of a turn from below the hole, rad.
fn azimuth(part: f64) -> f64 {
    let (sin, cos) = (TAU * part - FRAC_PI_2).sin_cos();
    sin.atan2(cos * FLATTENING)
}

fn in_m(place: [f64; 2]) -> [f64; 2] {
    place.map(|length| length * M_PER_RADIUS)
}

/// One image of the disc, on a grid of azimuths in the picture and radii in the disc.
struct Sheet<'a> {
    disc: &'a FarDisc,
    image: Image,
    nodes: Vec<Seen>,
}

impl<'a> Sheet<'a> {
    fn new(disc: &'a FarDisc, image: Image) -> Self {
        let nodes = (0..ROWS * COLUMNS).into_par_iter().map(|node| {
            let at = [(node % COLUMNS) as f64, (node / COLUMNS) as f64];
            disc.seen(image, Self::radius(at), Self::azimuth(at))
        });
        Sheet {
            disc,
            image,
            nodes: nodes.collect(),
        }
    }

    /// The azimuth of a column.
    fn azimuth([column, _]: [f64; 2]) -> f64 {
        azimuth(column / (COLUMNS - 1) as f64)
    }

    /// From rim to rim, denser at the inner one, where the flux changes most.
    fn radius([_, row]: [f64; 2]) -> f64 {
        let part = row / (ROWS - 1) as f64;
        INNERMOST_STABLE + (outer() - INNERMOST_STABLE) * part * part
    }

    /// The visible parts of the curves on which `value` has one of `levels`.
    fn curves(&self, kind: Kind, levels: &[f64], value: impl Fn(&Seen) -> f64) -> Vec<Curve> {
        let grid = Grid::new(COLUMNS, ROWS, |column, row| {
            value(&self.nodes[row * COLUMNS + column])
        });
        let parts = levels.iter().flat_map(|&level| {
            let lines = grid.contours(level);
            let parts = lines.into_iter().flat_map(|line| self.visible(&line));
            parts.map(move |points| (level, points)).collect::<Vec<_>>()
        });
        let curve = |(level, points)| Curve {
            kind,
            image: self.image,
            level,
            points,
        };
        parts.map(curve).collect()
    }

    /// The parts of a line on the grid that the direct image of the disc does not hide, in the picture (M).
    fn visible(&self, line: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
        let places = line.iter().map(|&at| {
            let azimuth = Self::azimuth(at);
            let seen = self.disc.seen(self.image, Self::radius(at), azimuth);
            (!self.is_hidden(seen.place, azimuth)).then(|| in_m(seen.place))
        });
        let places: Vec<Option<[f64; 2]>> = places.collect();
        let parts = places.split(Option::is_none);
        let parts = parts.map(|part| part.iter().flatten().copied().collect::<Vec<_>>());
        parts.filter(|part| part.len() > 1).collect()
    }

    fn is_hidden(&self, [x, y]: [f64; 2], azimuth: f64) -> bool {
        let rim = |radius| self.disc.impact_parameter(Image::Direct, radius, azimuth);
        let b = x.hypot(y);
        self.image == Image::Secondary && b > rim(INNERMOST_STABLE) && b < rim(outer())
    }
}

/// The outer radius of the disc, r_s.
fn outer() -> f64 {
    RADII_M[RADII_M.len() - 1] / M_PER_RADIUS
}

/// The brightest point of the direct image: of a coarse grid on its left, then by ever smaller steps.
fn brightest(disc: &FarDisc) -> Brightest {
    let seen = |[azimuth, radius]: [f64; 2]| disc.seen(Image::Direct, radius, azimuth);
    let flux = |at: [f64; 2]| seen(at).flux;
    let starts = (0..400).map(|i| {
        let (column, row) = (f64::from(i % 20), f64::from(i / 20));
        [
            FRAC_PI_2 + column * 0.16,
            INNERMOST_STABLE + 0.2 * (row + 1.0),
        ]
    });
    let best = |a: [f64; 2], b: [f64; 2]| if flux(b) > flux(a) { b } else { a };
    let mut at = starts.reduce(best).unwrap_or([FRAC_PI_2, outer()]);
    let mut step = 0.2;
    while step > 1e-9 {
        let [azimuth, radius] = at;
        let around = [
            [azimuth - step, radius],
            [azimuth + step, radius],
            [azimuth, (radius - step).max(INNERMOST_STABLE)],
            [azimuth, radius + step],
        ];
        let next = around.into_iter().fold(at, best);
        if next == at {
            step *= 0.5;
        }
        at = next;
    }
    let found = seen(at);
    Brightest {
        radius: at[1] * M_PER_RADIUS,
        place: in_m(found.place),
        redshift: found.redshift - 1.0,
        flux: found.flux,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_have_the_value_of_their_level() {
        let found = curves(80f64.to_radians());
        let disc = FarDisc {
            inclination: 80f64.to_radians(),
        };
        let mut checked = 0;
        for curve in &found.curves {
            if curve.kind != Kind::Flux || curve.image != Image::Direct {
                continue;
            }
            for [x, y] in &curve.points {
                let (azimuth, b) = (y.atan2(*x), x.hypot(*y) / M_PER_RADIUS);
                // The radius by bisection: the impact parameter grows with it.
                let (mut low, mut high) = (INNERMOST_STABLE, outer());
                for _ in 0..50 {
                    let middle = 0.5 * (low + high);
                    match disc.impact_parameter(Image::Direct, middle, azimuth) < b {
                        true => low = middle,
                        false => high = middle,
                    }
                }
                let flux = disc.seen(Image::Direct, low, azimuth).flux;
                let off = (flux - curve.level).abs();
                assert!(off < 0.01, "{} {flux}", curve.level);
                checked += 1;
            }
        }
        assert!(checked > 500, "{checked}");
    }

    #[test]
    fn the_brightest_point_is_on_the_left_near_the_inner_rim() {
        let found = brightest(&FarDisc {
            inclination: 80f64.to_radians(),
        });
        assert!(found.place[0] < 0.0 && found.redshift < 0.0);
        assert!((6.0..10.0).contains(&found.radius), "{found:?}");
        // Face-on it is where the flux over (1 + z)⁴ is greatest, with 1 + z = (1 − 3M/r)^(-1/2).
        let from_above = brightest(&FarDisc { inclination: 1e-6 });
        let flux = |r: f64| lensbake_core::accretion::flux(0.5 * r) * (1.0 - 3.0 / r).powi(2);
        for r in [from_above.radius - 0.01, from_above.radius + 0.01] {
            assert!(flux(r) < from_above.flux);
        }
    }
}
