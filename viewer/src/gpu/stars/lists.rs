//! The lists of stars of one canvas: what is made of them for a frame, and how it comes into the picture.

use super::Stars;
use super::data::{GpuLens, Piece};
use super::nodes;
use super::report::{Reports, StarLight};
use super::shader::WORKGROUP;
use crate::gpu::bindings::bind_group;
use crate::gpu::step::Step;
use crate::gpu::{Frame, Gpu, GpuError, Tile};
use crate::scene::{Method, Scene};
use crate::stars::cells::Candidates;
use crate::stars::draw::arc_splats;
use crate::stars::images::Lens;
use lensbake_tables::Row;
use std::sync::Arc;
use wgpu::*;

/// Pieces of arcs there is room for: those of some dozen stars on the axis.
const PIECES: usize = 1 << 17;
/// Images of stars there is room for; with the pieces, as many as one dispatch may have.
const CANDIDATES: usize = 4_000_000;

/// The lists of stars of one canvas.
#[derive(Debug)]
pub(in crate::gpu) struct StarLists {
    stars: Arc<Stars>,
    queue: Queue,
    frame: Buffer,
    lens: Buffer,
    pieces: Buffer,
    candidates: Buffer,
    /// The number of places asked for, and where each list begins.
    heads: Buffer,
    making: BindGroup,
    folding: BindGroup,
    linking: BindGroup,
    reports: Reports,
    reading: BindGroup,
    /// What is on the GPU: the method and the row that the lens was made of.
    shown: Option<(Method, Row, Lens)>,
    /// What the stars of the last scene were found to be.
    found: Candidates,
    invocations: u32,
    /// Whether there are more stars than there is room for.
    full: bool,
}

impl StarLists {
    /// Lists for pictures of `size` pixels.
    pub(in crate::gpu) fn new(gpu: &Gpu, stars: Arc<Stars>, size: [u32; 2]) -> Self {
        let device = &gpu.device;
        let buffer = |label, size, usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let uniform = |label, bytes: usize| buffer(label, bytes as u64, BufferUsages::UNIFORM);
        let frame = uniform("frame of the stars", size_of::<Frame>());
        let lens = uniform("lens", size_of::<GpuLens>());
        let storage = |label, bytes| buffer(label, bytes, BufferUsages::STORAGE);
        let pieces = storage("pieces of arcs", (PIECES * size_of::<Piece>()) as u64);
        let candidates = storage("candidates", 4 * CANDIDATES as u64);
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let heads = buffer("heads", nodes::heads_bytes(size), usage);
        let nodes = nodes::places(device).create_view(&Default::default());
        let whole = Buffer::as_entire_binding;
        let making = [
            whole(&frame),
            whole(&lens),
            whole(&stars.buffer),
            whole(&pieces),
            whole(&candidates),
            whole(&heads),
            BindingResource::TextureView(&nodes),
        ];
        let overflows = |label, step: &Step| {
            let nodes = BindingResource::TextureView(&nodes);
            let resources = [whole(&frame), whole(&heads), nodes];
            bind_group(device, label, &step.layout, resources)
        };
        let reading = [whole(&heads), BindingResource::TextureView(&nodes)];
        StarLists {
            making: bind_group(device, "stars to lists", &stars.bent.layout, making),
            folding: overflows("fold stars", &stars.folding),
            linking: overflows("link stars", &stars.linking),
            reading: bind_group(device, "lists of stars", &stars.list_layout, reading),
            reports: Reports::new(device),
            queue: gpu.queue.clone(),
            stars,
            frame,
            lens,
            pieces,
            candidates,
            heads,
            shown: None,
            found: Candidates::default(),
            invocations: 0,
            full: false,
        }
    }

