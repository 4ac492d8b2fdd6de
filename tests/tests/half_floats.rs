//! The error of the atlas stored as half floats: the figure in docs/format.md.

use half::f16;
use lensbake_studies::table_error::{DiffStatistics, Picture, diff};
use lensbake_tables::baking::{EDGE_GAP, R_MIN, random};
use lensbake_tables::{Table, default_atlas};

fn in_half_floats(table: &Table) -> Table {
    let rounded = |float: f32| f16::from_f32(float).to_f32();
    let texels = table.texels().iter().map(|texel| texel.map(rounded));
    Table::new(table.header().clone(), texels.collect()).unwrap()
}

#[test]
fn half_floats_would_cost_what_the_document_says() {
    let atlas = default_atlas();
    let rays = random(atlas.header(), 200_000, 1);
    let picture = Picture {
        width: 1920,
        field_of_view: std::f64::consts::FRAC_PI_2,
    };
    let error = |table: &Table| -> DiffStatistics {
        let diff = diff(table, &rays, 1e-9, || ()).unwrap();
        diff.statistics(&picture, |ray| ray.lookup - ray.closed)
            .unwrap()
    };
    let (stored, half) = (error(atlas), error(&in_half_floats(atlas)));
    println!(
        "{} rays, r from {R_MIN}, 1 - x from {EDGE_GAP:e}; pixels of a picture {} wide and 90 degrees across",
        rays.len(),
        picture.width
    );
    for (name, statistics) in [("32-bit floats", stored), ("half floats", half)] {
        println!("{name:13} rad  {}", statistics.radians);
        println!("{:13} px   {}", "", statistics.pixels.unwrap());
    }
    let (rad, px) = (half.radians.max, half.pixels.unwrap().max);
    assert!((4.9e-4..5.1e-4).contains(&rad), "{rad:e} rad");
    assert!((0.041..0.043).contains(&px), "{px} px");
}
