//! Frames one after the other, for a window or a benchmark: everything is made beforehand, and a frame
//! writes what has changed and dispatches what the picture needs.

use super::canvas::shape;
use super::{
    Canvas, Output, Passes, Program, Renderer, StarLight, Store, Target, Tile, band_pixels,
};
use crate::scene::{Method, Sampling, Scene};
use crate::stars::StarField;
use lensbake_tables::Row;
use wgpu::*;

/// What a frame shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Show {
    /// The picture by the scene's method.
    Picture,
    /// The table's picture left of a column of pixels, direct integration's from there on.
    Split {
        /// The column.
        divider: u32,
    },
    /// How far the table's picture and direct integration's are apart.
    Difference {
        /// What it is multiplied by.
        gain: f32,
    },
}

/// What draws a tile.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Brush {
    Lut,
    Direct { step: f64 },
    Flat,
    Difference,
}

/// A texture that is drawn again and again.
#[derive(Debug)]
pub struct Live {
    renderer: Renderer,
    programs: Programs,
    steps: Vec<f64>,
    canvas: Canvas,
    row: Row,
    room: [u32; 2],
    brushes: Vec<Brush>,
    sampling: Sampling,
}

#[derive(Debug)]
struct Programs {
    single: Pictures,
    filtered: Pictures,
    /// By the first of the steps.
    difference: Program,
}

/// What draws pictures by one sampling.
#[derive(Debug)]
struct Pictures {
    lut: Program,
    flat: Program,
    /// By their steps.
    direct: Vec<(f64, Program)>,
}

impl Live {
    /// Frames of at most `room` pixels across and down by `renderer`, with rows of the shape of `row`.
    /// Direct integration takes one of `steps`, rad; a difference takes the first.
    ///
    /// # Panics
    /// If there are no steps.
    pub fn new(renderer: Renderer, row: &Row, room: [u32; 2], steps: &[f64]) -> Self {
        Live {
            programs: Programs::new(&renderer, row, steps),
            steps: steps.to_vec(),
            canvas: Canvas::on_texture(&renderer, row, room),
            row: row.clone(),
            room,
            brushes: Vec::new(),
            sampling: Sampling::Single,
            renderer,
        }
    }

    /// What draws: to put another sky on the device.
    pub fn renderer(&mut self) -> &mut Renderer {
        &mut self.renderer
    }

    /// Columns and rows of pixels that a frame may have.
    pub fn room(&self) -> [u32; 2] {
        self.room
    }

    /// Makes room for frames of other sizes.
    pub fn set_room(&mut self, room: [u32; 2]) {
        if room != self.room {
            self.room = room;
            self.canvas = Canvas::on_texture(&self.renderer, &self.row, room);
        }
    }

    /// Whether it is ready for rows of the shape of `row`.
    pub fn takes(&self, row: &Row) -> bool {
        shape(row) == shape(&self.row)
    }

    /// Makes ready for rows of the shape of `row`.
    pub fn set_row_shape(&mut self, row: &Row) {
        if !self.takes(row) {
            self.row = row.clone();
            self.remake();
        }
    }

    /// Draws the stars of `field` before the sky from now on, or none.
    pub fn set_stars(&mut self, field: Option<&StarField>) {
        self.renderer.set_stars(field);
        self.remake();
    }

    /// Whether the newest of the frames that have come back since the last call has all light of its stars;
    /// none if none has come back. Does not block. Call it after each frame is submitted, and again
    /// while [`Live::awaits_star_light`].
    pub fn star_light(&self) -> Option<StarLight> {
        self.canvas.star_light()
    }

    /// Whether a frame is under way of which [`Live::star_light`] will tell.
    pub fn awaits_star_light(&self) -> bool {
        self.canvas.awaits_star_light()
    }

    fn remake(&mut self) {
        self.programs = Programs::new(&self.renderer, &self.row, &self.steps);
        self.canvas = Canvas::on_texture(&self.renderer, &self.row, self.room);
    }

    /// The texture that the frames are drawn to, of [`Live::room`] pixels; a smaller frame lies in its
    /// upper left.
    pub fn texture(&self) -> &TextureView {
        match self.canvas.target() {
            Target::Texture(view) => view,
            Target::Buffer(_) => unreachable!("made on a texture"),
        }
    }

