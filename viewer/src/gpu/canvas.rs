//! What a picture in the making keeps on a GPU from frame to frame: its row, its frame blocks and what
//! it is written to. Showing the next scene writes into these and makes nothing.

use super::bindings::{bind_group, block_of};
use super::blocks::{self, BLOCK, BlockLists};
use super::renderer::{Program, Renderer};
use super::stars::{StarLight, StarLists};
use super::texture::texture;
use super::{Frame, Gpu, GpuError, Store, Tile};
use crate::scene::{Sampling, Scene};
use crate::shadow::Shadow;
use lensbake_tables::lookup::row_texture_size;
use lensbake_tables::{Interpolation, Row, Texel};
use wgpu::*;

/// Bytes of a pixel in a [`Store::Buffer`].
const PIXEL: u64 = size_of::<[f32; 4]>() as u64;
/// Format of a [`Store::Texture`], as `shaders/store_texture.wgsl` has it.
pub(super) const TEXTURE_FORMAT: TextureFormat = TextureFormat::Rgba16Float;

/// What a frame is written to.
#[derive(Debug)]
pub enum Target {
    /// One tile after the other, `[rows][columns][4]` of f32.
    Buffer(Buffer),
    /// The whole picture.
    Texture(TextureView),
}

impl Target {
    /// As a shader sees it.
    pub(super) fn binding(&self) -> BindingResource<'_> {
        match self {
            Target::Buffer(buffer) => buffer.as_entire_binding(),
            Target::Texture(view) => BindingResource::TextureView(view),
        }
    }
}

/// The row, the frame blocks and the target of pictures of one size.
#[derive(Debug)]
pub struct Canvas {
    device: Device,
    queue: Queue,
    layout: BindGroupLayout,
    target: Target,
    row: Texture,
    /// Texels of the rows that it is for, and how they are read.
    shape: (u32, Interpolation),
    shown: Option<Row>,
    frames: Buffer,
    frame_stride: u64,
    tiles: Vec<Tile>,
    sort_layout: BindGroupLayout,
    blocks: BlockLists,
    bind_group: BindGroup,
    stars: Option<StarLists>,
}

impl Canvas {
    /// A canvas for rows of the shape of `row`, written to a texture of `size` pixels.
    pub fn on_texture(renderer: &Renderer, row: &Row, size: [u32; 2]) -> Self {
        let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
        let texture = texture(&renderer.gpu.device, "picture", size, TEXTURE_FORMAT, usage);
        let view = texture.create_view(&Default::default());
        Canvas::new(renderer, row, Target::Texture(view), 1).with_lists(renderer, size)
    }

