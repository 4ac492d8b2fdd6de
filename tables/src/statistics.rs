//! Summary statistics of a set of errors, as all programs report them.

use std::fmt;

/// Summary statistics of the absolute values of a set of errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorStatistics {
    /// Largest error.
    pub max: f64,
    /// 99.9th percentile.
    pub p999: f64,
    /// Root mean square.
    pub rms: f64,
}

impl ErrorStatistics {
    /// The statistics of `errors`; their signs do not matter. A NaN counts as an infinite error. `None` if there
    /// are no errors.
    pub fn of(errors: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sizes: Vec<f64> = errors
            .into_iter()
            .map(|e| if e.is_nan() { f64::INFINITY } else { e.abs() })
            .collect();
        let count = sizes.len();
        let rms = (sizes.iter().map(|e| e * e).sum::<f64>() / count as f64).sqrt();
        sizes.sort_unstable_by(f64::total_cmp);
        let rank = (0.999 * count as f64).ceil() as usize;
        Some(ErrorStatistics {
            max: *sizes.last()?,
            p999: *sizes.get(rank.saturating_sub(1))?,
            rms,
        })
    }
}

impl fmt::Display for ErrorStatistics {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "max {:9.3e}   99.9 % {:9.3e}   RMS {:9.3e}",
            self.max, self.p999, self.rms
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_a_known_set() {
        let errors = (1..=1000).map(|i| {
            if i % 2 == 0 {
                f64::from(i)
            } else {
                -f64::from(i)
            }
        });
        let statistics = ErrorStatistics::of(errors).unwrap();
        assert_eq!((statistics.max, statistics.p999), (1000.0, 999.0));
        assert!((statistics.rms - (333_833.5_f64).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn nan_is_not_lost_and_nothing_is_nothing() {
        let statistics = ErrorStatistics::of([1.0, f64::NAN]).unwrap();
        assert_eq!(statistics.max, f64::INFINITY);
        assert_eq!(ErrorStatistics::of([]), None);
    }
}