    /// Sets what the next frame draws: on the CPU this is all that a frame takes besides submitting it.
    /// The two comparisons take the integrator's step from the scene's method; a difference is of one ray a
    /// pixel.
    ///
    /// # Panics
    /// If the scene is larger than the room, its row has another shape, or its step is not among those
    /// that it was made for.
    pub fn show(&mut self, scene: &Scene, show: Show) {
        let (width, height) = (scene.camera.width, scene.camera.height);
        let [most_wide, most_high] = self.room;
        assert!(width <= most_wide && height <= most_high, "no room");
        let whole = columns(0, width, height);
        let none = columns(0, 0, height);
        let (parts, gain) = match show {
            Show::Picture => ([(Brush::of(scene.method), whole), (Brush::Flat, none)], 1.0),
            Show::Difference { gain } => ([(Brush::Difference, whole), (Brush::Flat, none)], gain),
            Show::Split { divider } => {
                let divider = divider.min(width);
                let right = columns(divider, width - divider, height);
                let left = columns(0, divider, height);
                let direct = Brush::Direct {
                    step: scene.method.integrator_step(),
                };
                ([(Brush::Lut, left), (direct, right)], 1.0)
            }
        };
        self.sampling = scene.sampling;
        self.brushes.clear();
        let tiles = parts
            .into_iter()
            .filter(|(_, part)| part.count[0] > 0)
            .flat_map(|(brush, part)| {
                part.bands(brush.band_pixels(scene))
                    .map(move |t| (brush, t))
            })
            .map(|(brush, tile)| {
                self.brushes.push(brush);
                tile
            });
        self.canvas.show(scene, tiles, gain);
    }
}

impl Passes for Live {
    fn count(&self) -> usize {
        self.brushes.len()
    }

    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        pass: usize,
        timestamps: Option<ComputePassTimestampWrites>,
    ) {
        let program = self.programs.program(self.brushes[pass], self.sampling);
        self.canvas.encode(
            encoder,
            &self.renderer.sky.bind_group,
            program,
            pass,
            timestamps,
        );
    }
}

impl Programs {
    fn new(renderer: &Renderer, row: &Row, steps: &[f64]) -> Self {
        let compared = Method::Direct { step: steps[0] };
        let (sampling, output) = (Sampling::Single, Output::Difference);
        Programs {
            single: Pictures::new(renderer, row, steps, sampling),
            filtered: Pictures::new(renderer, row, steps, Sampling::Filtered),
            difference: renderer.program(compared, sampling, output, Store::Texture, row),
        }
    }

    fn program(&self, brush: Brush, sampling: Sampling) -> &Program {
        let pictures = match sampling {
            Sampling::Single => &self.single,
            Sampling::Filtered => &self.filtered,
        };
        match brush {
            Brush::Lut => &pictures.lut,
            Brush::Direct { step } => pictures.direct(step),
            Brush::Flat => &pictures.flat,
            Brush::Difference => &self.difference,
        }
    }
}

impl Pictures {
    fn new(renderer: &Renderer, row: &Row, steps: &[f64], sampling: Sampling) -> Self {
        let program =
            |method| renderer.program(method, sampling, Output::Picture, Store::Texture, row);
        let direct = |&step| (step, program(Method::Direct { step }));
        Pictures {
            lut: program(Method::Lut),
            flat: program(Method::Flat),
            direct: steps.iter().map(direct).collect(),
        }
    }

    fn direct(&self, step: f64) -> &Program {
        let mut all = self.direct.iter();
        let found = all.find(|(of, _)| *of == step);
        &found.expect("a step that the programs were made for").1
    }
}

impl Brush {
    fn of(method: Method) -> Self {
        match method {
            Method::Lut => Brush::Lut,
            Method::Direct { step } => Brush::Direct { step },
            Method::Flat => Brush::Flat,
        }
    }

    /// Pixels that one dispatch of it may draw.
    fn band_pixels(self, scene: &Scene) -> u32 {
        match self {
            Brush::Lut => band_pixels(Method::Lut),
            Brush::Flat => band_pixels(Method::Flat),
            Brush::Direct { .. } | Brush::Difference => band_pixels(Method::Direct {
                step: scene.method.integrator_step(),
            }),
        }
    }
}

fn columns(first: u32, count: u32, height: u32) -> Tile {
    Tile {
        first: [first, 0],
        count: [count, height],
    }
}
