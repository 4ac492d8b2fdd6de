//! Screenshots: the window's picture without the panel, written to a file.

use super::render_pass::begin;
use lensbake_program::output::{self, OutputError};
use lensbake_render::gpu::{Gpu, GpuError, Presenter, texture};
use lensbake_render::picture::{PictureError, encode_png};
use pollster::block_on;
use std::path::PathBuf;
use thiserror::Error;
use wgpu::*;

/// Why a screenshot cannot be written.
#[derive(Debug, Error)]
pub(super) enum ScreenshotError {
    /// The picture cannot be encoded.
    #[error(transparent)]
    Encode(#[from] PictureError),
    /// The file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// Draws what the presenter shows to a texture of this size and reads it back: `[height][width][3]`, 8-bit sRGB.
pub(super) fn take(
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
    let bytes: Vec<u8> = block_on(gpu.read(&buffer))?;
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

/// Writes a screenshot to the first free `lensbake-N.png` of the current folder, and returns its name.
pub(super) fn write([width, height]: [u32; 2], pixels: &[u8]) -> Result<PathBuf, ScreenshotError> {
    let free = (1..)
        .map(|n| PathBuf::from(format!("lensbake-{n}.png")))
        .find(|path| !path.exists())
        .expect("numbers do not end");
    output::write(&free, &encode_png(width, height, pixels)?)?;
    Ok(free)
}
