//! The cost of a model in counts, not in time: counts are the same on every machine.

use crate::gpu::UNIFORM_BYTES;
use crate::lens::{Deflection, Lens, Lookup};
use lensbake_tables::{Interpolation, RowFormat, stereographic};
use std::f64::consts::PI;
use std::fmt;

/// The cost of a lens's picture for the part that differs between models, the deflection. Camera and sky add the
/// same cost for every model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cost {
    /// Bytes uploaded per frame: the uniform blocks of camera and region, and the row if there is one.
    pub bytes: usize,
    /// Texels loaded per ray.
    pub loads: u32,
    /// Arithmetic operations per ray in the shader's `deflect` and all it calls, as written: an operation on a
    /// vector, a function and a selection count once. Direct integration is counted over half a turn.
    pub operations: u32,
}

/// Operation counts of the shaders. A test compares them with the WGSL.
mod operations {
    pub const FLAT: u32 = 8;
    pub const LINEAR: u32 = 88;
    pub const HERMITE: u32 = 105;
    pub const COEFFICIENTS: u32 = 96;
    pub const STEREOGRAPHIC: u32 = 52;
    /// The map of one texel from the codes of 16-bit integers.
    pub const DECODING: u32 = 2;
    /// Direct integration without its steps.
    pub const DIRECT: u32 = 79;
    /// One step of direct integration.
    pub const STEP: u32 = 32;
}

impl Cost {
    /// The cost of drawing `lens` on a GPU.
    pub fn of(lens: &Lens) -> Self {
        match lens.deflection {
            Deflection::Flat => Cost {
                bytes: UNIFORM_BYTES,
                loads: 0,
                operations: operations::FLAT,
            },
            Deflection::Direct { step } => Cost {
                bytes: UNIFORM_BYTES,
                loads: 0,
                operations: operations::DIRECT + operations::STEP * (PI / step).ceil() as u32,
            },
            Deflection::Lut if lens.lookup == Lookup::Stereographic => Cost {
                bytes: UNIFORM_BYTES + stereographic::BYTES,
                loads: 1,
                operations: operations::STEREOGRAPHIC,
            },
            Deflection::Lut => {
                let interpolation = match lens.row.interpolation() {
                    Interpolation::Linear => operations::LINEAR,
                    Interpolation::Hermite => operations::HERMITE,
                };
                let (loads, operations) = match lens.row.format() {
                    RowFormat::Float32 | RowFormat::Float16 => (2, interpolation),
                    RowFormat::Unorm16(_) => (2, interpolation + 2 * operations::DECODING),
                    RowFormat::Coefficients => (1, operations::COEFFICIENTS),
                };
                Cost {
                    bytes: UNIFORM_BYTES + lens.row.gpu_bytes(),
                    loads,
                    operations,
                }
            }
        }
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "{:5} bytes per frame, {} loads and {:4} operations per ray",
            self.bytes, self.loads, self.operations
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{CameraKey, LookupShape, Output, PipelineKey, Store};
    use crate::shift::Shift;
    use lensbake_tables::ChannelRanges;
    use lensbake_tables::lookup::{HorizonSide, RowShape};

    use naga::{Block, Expression, Function, Handle, Module, Statement};

    /// Operations outside and inside loops, and texel loads, of a function and those it calls.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    struct Count {
        outside: u32,
        inside: u32,
        loads: u32,
    }

