//! What a picture in the making keeps on a GPU from frame to frame: its row, its frame blocks and what
//! it is written to. Showing the next scene writes into these and makes nothing.

use super::bindings::{bind_group, block_of};
use super::blocks::{BLOCK, LIST_WIDTH, List, append_lists};
use super::renderer::{Program, Renderer, SkyOnDevice};
use super::stars::StarLists;
use super::{Frame, Gpu, GpuError, Store, Tile};
use crate::filtered::Pixels;
use crate::scene::{Sampling, Scene};
use crate::shadow::Shadow;
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
    shown: Option<Row>,
    frames: Buffer,
    frame_stride: u64,
    tiles: Vec<Tile>,
    blocks: Buffer,
    /// The lists of each tile; none if the picture is not filtered.
    lists: Vec<[List; 3]>,
    bind_group: BindGroup,
    stars: Option<StarLists>,
}

impl Canvas {
    /// A canvas for rows of the shape of `row`, written to a texture of `size` pixels.
    pub fn on_texture(renderer: &Renderer, row: &Row, size: [u32; 2]) -> Self {
        let texture = renderer.gpu.device.create_texture(&TextureDescriptor {
            label: Some("picture"),
            size: Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: TextureDimension::D2,
            format: TEXTURE_FORMAT,
            usage: TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
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
        let row = row_texture(&device, row);
        let alignment = device.limits().min_uniform_buffer_offset_alignment;
        let frame_stride = (size_of::<Frame>() as u64).next_multiple_of(alignment.into());
        let frames = frame_buffer(&device, tiles * frame_stride);
        let blocks = block_buffer(&device, 1);
        let bind_group = frame_group(&device, layout, &frames, &row, &target, &blocks);
        Canvas {
            queue: renderer.gpu.queue.clone(),
            layout: layout.clone(),
            target,
            row,
            shown: None,
            frames,
            frame_stride,
            tiles: Vec::new(),
            blocks,
            lists: Vec::new(),
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

    /// What the frames are written to.
    pub fn target(&self) -> &Target {
        &self.target
    }

    /// The tiles that were set last.
    pub fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    /// Sets what the next dispatches draw: the scene, in these tiles. The row goes to the GPU only if
    /// it is another than the last. `sky` is what they will be drawn before, `gain` amplifies a difference.
    ///
    /// # Panics
    /// If the scene's row has another shape than the canvas was made for.
    pub fn show(
        &mut self,
        scene: &Scene,
        sky: &SkyOnDevice,
        tiles: impl Iterator<Item = Tile>,
        gain: f32,
    ) {
        self.tiles.clear();
        self.tiles.extend(tiles);
        let blocks = self.list_blocks(scene, sky.face_texels);
        self.grow(blocks.len() as u64);
        self.queue
            .write_buffer(&self.blocks, 0, bytemuck::cast_slice(&blocks));
        let shadow = Shadow::of(scene);
        for (i, &tile) in self.tiles.iter().enumerate() {
            let lists = self.lists.get(i).copied().unwrap_or_default();
            let frame = Frame::new(&scene.camera, tile, gain)
                .filtered(shadow, lists.map(|list| list.first));
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

    /// Lists the blocks of the tiles if the picture is filtered.
    fn list_blocks(&mut self, scene: &Scene, face_texels: u32) -> Vec<u32> {
        self.lists.clear();
        let mut blocks = Vec::new();
        if scene.sampling == Sampling::Filtered {
            let pixels = Pixels::new(scene);
            for &tile in &self.tiles {
                let lists = append_lists(&mut blocks, &pixels, tile, face_texels);
                self.lists.push(lists);
            }
        }
        blocks
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
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
            label: Some(program.name),
            timestamp_writes: timestamps,
        });
        let offset = index as u64 * self.frame_stride;
        if let Some(lists) = lists {
            lists.make(&mut pass);
        }
        pass.set_bind_group(0, &self.bind_group, &[offset as u32]);
        pass.set_bind_group(1, sky, &[]);
        if let Some(stars) = stars {
            pass.set_bind_group(2, stars.reading(), &[]);
        }
        if let [pipeline] = &program.pipelines[..] {
            let [across, down] = self.tiles[index].count.map(|n| n.div_ceil(BLOCK));
            pass.set_pipeline(pipeline);
            pass.dispatch_workgroups(across, down, 1);
            return;
        }
        for (pipeline, list) in program.pipelines.iter().zip(&self.lists[index]) {
            pass.set_pipeline(pipeline);
            pass.dispatch_workgroups(LIST_WIDTH, list.rows, 1);
        }
    }

    /// Makes room for the frames of all tiles and for so many blocks: only when there are more than
    /// ever before.
    fn grow(&mut self, blocks: u64) {
        let frames = self.tiles.len() as u64 * self.frame_stride;
        let blocks = blocks * size_of::<u32>() as u64;
        if frames > self.frames.size() || blocks > self.blocks.size() {
            self.frames = frame_buffer(&self.device, frames.max(self.frames.size()));
            self.blocks = block_buffer(&self.device, blocks.max(self.blocks.size()));
            self.bind_group = frame_group(
                &self.device,
                &self.layout,
                &self.frames,
                &self.row,
                &self.target,
                &self.blocks,
            );
        }
    }

    fn upload(&mut self, row: &Row) {
        let shape = (self.row.width(), self.row.format());
        assert_eq!(shape, (row.texel_count(), row_format(row)), "another shape");
        let texels: Vec<Texel> = row.gpu_texels();
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
            bytes_per_row: Some(bytes.len() as u32),
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

fn block_buffer(device: &Device, size: u64) -> Buffer {
    device.create_buffer(&BufferDescriptor {
        label: Some("blocks"),
        size: size.next_multiple_of(COPY_BUFFER_ALIGNMENT),
        usage: BufferUsages::STORAGE | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn frame_group(
    device: &Device,
    layout: &BindGroupLayout,
    frames: &Buffer,
    row: &Texture,
    target: &Target,
    blocks: &Buffer,
) -> BindGroup {
    let row = row.create_view(&Default::default());
    let resources = [
        block_of::<Frame>(frames),
        BindingResource::TextureView(&row),
        target.binding(),
        blocks.as_entire_binding(),
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

/// A 1-D texture for rows of the shape of `row`.
fn row_texture(device: &Device, row: &Row) -> Texture {
    device.create_texture(&TextureDescriptor {
        label: Some("row"),
        size: Extent3d {
            width: row.texel_count(),
            height: 1,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D1,
        format: row_format(row),
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    })
}
