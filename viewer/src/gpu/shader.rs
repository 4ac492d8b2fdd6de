//! The shader text of a frame, put together from the parts that differ and the parts that do not.

use crate::scene::Method;
use lensbake_tables::{Interpolation, lookup};

/// What a dispatch writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// The light of each pixel.
    Picture,
    /// Where each pixel's light comes from.
    Trace,
}

impl Output {
    /// The name of its entry point.
    pub fn entry_point(self) -> &'static str {
        match self {
            Output::Picture => "picture",
            Output::Trace => "trace",
        }
    }
}

/// The WGSL of one method and output, for rows of `texels` texels read by `interpolation`.
pub fn shader_source(
    method: Method,
    output: Output,
    texels: u32,
    interpolation: Interpolation,
) -> String {
    let deflect = match method {
        Method::Lut => include_str!("../shaders/deflect_lut.wgsl"),
        Method::Direct { .. } => include_str!("../shaders/deflect_direct.wgsl"),
        Method::Flat => include_str!("../shaders/deflect_flat.wgsl"),
    };
    let output = match output {
        Output::Picture => include_str!("../shaders/picture.wgsl"),
        Output::Trace => include_str!("../shaders/trace.wgsl"),
    };
    [
        &lookup::wgsl_row(texels, interpolation, 0, 1),
        lookup::WGSL,
        include_str!("../shaders/frame.wgsl"),
        deflect,
        output,
    ]
    .join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    #[test]
    fn every_shader_is_valid() {
        let methods = [Method::Lut, Method::Direct { step: 0.1 }, Method::Flat];
        let reads = [Interpolation::Linear, Interpolation::Hermite];
        for (method, interpolation) in methods.into_iter().flat_map(|m| reads.map(|r| (m, r))) {
            for output in [Output::Picture, Output::Trace] {
                let source = shader_source(method, output, 64, interpolation);
                let module = naga::front::wgsl::parse_str(&source)
                    .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
                Validator::new(ValidationFlags::all(), Capabilities::empty())
                    .validate(&module)
                    .unwrap_or_else(|e| panic!("{method:?} {output:?}: {e:?}"));
            }
        }
    }
}
