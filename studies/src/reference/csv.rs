//! The errors as CSV.

use super::{DiscPicture, DiscStudy, MeanError, SampledPicture, Study};
use crate::figure::csv::quoted;

/// The header line.
pub const HEAD: &str =
    "sky,view,sampling,whole_screen,whole_linear,edge_screen,edge_linear,edge_pixels\n";

/// The three lines of a study with the sky of this name, one per sampling.
pub fn lines(sky: &str, study: &Study) -> String {
    let line = |sampling, entry: &SampledPicture| {
        let (whole, edge) = (entry.error.whole, entry.error.beside_edge);
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

/// The header line of the errors with a disc.
pub const DISC_HEAD: &str = "sky,view,picture,whole_screen,whole_linear,edge_screen,edge_linear,edge_pixels,rims_screen,\
rims_linear,rim_pixels,largest_screen,column,row\n";

/// The lines of a study with the sky of this name, one per picture.
pub fn disc_lines(sky: &str, study: &DiscStudy) -> String {
    let line = |entry: &DiscPicture| {
        let [column, row] = entry.largest_at;
        let (whole, edge, rims) = (entry.error.whole, entry.error.beside_edge, entry.on_rims);
        format!(
            "{sky},{},{},{},{},{},{},{},{:.1},{column},{row}\n",
            quoted(&study.case.name),
            entry.by.name(),
            fields(whole),
            fields(edge),
            edge.pixels,
            fields(rims),
            rims.pixels,
            entry.largest,
        )
    };
    study.pictures.iter().map(line).collect()
}

fn fields(mean: MeanError) -> String {
    format!("{:.3},{:.3}", mean.screen, mean.linear)
}
