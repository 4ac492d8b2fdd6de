//! The chart's data: one line a method.

use super::{Chart, Entry};
use lensbake_report::csv::{quoted, statistics, time};

const HEAD: &str = "family,method,bytes_a_frame,loads_a_ray,operations_a_ray,\
                    gpu_ns_a_ray,gpu_spread,wall_ns_a_ray,wall_spread,\
                    max_px,p999_px,rms_px,max_rad,p999_rad,rms_rad,other_fates,\
                    adapter,width,height,radius,rounds";

/// The chart as CSV text with a head line. A clock that the adapter lacks leaves its fields empty.
pub fn text(chart: &Chart) -> String {
    let lines = chart.entries.iter().map(|entry| line(chart, entry));
    std::iter::once(HEAD.to_owned())
        .chain(lines)
        .map(|line| line + "\n")
        .collect()
}

fn line(chart: &Chart, entry: &Entry) -> String {
    let (width, height) = chart.size;
    format!(
        "{},{},{},{},{},{},{},{},{},{},{},{width},{height},{},{}",
        quoted(entry.family.name()),
        quoted(&entry.name),
        entry.cost.bytes,
        entry.cost.loads,
        entry.cost.operations,
        entry.times.gpu.map_or(",".to_owned(), time),
        time(entry.times.wall),
        statistics(&entry.errors.pixels),
        statistics(&entry.errors.radians),
        entry.errors.other_fates,
        quoted(&chart.adapter),
        chart.radius,
        chart.rounds,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Family, FrameTimes};
    use crate::diff::TraceStatistics;
    use crate::model::Cost;
    use lensbake_report::Time;
    use lensbake_tables::statistics::ErrorStatistics;

    #[test]
    fn every_line_has_the_fields_of_the_head() {
        let errors = ErrorStatistics::of([1.0]).unwrap();
        let time = Time {
            ns: 2.0,
            spread: 0.1,
        };
        let entry = |gpu| Entry {
            name: "64 texels".into(),
            family: Family::Hermite,
            cost: Cost {
                bytes: 624,
                loads: 2,
                operations: 99,
            },
            times: FrameTimes { gpu, wall: time },
            errors: TraceStatistics {
                no_value: 0,
                radians: errors,
                pixels: errors,
                other_fates: 0,
            },
        };
        let chart = Chart {
            adapter: "an adapter".into(),
            software: false,
            size: (4, 3),
            radius: 25.0,
            rounds: 1,
            entries: vec![entry(None), entry(Some(time))],
        };
        let text = text(&chart);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        // The family's name holds a comma of its own.
        let fields = |line: &str| line.replace("row, Hermite", "").split(',').count();
        assert!(lines.iter().all(|line| fields(line) == fields(HEAD)));
    }
}
