//! What was found as a table for a terminal, a line a star.

use super::{Departure, Track};

/// The lines above the table: what is in its columns.
pub fn head() -> String {
    format!(
        "{:>38} {:>20} {:>36}\n{:>8} {:>8} {:>6} {:>13} {:>6} {:>6} {:>6} {:>7} {:>13} {:>14}\n",
        "star",
        "as a point",
        "as a texel, first image in view",
        "RA deg",
        "Dec deg",
        "mag",
        "at brightest",
        "frames",
        "RMS %",
        "worst",
        "frames",
        "filtered, RMS",
        "one ray, RMS",
    )
}

/// The line of a star, as the CPU drew it.
pub fn line(track: &Track) -> String {
    let star = &track.subject.star;
    let Departure { rms, worst } = track.point();
    format!(
        "{:>8.3} {:>8.3} {:>6.2} {:>13} {:>6} {:>6.4} {:>6.4} {:>7} {:>13.1} {:>14.1}\n",
        star.right_ascension.to_degrees(),
        star.declination.to_degrees(),
        star.magnitude,
        format!("{:.2} times", track.peak()),
        track.frames.len(),
        100.0 * rms,
        100.0 * worst,
        track.texel_frames().count(),
        100.0 * track.filtered().rms,
        100.0 * track.nearest().rms,
    )
}

/// The line of a star as a GPU of this name drew it; nothing if none did.
pub fn gpu_line(track: &Track, name: &str) -> String {
    let star = &track.subject.star;
    track.on_gpu.map_or(String::new(), |off| {
        format!(
            "{:>8.3} {:>8.3} on {name}: RMS {:.4} %, worst {:.4} %\n",
            star.right_ascension.to_degrees(),
            star.declination.to_degrees(),
            100.0 * off.rms,
            100.0 * off.worst,
        )
    })
}
