//! How far a drawing is from the curve.

/// How far what is found is from what is expected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// Root mean square over the frames of found / expected − 1.
    pub rms: f64,
    /// The largest of any frame.
    pub worst: f64,
}

impl Departure {
    /// Of the ratios found / expected, one a frame; 0 of none.
    pub fn of(ratios: impl IntoIterator<Item = f64>) -> Self {
        let (mut squares, mut worst, mut count) = (0.0, 0.0_f64, 0_u32);
        for ratio in ratios {
            let off = (ratio - 1.0).abs();
            squares += off * off;
            worst = worst.max(off);
            count += 1;
        }
        Departure {
            rms: (squares / f64::from(count.max(1))).sqrt(),
            worst,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_mean_square_is_about_one_and_not_about_the_mean() {
        let off = Departure::of([1.1, 0.9, 1.1, 1.3]);
        assert!((off.rms - 0.03_f64.sqrt()).abs() < 1e-12, "{off:?}");
        assert!((off.worst - 0.3).abs() < 1e-12, "{off:?}");
        assert!((Departure::of([2.0; 7]).rms - 1.0).abs() < 1e-12);
        assert_eq!(Departure::of([]).rms, 0.0);
    }
}
