//! The chart's data: one line a method and observer.

use super::rays::Watcher;
use super::{Entry, Section};
use lensbake_report::csv::{quoted, statistics};

const HEAD: &str = "observer,family,name,knobs,source,bytes,ns_per_ray,ns_spread,\
                    max_rad,p999_rad,rms_rad,median_on_sky_rad,max_px,p999_px,rms_px,lost_rays";

/// All sections as CSV text with a head line.
pub fn text(sections: &[Section]) -> String {
    let lines = sections.iter().flat_map(|section| {
        let observer = match section.watcher {
            Watcher::Far => "far".to_owned(),
            Watcher::View(r) => r.to_string(),
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

fn line(observer: &str, entry: &Entry) -> String {
    let card = &entry.card;
    format!(
        "{observer},{},{},{},{},{},{:.2},{:.3},{},{:.3e},{},{}",
        card.family.name(),
        quoted(&card.name),
        quoted(&card.knobs),
        quoted(card.source),
        entry.bytes,
        entry.ns,
        entry.spread,
        statistics(&entry.radians),
        entry.median_on_sky,
        statistics(&entry.pixels),
        entry.lost,
    )
}
