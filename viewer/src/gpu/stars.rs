//! Stars on a GPU. A first dispatch finds the images of every star and puts the light that falls on each
//! pixel into the pixel's list; the picture adds up the lists. So the light is summed in f32, which no
//! integer atomic and no blending into 16-bit floats would give, on any device that can compute.

use super::renderer::{bind_group_layout, resource, storage_buffer_binding, uniform_binding};
use super::{Frame, Gpu, GpuError, Tile};
use crate::scene::{Method, Scene};
use crate::stars::cells::{Candidate, Cells};
use crate::stars::draw::{Splat, arc_splats};
use crate::stars::images::{FAINTEST, Lens, point_distance};
use crate::stars::kernel::REACHES;
use crate::stars::{PointStar, StarField};
use lensbake_tables::inverse::{self, GpuInverseRow, INVERSE_TEXELS, Inverse};
use lensbake_tables::{Row, Texel, lookup};
use std::sync::Arc;
use wgpu::util::DeviceExt;
use wgpu::*;

/// Places in the lists of all pixels together: 64 MiB.
const NODES: u64 = 1 << 22;
/// Bytes of such a place, as `shaders/stars.wgsl` has it.
const NODE: u64 = 16;
/// Pieces of arcs there is room for: those of some dozen stars on the axis.
const PIECES: usize = 1 << 17;
/// Images of stars there is room for; with the pieces, as many as one dispatch may have.
const CANDIDATES: usize = 4_000_000;
/// Two texels of an inverse row each: a uniform array is made of vectors of four.
const INVERSE_PAIRS: usize = INVERSE_TEXELS as usize / 2;
/// Invocations of a workgroup.
const WORKGROUP: u32 = 64;

/// The struct `Star` of `shaders/stars.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct GpuStar {
    direction: [f32; 3],
    padding: f32,
    light: [f32; 3],
    padding_2: f32,
}

/// The struct `Piece` of `shaders/stars.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Piece {
    at: [f32; 2],
    reach: f32,
    padding: f32,
    light: [f32; 3],
    padding_2: f32,
}

/// The struct `Lens` of `shaders/stars.wgsl`.
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct GpuLens {
    point_distance: f32,
    candidates: u32,
    pieces: u32,
    padding: u32,
    inverse: Inverse,
    padding_2: [u32; 3],
    texels: [[f32; 4]; INVERSE_PAIRS],
}

/// Stars on a device, and the pipelines that sort them.
#[derive(Debug)]
pub(super) struct Stars {
    field: StarField,
    cells: Cells,
    buffer: Buffer,
    sort_layout: BindGroupLayout,
    pub(super) list_layout: BindGroupLayout,
    bent: ComputePipeline,
    flat: ComputePipeline,
}

impl Stars {
    pub(super) fn new(gpu: &Gpu, field: &StarField) -> Self {
        let device = &gpu.device;
        let stars: Vec<GpuStar> = field.stars.iter().map(gpu_star).collect();
        let read_only = storage_buffer_binding(true);
        let read_write = storage_buffer_binding(false);
        let layout = |label, bindings: &[_]| {
            bind_group_layout(device, label, ShaderStages::COMPUTE, bindings)
        };
        let sort_layout = layout(
            "stars to lists",
            &[
                uniform_binding(false),
                uniform_binding(false),
                read_only,
                read_only,
                read_write,
                read_write,
                read_only,
            ],
        );
        let list_layout = layout("lists of stars", &[read_only, read_only]);
        Stars {
            buffer: device.create_buffer_init(&util::BufferInitDescriptor {
                label: Some("stars"),
                contents: bytemuck::cast_slice(&stars),
                usage: BufferUsages::STORAGE,
            }),
            bent: pipeline(
                device,
                &sort_layout,
                include_str!("../shaders/lens_bent.wgsl"),
            ),
            flat: pipeline(
                device,
                &sort_layout,
                include_str!("../shaders/lens_flat.wgsl"),
            ),
            cells: Cells::new(field),
            field: field.clone(),
            sort_layout,
            list_layout,
        }
    }
}

/// The lists of stars of one canvas.
#[derive(Debug)]
pub(super) struct StarLists {
    stars: Arc<Stars>,
    queue: Queue,
    frame: Buffer,
    lens: Buffer,
    pieces: Buffer,
    candidates: Buffer,
    heads: Buffer,
    sort: BindGroup,
    lists: BindGroup,
    /// What is on the GPU: the method and the row that the lens was made of.
    shown: Option<(Method, Row, Lens)>,
    invocations: u32,
    /// Whether there are more stars than there is room for.
    full: bool,
}

