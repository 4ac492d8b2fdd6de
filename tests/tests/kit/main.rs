//! The texts of `kit/`: each is compiled by a compiler of its language and run, and its answers are compared with the
//! closed form.

mod browser;
mod compilers;
mod falling;
mod godot;
mod mistakes;
mod native;
mod python;
mod rays;
mod wgsl;

use lensbake_test_support::workspace;
use rays::Errors;

/// Largest error in image space, in pixels, of a text that looks up the 32-bit row, in 32-bit arithmetic. The row itself
/// is within 2.1e-5; the rest is rounding, nearly all of it that of the two directions that the text takes.
const F32_BOUND: f64 = 5e-4;
/// The same for one filtered fetch from the atlas of half floats.
const SIMPLE_BOUND: f64 = 0.13;
/// What to do if a compiler is missing.
const HINT: &str = lensbake_test_support::READERS_HINT;

/// Prints the errors of a text, and checks them.
fn report(name: &str, errors: Errors, bound: f64) {
    print(name, errors);
    assert!(errors.length < 1e-5, "{name}: {:e}", errors.length);
    assert!(
        errors.rays > 0 && errors.pixels < bound,
        "{name}: {:e} px",
        errors.pixels
    );
}

#[expect(clippy::print_stdout, reason = "the figures of the tests")]
fn print(name: &str, errors: Errors) {
    let Errors {
        rays,
        pixels,
        radians,
        radians_off_edge,
        wrong,
        ..
    } = errors;
    println!(
        "{name:24} {rays:7} rays  {pixels:.1e} px  {radians_off_edge:.1e} rad ({radians:.1e} at the edge)  wrong outcome: \
         {wrong}"
    );
}

fn bytes_as<T: bytemuck::Pod>(bytes: &[u8]) -> Vec<T> {
    bytemuck::pod_collect_to_vec(bytes)
}

fn words_of(texels: &[[f32; 2]]) -> Vec<f32> {
    texels.as_flattened().to_vec()
}

/// R and G of the pixels of an OpenEXR file of the kit.
fn values_and_slopes(file: &str) -> Vec<f32> {
    let path = workspace().join("kit").join(file);
    let picture = image::open(path).unwrap().into_rgb32f();
    picture
        .pixels()
        .flat_map(|pixel| [pixel[0], pixel[1]])
        .collect()
}
