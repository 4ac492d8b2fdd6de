//! The star lists of one picture: linked lists of the light of star images, made for each frame and read by the
//! picture.

use super::StarsOnDevice;
use super::data::{InverseLensBlock, Piece};
use super::nodes::{self, Group};
use super::programs::{ListKey, StarPrograms, WORKGROUP};
use super::report::{Reports, StarLight};
use crate::gpu::bindings::bind_group;
use crate::gpu::camera_key::CameraKey;
use crate::gpu::compute::{ComputeShader, begin_compute};
use crate::gpu::layouts::Layouts;
use crate::gpu::timestamps::PassTimestamps;
use crate::gpu::{CameraBlock, Gpu, GpuError};
use crate::lens::{Deflection, Lens};
use crate::shadow::Shadow;
use crate::shift::Rendition;
use crate::stars::cells::Candidates;
use crate::stars::draw::arc_splats;
use crate::stars::image_bounds::ImageBounds;
use crate::stars::images::InverseLens;
use lensbake_tables::Row;
use std::sync::Arc;
use wgpu::*;

/// Largest number of pieces of arcs: those of about a dozen stars on the optical axis.
const PIECES: usize = 1 << 17;
/// Largest number of candidates. One dispatch may have more invocations.
const CANDIDATES: usize = 4_000_000;

/// The star lists of one picture.
#[derive(Debug)]
pub(in crate::gpu) struct StarLists {
    stars: StarsOnDevice,
    programs: Arc<StarPrograms>,
    /// The program that lists the images.
    list: Arc<ComputeShader>,
    queue: Queue,
    camera: Buffer,
    lens: Buffer,
    pieces: Buffer,
    candidates: Buffer,
    /// The number of requested nodes, and the head of each list.
    list_heads: Buffer,
    /// The heads of the groups' lists, as pictures read them.
    head_texture: Texture,
    /// Width and height of the picture, pixels.
    size: [u32; 2],
    listing: BindGroup,
    listing_pieces: BindGroup,
    summing: BindGroup,
    linking: BindGroup,
    reports: Reports,
    reading: BindGroup,
    shown: Option<ShownLens>,
    /// The images found in the last frame.
    found: Candidates,
    /// Number of candidates and of pieces on the GPU.
    counts: [u32; 2],
    /// Whether there were more candidates or pieces than the buffers hold.
    full: bool,
}

/// The inverse of a lens and the bounds of its images, with the deflection method and the row that both were computed
/// from.
#[derive(Debug)]
struct ShownLens {
    deflection: Deflection,
    row: Row,
    inverse: InverseLens,
    bounds: ImageBounds,
}

impl ShownLens {
    fn of(lens: &Lens, disc_radius: f64) -> Self {
        let inverse = InverseLens::of(lens);
        ShownLens {
            deflection: lens.deflection,
            row: lens.row.clone(),
            bounds: ImageBounds::of(&inverse, disc_radius),
            inverse,
        }
    }

    /// Whether it is the inverse of `lens`.
    fn is_of(&self, lens: &Lens) -> bool {
        self.deflection == lens.deflection && self.row == lens.row
    }
}

