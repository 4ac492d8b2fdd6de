//! The results as a table for a terminal and as CSV, one line per star.

use super::{Departure, Track};

/// The header lines of the table.
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

/// The line of a star as drawn by the CPU.
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

/// The line of a star as drawn by the GPU called `name`; empty if no GPU drew it.
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

/// The header line of the CSV file. Departures are fractions of 1, and RMS except for the worst; `point_gpu` is
/// empty if no GPU drew the star.
pub const CSV_HEAD: &str = "ra_deg,dec_deg,magnitude,at_brightest,frames,point,point_worst,point_gpu,texel_frames,texel_filtered,texel_one_ray\n";

/// The line of a star in the CSV file.
pub fn csv_line(track: &Track) -> String {
    let star = &track.subject.star;
    let point = track.point();
    let on_gpu = track.on_gpu.map(|off| format!("{:.3e}", off.rms));
    format!(
        "{:.4},{:.4},{:.3},{:.3},{},{:.3e},{:.3e},{},{},{:.4},{:.4}\n",
        star.right_ascension.to_degrees(),
        star.declination.to_degrees(),
        star.magnitude,
        track.peak(),
        track.frames.len(),
        point.rms,
        point.worst,
        on_gpu.unwrap_or_default(),
        track.texel_frames().count(),
        track.filtered().rms,
        track.nearest().rms,
    )
}
