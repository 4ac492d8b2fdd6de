//! Rewrites the seeds of every fuzz target in `fuzz/seeds`: `cargo run -p lensbake-tests --example fuzz_seeds`.

use exr::prelude::{Blocks, Vec2};
use image::{DynamicImage, ImageFormat, Rgb, Rgb32FImage, RgbImage};
use lensbake_render::stars::{Catalogue, Star, to_bytes};
use lensbake_tables::container::Container;
use lensbake_tables::{Axis, Header, Measured, Rows, Solver, Table};
use lensbake_test_support::exr_files::{COMPRESSIONS, Samples, picture};
use lensbake_test_support::workspace;
use std::fs;
use std::io::Cursor;

fn main() {
    tables();
    stars();
    skies();
    query();
}

fn write(target: &str, name: &str, bytes: &[u8]) {
    let folder = workspace().join("fuzz/seeds").join(target);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join(name), bytes).unwrap();
}

fn tables() {
    let far = Rows::One {
        inverse_radius: 0.0,
    };
    let near = Rows::One {
        inverse_radius: 0.1,
    };
    let through = Rows::ThroughHorizon {
        above: 4,
        below: 4,
        r_min: 0.1,
    };
    let (b_min, b_max) = (2.7, 50.0);
    for (name, axis, rows, texels) in [
        ("far", Axis::Residual, far, 4),
        ("near", Axis::Residual, near, 16),
        ("atlas", Axis::Residual, Rows::Chi { count: 4 }, 5),
        ("through", Axis::Residual, through, 4),
        ("b", Axis::UniformB { b_min, b_max }, far, 4),
        ("inverse-b", Axis::UniformInverseB { b_min, b_max }, far, 4),
        ("log-b", Axis::UniformLogB { b_min, b_max }, far, 4),
    ] {
        let header = Header {
            axis,
            rows,
            texels,
            solver: Solver {
                name: "seed".into(),
                tolerance: 1e-10,
            },
            measured: Measured::NOTHING,
            measured_below: None,
        };
        let count = header.texel_count() as u32;
        let texels = (0..count).map(|index| [0.1 + index as f32, -0.25]);
        let table = Table::new(header, texels.collect()).unwrap();
        for (container, target, ending) in [
            (Container::Binary, "table_binary", "lbt"),
            (Container::OpenExr, "table_exr", "exr"),
        ] {
            let bytes = container.encode(&table).unwrap();
            write(target, &format!("{name}.{ending}"), &bytes);
        }
    }
}

fn stars() {
    let star = |index: u32| Star {
        right_ascension: f64::from(index),
        declination: 0.3 * f64::from(index) - 1.4,
        magnitude: 2.0 * f64::from(index) - 1.5,
        colour_index: index.is_multiple_of(2).then_some(0.4),
    };
    for count in [1, 5] {
        let catalogue = Catalogue::new((0..count).map(star).collect(), 1e-8).unwrap();
        write(
            "stars_compact",
            &format!("{count}.stars"),
            &to_bytes(&catalogue),
        );
    }
    for (name, text) in [
        ("plain", "ra,dec,mag\n10,20,3\n-10.5,-89.9,-1.46\n"),
        ("crlf", "ra,dec,mag,bv\r\n10,20,3,0.6\r\n1,2,3,\r\n"),
        ("comment", "#ra,dec,mag\n# more\n\n1,2,3\n"),
        (
            "quoted",
            "name,MAG,dec,RA\n\"A\nB\",1,2,3\n\"say \"\"C\"\"\",4,5,6\n",
        ),
        ("bom", "\u{feff}ra,dec,mag\r\n\r\n1e1,2e0,.5\r\n"),
        ("bad", "ra,dec,mag\n1,2,3\n1,2,x\n"),
    ] {
        write("stars_csv", &format!("{name}.csv"), text.as_bytes());
    }
}

fn skies() {
    for compression in COMPRESSIONS {
        let name = compression.to_string().replace(' ', "-");
        for (kind, blocks, samples) in [
            ("lines", Blocks::ScanLines, Samples::Half),
            ("tiles", Blocks::Tiles(Vec2(20, 9)), Samples::Float),
            ("uint", Blocks::ScanLines, Samples::Uint),
        ] {
            let bytes = picture(compression, blocks, samples);
            write("sky", &format!("{name}-{kind}.exr"), &bytes);
        }
    }
    let rgb = RgbImage::from_fn(16, 8, |x, y| Rgb([x as u8 * 16, y as u8 * 32, 128]));
    let rgb = DynamicImage::from(rgb);
    let float = Rgb32FImage::from_fn(16, 8, |x, y| Rgb([x as f32, y as f32, 0.5]));
    for (name, image, format) in [
        ("rgb8.png", rgb.clone(), ImageFormat::Png),
        ("rgba16.png", rgb.to_rgba16().into(), ImageFormat::Png),
        ("grey8.png", rgb.to_luma8().into(), ImageFormat::Png),
        ("colour.jpg", rgb.clone(), ImageFormat::Jpeg),
        ("grey.jpg", rgb.to_luma8().into(), ImageFormat::Jpeg),
        ("light.hdr", float.into(), ImageFormat::Hdr),
    ] {
        let mut file = Cursor::new(Vec::new());
        image.write_to(&mut file, format).unwrap();
        write("sky", name, &file.into_inner());
    }
}

fn query() {
    for (name, line) in [
        ("near", "10 30"),
        ("pole", "10 180"),
        ("far", "inf 5.5"),
        ("captured", "3 0.001"),
        ("comment", "# a comment"),
        ("exponent", "1e3 1e-3"),
    ] {
        write("query", name, line.as_bytes());
    }
}
