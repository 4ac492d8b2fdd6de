//! A time measured over and over.

/// A time over several rounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// Median, ns.
    pub ns: f64,
    /// Relative spread: 1.48 × the median absolute deviation, over the median.
    pub spread: f64,
}

impl Time {
    /// Of these times, ns; NaN of none.
    pub fn of(times: &[f64]) -> Self {
        let ns = median(times.to_vec());
        let deviation = median(times.iter().map(|t| (t - ns).abs()).collect());
        Time {
            ns,
            spread: 1.48 * deviation / ns,
        }
    }
}

/// The middle one of `values`, of two the greater; NaN of none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_round_changes_neither_time_nor_spread_much() {
        let time = Time::of(&[10.0, 10.1, 9.9, 10.0, 90.0]);
        assert_eq!(time.ns, 10.0);
        assert!(time.spread < 0.02);
    }
}
