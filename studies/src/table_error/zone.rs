//! The radii whose errors are stated and judged separately.

use lensbake_core::Observer;

/// A range of radii. A table's error grows below the horizon, slowly at first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zone {
    /// Above the horizon.
    Above,
    /// From the horizon down to [`Zone::R_DEEP`].
    Below,
    /// Below [`Zone::R_DEEP`].
    Deep,
}

impl Zone {
    /// All zones, from far to near.
    pub const ALL: [Zone; 3] = [Zone::Above, Zone::Below, Zone::Deep];
    /// Radius below which a larger error is allowed.
    pub const R_DEEP: f64 = 0.1;

    /// The zone of `observer`.
    pub fn of(observer: &Observer) -> Self {
        if !observer.is_inside() {
            Zone::Above
        } else if observer.radius() >= Zone::R_DEEP {
            Zone::Below
        } else {
            Zone::Deep
        }
    }

    /// Its radii, in words for a report.
    pub fn name(self) -> &'static str {
        match self {
            Zone::Above => "r > 1",
            Zone::Below => "0.1 <= r <= 1",
            Zone::Deep => "r < 0.1",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_horizon_belongs_to_the_zone_below_it() {
        for (r, zone) in [
            (f64::INFINITY, Zone::Above),
            (1.0 + 1e-12, Zone::Above),
            (1.0, Zone::Below),
            (0.11, Zone::Below),
            (0.09, Zone::Deep),
        ] {
            assert_eq!(Zone::of(&Observer::falling(r).unwrap()), zone, "{r}");
        }
        for (index, zone) in Zone::ALL.into_iter().enumerate() {
            assert_eq!(zone as usize, index);
        }
    }
}
