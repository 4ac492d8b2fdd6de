//! Which methods beat the default row.

use super::{MeasuredMethod, Section};

/// The entries that beat the first one, the default row: their largest error is smaller (in rad, the unit of the
/// error that a table's header states), they are faster by more than the noise of the run, and they need no more
/// bytes per frame.
pub fn better_than_default(section: &Section) -> Vec<&MeasuredMethod> {
    let Some((default, others)) = section.entries.split_first() else {
        return Vec::new();
    };
    let noise = section.noise();
    others
        .iter()
        .filter(|other| {
            let accurate = other.radians.max < default.radians.max;
            let fast = other.ns * (1.0 + noise) < default.ns;
            accurate && fast && other.bytes <= default.bytes
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method_chart::rays::ChartObserver;
    use crate::methods::{Family, MethodInfo};
    use lensbake_tables::statistics::ErrorStatistics;

    fn entry(ns: f64, error: f64, bytes: usize) -> MeasuredMethod {
        let statistics = ErrorStatistics::of([error]).unwrap();
        MeasuredMethod {
            info: MethodInfo {
                name: String::new(),
                knobs: String::new(),
                source: "",
                family: Family::Table,
                landmark: false,
            },
            bytes,
            ns,
            spread: 0.05,
            radians: statistics,
            pixels: statistics,
            median_on_sky: error,
            lost: 0,
        }
    }

    #[test]
    fn only_more_accurate_and_faster_beyond_noise_and_no_larger_beats_the_default() {
        let rivals = |other: MeasuredMethod| {
            let section = Section {
                observer: ChartObserver::Far,
                entries: vec![entry(10.0, 1.0, 512), other],
            };
            better_than_default(&section).len()
        };
        assert_eq!(rivals(entry(5.0, 0.5, 512)), 1);
        assert_eq!(rivals(entry(9.8, 0.5, 512)), 0, "within the noise");
        assert_eq!(rivals(entry(5.0, 1.5, 512)), 0, "less accurate");
        assert_eq!(rivals(entry(5.0, 0.5, 1024)), 0, "larger");
    }
}