    /// A canvas for rows of the shape of `row`, each of its tiles of at most `pixels` pixels written to
    /// the same buffer.
    pub fn on_buffer(renderer: &Renderer, row: &Row, pixels: u64, tiles: u64) -> Self {
        let buffer = renderer.gpu.device.create_buffer(&BufferDescriptor {
            label: Some("pixels"),
            size: pixels * PIXEL,
            usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Canvas::new(renderer, row, Target::Buffer(buffer), tiles)
    }

    fn new(renderer: &Renderer, row: &Row, target: Target, tiles: u64) -> Self {
        let device = renderer.gpu.device.clone();
        let layout = renderer.frame_layout(match target {
            Target::Buffer(_) => Store::Buffer,
            Target::Texture(_) => Store::Texture,
        });
        let shape = shape(row);
        let row = row_texture(&device, row);
        let alignment = device.limits().min_uniform_buffer_offset_alignment;
        let frame_stride = (size_of::<Frame>() as u64).next_multiple_of(alignment.into());
        let frames = frame_buffer(&device, tiles * frame_stride);
        let sort_layout = renderer.sort_layout.clone();
        let view = row.create_view(&Default::default());
        let blocks = BlockLists::new(&device, &sort_layout, &frames, &view, &[]);
        let bind_group = frame_group(&device, layout, &frames, &view, &target, &blocks);
        Canvas {
            queue: renderer.gpu.queue.clone(),
            layout: layout.clone(),
            target,
            row,
            shape,
            shown: None,
            frames,
            frame_stride,
            tiles: Vec::new(),
            sort_layout,
            blocks,
            bind_group,
            device,
            stars: None,
        }
    }

    /// The same canvas with room for the stars of `renderer` in pictures of `size` pixels.
    pub(super) fn with_lists(self, renderer: &Renderer, size: [u32; 2]) -> Self {
        let lists = |stars| StarLists::new(&renderer.gpu, stars, size);
        Canvas {
            stars: renderer.stars.clone().map(lists),
            ..self
        }
    }

    /// Checks that no light of the stars was lost in the picture drawn last.
    ///
    /// # Errors
    /// [`GpuError::TooManyStars`] if some was, [`GpuError::Failed`] if the device fails.
    pub fn check_stars(&self, gpu: &Gpu) -> Result<(), GpuError> {
        self.stars.as_ref().map_or(Ok(()), |lists| lists.check(gpu))
    }

    /// Whether the newest of the pictures that have come back since the last call has all light of its stars;
    /// none if none has come back. Does not block. Call it after the encoded commands are submitted.
    pub fn star_light(&self) -> Option<StarLight> {
        self.stars.as_ref().and_then(StarLists::arrived)
    }

    /// Whether [`Canvas::star_light`] will have something to tell.
    pub fn awaits_star_light(&self) -> bool {
        self.stars.as_ref().is_some_and(StarLists::awaited)
    }

    /// The lists of blocks of the tiles.
    #[cfg(test)]
    pub(super) fn block_lists(&self) -> &BlockLists {
        &self.blocks
    }

    /// What the frames are written to.
    pub fn target(&self) -> &Target {
        &self.target
    }

    /// The tiles that were set last.
    pub fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    /// Sets what the next dispatches draw: the scene, in these tiles. The row goes to the GPU only if
    /// it is another than the last. `gain` amplifies a difference.
    ///
    /// # Panics
    /// If the scene's row has another shape than the canvas was made for.
    pub fn show(&mut self, scene: &Scene, tiles: impl Iterator<Item = Tile>, gain: f32) {
        self.tiles.clear();
        self.tiles.extend(tiles);
        self.grow(scene.sampling);
        let shadow = Shadow::of(scene);
        let tiles = self.tiles.iter().zip(blocks::places(&self.tiles));
        for (i, (&tile, (lists, blocks))) in tiles.enumerate() {
            let frame = Frame::new(&scene.camera, tile, gain).filtered(shadow, lists, blocks);
            let offset = i as u64 * self.frame_stride;
            self.queue
                .write_buffer(&self.frames, offset, bytemuck::bytes_of(&frame));
        }
        if let Some(stars) = &mut self.stars {
            stars.show(scene);
        }
        if self.shown.as_ref() != Some(&scene.row) {
            self.upload(&scene.row);
        }
    }

    /// Encodes the drawing of tile `index` by `program` before `sky`; `timestamps` notes when it begins
    /// and ends. With the first tile go the lists of the stars that all of them read.
    pub(super) fn encode(
        &self,
        encoder: &mut CommandEncoder,
        sky: &BindGroup,
        program: &Program,
        index: usize,
        timestamps: Option<ComputePassTimestampWrites>,
    ) {
        let stars = self.stars.as_ref().filter(|_| program.sees_stars);
        let lists = stars.filter(|_| index == 0);
        if let Some(lists) = lists {
            lists.clear(encoder);
        }
        if program.sorter.is_some() {
            self.blocks.clear(encoder, index);
        }
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
            label: Some(program.name),
            timestamp_writes: timestamps,
        });
        let offset = (index as u64 * self.frame_stride) as u32;
        if let Some(lists) = lists {
            lists.make(&mut pass);
        }
        if let Some(sorter) = &program.sorter {
            let tile = self.tiles[index];
            self.blocks.sort(&mut pass, sorter, sky, tile, offset);
        }
        pass.set_bind_group(0, &self.bind_group, &[offset]);
        pass.set_bind_group(1, sky, &[]);
        if let Some(stars) = stars {
            pass.set_bind_group(2, stars.reading(), &[]);
        }
        for (list, pipeline) in program.pipelines.iter().enumerate() {
            pass.set_pipeline(pipeline);
            if program.sorter.is_some() {
                self.blocks.draw(&mut pass, index, list);
            } else {
                let [across, down] = self.tiles[index].count.map(|n| n.div_ceil(BLOCK));
                pass.dispatch_workgroups(across, down, 1);
            }
        }
        drop(pass);
        if let Some(lists) = lists {
            lists.report(encoder);
        }
    }

