//! What a picture in the making keeps on a GPU from frame to frame: its row, its frame blocks and what
//! it is written to. Showing the next scene writes into these and makes nothing.

use super::renderer::{Renderer, resource};
use super::stars::StarLists;
use super::{Frame, Gpu, GpuError, Store, Tile};
use crate::scene::Scene;
use lensbake_tables::{Interpolation, Row, Texel};
use wgpu::*;

/// Bytes of a pixel in a [`Store::Buffer`].
const PIXEL: u64 = size_of::<[f32; 4]>() as u64;
/// Side of a workgroup in the shaders, pixels.
const WORKGROUP: u32 = 8;
/// Format of a [`Store::Texture`], as `shaders/store_texture.wgsl` has it.
const TEXTURE_FORMAT: TextureFormat = TextureFormat::Rgba16Float;

/// What a frame is written to.
#[derive(Debug)]
pub enum Target {
    /// One tile after the other, `[rows][columns][4]` of f32.
    Buffer(Buffer),
    /// The whole picture.
    Texture(TextureView),
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
        let bind_group = bind_group(&device, layout, &frames, &row, &target);
        Canvas {
            queue: renderer.gpu.queue.clone(),
            layout: layout.clone(),
            target,
            row,
            shown: None,
            frames,
            frame_stride,
            tiles: Vec::new(),
            bind_group,
            device,
            stars: None,
        }
    }

    /// The same canvas with room for the stars of `renderer` in pictures of `size` pixels.
    pub(super) fn with_lists(self, renderer: &Renderer, size: [u32; 2]) -> Self {
        let stars = renderer.stars.clone();
        Canvas {
            stars: stars.map(|stars| StarLists::new(&renderer.gpu, stars, size)),
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
    /// it is another than the last. `gain` amplifies a difference.
    ///
    /// # Panics
    /// If the scene's row has another shape than the canvas was made for.
    pub fn show(&mut self, scene: &Scene, tiles: impl Iterator<Item = Tile>, gain: f32) {
        self.tiles.clear();
        self.tiles.extend(tiles);
        self.grow();
        let step = scene.method.integrator_step();
        for (i, &tile) in self.tiles.iter().enumerate() {
            let frame = Frame::new(&scene.camera, tile, step, gain);
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

    /// Encodes the drawing of tile `index` by `pipeline` before `sky`; `timestamps` notes when it begins
    /// and ends. With the first tile go the lists of the stars that all of them read.
    pub(super) fn encode(
        &self,
        encoder: &mut CommandEncoder,
        sky: &BindGroup,
        pipeline: &ComputePipeline,
        index: usize,
        timestamps: Option<ComputePassTimestampWrites>,
    ) {
        let lists = self.stars.as_ref().filter(|_| index == 0);
        if let Some(lists) = lists {
            lists.clear(encoder);
        }
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
            label: Some("tile"),
            timestamp_writes: timestamps,
        });
        let offset = index as u64 * self.frame_stride;
        if let Some(lists) = lists {
            lists.sort(&mut pass);
        }
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.bind_group, &[offset as u32]);
        pass.set_bind_group(1, sky, &[]);
        if let Some(stars) = &self.stars {
            pass.set_bind_group(2, stars.lists(), &[]);
        }
        let [across, down] = self.tiles[index].count.map(|n| n.div_ceil(WORKGROUP));
        pass.dispatch_workgroups(across, down, 1);
    }

    /// Makes room for the blocks of all tiles: only when there are more than ever before.
    fn grow(&mut self) {
        let needed = self.tiles.len() as u64 * self.frame_stride;
        if needed > self.frames.size() {
            self.frames = frame_buffer(&self.device, needed);
            self.bind_group = bind_group(
                &self.device,
                &self.layout,
                &self.frames,
                &self.row,
                &self.target,
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

fn bind_group(
    device: &Device,
    layout: &BindGroupLayout,
    frames: &Buffer,
    row: &Texture,
    target: &Target,
) -> BindGroup {
    let frame = BufferBinding {
        buffer: frames,
        offset: 0,
        size: BufferSize::new(size_of::<Frame>() as u64),
    };
    let row = row.create_view(&Default::default());
    let target = match target {
        Target::Buffer(buffer) => buffer.as_entire_binding(),
        Target::Texture(view) => BindingResource::TextureView(view),
    };
    device.create_bind_group(&BindGroupDescriptor {
        label: Some("frame"),
        layout,
        entries: &[
            resource(0, BindingResource::Buffer(frame)),
            resource(1, BindingResource::TextureView(&row)),
            resource(2, target),
        ],
    })
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

pub(super) fn storage_texture_binding() -> BindingType {
    BindingType::StorageTexture {
        access: StorageTextureAccess::WriteOnly,
        format: TEXTURE_FORMAT,
        view_dimension: TextureViewDimension::D2,
    }
}
