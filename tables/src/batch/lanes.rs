//! Loops over a fixed number of rays, which the compiler turns into instructions for several numbers.

/// `f(i)` for each lane i.
#[inline(always)]
pub(crate) fn each<T: Copy, const N: usize>(f: impl Fn(usize) -> T) -> [T; N] {
    let mut lanes = [f(0); N];
    for (i, lane) in lanes.iter_mut().enumerate() {
        *lane = f(i);
    }
    lanes
}

/// A function of N inputs. It is a trait and not a closure, because a closure that is called twice is not inlined, and
/// only what is inlined is compiled for the instructions of `pulp`.
pub(super) trait Batched<T, U, const N: usize> {
    /// The outputs of the inputs. To be inlined always.
    fn of(&self, inputs: &[T; N]) -> [U; N];
}

/// Writes `function` of N of the `inputs` at a time to `outputs`, as many as the shorter slice has. `any` is an input that
/// is computed in the place of those that are missing for N; its output is not written.
#[inline(always)]
pub(super) fn in_lanes<T: Copy, U: Copy, const N: usize>(
    function: impl Batched<T, U, N>,
    inputs: &[T],
    any: T,
    outputs: &mut [U],
) {
    let count = inputs.len().min(outputs.len());
    let (inputs, rest) = inputs[..count].as_chunks();
    let (outputs, rest_out) = outputs[..count].as_chunks_mut();
    for (input, output) in inputs.iter().zip(outputs) {
        *output = function.of(input);
    }
    if !rest.is_empty() {
        let mut filled = [any; N];
        filled[..rest.len()].copy_from_slice(rest);
        rest_out.copy_from_slice(&function.of(&filled)[..rest.len()]);
    }
}
