//! Bends one ray by the built-in atlas and compares the result with the closed form:
//! `cargo run -p lensbake-tables --example bend_one_ray`.

use lensbake_core::{Observer, RayOutcome, exact};
use lensbake_tables::default_atlas;
use std::error::Error;

#[expect(clippy::print_stdout, reason = "the output of the example")]
fn main() -> Result<(), Box<dyn Error>> {
    let observer = Observer::at(10.0)?; // r = 10 Schwarzschild radii
    let theta = 30f64.to_radians(); // the view direction, from the direction of the hole
    let row = default_atlas().row(observer)?;
    match row.bend(observer.shadow_coordinate(theta)) {
        RayOutcome::Captured => println!("the ray falls into the hole"),
        RayOutcome::Escapes(bend) => {
            println!("bending by the table     {bend:.9} rad");
            println!("angle on the sky         {:.9} rad", theta - bend);
        }
    }
    let exact = exact::bend(&observer.ray(theta)?);
    if let RayOutcome::Escapes(bend) = exact {
        println!("bending, closed form     {bend:.9} rad");
    }
    Ok(())
}
