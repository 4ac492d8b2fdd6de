//! The chart's data: one line a method and observer.

use super::rays::Watcher;
use super::{Entry, Section};
use lensbake_tables::statistics::ErrorStatistics;

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

fn statistics(errors: &ErrorStatistics) -> String {
    let ErrorStatistics { max, p999, rms } = errors;
    format!("{max:.3e},{p999:.3e},{rms:.3e}")
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_and_quotes_are_quoted() {
        assert_eq!(quoted("plain"), "plain");
        assert_eq!(quoted("a, b"), "\"a, b\"");
        assert_eq!(quoted("say \"a\""), "\"say \"\"a\"\"\"");
    }
}
