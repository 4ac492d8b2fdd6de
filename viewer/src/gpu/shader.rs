//! The shader text of a frame, put together from the parts that differ and the parts that do not.

use super::stars::keep;
use crate::scene::{Method, Sampling};
use lensbake_tables::{Interpolation, lookup};

/// What a dispatch finds out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// The light of each pixel.
    Picture,
    /// Where each pixel's light comes from.
    Trace,
    /// How far the light by the table and by direct integration are apart, amplified; whatever the
    /// scene's own method is.
    Difference,
}

impl Output {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Output::Picture => "picture",
            Output::Trace => "trace",
            Output::Difference => "difference",
        }
    }

    /// Whether it looks at the sky.
    pub fn sees_sky(self) -> bool {
        self != Output::Trace
    }
}

/// Where a dispatch writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Store {
    /// To a buffer of one tile, in 32-bit floats: to be read back.
    Buffer,
    /// To a texture of the whole picture, in 16-bit floats: to be shown.
    Texture,
}

/// The entry points of a shader: one, or the programs of a filtered picture, one for each
/// [`crate::filtered::Need`].
pub fn entry_points(sampling: Sampling, output: Output) -> &'static [&'static str] {
    match (output, sampling) {
        (Output::Picture, Sampling::Single) => &["picture"],
        (Output::Picture, Sampling::Filtered) => &["one_tap", "one_ray", "many_rays"],
        (Output::Trace, _) => &["trace"],
        (Output::Difference, _) => &["difference"],
    }
}

/// The WGSL of one method and output, for rows of `texels` texels read by `interpolation`; its picture sees
/// stars if there are any.
pub fn shader_source(
    method: Method,
    sampling: Sampling,
    output: Output,
    store: Store,
    texels: u32,
    interpolation: Interpolation,
    stars: bool,
) -> String {
    let lut = include_str!("../shaders/deflect_lut.wgsl");
    let step = format!("const STEP: f32 = {:?};", method.integrator_step());
    let direct = &[&step, include_str!("../shaders/deflect_direct.wgsl")].join("\n");
    let flat = include_str!("../shaders/deflect_flat.wgsl");
    let deflect = match (output, method) {
        (Output::Difference, _) => [lut, direct].join("\n"),
        (_, Method::Lut) => deflect_by(lut, "deflect_lut"),
        (Output::Picture, Method::Direct { .. }) if sampling == Sampling::Filtered => {
            [direct, DEFLECT_DIRECT_WITH_SLOPE].join("\n")
        }
        (_, Method::Direct { .. }) => deflect_by(direct, "deflect_direct"),
        (_, Method::Flat) => deflect_by(flat, "deflect_flat"),
    };
    let store = match store {
        Store::Buffer => include_str!("../shaders/store_buffer.wgsl"),
        Store::Texture => include_str!("../shaders/store_texture.wgsl"),
    };
    let entry_points = match (output, sampling) {
        (Output::Picture, Sampling::Single) => include_str!("../shaders/picture.wgsl"),
        (Output::Picture, Sampling::Filtered) => concat!(
            include_str!("../shaders/shadow.wgsl"),
            include_str!("../shaders/footprint.wgsl"),
            include_str!("../shaders/blocks.wgsl"),
            include_str!("../shaders/filtered.wgsl"),
        ),
        (Output::Trace, _) => include_str!("../shaders/trace.wgsl"),
        (Output::Difference, _) => include_str!("../shaders/difference.wgsl"),
    };
    let sky = if output.sees_sky() {
        include_str!("../shaders/sky.wgsl")
    } else {
        ""
    };
    let keep = if output == Output::Picture {
        keep(stars)
    } else {
        String::new()
    };
    [
        &lookup::wgsl_row(texels, interpolation, 0, 1),
        lookup::WGSL,
        include_str!("../shaders/frame.wgsl"),
        store,
        &deflect,
        sky,
        &keep,
        entry_points,
    ]
    .join("\n")
}

/// The WGSL that sorts the blocks of a filtered picture by `method`: by the row, whoever turns the light.
pub(super) fn sort_source(method: Method, texels: u32, interpolation: Interpolation) -> String {
    let deflect = match method {
        Method::Lut | Method::Direct { .. } => {
            deflect_by(include_str!("../shaders/deflect_lut.wgsl"), "deflect_lut")
        }
        Method::Flat => deflect_by(include_str!("../shaders/deflect_flat.wgsl"), "deflect_flat"),
    };
    [
        &lookup::wgsl_row(texels, interpolation, 0, 1),
        lookup::WGSL,
        include_str!("../shaders/frame.wgsl"),
        &deflect,
        include_str!("../shaders/sky.wgsl"),
        include_str!("../shaders/shadow.wgsl"),
        include_str!("../shaders/footprint.wgsl"),
        include_str!("../shaders/blocks.wgsl"),
        include_str!("../shaders/sort_blocks.wgsl"),
    ]
    .join("\n")
}

/// Direct integration in f32 knows no slope; for the size of a footprint the row's will do.
const DEFLECT_DIRECT_WITH_SLOPE: &str = "
fn deflect(c: f32, p: f32) -> Turned {
    var turned = deflect_direct(c, p);
    turned.slope = bending(c, p, Edge(frame.edge.x, frame.edge.y, frame.away_slope)).slope;
    return turned;
}
";

/// The text of one method, called `deflect` by those who do not care which it is.
fn deflect_by(text: &str, name: &str) -> String {
    format!("{text}\nfn deflect(c: f32, p: f32) -> Turned {{ return {name}(c, p); }}\n")
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    #[test]
    fn every_shader_is_valid() {
        let methods = [Method::Lut, Method::Direct { step: 0.1 }, Method::Flat];
        let outputs = [Output::Picture, Output::Trace, Output::Difference];
        let samplings = [Sampling::Single, Sampling::Filtered];
        let reads = [Interpolation::Linear, Interpolation::Hermite];
        let mut validated = 0;
        for method in methods {
            for output in outputs {
                for store in [Store::Buffer, Store::Texture] {
                    for (interpolation, stars) in reads.map(|r| [(r, false), (r, true)]).concat() {
                        for sampling in samplings {
                            let source = shader_source(
                                method,
                                sampling,
                                output,
                                store,
                                64,
                                interpolation,
                                stars,
                            );
                            validate(&source, entry_points(sampling, output));
                            validated += 1;
                        }
                    }
                }
            }
        }
        assert_eq!(validated, 144);
    }

    #[test]
    fn the_sorters_are_valid() {
        for method in [Method::Lut, Method::Direct { step: 0.1 }, Method::Flat] {
            for interpolation in [Interpolation::Linear, Interpolation::Hermite] {
                let source = sort_source(method, 64, interpolation);
                validate(&source, &["sort_blocks", "close_lists"]);
            }
        }
    }

    pub(in crate::gpu) fn validate(source: &str, entry_points: &[&str]) {
        let module = naga::front::wgsl::parse_str(source)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|e| panic!("{e:?} in\n{source}"));
        let names: Vec<&str> = module
            .entry_points
            .iter()
            .map(|e| e.name.as_str())
            .collect();
        assert_eq!(names, entry_points);
    }
}
