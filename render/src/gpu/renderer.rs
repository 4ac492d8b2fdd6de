//! Draws scenes on a GPU.

use super::pass::Pass;
use super::pipelines::{Pipelines, Program};
use super::prepared::picture_key;
use super::source::{Output, PipelineKey};
use super::stars::StarsOnDevice;
use super::{Gpu, GpuError, Passes, Prepared, Region, ResidentScene, SkyOnDevice, SkyUpload};
use crate::camera::Mapping;
use crate::cpu;
use crate::disc::Disc;
use crate::lens::Lens;
use crate::picture::Picture;
use crate::scene::{Sampling, Scene};
use crate::shift::Shift;
use crate::sky::Sky;
use crate::stars::StarField;
use glam::{DVec3, Vec3};
use lensbake_core::RayOutcome;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use wgpu::*;

/// Where the light of each pixel comes from: unit directions on the sky in the hole frame, row-major
/// `[height][width]`.
pub type Trace = Vec<RayOutcome<DVec3>>;

/// A renderer on one device; a clone shares its pipelines and uploads.
#[derive(Debug, Clone)]
pub struct Renderer {
    gpu: Gpu,
    /// The kind of pass of all pictures; if `None`, the fastest for each.
    pass: Option<Pass>,
    pipelines: Arc<Pipelines>,
    uploaded: Arc<Mutex<Uploaded>>,
}

/// The uploaded sky and stars of the last scene. If the next scene has the same ones, nothing is uploaded.
#[derive(Debug, Default)]
struct Uploaded {
    sky: Option<(Weak<Sky>, SkyOnDevice)>,
    stars: Option<(Weak<StarField>, StarsOnDevice)>,
}

impl Renderer {
    /// A renderer on `gpu`, which draws in [`Pass::fastest_on`].
    pub fn new(gpu: &Gpu) -> Self {
        Renderer {
            pipelines: Arc::new(Pipelines::new(gpu)),
            gpu: gpu.clone(),
            pass: None,
            uploaded: Arc::default(),
        }
    }

    /// A renderer on `gpu` that draws in `pass`; in [`Pass::Fragment`] on a device without compute shaders.
    pub fn with_pass(gpu: &Gpu, pass: Pass) -> Self {
        Self::new(gpu).in_pass(pass)
    }

    /// The same renderer, with the same pipelines and uploads, drawing in another kind of pass; in [`Pass::Fragment`]
    /// on a device without compute shaders.
    pub fn in_pass(self, pass: Pass) -> Self {
        let pass = if self.gpu.has_compute() {
            pass
        } else {
            Pass::Fragment
        };
        Renderer {
            pass: Some(pass),
            ..self
        }
    }

    /// The kind of pass that it draws `output` in.
    pub fn pass(&self, output: Output) -> Pass {
        self.pass
            .unwrap_or_else(|| Pass::fastest_on(&self.gpu, output))
    }

