//! A scene made ready on a GPU to be drawn and read back, in bands of rows: a driver resets a GPU that is
//! busy for seconds.

use super::renderer::{Program, Renderer};
use super::{Canvas, Output, Passes, Store, Tile};
use crate::scene::{Method, Scene};
use std::f64::consts::PI;
use wgpu::*;

/// Pixels of a band in a buffer at the most: 16 MiB of output.
const BUFFERED: u32 = 1 << 20;
/// Ray steps of a band at the most, for direct integration: a fraction of a second on a small GPU.
const BAND_STEPS: f64 = 1e8;

/// A scene's program and its canvas.
#[derive(Debug)]
pub struct Prepared {
    program: Program,
    sky: BindGroup,
    canvas: Canvas,
}

impl Prepared {
    pub(super) fn new(renderer: &Renderer, scene: &Scene, output: Output) -> Self {
        let camera = &scene.camera;
        let most_pixels = BUFFERED.min(band_pixels(scene.method));
        let rows = (most_pixels / camera.width).clamp(1, camera.height);
        let pixels = u64::from(rows) * u64::from(camera.width);
        let whole = Tile {
            first: [0, 0],
            count: [camera.width, camera.height],
        };
        let bands = camera.height.div_ceil(rows);
        let mut canvas = Canvas::on_buffer(renderer, &scene.row, pixels, bands.into());
        if output == Output::Picture {
            canvas = canvas.with_lists(renderer, whole.count);
        }
        canvas.show(scene, whole.bands(most_pixels), 1.0);
        Prepared {
            program: renderer.program(
                scene.method,
                scene.sampling,
                output,
                Store::Buffer,
                &scene.row,
            ),
            sky: renderer.sky.bind_group.clone(),
            canvas,
        }
    }

    /// The bands, from the top down, each as wide as the picture.
    pub fn bands(&self) -> &[Tile] {
        self.canvas.tiles()
    }

    /// Where each band writes its pixels in turn, `[rows][width][4]` of f32.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }
}

impl Passes for Prepared {
    fn count(&self) -> usize {
        self.bands().len()
    }

    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        pass: usize,
        timestamps: Option<ComputePassTimestampWrites>,
    ) {
        self.canvas
            .encode(encoder, &self.sky, &self.program, pass, timestamps);
    }
}

/// Pixels that a dispatch may draw by `method`.
pub fn band_pixels(method: Method) -> u32 {
    match method {
        // A ray turns by about π; those that turn more are few.
        Method::Direct { step } => (BAND_STEPS * step / PI) as u32,
        Method::Lut | Method::Flat => u32::MAX,
    }
}

impl Tile {
    /// The tile cut into bands of whole rows of at most `pixels` pixels, but a row at the least.
    pub fn bands(self, pixels: u32) -> impl Iterator<Item = Tile> {
        let ([column, row], [width, height]) = (self.first, self.count);
        let rows = (pixels / width.max(1)).clamp(1, height.max(1));
        (0..height).step_by(rows as usize).map(move |y| Tile {
            first: [column, row + y],
            count: [width, rows.min(height - y)],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_cover_a_tile_once_from_the_top_down() {
        for (width, height, pixels) in [(7, 10, 21), (7, 11, 21), (7, 10, 1), (7, 10, 1000)] {
            let tile = Tile {
                first: [3, 5],
                count: [width, height],
            };
            let mut next = 5;
            for band in tile.bands(pixels) {
                assert_eq!((band.first, band.count[0]), ([3, next], width));
                assert!(band.count[1] == 1 || width * band.count[1] <= pixels);
                next += band.count[1];
            }
            assert_eq!(next, 5 + height);
        }
        let empty = Tile {
            first: [0, 0],
            count: [0, 4],
        };
        assert_eq!(empty.bands(8).count(), 1);
    }
}
