//! Bakes the row of one observer, measures its error, writes it to a file, and prints the WGSL that looks it up:
//! `cargo run -p lensbake-tables --example make_row -- r10.lbt`.

use lensbake_core::Observer;
use lensbake_tables::Rows;
use lensbake_tables::baking::{Recipe, bake, measured};
use lensbake_tables::container::Container;
use lensbake_tables::lookup::{self, GpuRow};
use std::error::Error;
use std::path::PathBuf;

#[expect(clippy::print_stdout, reason = "the output of the example")]
fn main() -> Result<(), Box<dyn Error>> {
    let file: PathBuf = std::env::args_os()
        .nth(1)
        .ok_or("name a .lbt or .exr file")?
        .into();
    let container = Container::of(&file)?;

    let observer = Observer::at(10.0)?; // r = 10 Schwarzschild radii
    let recipe = Recipe {
        rows: Rows::One {
            inverse_radius: observer.inverse_radius(),
        },
        ..Recipe::default()
    };
    let table = measured(bake(&recipe, || ())?)?;
    println!(
        "// largest error: {:.1e} rad",
        table.header().measured.max_error
    );
    std::fs::write(&file, container.encode(&table)?)?;

    // What a GPU needs: the texels as a texture, three numbers of the observer, and this shader code.
    let row = GpuRow::new(&table.row(observer)?);
    println!(
        "// texture of {:?} texels: {} bytes",
        row.shape().texture_size(),
        row.texture_bytes().len()
    );
    println!("// {:?}", row.edge);
    println!("{}{}", row.shape().wgsl(0, 0), lookup::WGSL);
    Ok(())
}
