//! Opens a GPU device, waits for it and reads buffers back from it.

use super::backend;
use super::failure::Failure;
use super::needs::{Needs, has_compute};
use futures_channel::oneshot;
use std::sync::Arc;
use thiserror::Error;
use wgpu::*;

/// Time between two polls for finished work with WebGL2, ms.
#[cfg(target_arch = "wasm32")]
const POLL_MS: u32 = 4;

/// There is no GPU, or it failed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GpuError {
    /// There is no adapter.
    #[cfg_attr(target_arch = "wasm32", error("no adapter of WebGPU or WebGL 2"))]
    #[cfg_attr(
        not(target_arch = "wasm32"),
        error(
            "no GPU adapter found: install a Vulkan driver (on Debian and Ubuntu `mesa-vulkan-drivers` \
         brings one in software), or draw without one: viewer render --device cpu"
        )
    )]
    NoAdapter,
    /// `WGPU_BACKEND` names a backend that is unknown or not available.
    #[error(
        "WGPU_BACKEND is '{asked}', which names a backend that is unknown or not available on this system: \
         set it to {known}, or leave it unset"
    )]
    Backend {
        /// Value of the variable.
        asked: String,
        /// Names of the available backends.
        known: String,
    },
    /// The adapter cannot be opened.
    #[error("the GPU {adapter} cannot be opened: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// Error message of the device.
        reason: String,
    },
    /// There are more star images than the star lists hold.
    #[error(
        "more images of stars than the GPU has room for: lower --star-exposure, leave out the faintest \
         stars, or use --device cpu"
    )]
    TooManyStars,
    /// The adapter cannot draw to the window.
    #[error("the window cannot be drawn to: {0}")]
    NoSurface(String),
    /// The device failed while working.
    #[error("the GPU {adapter} failed: {reason}")]
    Failed {
        /// Name of the adapter.
        adapter: String,
        /// Error message of the device.
        reason: String,
    },
}

/// An open device; a clone refers to the same device.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// The device.
    pub device: Device,
    /// Its queue.
    pub queue: Queue,
    adapter: Adapter,
    instance: Instance,
    info: AdapterInfo,
    failure: Failure,
}

impl Gpu {
    /// Opens the fastest available adapter. `WGPU_BACKEND` chooses the backend.
    ///
    /// # Errors
    /// [`GpuError::Backend`] if `WGPU_BACKEND` names an unknown or unavailable backend, [`GpuError::NoAdapter`] if
    /// there is no adapter, [`GpuError::NoDevice`] if it cannot be opened.
    pub async fn open() -> Result<Self, GpuError> {
        let instance = new_instance(backend::asked_for()?).await;
        Self::on_adapter(instance, None, Needs::Most).await
    }

    /// Opens the same adapter as [`Gpu::open`] with no more than WebGL2 offers: without compute shaders, storage
    /// buffers, storage textures or features. It shows on any device what is drawn on such a one.
    ///
    /// # Errors
    /// As [`Gpu::open`].
    pub async fn open_without_compute() -> Result<Self, GpuError> {
        let instance = new_instance(backend::asked_for()?).await;
        Self::on_adapter(instance, None, Needs::WebGl2).await
    }

    /// Checks that `WGPU_BACKEND` is unset or names available backends. Opens no device.
    ///
    /// # Errors
    /// [`GpuError::Backend`] if it does not.
    pub fn check_backend() -> Result<(), GpuError> {
        backend::asked_for().map(|_| ())
    }

    /// Opens the fastest adapter that can draw to `window`, and creates a surface for the window. In a browser this is
    /// WebGPU if it has an adapter, and WebGL2 otherwise.
    ///
    /// # Errors
    /// As [`Gpu::open`], and [`GpuError::NoSurface`] if no surface can be created.
    pub async fn open_for(
        window: impl Into<SurfaceTarget<'static>>,
    ) -> Result<(Self, Surface<'static>), GpuError> {
        Self::open_for_backends(window, backend::asked_for()?).await
    }

    /// As [`Gpu::open_for`], on one of these backends only: for example [`Backends::GL`] for WebGL2 in a browser that
    /// has WebGPU as well. `WGPU_BACKEND` is ignored.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] if there is no adapter, [`GpuError::NoDevice`] if it cannot be opened,
    /// [`GpuError::NoSurface`] if no surface can be created.
    pub async fn open_for_backends(
        window: impl Into<SurfaceTarget<'static>>,
        backends: Backends,
    ) -> Result<(Self, Surface<'static>), GpuError> {
        let instance = new_instance(backends).await;
        let surface = instance
            .create_surface(window)
            .map_err(|e| GpuError::NoSurface(one_line(&e.to_string())))?;
        let gpu = Self::on_adapter(instance, Some(&surface), Needs::Most).await?;
        Ok((gpu, surface))
    }

