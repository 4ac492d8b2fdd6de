//! The chart's data as CSV, one line per method and observer.

use super::rays::ChartObserver;
use super::{MeasuredMethod, Section};
use crate::figure::csv::{quoted, statistics};

const HEAD: &str = "observer,family,name,knobs,source,bytes,ns_per_ray,ns_spread,\
                    max_rad,p999_rad,rms_rad,median_on_sky_rad,max_px,p999_px,rms_px,lost_rays";

/// All sections as CSV text with a header line.
pub fn text(sections: &[Section]) -> String {
    let lines = sections.iter().flat_map(|section| {
        let observer = match section.observer {
            ChartObserver::Far => "far".to_owned(),
            ChartObserver::View(r) => r.to_string(),
        };
        section
            .entries
            .iter()
            .map(move |entry| line(&observer, entry))
    });
    std::iter::once(HEAD.to_owned())
        .chain(lines)
        .map(|line| line + "\n")
        .collect()
}

fn line(observer: &str, entry: &MeasuredMethod) -> String {
    let info = &entry.info;
    format!(
        "{observer},{},{},{},{},{},{:.2},{:.3},{},{:.3e},{},{}",
        info.family.name(),
        quoted(&info.name),
        quoted(&info.knobs),
        quoted(info.source),
        entry.bytes,
        entry.ns,
        entry.spread,
        statistics(&entry.radians),
        entry.median_on_sky,
        statistics(&entry.pixels),
        entry.lost,
    )
}