    /// Sets what the next lists are made of: the stars as the camera of `scene` sees them. The inverse row
    /// is made anew only for another row or method.
    pub(in crate::gpu) fn show(&mut self, scene: &Scene) {
        let shown = self.shown.as_ref();
        if shown.is_none_or(|(method, row, _)| *method != scene.method || *row != scene.row) {
            let Ok(lens) = Lens::of(scene) else {
                unreachable!("a camera is at no infinite distance");
            };
            self.shown = Some((scene.method, scene.row.clone(), lens));
        }
        let Some((.., lens)) = &self.shown else {
            return;
        };
        let (cells, found) = (&self.stars.cells, &mut self.found);
        cells.find(&scene.camera, lens, found);
        let radius = cells.disc_radius();
        let points = &found.points[..found.points.len().min(CANDIDATES)];
        let on_axis = found.arcs.iter().map(|i| &cells.stars()[*i as usize]);
        let splats = arc_splats(&scene.camera, lens, on_axis, radius);
        let pieces: Vec<Piece> = splats.iter().take(PIECES).map(Piece::from).collect();
        self.full = found.points.len() > CANDIDATES || splats.len() > PIECES;
        let counts = [points.len(), pieces.len()].map(|n| n as u32);
        self.invocations = counts.iter().sum();
        let block = GpuLens::new(lens, radius, counts);
        let camera = &scene.camera;
        let whole = Tile {
            first: [0, 0],
            count: [camera.width, camera.height],
        };
        let frame = Frame::new(camera, whole, 1.0);
        let write = |buffer, bytes| self.queue.write_buffer(buffer, 0, bytes);
        write(&self.frame, bytemuck::bytes_of(&frame));
        write(&self.lens, bytemuck::bytes_of(&block));
        write(&self.pieces, bytemuck::cast_slice(&pieces));
        write(&self.candidates, bytemuck::cast_slice(points));
    }

    /// Encodes the emptying of the lists, which must come before [`StarLists::make`].
    pub(in crate::gpu) fn clear(&self, encoder: &mut CommandEncoder) {
        encoder.clear_buffer(&self.heads, 0, None);
    }

    /// Encodes the making of the lists.
    pub(in crate::gpu) fn make(&self, pass: &mut ComputePass) {
        let making = match &self.shown {
            Some((.., Lens::Flat(_))) => &self.stars.flat,
            _ => &self.stars.bent,
        };
        pass.set_pipeline(&making.pipeline);
        pass.set_bind_group(0, &self.making, &[]);
        pass.dispatch_workgroups(self.invocations.div_ceil(WORKGROUP), 1, 1);
        for (step, group) in [
            (&self.stars.folding, &self.folding),
            (&self.stars.linking, &self.linking),
        ] {
            pass.set_pipeline(&step.pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(nodes::FOLDING / WORKGROUP, 1, 1);
        }
    }

    /// Encodes the way back of what [`StarLists::arrived`] tells, after the pass in which the lists were made.
    pub(in crate::gpu) fn report(&self, encoder: &mut CommandEncoder) {
        self.reports.encode(encoder, &self.heads, self.full);
    }

    /// Whether the newest frame that has come back since the last call has all light; none if none has.
    /// Does not block. Call it after the encoded commands are submitted.
    pub(in crate::gpu) fn arrived(&self) -> Option<StarLight> {
        self.reports.arrived()
    }

    /// Whether [`StarLists::arrived`] will have something to tell.
    pub(in crate::gpu) fn awaited(&self) -> bool {
        self.reports.under_way()
    }

    /// The lists as a picture reads them.
    pub(in crate::gpu) fn reading(&self) -> &BindGroup {
        &self.reading
    }

    /// Checks that the lists that were made last have held all the light.
    ///
    /// # Errors
    /// [`GpuError::TooManyStars`] if they have not, [`GpuError::Failed`] if the device fails.
    pub(in crate::gpu) fn check(&self, gpu: &Gpu) -> Result<(), GpuError> {
        let asked: Vec<u32> = gpu.copy_back(&self.heads, 4)?;
        match StarLight::of(asked[0], self.full) {
            StarLight::Whole => Ok(()),
            StarLight::PartLost => Err(GpuError::TooManyStars),
        }
    }
}
