//! Where an observer is, and the redshift factor of the radial motion.

use crate::U_PHOTON;

/// u, w = 2/3 − u and 1 − u of a radius, each to full relative accuracy.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// u = 1/r.
    pub(super) u: f64,
    /// w = 2/3 − u.
    pub(super) w: f64,
    /// 1 − u.
    pub(super) one_minus_u: f64,
    /// √(1 − u), 0 at and below the horizon.
    pub(super) lapse: f64,
}

impl Place {
    /// The place at radius `r`.
    pub(super) fn at(r: f64) -> Self {
        let one_minus_u = (r - 1.0) / r;
        Place {
            u: 1.0 / r,
            w: (2.0 * r - 3.0) / (3.0 * r),
            one_minus_u,
            lapse: one_minus_u.max(0.0).sqrt(),
        }
    }

    pub(super) const INFINITY: Place = Place {
        u: 0.0,
        w: U_PHOTON,
        one_minus_u: 1.0,
        lapse: 1.0,
    };
}

/// A radial motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Redshift {
    /// z_out, the redshift factor of light from straight away.
    pub(super) z_out: f64,
    /// (1 − z_out)/u.
    pub(super) gain_out: f64,
}

impl Redshift {
    pub(super) fn at_rest(place: Place) -> Self {
        Redshift {
            z_out: place.lapse,
            gain_out: 1.0 / (1.0 + place.lapse),
        }
    }

    pub(super) fn in_fall(place: Place) -> Self {
        let speed = place.u.sqrt();
        Redshift {
            z_out: 1.0 + speed,
            gain_out: -1.0 / speed,
        }
    }
}
