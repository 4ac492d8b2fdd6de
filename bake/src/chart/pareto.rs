//! Which methods no other beats, and which beat the default row.

use super::{Entry, Section};

/// Indices of the entries that no other beats in both time and `error`, fastest first.
pub fn front(entries: &[Entry], error: impl Fn(&Entry) -> f64) -> Vec<usize> {
    let points: Vec<_> = entries
        .iter()
        .map(|entry| (entry.ns, error(entry)))
        .collect();
    lensbake_report::front(&points)
}

/// The entries that beat the first, the default row: smaller in the largest error (rad, what a table's
/// header promises) and faster by more than the run's noise, at no more bytes a frame.
pub fn better_than_default(section: &Section) -> Vec<&Entry> {
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
    use crate::chart::rays::Watcher;
    use crate::methods::{Card, Family};
    use lensbake_tables::statistics::ErrorStatistics;

    fn entry(ns: f64, error: f64, bytes: usize) -> Entry {
        let statistics = ErrorStatistics::of([error]).unwrap();
        Entry {
            card: Card {
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
    fn the_front_is_a_staircase() {
        let entries: Vec<Entry> = [(3.0, 1.0), (1.0, 5.0), (2.0, 6.0), (4.0, 0.5), (5.0, 0.7)]
            .map(|(ns, error)| entry(ns, error, 0))
            .into();
        assert_eq!(front(&entries, |e| e.radians.max), [1, 0, 3]);
    }

    #[test]
    fn only_more_accurate_and_faster_beyond_noise_and_no_larger_beats_the_default() {
        let rivals = |other: Entry| {
            let section = Section {
                watcher: Watcher::Far,
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
