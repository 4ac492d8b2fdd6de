//! Screenshots: what a presenter shows, read back.

use crate::render_pass::begin;
use lensbake_render::gpu::{Gpu, GpuError, Presenter, texture};
use wgpu::*;

/// Draws what the presenter shows to a texture of this size and reads it back: `[height][width][3]`, 8-bit sRGB.
///
/// # Errors
/// [`GpuError::Failed`] if the device fails.
pub async fn take(
    gpu: &Gpu,
    presenter: &Presenter,
    format: TextureFormat,
    [width, height]: [u32; 2],
) -> Result<Vec<u8>, GpuError> {
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    let texture = texture(&gpu.device, "screenshot", [width, height], format, usage);
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
    let bytes: Vec<u8> = gpu.read(&buffer).await?;
    let blue_first = matches!(
        format,
        TextureFormat::Bgra8Unorm | TextureFormat::Bgra8UnormSrgb
    );
    let rgb = |pixel: &[u8]| {
        if blue_first {
            [pixel[2], pixel[1], pixel[0]]
        } else {
            [pixel[0], pixel[1], pixel[2]]
        }
    };
    let rows = bytes.chunks_exact(stride as usize);
    Ok(rows
        .flat_map(|row| row[..4 * width as usize].chunks_exact(4).flat_map(rgb))
        .collect())
}
