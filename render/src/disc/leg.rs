//! One leg of a ray: from the sky to its periapsis, or to the observer; and the share of a patch of the picture in which
//! it meets the disc.
//!
//! A leg is parametrised by the phase ψ from infinity. In the plane of the ray, with the outward axis Z of the observer
//! and the unit vector e towards the view direction, its point at ψ has the direction cos(φ_∞ − ψ) Z + sin(φ_∞ − ψ) e.
//! The leg on which light comes in to the observer is the mirror image: it is the outward leg of the ray that leaves in
//! the opposite direction, followed beyond the observer, with −e in place of e.
//!
//! **The crossing.** F(ψ), the height of that direction above the plane of the disc, has opposite signs where the leg
//! passes the outer rim and where it passes the inner rim, or its end if that comes first, exactly if it crosses the disc
//! between them: less than half a turn lies between them.
//!
//! **The share of a patch.** The heights at both ends are smooth functions of the view direction, also for a disc that is
//! seen edge-on and covers less than a pixel, whereas the radius of the crossing is not. So the edges of the disc's image
//! are where a height is 0, and the share of the patch is the difference of the shares on which the two are positive.
//! Beside the shadow's edge φ_∞ grows without bound, images of all orders crowd together, and the heights oscillate within
//! a patch. φ_∞ grows like the logarithm of the distance from that edge, so each image covers a known range of distances.

use super::coverage::{Crowded, positive_share};
use crate::footprint::Patch;
use glam::DVec2;
use std::f64::consts::PI;

/// A leg turns by this angle within a patch, rad, where its images count as crowded.
pub(crate) const FAST_TURN: f64 = 0.25;

/// A quantity with its derivative by the view angle θ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Varying {
    pub value: f64,
    pub slope: f64,
}

/// The axis of the disc in the plane of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AxisInPlane {
    /// Component along the outward axis Z.
    pub out: f64,
    /// Component along e.
    pub aside: f64,
    /// Component across the plane, in the direction in which the azimuth of e grows.
    pub across: f64,
}

/// One end of the part of a leg that can meet the disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum End {
    /// At the phase of a rim.
    Rim(Varying),
    /// At the phase of the periapsis.
    Periapsis(Varying),
    /// At the observer.
    Observer {
        /// Phase of the observer, rad.
        phase: f64,
        /// Component of the disc's axis along the unit vector towards which the leg leaves him, across the outward axis.
        ahead: f64,
    },
}

impl End {
    fn phase(self) -> f64 {
        match self {
            End::Rim(phase) | End::Periapsis(phase) => phase.value,
            End::Observer { phase, .. } => phase,
        }
    }
}

/// A leg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Leg {
    /// (cos φ_∞, sin φ_∞).
    pub sky: DVec2,
    /// dφ_∞/dθ.
    pub turn: f64,
    /// The axis of the disc.
    pub axis: AxisInPlane,
    /// The end nearer to the sky.
    pub far: End,
    /// The end nearer to the hole.
    pub near: End,
}

/// Where a leg meets the disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    /// The share of the patch in which it does.
    pub share: f64,
    /// Its phase ψ, rad.
    pub phase: f64,
    /// The shares in which the heights at the far end and at the near end are positive.
    pub above: [f64; 2],
}

impl Leg {
    /// Where the leg meets the disc within `patch`; `None` if no part of the patch sees that. `from_shadow` is the distance of its middle
    /// from the edge of the shadow, rad, for a leg that leaves for the sky.
    pub(crate) fn crossing(&self, patch: &Patch, from_shadow: Option<f64>) -> Option<Crossing> {
        let (low, high) = (self.far.phase(), self.near.phase());
        if low >= high {
            return None;
        }
        let in_plane = self.phase_in_plane();
        let above = [self.far, self.near].map(|end| self.share_above(end, patch));
        let turn = self.turn.abs() * patch.gradient();
        let (share, phase) = match from_shadow {
            Some(middle) if turn > FAST_TURN => {
                let crowded = Crowded {
                    middle,
                    half: 0.5 * patch.gradient(),
                    phase: in_plane,
                    growth: self.turn.abs() * middle,
                };
                crowded.share(low, high)
            }
            // Of phases that differ by half a turn, the one nearest to the disc.
            _ if 2.0 * in_plane - PI > low + high => ((above[0] - above[1]).abs(), in_plane - PI),
            _ => ((above[0] - above[1]).abs(), in_plane),
        };
        (share > 0.0).then_some(Crossing {
            share,
            phase: phase.clamp(low, high),
            above,
        })
    }

    /// The direction of the point at `phase`.
    pub(crate) fn direction(&self, phase: f64) -> DVec2 {
        let (sin, cos) = phase.sin_cos();
        DVec2::new(
            self.sky.x * cos + self.sky.y * sin,
            self.sky.y * cos - self.sky.x * sin,
        )
    }

    /// The phase in [0, π) at which the leg is in the plane of the disc.
    fn phase_in_plane(&self) -> f64 {
        let AxisInPlane { out, aside, .. } = self.axis;
        let cross = out * self.sky.x + aside * self.sky.y;
        let along = aside * self.sky.x - out * self.sky.y;
        cross.abs().atan2(along * cross.signum())
    }

    /// The share of `patch` in which the leg's end is above the disc.
    fn share_above(&self, end: End, patch: &Patch) -> f64 {
        let AxisInPlane { out, aside, across } = self.axis;
        match end {
            End::Observer { ahead, .. } => {
                // An observer in the plane of the disc has the height 0; the sign is that of the leg just beyond him.
                let height = if out == 0.0 { ahead } else { out };
                if height > 0.0 { 1.0 } else { 0.0 }
            }
            End::Rim(phase) | End::Periapsis(phase) => {
                let at = self.direction(phase.value);
                let height = out * at.x + aside * at.y;
                let radial = (aside * at.x - out * at.y) * (self.turn - phase.slope);
                let tangential = across * at.y / patch.view_angle.sin.max(1e-12);
                let slope = |step: DVec2| radial * step.x + tangential * step.y;
                positive_share(height, slope(patch.right), slope(patch.down))
            }
        }
    }
}