    /// Whether it draws the stars of a scene: their images are listed by compute shaders, which not every device has.
    pub fn draws_stars(&self) -> bool {
        self.gpu.has_compute()
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    pub(super) fn pipelines(&self) -> &Arc<Pipelines> {
        &self.pipelines
    }

    /// The program of `key`. Compiles it the first time.
    pub(super) fn program(&self, key: PipelineKey) -> Arc<Program> {
        self.pipelines.program(key.in_pass(self.pass(key.output)))
    }

    /// Compiles what pictures through `lens` need, so that the first of them finds it compiled: another thread can do this
    /// while the sky is made. `stars` is whether they have stars.
    pub fn compile(
        &self,
        lens: &Lens,
        sampling: Sampling,
        stars: bool,
        shift: Shift,
        disc: Option<&Disc>,
    ) {
        let stars = stars && self.draws_stars_through(lens);
        let program = self.program(picture_key(lens, sampling, stars, shift, disc));
        if stars {
            self.pipelines.stars(program.key.group);
        }
    }

    /// Uploads a sky to the device.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if it does not fit; the device stays usable.
    pub async fn upload_sky(&self, sky: &Sky) -> Result<SkyOnDevice, GpuError> {
        let Gpu { device, queue, .. } = &self.gpu;
        let upload = || SkyOnDevice::new(device, queue, &self.pipelines.layouts, sky);
        let sky = self.gpu.attempt(upload).await?;
        self.gpu.wait().await?;
        Ok(sky)
    }

    /// Makes room on the device for a sky of this many texels along the edge of a face, which is then written face by
    /// face.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if it does not fit; the device stays usable.
    pub async fn begin_sky(&self, face_texels: u32) -> Result<SkyUpload, GpuError> {
        let Gpu { device, queue, .. } = &self.gpu;
        let begin = || SkyUpload::new(device, queue, &self.pipelines.layouts, face_texels);
        self.gpu.attempt(begin).await
    }

    /// Uploads stars to the device, sorted into cells of the sky. Nothing is uploaded to a device that cannot draw them
    /// ([`Renderer::draws_stars`]).
    pub fn upload_stars(&self, field: &StarField) -> StarsOnDevice {
        StarsOnDevice::new(&self.gpu, field)
    }

    /// Uploads the sky and the stars of `scene`, unless they are those of the scene before.
    ///
    /// # Errors
    /// As [`Renderer::upload_sky`].
    pub async fn upload(&self, scene: &Scene) -> Result<ResidentScene, GpuError> {
        let sky = match self.uploaded_sky(&scene.sky) {
            Some(sky) => sky,
            None => {
                let sky = self.upload_sky(&scene.sky).await?;
                self.lock().sky = Some((Arc::downgrade(&scene.sky), sky.clone()));
                sky
            }
        };
        let stars = scene.stars.as_ref();
        let stars = stars.filter(|_| self.draws_stars_through(&scene.lens));
        let stars = stars.map(|field| self.stars_of(field));
        Ok(Scene {
            lens: scene.lens.clone(),
            sampling: scene.sampling,
            sky,
            stars,
            rendition: scene.rendition,
            disc: scene.disc,
        })
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Uploaded> {
        self.uploaded.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn uploaded_sky(&self, sky: &Arc<Sky>) -> Option<SkyOnDevice> {
        let uploaded = self.lock();
        let (of, sky_on_device) = uploaded.sky.as_ref()?;
        std::ptr::eq(of.as_ptr(), Arc::as_ptr(sky)).then(|| sky_on_device.clone())
    }

    fn stars_of(&self, field: &Arc<StarField>) -> StarsOnDevice {
        let mut uploaded = self.lock();
        match &uploaded.stars {
            Some((of, stars)) if std::ptr::eq(of.as_ptr(), Arc::as_ptr(field)) => stars.clone(),
            _ => {
                let stars = self.upload_stars(field);
                uploaded.stars = Some((Arc::downgrade(field), stars.clone()));
                stars
            }
        }
    }

    /// Whether it draws the stars of a scene through this lens. Only those of a picture in perspective are drawn on the
    /// device.
    pub(super) fn draws_stars_through(&self, lens: &Lens) -> bool {
        self.draws_stars() && lens.camera.mapping == Mapping::Perspective
    }

    /// Draws the picture of a scene, without its stars if the device cannot draw them ([`Renderer::draws_stars`]). The
    /// stars of a picture that is not in perspective are added on the CPU.
    /// `band_done` is called with the number of rows drawn so far.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device fails, [`GpuError::TooManyStars`] if the star lists do not hold all
    /// images.
    pub async fn picture(
        &self,
        scene: &Scene,
        band_done: impl Fn(u32),
    ) -> Result<Picture, GpuError> {
        let camera = &scene.lens.camera;
        let mut light = Vec::with_capacity(camera.pixels());
        self.stream(scene, |band, pixels| {
            light.extend(pixels.iter().map(|&[r, g, b, _]| [r, g, b]));
            band_done(band.first[1] + band.count[1]);
        })
        .await?;
        let mut picture = Picture::new(camera.width, camera.height, light);
        if camera.mapping != Mapping::Perspective {
            cpu::finish(&mut picture, scene);
        }
        Ok(picture)
    }

    /// Draws a scene and calls `take` with each of its bands, from the top down, and with the band's pixels: for
    /// pictures too large to be kept. One that is not in perspective has no stars, and a fisheye no rim.
    ///
    /// # Errors
    /// As [`Renderer::picture`]; [`GpuError::TooManyStars`] comes before the first band is taken.
    pub async fn stream(
        &self,
        scene: &Scene,
        take: impl FnMut(Region, &[[f32; 4]]),
    ) -> Result<(), GpuError> {
        let scene = self.upload(scene).await?;
        self.read_bands(&self.prepare(&scene), take).await
    }

    /// Finds where the light of each pixel comes from. A ray whose direct integration does not finish counts as
    /// captured. `band_done` is called with the number of rows done so far.
    ///
    /// # Errors
    /// [`GpuError::Failed`] if the device fails.
    pub async fn trace(&self, lens: &Lens, band_done: impl Fn(u32)) -> Result<Trace, GpuError> {
        const ESCAPES: f32 = 1.0;
        let decode = |&[x, y, z, outcome]: &[f32; 4]| {
            if outcome == ESCAPES {
                RayOutcome::Escapes(Vec3::new(x, y, z).as_dvec3())
            } else {
                RayOutcome::Captured
            }
        };
        let mut trace = Vec::with_capacity(lens.camera.pixels());
        self.read_bands(&Prepared::trace(self, lens), |band, pixels| {
            trace.extend(pixels.iter().map(decode));
            band_done(band.first[1] + band.count[1]);
        })
        .await?;
        Ok(trace)
    }

    /// Creates everything that drawing `scene` needs, so that only the dispatches remain.
    pub fn prepare(&self, scene: &ResidentScene) -> Prepared {
        Prepared::picture(self, scene)
    }

    async fn read_bands(
        &self,
        prepared: &Prepared,
        mut take: impl FnMut(Region, &[[f32; 4]]),
    ) -> Result<(), GpuError> {
        let Gpu { device, queue, .. } = &self.gpu;
        let target = prepared.target();
        let read_back = device.create_buffer(&BufferDescriptor {
            label: Some("pixels read back"),
            size: target.bytes(),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        for (i, &band) in prepared.bands().iter().enumerate() {
            let mut encoder = device.create_command_encoder(&Default::default());
            prepared.encode(&mut encoder, i, None);
            target.copy(&mut encoder, band, &read_back);
            queue.submit([encoder.finish()]);
            let pixels = target.unpadded(self.gpu.read(&read_back).await?, band);
            if i == 0 {
                // The star lists are made with the first band, and all bands read them.
                prepared.check_stars().await?;
            }
            take(band, &pixels);
        }
        Ok(())
    }
}
