//! The errors as comma-separated values.

use super::{Entry, MeanError, Study};
use lensbake_report::csv::quoted;

/// The first line.
pub const HEAD: &str =
    "sky,view,sampling,whole_screen,whole_linear,edge_screen,edge_linear,edge_pixels\n";

/// Two lines of a study before the sky of this name.
pub fn lines(sky: &str, study: &Study) -> String {
    let line = |sampling, entry: &Entry| {
        let (whole, edge) = (entry.error.whole, entry.error.beside_edge);
        let fields = |mean: MeanError| format!("{:.3},{:.3}", mean.screen, mean.linear);
        format!(
            "{sky},{},{sampling},{},{},{}\n",
            quoted(&study.case.name),
            fields(whole),
            fields(edge),
            edge.pixels
        )
    };
    line("filtered", &study.filtered) + &line("single", &study.single)
}
