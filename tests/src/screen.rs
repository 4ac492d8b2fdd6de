//! Draws what a window would show of the realtime renderer's picture, without a window.

use lensbake_render::camera::Camera;
use lensbake_render::gpu::{EdgeMode, Gpu, Presentation, Presenter, RealtimeRenderer};
use pollster::block_on;
use wgpu::*;

/// What a window of the size of `camera` shows of the last picture of `live`, which has `picture` pixels:
/// `[height][width]`, 8-bit sRGB.
///
/// # Panics
/// If the device fails.
pub fn on_screen(
    gpu: &Gpu,
    live: &RealtimeRenderer,
    picture: [u32; 2],
    camera: &Camera,
) -> Vec<[u8; 3]> {
    let format = TextureFormat::Rgba8Unorm;
    let texture = gpu.device.create_texture(&TextureDescriptor {
        label: Some("screen"),
        size: Extent3d {
            width: camera.width,
            height: camera.height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format,
        usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut presenter = Presenter::new(gpu, live, format);
    let presentation = Presentation {
        edge: EdgeMode::AsDrawn,
        divider: None,
        exposure: 0.0,
    };
    presenter.show(picture, camera, presentation);
    let stride = (4 * camera.width).next_multiple_of(COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&BufferDescriptor {
        label: Some("screen"),
        size: u64::from(stride) * u64::from(camera.height),
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let view = texture.create_view(&Default::default());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    presenter.draw(&mut encoder.begin_render_pass(&RenderPassDescriptor {
        color_attachments: &[Some(RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: Operations {
                load: LoadOp::Clear(Color::BLACK),
                store: StoreOp::Store,
            },
        })],
        ..Default::default()
    }));
    let to = TexelCopyBufferInfo {
        buffer: &buffer,
        layout: TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(stride),
            rows_per_image: None,
        },
    };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
    gpu.queue.submit([encoder.finish()]);
    let bytes: Vec<u8> = block_on(gpu.read(&buffer)).unwrap();
    let rows = bytes.chunks_exact(stride as usize);
    let rows = rows.map(|row| &row[..4 * camera.width as usize]);
    rows.flat_map(|row| row.chunks_exact(4).map(|p| [p[0], p[1], p[2]]))
        .collect()
}