    struct Counter<'a> {
        module: &'a Module,
        function: &'a Function,
        count: Count,
    }

    fn count(module: &Module, function: &Function) -> Count {
        let mut counter = Counter {
            module,
            function,
            count: Count::default(),
        };
        counter.block(&function.body, false);
        counter.count
    }

    impl Counter<'_> {
        fn block(&mut self, block: &Block, in_loop: bool) {
            for statement in block {
                match statement {
                    Statement::Emit(range) => {
                        for handle in range.clone() {
                            self.expression(handle, in_loop);
                        }
                    }
                    Statement::Block(block) => self.block(block, in_loop),
                    Statement::If { accept, reject, .. } => {
                        self.block(accept, in_loop && !ends_the_ray(accept));
                        self.block(reject, in_loop);
                    }
                    Statement::Loop {
                        body, continuing, ..
                    } => {
                        self.block(body, true);
                        self.block(continuing, true);
                    }
                    Statement::Call { function, .. } => {
                        let called = count(self.module, &self.module.functions[*function]);
                        self.add(called.outside + called.inside, in_loop);
                        self.count.loads += called.loads;
                    }
                    _ => (),
                }
            }
        }

        fn expression(&mut self, handle: Handle<Expression>, in_loop: bool) {
            match &self.function.expressions[handle] {
                Expression::Binary { .. }
                | Expression::Unary { .. }
                | Expression::Math { .. }
                | Expression::Select { .. } => self.add(1, in_loop),
                Expression::ImageLoad { .. } => self.count.loads += 1,
                _ => (),
            }
        }

        fn add(&mut self, operations: u32, in_loop: bool) {
            if in_loop {
                self.count.inside += operations;
            } else {
                self.count.outside += operations;
            }
        }
    }

    /// Whether a block ends the ray. Inside a loop it runs once, so it does not count towards a step.
    fn ends_the_ray(block: &Block) -> bool {
        block.iter().any(|s| matches!(s, Statement::Return { .. }))
    }

    fn counted(method: Deflection, interpolation: Interpolation) -> Count {
        counted_in_format(method, interpolation, RowFormat::Float32)
    }

    fn counted_in_format(
        method: Deflection,
        interpolation: Interpolation,
        format: RowFormat,
    ) -> Count {
        counted_by(
            method,
            LookupShape::Row(RowShape {
                texels: 64,
                interpolation,
                side: HorizonSide::Above,
                format,
            }),
        )
    }

    fn counted_by(method: Deflection, lookup: LookupShape) -> Count {
        let source = PipelineKey::new(
            method,
            Output::Trace,
            Store::Buffer,
            lookup,
            false,
            CameraKey::AT_REST,
            Shift::Off,
        )
        .source();
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let name = match method {
            Deflection::Lut => "deflect_lut",
            Deflection::Direct { .. } => "deflect_direct",
            Deflection::Flat => "deflect_flat",
        };
        let deflect = module
            .functions
            .iter()
            .find(|(_, f)| f.name.as_deref() == Some(name))
            .unwrap()
            .1;
        count(&module, deflect)
    }

    #[test]
    fn the_costs_are_those_of_the_shaders() {
        let flat = counted(Deflection::Flat, Interpolation::Hermite);
        let linear = counted(Deflection::Lut, Interpolation::Linear);
        let hermite = counted(Deflection::Lut, Interpolation::Hermite);
        let stereographic = LookupShape::Stereographic(HorizonSide::Above);
        let stereographic = counted_by(Deflection::Lut, stereographic);
        let direct = counted(Deflection::Direct { step: 0.1 }, Interpolation::Hermite);
        let known = |outside, inside, loads| Count {
            outside,
            inside,
            loads,
        };
        assert_eq!(
            [flat, linear, hermite, stereographic, direct],
            [
                known(operations::FLAT, 0, 0),
                known(operations::LINEAR, 0, 2),
                known(operations::HERMITE, 0, 2),
                known(operations::STEREOGRAPHIC, 0, 1),
                known(operations::DIRECT, operations::STEP, 0),
            ]
        );
    }

    #[test]
    fn the_costs_of_the_row_formats_are_those_of_the_shaders() {
        let ranges = ChannelRanges::of(&[[-0.4, 0.0], [0.0, 0.5]]);
        let lut = |interpolation, format| {
            let count = counted_in_format(Deflection::Lut, interpolation, format);
            (count.outside, count.loads)
        };
        let (linear, hermite) = (Interpolation::Linear, Interpolation::Hermite);
        for (interpolation, operations) in
            [(linear, operations::LINEAR), (hermite, operations::HERMITE)]
        {
            let decoding = 2 * operations::DECODING;
            for (format, expected) in [
                (RowFormat::Float16, (operations, 2)),
                (RowFormat::Unorm16(ranges), (operations + decoding, 2)),
                (RowFormat::Coefficients, (operations::COEFFICIENTS, 1)),
            ] {
                assert_eq!(lut(interpolation, format), expected, "{format:?}");
            }
        }
    }
}
