//! The benchmark as a table for a terminal, as CSV and as JSON.

use super::contender::{
    ANISOTROPIC, CONTENDERS, Contender, FILTERED, FILTERED_DISC, FILTERED_FALL, FILTERED_ORBIT,
    FINEST, FINEST_DISC, FLAT, LUT, LUT_FALL, LUT_ORBIT,
};
use super::{Bench, MeasuredContender};
use crate::figure::csv::quoted;
use crate::figure::median;
use serde::Serialize;

/// The table for a terminal, with the ratios of times at each size.
pub fn text(bench: &Bench) -> String {
    let mut lines = vec![
        format!(
            "{}{}",
            bench.adapter,
            if bench.software {
                ": software, its times are no GPU's"
            } else {
                ""
            }
        ),
        format!(
            "{:>10}  {:<28} {:>9} {:>9} {:>9} {:>9} {:>8}  {:>8}",
            "size", "method", "fps", "least fps", "T_ray", "by wall", "/ flat", "error px"
        ),
    ];
    lines.extend(bench.rows().map(|row| {
        let gpu = row
            .gpu_ns_per_ray
            .map_or("–".into(), |ns| format!("{ns:.2} ns"));
        format!(
            "{:>10}  {:<28} {:>9.2} {:>9.2} {:>9} {:>9} {:>8.2}  {:>8.1e}",
            format!("{}x{}", row.width, row.height),
            row.method,
            row.average_fps,
            row.minimum_fps,
            gpu,
            format!("{:.2} ns", row.wall_ns_per_ray),
            row.over_flat,
            row.error_px,
        )
    }));
    lines.extend(bench.sizes().map(|size| ratios(bench, size)));
    lines.into_iter().map(|line| line + "\n").collect()
}

/// The ratios of times that the project promises, and that can be compared between machines.
fn ratios(bench: &Bench, size: (u32, u32)) -> String {
    let ratio = |what: Contender, over: Contender| {
        let (what, over) = (bench.entry(size, what), bench.entry(size, over));
        format!("{} / {} {:.2}", what.name(), over.name(), what.over(over))
    };
    let ratios = [
        ratio(LUT, FLAT),
        ratio(FINEST, LUT),
        ratio(FILTERED, LUT),
        ratio(LUT.with_stars(), LUT),
        ratio(FILTERED.with_stars(), FILTERED),
        ratio(LUT_FALL, LUT),
        ratio(LUT_ORBIT, LUT),
        ratio(FILTERED_FALL, FILTERED),
        ratio(FILTERED_ORBIT, FILTERED),
        ratio(FILTERED_DISC, FILTERED),
        ratio(FINEST_DISC, FILTERED_DISC),
        ratio(ANISOTROPIC, FILTERED),
        ratio(LUT.in_other_pass(), LUT),
        ratio(FILTERED.in_other_pass(), FILTERED),
        ratio(ANISOTROPIC.in_other_pass(), ANISOTROPIC),
    ];
    format!("{}x{}: {}", size.0, size.1, ratios.join(", "))
}

/// One line per contender and size, with a header line. The field of a clock that the adapter lacks is empty.
pub fn csv(bench: &Bench) -> String {
    const HEAD: &str = "width,height,method,frames,average_fps,minimum_fps,gpu_ns_per_ray,\
                        wall_ns_per_ray,wall_spread,over_flat,error_px,adapter";
    let lines = bench.rows().map(|row| {
        format!(
            "{},{},{},{},{:.3},{:.3},{},{:.4},{:.4},{:.4},{:.4e},{}",
            row.width,
            row.height,
            quoted(&row.method),
            row.frames,
            row.average_fps,
            row.minimum_fps,
            row.gpu_ns_per_ray
                .map_or(String::new(), |ns| format!("{ns:.4}")),
            row.wall_ns_per_ray,
            row.wall_spread,
            row.over_flat,
            row.error_px,
            quoted(&bench.adapter),
        )
    });
    std::iter::once(HEAD.to_owned())
        .chain(lines)
        .map(|line| line + "\n")
        .collect()
}