    /// Makes room for the frames of all tiles, and for the lists of their blocks if they are filtered:
    /// only when there are more than ever before.
    fn grow(&mut self, sampling: Sampling) {
        let frames = self.tiles.len() as u64 * self.frame_stride;
        let listed = sampling == Sampling::Filtered;
        let holds = !listed || self.blocks.holds(&self.tiles);
        if frames <= self.frames.size() && holds {
            return;
        }
        if frames > self.frames.size() {
            self.frames = frame_buffer(&self.device, frames);
        }
        let device = &self.device;
        let row = self.row.create_view(&Default::default());
        let tiles = if listed { &self.tiles[..] } else { &[] };
        self.blocks = BlockLists::new(device, &self.sort_layout, &self.frames, &row, tiles);
        self.bind_group = frame_group(
            device,
            &self.layout,
            &self.frames,
            &row,
            &self.target,
            &self.blocks,
        );
    }

    fn upload(&mut self, row: &Row) {
        assert_eq!(self.shape, shape(row), "another shape");
        let [width, height] = [self.row.width(), self.row.height()];
        let mut texels: Vec<Texel> = row.gpu_texels();
        texels.resize((width * height) as usize, [0.0; 2]);
        let values: Vec<f32>;
        let bytes: &[u8] = match row.interpolation() {
            Interpolation::Linear => {
                values = texels.iter().map(|texel| texel[0]).collect();
                bytemuck::cast_slice(&values)
            }
            Interpolation::Hermite => bytemuck::cast_slice(&texels),
        };
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(bytes.len() as u32 / height),
            rows_per_image: None,
        };
        self.queue
            .write_texture(self.row.as_image_copy(), bytes, layout, self.row.size());
        self.shown = Some(row.clone());
    }
}

fn frame_buffer(device: &Device, size: u64) -> Buffer {
    device.create_buffer(&BufferDescriptor {
        label: Some("frames"),
        size,
        usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn frame_group(
    device: &Device,
    layout: &BindGroupLayout,
    frames: &Buffer,
    row: &TextureView,
    target: &Target,
    blocks: &BlockLists,
) -> BindGroup {
    let resources = [
        block_of::<Frame>(frames),
        BindingResource::TextureView(row),
        target.binding(),
        blocks.blocks().as_entire_binding(),
    ];
    bind_group(device, "frame", layout, resources)
}

/// Values and slopes, or the values alone where no slope is read.
fn row_format(row: &Row) -> TextureFormat {
    match row.interpolation() {
        Interpolation::Linear => TextureFormat::R32Float,
        Interpolation::Hermite => TextureFormat::Rg32Float,
    }
}

/// What of a row programs and canvases are made for: its texels, and how they are read.
pub(super) fn shape(row: &Row) -> (u32, Interpolation) {
    (row.texel_count(), row.interpolation())
}

/// A texture for rows of the shape of `row`.
fn row_texture(device: &Device, row: &Row) -> Texture {
    let size = row_texture_size(row.texel_count());
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    texture(device, "row", size, row_format(row), usage)
}
