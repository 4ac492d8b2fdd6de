//! The errors as CSV.

use super::{MeanError, SampledPicture, Study};
use crate::figure::csv::quoted;

/// The header line.
pub const HEAD: &str =
    "sky,view,sampling,whole_screen,whole_linear,edge_screen,edge_linear,edge_pixels\n";

/// The three lines of a study with the sky of this name, one per sampling.
pub fn lines(sky: &str, study: &Study) -> String {
    let line = |sampling, entry: &SampledPicture| {
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
    line("filtered", &study.filtered)
        + &line("anisotropic", &study.anisotropic)
        + &line("single", &study.single)
}