    async fn on_adapter(
        instance: Instance,
        surface: Option<&Surface<'_>>,
        needs: Needs,
    ) -> Result<Self, GpuError> {
        let options = RequestAdapterOptions {
            power_preference: PowerPreference::HighPerformance,
            compatible_surface: surface,
            ..Default::default()
        };
        let adapter = instance
            .request_adapter(&options)
            .await
            .map_err(|_| GpuError::NoAdapter)?;
        let info = adapter.get_info();
        let (device, queue) = adapter
            .request_device(&DeviceDescriptor {
                required_features: needs.features(&adapter),
                required_limits: needs.limits(&adapter),
                ..Default::default()
            })
            .await
            .map_err(|e| GpuError::NoDevice {
                adapter: info.name.clone(),
                reason: e.to_string(),
            })?;
        let failure = Failure::default();
        let on_error = failure.clone();
        device.on_uncaptured_error(Arc::new(move |error: Error| {
            on_error.note(&error.to_string());
        }));
        let on_loss = failure.clone();
        device.set_device_lost_callback(move |reason, text| match reason {
            DeviceLostReason::Destroyed => (),
            _ => on_loss.note(&format!("the device was lost: {text}")),
        });
        Ok(Gpu {
            device,
            queue,
            adapter,
            instance,
            info,
            failure,
        })
    }

