//! What usual mistakes cost: the figures in docs/use.md.

use super::native::{HLSL, answers};
use super::rays::{Errors, RADII, rays};
use lensbake_core::Observer;
use lensbake_tables::{Texel, default_atlas};
use lensbake_test_support::workspace;
use tempfile::TempDir;

/// Texture coordinates without the half texel at each end.
#[test]
#[cfg_attr(
    any(feature = "no-readers", not(target_os = "linux")),
    ignore = "feature no-readers, or not Linux"
)]
fn texture_coordinates_off_the_texel_centres_cost_two_pixels() {
    let text = std::fs::read_to_string(workspace().join("kit/hlsl/lensbake_simple.hlsl")).unwrap();
    let [right_x, right_y] = ["(q * 63.0 + 0.5) / 64.0", "(row + 0.5) / 128.0"];
    assert!(text.contains(right_x) && text.contains(right_y));
    let wrong = text.replace(right_x, "q").replace(right_y, "row / 127.0");
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("wrong.hlsl");
    std::fs::write(&path, wrong).unwrap();
    let mut rays = rays(&RADII[..9]);
    for ray in &mut rays {
        ray.observer = 0.0;
    }
    let texels = super::values_and_slopes("tables/simple.exr");
    let call = "lensbake_simple(d,hole,r,Texture2D(data),SamplerState())";
    let answers = answers(HLSL, &path, call, &rays, &texels, 64, &folder);
    let errors = Errors::of(&rays, &answers);
    super::print("off the texel centres", errors);
    assert!((2.0..2.4).contains(&errors.pixels), "{} px", errors.pixels);
}

/// The weights of Lagrange's cubic through four rows, at the position `t` from the first.
fn weights(t: f64) -> [f64; 4] {
    [
        -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0,
        t * (t - 2.0) * (t - 3.0) / 2.0,
        -t * (t - 1.0) * (t - 3.0) / 2.0,
        t * (t - 1.0) * (t - 2.0) / 6.0,
    ]
}

/// The values of the rows `indices`, mixed at `t`.
fn mixed(indices: [i32; 4], t: f64) -> Vec<f64> {
    let rows: [&[Texel]; 4] = indices.map(|index| default_atlas().row_texels(index as u32));
    let value = |i: usize| {
        weights(t)
            .iter()
            .zip(rows)
            .map(|(weight, row)| weight * f64::from(row[i][0]))
            .sum()
    };
    (0..64).map(value).collect()
}

/// Repeating the last row beyond the horizon instead of moving the four rows inwards.
#[test]
fn repeating_the_last_row_costs_two_thousandths_of_a_radian() {
    let mut worst = 0.0_f64;
    for i in 0..100 {
        let r = 1.0 + 10f64.powf(-7.0 + 0.03 * f64::from(i));
        let position = Observer::at(r).unwrap().chi() / std::f64::consts::FRAC_PI_2 * 127.0;
        if position < 126.0 {
            continue;
        }
        let repeated = mixed([125, 126, 127, 127], position - 125.0);
        let inwards = mixed([124, 125, 126, 127], position - 124.0);
        let off = repeated.iter().zip(&inwards).map(|(a, b)| (a - b).abs());
        worst = off.fold(worst, f64::max);
    }
    println!("the last row repeated: {worst:.1e} rad");
    assert!((1.9e-3..2.2e-3).contains(&worst), "{worst:e} rad");
}
