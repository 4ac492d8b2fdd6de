//! The chart's data as CSV, one line per method.

use super::{Chart, MeasuredDeflection};
use crate::figure::csv::{quoted, statistics, time};

const HEAD: &str = "family,method,bytes_per_frame,loads_per_ray,operations_per_ray,\
                    gpu_ns_per_ray,gpu_spread,wall_ns_per_ray,wall_spread,\
                    max_px,p999_px,rms_px,max_rad,p999_rad,rms_rad,other_outcomes,\
                    adapter,width,height,radius,rounds";

/// The chart as CSV text with a header line. The fields of a clock that the adapter lacks are empty.
pub fn text(chart: &Chart) -> String {
    let lines = chart.entries.iter().map(|entry| line(chart, entry));
    std::iter::once(HEAD.to_owned())
        .chain(lines)
        .map(|line| line + "\n")
        .collect()
}

fn line(chart: &Chart, entry: &MeasuredDeflection) -> String {
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
        entry.errors.differing_outcomes,
        quoted(&chart.adapter),
        chart.radius,
        chart.rounds,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Time;
    use crate::gpu_chart::{Family, FrameTimes};
    use lensbake_render::diff::TraceStatistics;
    use lensbake_render::model::Cost;
    use lensbake_tables::statistics::ErrorStatistics;

    #[test]
    fn every_line_has_the_fields_of_the_head() {
        let errors = ErrorStatistics::of([1.0]).unwrap();
        let time = Time {
            ns: 2.0,
            spread: 0.1,
        };
        let entry = |gpu| MeasuredDeflection {
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
                differing_outcomes: 0,
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
        // The family's name contains a comma.
        let fields = |line: &str| line.replace("row, Hermite", "").split(',').count();
        assert!(lines.iter().all(|line| fields(line) == fields(HEAD)));
    }
}