/// The benchmark as a JSON object.
///
/// # Errors
/// [`serde_json::Error`]; none occurs for a benchmark.
pub fn json(bench: &Bench) -> serde_json::Result<String> {
    #[derive(Serialize)]
    struct All<'a> {
        adapter: &'a str,
        software: bool,
        entries: Vec<Row>,
    }
    let all = All {
        adapter: &bench.adapter,
        software: bench.software,
        entries: bench.rows().collect(),
    };
    serde_json::to_string_pretty(&all).map(|text| text + "\n")
}

/// One line of the report.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Row {
    width: u32,
    height: u32,
    method: String,
    frames: usize,
    average_fps: f64,
    minimum_fps: f64,
    gpu_ns_per_ray: Option<f64>,
    wall_ns_per_ray: f64,
    wall_spread: f64,
    over_flat: f64,
    error_px: f64,
}

impl MeasuredContender {
    pub(super) fn name(&self) -> String {
        self.contender.name(self.pass)
    }

    /// The ratio of its time to that of `other`: the median over the rounds.
    fn over(&self, other: &MeasuredContender) -> f64 {
        let rounds = self.rounds.iter().zip(&other.rounds);
        median(rounds.map(|(ours, theirs)| ours / theirs).collect())
    }
}

impl Bench {
    pub(super) fn sizes(&self) -> impl Iterator<Item = (u32, u32)> {
        self.entries
            .iter()
            .step_by(CONTENDERS.len())
            .map(|entry| entry.size)
    }

    pub(super) fn entry(&self, size: (u32, u32), contender: Contender) -> &MeasuredContender {
        let mut all = self.entries.iter();
        all.find(|entry| entry.size == size && entry.contender == contender)
            .expect("every contender is measured at every size")
    }

    fn rows(&self) -> impl Iterator<Item = Row> {
        self.entries.iter().enumerate().map(|(i, entry)| {
            let measured = entry.measured;
            Row {
                width: entry.size.0,
                height: entry.size.1,
                method: entry.name(),
                frames: measured.frames,
                average_fps: measured.average_fps,
                minimum_fps: measured.minimum_fps,
                gpu_ns_per_ray: measured.gpu_ns_per_ray,
                wall_ns_per_ray: measured.wall_ns_per_ray,
                wall_spread: measured.wall_spread,
                over_flat: entry.over(self.entry(entry.size, FLAT)),
                error_px: self.errors[i % CONTENDERS.len()],
            }
        })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::bench::Measured;
    use lensbake_render::gpu::Pass;

    /// A benchmark of this time by the GPU's clock.
    pub(in crate::bench) fn bench(gpu_ns_per_ray: Option<f64>) -> Bench {
        let entry = |contender| MeasuredContender {
            size: (4, 3),
            contender,
            pass: Pass::Compute,
            measured: Measured {
                frames: 2,
                average_fps: 50.0,
                minimum_fps: 40.0,
                gpu_ns_per_ray,
                wall_ns_per_ray: 7.0,
                wall_spread: 0.1,
            },
            rounds: vec![6.0, 7.0],
        };
        Bench {
            adapter: "an adapter, named".into(),
            software: true,
            errors: vec![0.5; CONTENDERS.len()],
            entries: CONTENDERS.map(entry).into(),
        }
    }

    #[test]
    fn all_three_hold_every_contender() {
        for bench in [bench(None), bench(Some(6.0))] {
            let csv = csv(&bench);
            assert_eq!(csv.lines().count(), 1 + CONTENDERS.len());
            let fields = |line: &str| line.replace("adapter, named", "").split(',').count();
            assert!(csv.lines().all(|line| fields(line) == 12), "{csv}");
            let json: serde_json::Value = serde_json::from_str(&json(&bench).unwrap()).unwrap();
            assert_eq!(json["entries"].as_array().unwrap().len(), CONTENDERS.len());
            assert_eq!(json["entries"][1]["method"], "lut");
            let text = text(&bench);
            assert!(
                CONTENDERS
                    .iter()
                    .all(|one| text.contains(&one.name(Pass::Compute))),
                "{text}"
            );
        }
    }
}
