//! Screenshots: what a presenter shows, read back.

use crate::render_pass::begin;
use lensbake_render::gpu::{Gpu, GpuError, Presenter, texture};
use wgpu::*;

/// A screenshot that the GPU draws.
#[derive(Debug)]
pub struct Screenshot {
    gpu: Gpu,
    buffer: Buffer,
    format: TextureFormat,
    size: [u32; 2],
    /// Bytes from row to row.
    stride: u32,
}

impl Screenshot {
    /// Submits the drawing of what the presenter shows, to a texture of this format and size in pixels.
    pub(crate) fn submit(
        gpu: &Gpu,
        presenter: &Presenter,
        format: TextureFormat,
        size: [u32; 2],
    ) -> Self {
        let [width, height] = size;
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
        let texture = texture(&gpu.device, "screenshot", size, format, usage);
        let stride = (4 * width).next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&BufferDescriptor {
            label: Some("screenshot"),
            size: u64::from(stride) * u64::from(height),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let view = texture.create_view(&Default::default());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        presenter.draw(&mut begin(&mut encoder, &view, None));
        let layout = TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(stride),
            rows_per_image: None,
        };
        let to = TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
        gpu.queue.submit([encoder.finish()]);
        Screenshot {
            gpu: gpu.clone(),
            buffer,
            format,
            size,
            stride,
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The pixels, `[height][width][3]`, 8-bit sRGB.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device fails.
    pub async fn read(&self) -> Result<Vec<u8>, GpuError> {
        let bytes: Vec<u8> = self.gpu.read(&self.buffer).await?;
        let blue_first = matches!(
            self.format,
            TextureFormat::Bgra8Unorm | TextureFormat::Bgra8UnormSrgb
        );
        let rgb = |pixel: &[u8]| {
            if blue_first {
                [pixel[2], pixel[1], pixel[0]]
            } else {
                [pixel[0], pixel[1], pixel[2]]
            }
        };
        let width = self.size[0] as usize;
        let rows = bytes.chunks_exact(self.stride as usize);
        Ok(rows
            .flat_map(|row| row[..4 * width].chunks_exact(4).flat_map(rgb))
            .collect())
    }
}
