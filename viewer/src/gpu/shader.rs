//! The shader text of a frame, put together from the parts that differ and the parts that do not.

use super::stars::light_source;
use crate::scene::Method;
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
    /// The name of its entry point.
    pub fn entry_point(self) -> &'static str {
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

/// The WGSL of one method and output, for rows of `texels` texels read by `interpolation`; its picture sees
/// stars if there are any.
pub fn shader_source(
    method: Method,
    output: Output,
    store: Store,
    texels: u32,
    interpolation: Interpolation,
    stars: bool,
) -> String {
    let lut = include_str!("../shaders/deflect_lut.wgsl");
    let direct = include_str!("../shaders/deflect_direct.wgsl");
    let flat = include_str!("../shaders/deflect_flat.wgsl");
    let deflect = match (output, method) {
        (Output::Difference, _) => [lut, direct].join("\n"),
        (_, Method::Lut) => deflect_by(lut, "deflect_lut"),
        (_, Method::Direct { .. }) => deflect_by(direct, "deflect_direct"),
        (_, Method::Flat) => deflect_by(flat, "deflect_flat"),
    };
    let store = match store {
        Store::Buffer => include_str!("../shaders/store_buffer.wgsl"),
        Store::Texture => include_str!("../shaders/store_texture.wgsl"),
    };
    let entry_point = match output {
        Output::Picture => include_str!("../shaders/picture.wgsl"),
        Output::Trace => include_str!("../shaders/trace.wgsl"),
        Output::Difference => include_str!("../shaders/difference.wgsl"),
    };
    let sky = if output.sees_sky() {
        include_str!("../shaders/sky.wgsl")
    } else {
        ""
    };
    let star_light = match output {
        Output::Picture => light_source(stars),
        Output::Trace | Output::Difference => String::new(),
    };
    [
        &lookup::wgsl_row(texels, interpolation, 0, 1),
        lookup::WGSL,
        include_str!("../shaders/frame.wgsl"),
        store,
        &deflect,
        sky,
        &star_light,
        entry_point,
    ]
    .join("\n")
}

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
        let reads = [Interpolation::Linear, Interpolation::Hermite];
        let mut validated = 0;
        for method in methods {
            for output in outputs {
                for store in [Store::Buffer, Store::Texture] {
                    for (interpolation, stars) in reads.map(|r| [(r, false), (r, true)]).concat() {
                        let source = shader_source(method, output, store, 64, interpolation, stars);
                        validate(&source);
                        validated += 1;
                    }
                }
            }
        }
        assert_eq!(validated, 72);
    }

    pub(in crate::gpu) fn validate(source: &str) {
        let module = naga::front::wgsl::parse_str(source)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|e| panic!("{e:?} in\n{source}"));
    }
}