impl StarLists {
    /// Lists for pictures of `size` pixels.
    pub(super) fn new(gpu: &Gpu, stars: Arc<Stars>, size: [u32; 2]) -> Self {
        let device = &gpu.device;
        let buffer = |label, size, usage| {
            device.create_buffer(&BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let [width, height] = size.map(u64::from);
        let storage = BufferUsages::STORAGE;
        let frame = buffer(
            "frame of the stars",
            size_of::<Frame>() as u64,
            BufferUsages::UNIFORM,
        );
        let lens = buffer("lens", size_of::<GpuLens>() as u64, BufferUsages::UNIFORM);
        let pieces = buffer(
            "pieces of arcs",
            (PIECES * size_of::<Piece>()) as u64,
            storage,
        );
        let candidates = buffer("candidates", 4 * CANDIDATES as u64, storage);
        let heads = buffer(
            "heads",
            4 * (1 + width * height),
            storage | BufferUsages::COPY_SRC,
        );
        let nodes = buffer("nodes", NODES * NODE, storage);
        let bind_group = |layout, bindings: &[BindingResource]| {
            let entries: Vec<_> = (0..)
                .zip(bindings)
                .map(|(i, binding)| resource(i, binding.clone()))
                .collect();
            device.create_bind_group(&BindGroupDescriptor {
                label: Some("stars"),
                layout,
                entries: &entries,
            })
        };
        let sort = bind_group(
            &stars.sort_layout,
            &[
                frame.as_entire_binding(),
                lens.as_entire_binding(),
                stars.buffer.as_entire_binding(),
                pieces.as_entire_binding(),
                heads.as_entire_binding(),
                nodes.as_entire_binding(),
                candidates.as_entire_binding(),
            ],
        );
        let lists = bind_group(
            &stars.list_layout,
            &[heads.as_entire_binding(), nodes.as_entire_binding()],
        );
        StarLists {
            queue: gpu.queue.clone(),
            stars,
            frame,
            lens,
            pieces,
            candidates,
            heads,
            sort,
            lists,
            shown: None,
            invocations: 0,
            full: false,
        }
    }

    /// Sets what the next lists are made of: the stars as the camera of `scene` sees them. The inverse row
    /// is made anew only for another row or method.
    pub(super) fn show(&mut self, scene: &Scene) {
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
        let field = &self.stars.field;
        let radius = field.disc_radius;
        let candidates = self.stars.cells.candidates(&scene.camera, lens, radius);
        let points: Vec<u32> = candidates
            .points
            .iter()
            .take(CANDIDATES)
            .map(packed)
            .collect();
        let on_axis = candidates.arcs.iter().map(|i| &field.stars[*i as usize]);
        let splats = arc_splats(&scene.camera, lens, on_axis, radius);
        let pieces: Vec<Piece> = splats.iter().take(PIECES).map(piece).collect();
        self.full = candidates.points.len() > CANDIDATES || splats.len() > PIECES;
        let inverse = match lens {
            Lens::Bent(inverse) => Some(GpuInverseRow::new(inverse)),
            Lens::Flat(_) => None,
        };
        let block = GpuLens {
            point_distance: point_distance(radius) as f32,
            candidates: points.len() as u32,
            pieces: pieces.len() as u32,
            padding: 0,
            inverse: inverse
                .as_ref()
                .map_or_else(bytemuck::Zeroable::zeroed, |row| row.inverse),
            padding_2: [0; 3],
            texels: inverse.map_or_else(bytemuck::Zeroable::zeroed, |row| pairs(&row.texels)),
        };
        self.invocations = block.candidates + block.pieces;
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
        write(&self.candidates, bytemuck::cast_slice(&points));
    }

    /// Encodes the emptying of the lists, which must come before [`StarLists::sort`].
    pub(super) fn clear(&self, encoder: &mut CommandEncoder) {
        encoder.clear_buffer(&self.heads, 0, None);
    }

    /// Encodes the making of the lists.
    pub(super) fn sort(&self, pass: &mut ComputePass) {
        let pipeline = match &self.shown {
            Some((.., Lens::Flat(_))) => &self.stars.flat,
            _ => &self.stars.bent,
        };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.sort, &[]);
        pass.dispatch_workgroups(self.invocations.div_ceil(WORKGROUP), 1, 1);
    }

    /// The lists as the picture reads them.
    pub(super) fn lists(&self) -> &BindGroup {
        &self.lists
    }

    /// Checks that the lists that were made last have held all the light.
    ///
    /// # Errors
    /// [`GpuError::TooManyStars`] if they have not, [`GpuError::Failed`] if the device fails.
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), GpuError> {
        let count = gpu.device.create_buffer(&BufferDescriptor {
            label: Some("number of nodes"),
            size: 4,
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&self.heads, 0, &count, 0, 4);
        gpu.queue.submit([encoder.finish()]);
        let count: Vec<u32> = gpu.read(&count)?;
        if self.full || u64::from(count[0]) > NODES {
            return Err(GpuError::TooManyStars);
        }
        Ok(())
    }
}

/// The WGSL that lets a picture see the stars, or that there are none.
pub(super) fn light_source(stars: bool) -> String {
    if stars {
        [
            &constants(),
            include_str!("../shaders/kernel.wgsl"),
            include_str!("../shaders/star_light.wgsl"),
        ]
        .join("\n")
    } else {
        "fn star_light(pixel: vec2<u32>) -> vec3<f32> { return vec3(0.0); }\n".to_owned()
    }
}

/// The WGSL that makes the lists, by one of the lenses.
fn sort_source(lens: &str) -> String {
    [
        &constants(),
        lookup::ARITHMETIC_WGSL,
        inverse::WGSL,
        include_str!("../shaders/frame.wgsl"),
        include_str!("../shaders/kernel.wgsl"),
        include_str!("../shaders/stars.wgsl"),
        lens,
    ]
    .join("\n")
}

fn constants() -> String {
    let [core, first_halo, .., last_halo] = REACHES;
    format!(
        "const INVERSE_PAIRS: u32 = {INVERSE_PAIRS}u;\nconst INVERSE_LAST: u32 = {}u;\n\
         const FAINTEST: f32 = {FAINTEST:e};\nconst CORE: f32 = {core:e};\n\
         const FIRST_HALO: f32 = {first_halo:e};\nconst LAST_HALO: f32 = {last_halo:e};\n",
        INVERSE_TEXELS - 1,
    )
}

fn pipeline(device: &Device, layout: &BindGroupLayout, lens: &str) -> ComputePipeline {
    let label = Some("sort_stars");
    let module = device.create_shader_module(ShaderModuleDescriptor {
        label,
        source: ShaderSource::Wgsl(sort_source(lens).into()),
    });
    let layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_compute_pipeline(&ComputePipelineDescriptor {
        label,
        layout: Some(&layout),
        module: &module,
        entry_point: label,
        compilation_options: Default::default(),
        cache: None,
    })
}

fn pairs(texels: &[Texel]) -> [[f32; 4]; INVERSE_PAIRS] {
    std::array::from_fn(|i| {
        let ([a, b], [c, d]) = (texels[2 * i], texels[2 * i + 1]);
        [a, b, c, d]
    })
}

fn gpu_star(star: &PointStar) -> GpuStar {
    GpuStar {
        direction: star.direction.as_vec3().to_array(),
        padding: 0.0,
        light: star.light.to_array(),
        padding_2: 0.0,
    }
}

/// The star in the lower 24 bits, the way of its light above.
fn packed(candidate: &Candidate) -> u32 {
    let way = 2 * candidate.way.windings + u32::from(candidate.way.side < 0.0);
    candidate.star | way << 24
}

fn piece(splat: &Splat) -> Piece {
    Piece {
        at: splat.at.as_vec2().to_array(),
        reach: splat.reach as f32,
        padding: 0.0,
        light: splat.light.to_array(),
        padding_2: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::super::shader::tests::validate;
    use super::*;
    use std::mem::offset_of;

    #[test]
    fn both_lenses_are_valid() {
        for lens in [
            include_str!("../shaders/lens_bent.wgsl"),
            include_str!("../shaders/lens_flat.wgsl"),
        ] {
            validate(&sort_source(lens), &["sort_stars"]);
        }
    }

    #[test]
    fn the_layouts_are_the_shaders() {
        let source = sort_source(include_str!("../shaders/lens_bent.wgsl"));
        let module = naga::front::wgsl::parse_str(&source).unwrap();
        let offsets = |of: &str| -> (Vec<u32>, u32) {
            let found = module.types.iter().find_map(|(_, t)| match &t.inner {
                naga::TypeInner::Struct { members, span } if t.name.as_deref() == Some(of) => {
                    Some((members.iter().map(|m| m.offset).collect(), *span))
                }
                _ => None,
            });
            found.unwrap_or_else(|| panic!("no struct {of}"))
        };
        macro_rules! same_layout {
            ($type:ty, $name:literal, $($member:ident),*) => {
                let ours = vec![$(offset_of!($type, $member) as u32),*];
                assert_eq!(offsets($name), (ours, size_of::<$type>() as u32), $name);
            };
        }
        same_layout!(GpuStar, "Star", direction, light);
        same_layout!(Piece, "Piece", at, reach, light);
        same_layout!(
            GpuLens,
            "Lens",
            point_distance,
            candidates,
            pieces,
            inverse,
            texels
        );
        same_layout!(
            Inverse,
            "Inverse",
            edge,
            scale,
            first_angle,
            first,
            texels_per_v
        );
        assert_eq!(u64::from(offsets("Node").1), NODE);
    }
}