    /// Creates a new surface for `window` in place of one that was lost.
    ///
    /// # Errors
    /// [`GpuError::NoSurface`] if no surface can be created.
    pub fn surface(
        &self,
        window: impl Into<SurfaceTarget<'static>>,
    ) -> Result<Surface<'static>, GpuError> {
        self.instance
            .create_surface(window)
            .map_err(|e| GpuError::NoSurface(one_line(&e.to_string())))
    }

    /// The adapter that the device was opened on.
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// The adapter's name and backend.
    pub fn name(&self) -> String {
        format!("{} ({})", self.info.name, self.info.backend)
    }

    /// The adapter's backend.
    pub fn backend(&self) -> Backend {
        self.info.backend
    }

    /// Whether the device has compute shaders and what they write: storage buffers and storage textures. WebGL2 has
    /// none.
    pub fn has_compute(&self) -> bool {
        has_compute(&self.device.limits())
    }

    /// Whether the adapter is a software adapter, which runs on the CPU.
    pub fn is_software(&self) -> bool {
        self.info.device_type == DeviceType::Cpu
    }

    /// Whether the device supports timestamp queries.
    pub fn has_timestamps(&self) -> bool {
        self.device.features().contains(Features::TIMESTAMP_QUERY)
    }

    /// Whether the device has textures of 16-bit integers that stand for numbers from 0 to 1, which rows in the format
    /// `Unorm16` need.
    pub fn has_unorm16(&self) -> bool {
        let features = self.device.features();
        features.contains(Features::TEXTURE_FORMAT_16BIT_NORM)
    }

    /// Runs `work`, which may exceed the device's memory or limits. The device stays usable if it does.
    ///
    /// # Errors
    /// [`GpuError::Failed`] with the device's error message.
    pub(super) async fn attempt<T>(&self, work: impl FnOnce() -> T) -> Result<T, GpuError> {
        let invalid = self.device.push_error_scope(ErrorFilter::Validation);
        let too_much = self.device.push_error_scope(ErrorFilter::OutOfMemory);
        let done = work();
        // Both scopes end now, whatever is done while the results are awaited.
        let (too_much, invalid) = (too_much.pop(), invalid.pop());
        let first = too_much.await.or(invalid.await);
        first.map_or(Ok(done), |error| Err(self.failed(error)))
    }

    /// Waits until all submitted work is done.
    ///
    /// # Errors
    /// [`GpuError::Failed`] with the first error since the device was opened.
    pub async fn wait(&self) -> Result<(), GpuError> {
        let (done, waiting) = oneshot::channel();
        self.queue.on_submitted_work_done(move || {
            // The receiver may have been dropped.
            let _ = done.send(());
        });
        self.arrived(waiting).await?;
        self.check()
    }

    /// The result of finished work, once its callback has sent it; `None` if it never will.
    #[cfg(not(target_arch = "wasm32"))]
    async fn arrived<T>(&self, waiting: oneshot::Receiver<T>) -> Result<Option<T>, GpuError> {
        let polled = self.device.poll(PollType::wait_indefinitely());
        self.check()?;
        polled.map_err(|e| self.failed(e))?;
        Ok(waiting.await.ok())
    }

    /// The result of finished work, once its callback has sent it; `None` if it never will. WebGPU runs the callbacks by
    /// itself. With WebGL2 only polling does, and nothing is finished before the browser is given back control.
    #[cfg(target_arch = "wasm32")]
    async fn arrived<T>(&self, mut waiting: oneshot::Receiver<T>) -> Result<Option<T>, GpuError> {
        if self.info.backend != Backend::Gl {
            return Ok(waiting.await.ok());
        }
        loop {
            self.poll()?;
            match waiting.try_recv() {
                Ok(None) => gloo_timers::future::TimeoutFuture::new(POLL_MS).await,
                Ok(result) => return Ok(result),
                Err(_) => return Ok(None),
            }
        }
    }

    /// Runs the callbacks of finished work, without waiting.
    ///
    /// # Errors
    /// [`GpuError::Failed`] with the first error since the device was opened.
    pub fn poll(&self) -> Result<(), GpuError> {
        let polled = self.device.poll(PollType::Poll);
        self.check()?;
        polled.map(|_| ()).map_err(|e| self.failed(e))
    }

    fn check(&self) -> Result<(), GpuError> {
        self.failure
            .first()
            .map_or(Ok(()), |reason| Err(self.failed(reason)))
    }

    /// Waits until the device fails or is lost, and returns the first error. Does not keep the device open; once all clones
    /// of it are dropped, it waits for ever.
    pub fn failure(&self) -> impl Future<Output = GpuError> + use<> {
        let (reason, adapter) = (self.failure.wait(), self.info.name.clone());
        async move {
            GpuError::Failed {
                adapter,
                reason: reason.await,
            }
        }
    }

    /// The contents of `buffer`, which must have [`BufferUsages::MAP_READ`].
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device fails.
    pub async fn read<T: bytemuck::Pod>(&self, buffer: &Buffer) -> Result<Vec<T>, GpuError> {
        let (mapped, waiting) = oneshot::channel();
        buffer.slice(..).map_async(MapMode::Read, move |result| {
            // The receiver may have been dropped.
            let _ = mapped.send(result);
        });
        if let Some(Err(error)) = self.arrived(waiting).await? {
            return Err(self.failed(error));
        }
        let view = buffer
            .slice(..)
            .get_mapped_range()
            .map_err(|e| self.failed(e))?;
        let contents = bytemuck::pod_collect_to_vec(&view);
        drop(view);
        buffer.unmap();
        Ok(contents)
    }

    /// The first `bytes` bytes of `buffer`, which must have [`BufferUsages::COPY_SRC`].
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device fails.
    pub async fn copy_back<T: bytemuck::Pod>(
        &self,
        buffer: &Buffer,
        bytes: u64,
    ) -> Result<Vec<T>, GpuError> {
        let read_back = self.device.create_buffer(&BufferDescriptor {
            label: Some("read back"),
            size: bytes,
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &read_back, 0, bytes);
        self.queue.submit([encoder.finish()]);
        self.read(&read_back).await
    }

    fn failed(&self, reason: impl ToString) -> GpuError {
        GpuError::Failed {
            adapter: self.info.name.clone(),
            reason: one_line(&reason.to_string()),
        }
    }
}

async fn new_instance(backends: Backends) -> Instance {
    let mut descriptor = InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends = backends;
    // This validation adds a dispatch before each indirect one, to check counts that our own shader has written.
    // It costs a filtered frame a tenth of its time on a software adapter.
    descriptor
        .flags
        .remove(InstanceFlags::VALIDATION_INDIRECT_CALL);
    // A canvas that has been used by WebGPU cannot be used by WebGL2 afterwards, so WebGPU is left out unless it has
    // an adapter.
    util::new_instance_with_webgpu_detection(descriptor).await
}

pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::texture;
    use pollster::block_on;

    #[test]
    #[cfg_attr(feature = "no-gpu", ignore = "feature no-gpu")]
    fn a_device_goes_on_after_what_was_too_much_for_it() {
        let gpu = block_on(Gpu::open()).unwrap();
        let make = |side| {
            let usage = TextureUsages::TEXTURE_BINDING;
            let make = || texture(&gpu.device, "", [side, 1], TextureFormat::R8Unorm, usage);
            block_on(gpu.attempt(make)).map(|_| ())
        };
        let most = gpu.device.limits().max_texture_dimension_2d;
        assert_eq!(make(most), Ok(()));
        let error = make(most + 1).unwrap_err();
        assert!(matches!(error, GpuError::Failed { .. }), "{error}");
        assert_eq!(gpu.poll(), Ok(()));
        assert_eq!(make(64), Ok(()));
    }
}
