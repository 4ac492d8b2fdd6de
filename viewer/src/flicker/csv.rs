//! What was found as comma-separated values, a line a star.

use super::Track;

/// The first line. Departures are RMS and parts of 1; `gpu` is empty where no GPU drew the star.
pub const HEAD: &str = "ra_deg,dec_deg,magnitude,at_brightest,frames,point,point_worst,point_gpu,texel_frames,texel_filtered,texel_one_ray\n";

/// The line of a star.
pub fn line(track: &Track) -> String {
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