impl StarLists {
    /// Star lists for pictures of at most `size` pixels.
    pub(in crate::gpu) fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        programs: Arc<StarPrograms>,
        stars: &StarsOnDevice,
        size: [u32; 2],
    ) -> Self {
        let device = &gpu.device;
        let group = programs.group;
        let buffer = |label, size, usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let uniform = |label, bytes: usize| buffer(label, bytes as u64, BufferUsages::UNIFORM);
        let camera = uniform("camera of the stars", size_of::<CameraBlock>());
        let lens = uniform("inverse lens", size_of::<InverseLensBlock>());
        let storage = |label, bytes| buffer(label, bytes, BufferUsages::STORAGE);
        let pieces = storage("pieces of arcs", (PIECES * size_of::<Piece>()) as u64);
        let candidates = storage("candidates", 4 * CANDIDATES as u64);
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let list_heads = buffer("list heads", group.list_heads_bytes(size), usage);
        let nodes = nodes::node_texture(device).create_view(&Default::default());
        let whole = Buffer::as_entire_binding;
        // What each of the programs binds first.
        let shared = || {
            let nodes = BindingResource::TextureView(&nodes);
            [whole(&camera), whole(&list_heads), nodes]
        };
        let [a, b, c] = shared();
        let listing = [a, b, c, whole(&lens), stars.binding(), whole(&candidates)];
        let [a, b, c] = shared();
        let listing_pieces = [a, b, c, whole(&lens), whole(&pieces)];
        let overflow =
            |label, shader: &ComputeShader| bind_group(device, label, &shader.layout, shared());
        let head_texture = group.head_texture(device, size);
        let heads = head_texture.create_view(&Default::default());
        let reading = [&heads, &nodes].map(BindingResource::TextureView);
        let list = programs.list(ListKey::AT_REST);
        StarLists {
            listing: bind_group(device, "list stars", &list.layout, listing),
            listing_pieces: bind_group(
                device,
                "list pieces",
                &programs.list_pieces.layout,
                listing_pieces,
            ),
            summing: overflow("sum overflow lists", &programs.sum_overflows),
            linking: overflow("link overflow sums", &programs.link_sums),
            reading: bind_group(
                device,
                "lists of stars",
                &layouts.compute().star_lists,
                reading,
            ),
            reports: Reports::new(device, group),
            queue: gpu.queue.clone(),
            stars: stars.clone(),
            programs,
            list,
            camera,
            lens,
            pieces,
            candidates,
            list_heads,
            head_texture,
            size,
            shown: None,
            found: Candidates::default(),
            counts: [0; 2],
            full: false,
        }
    }

    /// Whether these are the lists of `stars`, one for each `group` of pixels.
    pub(in crate::gpu) fn are_of(&self, stars: &StarsOnDevice, group: Group) -> bool {
        self.stars == *stars && self.programs.group == group
    }

    /// Sets what the next lists contain: the stars as seen through `lens`. The inverse row is computed again only
    /// for another row or deflection method.
    pub(in crate::gpu) fn show(&mut self, lens: &Lens, rendition: Rendition) {
        let (cells, found) = (&self.stars.0.cells, &mut self.found);
        let radius = cells.disc_radius();
        let shown = self.shown.take().filter(|shown| shown.is_of(lens));
        let shown = shown.unwrap_or_else(|| ShownLens::of(lens, radius));
        let inverse = &shown.inverse;
        cells.find(&lens.camera, &shown.bounds, rendition, found);
        let points = &found.points[..found.points.len().min(CANDIDATES)];
        let on_axis = found.arcs.iter().map(|i| &cells.stars()[*i as usize]);
        let splats = arc_splats(lens, inverse, on_axis, radius, rendition);
        let pieces: Vec<Piece> = splats.iter().take(PIECES).map(Piece::from).collect();
        self.full = found.points.len() > CANDIDATES || splats.len() > PIECES;
        self.counts = [points.len(), pieces.len()].map(|n| n as u32);
        let block = InverseLensBlock::new(inverse, radius, self.counts);
        let camera = CameraBlock::new(&lens.camera, Shadow::of(lens), rendition.light_scale);
        self.list = self.programs.list(ListKey {
            bent: matches!(inverse, InverseLens::Bent(_)),
            motion: CameraKey::of(&lens.camera).without_radial_motion(),
            shift: rendition.shift,
        });
        let write = |buffer, bytes| self.queue.write_buffer(buffer, 0, bytes);
        write(&self.camera, bytemuck::bytes_of(&camera));
        write(&self.lens, bytemuck::bytes_of(&block));
        write(&self.pieces, bytemuck::cast_slice(&pieces));
        write(&self.candidates, bytemuck::cast_slice(points));
        self.shown = Some(shown);
        self.size = [lens.camera.width, lens.camera.height];
    }

    /// Encodes what makes the lists; `timestamps` records when the dispatches begin and end.
    pub(in crate::gpu) fn make(
        &self,
        encoder: &mut CommandEncoder,
        timestamps: Option<PassTimestamps>,
    ) {
        encoder.clear_buffer(&self.list_heads, 0, None);
        self.dispatch(&mut begin_compute(encoder, "star lists", timestamps));
        let (heads, texture) = (&self.list_heads, &self.head_texture);
        self.programs
            .group
            .copy_heads(encoder, heads, texture, self.size);
    }

    fn dispatch(&self, pass: &mut ComputePass) {
        let programs = &self.programs;
        let [listed, pieces] = self.counts.map(|n| n.div_ceil(WORKGROUP));
        let summed = programs.group.sum_invocations() / WORKGROUP;
        for (shader, group, workgroups) in [
            (&*self.list, &self.listing, listed),
            (&programs.list_pieces, &self.listing_pieces, pieces),
            (&programs.sum_overflows, &self.summing, summed),
            (&programs.link_sums, &self.linking, summed),
        ] {
            pass.set_pipeline(&shader.pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(workgroups, 1, 1);
        }
    }

    /// Encodes the copy of the node count that [`StarLists::arrived`] reports, after [`StarLists::make`].
    pub(in crate::gpu) fn report(&self, encoder: &mut CommandEncoder) {
        self.reports.encode(encoder, &self.list_heads, self.full);
    }

    /// Whether the newest frame whose node count has arrived since the last call contains the light of all its
    /// stars; `None` if no count has arrived. Does not block. Call it after the encoded commands are submitted.
    pub(in crate::gpu) fn arrived(&self) -> Option<StarLight> {
        self.reports.arrived()
    }

    /// Whether a node count is under way that [`StarLists::arrived`] will report.
    pub(in crate::gpu) fn awaited(&self) -> bool {
        self.reports.under_way()
    }

    /// The bind group with which a picture reads the lists.
    pub(in crate::gpu) fn reading(&self) -> &BindGroup {
        &self.reading
    }

    /// Checks that the lists that were made last held the light of all stars.
    ///
    /// # Errors
    /// [`GpuError::TooManyStars`] if they did not, [`GpuError::Failed`] if the device fails.
    pub(in crate::gpu) async fn check(&self, gpu: &Gpu) -> Result<(), GpuError> {
        let requested: Vec<u32> = gpu.copy_back(&self.list_heads, 4).await?;
        match StarLight::of(requested[0], self.programs.group, self.full) {
            StarLight::Whole => Ok(()),
            StarLight::PartLost => Err(GpuError::TooManyStars),
        }
    }
}
