//! Choosing and opening what a picture is drawn on: a GPU, or the CPU. A GPU takes a while to open, which other threads can use.

use super::CommandError;
use crate::cli::DeviceName;
use lensbake_program::message;
use lensbake_render::camera::Camera;
use lensbake_render::gpu::{Gpu, GpuError};
use lensbake_render::model::Precision;
use pollster::block_on;
use std::{panic, thread};

/// Rounding error of 32-bit floats above which it may be visible, pixels.
const VISIBLE_ROUNDING_PX: f64 = 0.5;

/// The GPU to draw on, or `None` for the CPU.
pub fn gpu(device: DeviceName) -> Result<Option<Gpu>, GpuError> {
    let opened = (device != DeviceName::Cpu).then(|| block_on(Gpu::open()));
    chosen(device, opened)
}

/// The GPU to draw the picture of `camera` on, or `None` for the CPU. If the pixels are so narrow that the GPU's
/// 32-bit floats cannot resolve them, `auto` chooses the CPU, and `gpu` prints a warning with the possible error.
pub fn gpu_for(device: DeviceName, camera: &Camera) -> Result<Option<Gpu>, GpuError> {
    report_rounding(device, camera);
    gpu(least_device(device, camera))
}

/// As [`gpu_for`], but the GPU is opened, and `prepare` prepares it, in a thread of its own while `load` loads what is drawn.
/// Returns what both return. An error of `load` comes first, as if nothing had been opened.
pub fn gpu_beside<P: Send, T>(
    device: DeviceName,
    camera: &Camera,
    prepare: impl FnOnce(&Gpu) -> P + Send,
    load: impl FnOnce() -> Result<T, CommandError>,
) -> Result<(Option<(Gpu, P)>, T), CommandError> {
    let opened = least_device(device, camera);
    thread::scope(|scope| {
        let opening = (opened != DeviceName::Cpu).then(|| {
            scope.spawn(|| {
                let gpu = block_on(Gpu::open())?;
                let prepared = prepare(&gpu);
                Ok::<_, GpuError>((gpu, prepared))
            })
        });
        let loaded = load()?;
        report_rounding(device, camera);
        let joined =
            opening.map(|thread| thread.join().unwrap_or_else(|e| panic::resume_unwind(e)));
        Ok((chosen(opened, joined)?, loaded))
    })
}

/// What `device` has opened; `None` for the CPU, also where it stands in for a GPU.
fn chosen<T>(
    device: DeviceName,
    opened: Option<Result<T, GpuError>>,
) -> Result<Option<T>, GpuError> {
    match opened.transpose() {
        // If the user has set an invalid backend, it is an error.
        Err(error) if device == DeviceName::Auto && !matches!(error, GpuError::Backend { .. }) => {
            message!("viewer: drawing on the CPU: {error}");
            Ok(None)
        }
        opened => opened,
    }
}

/// The device that `auto` stands for, if the GPU's floats are too short for the camera.
fn least_device(device: DeviceName, camera: &Camera) -> DeviceName {
    match device {
        DeviceName::Auto if rounding_px(camera).is_some() => DeviceName::Cpu,
        device => device,
    }
}

/// The rounding error of 32-bit floats in the picture of `camera` if it may be visible, pixels.
fn rounding_px(camera: &Camera) -> Option<f64> {
    let off = Precision::F32.rounding_px(camera);
    (off > VISIBLE_ROUNDING_PX).then_some(off)
}

/// Says what the rounding of a GPU's floats means for the picture of `camera`.
fn report_rounding(device: DeviceName, camera: &Camera) {
    let Some(off) = rounding_px(camera) else {
        return;
    };
    match device {
        DeviceName::Cpu => {}
        DeviceName::Gpu => message!(
            "viewer: the 32-bit floats of a GPU may be off by {off:.1} pixels in so narrow a field of \
             view; --device cpu draws it in 64 bits"
        ),
        DeviceName::Auto => message!(
            "viewer: drawing on the CPU: the 32-bit floats of a GPU would be off by up to {off:.1} \
             pixels in so narrow a field of view"
        ),
    }
}
