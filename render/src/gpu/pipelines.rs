//! The pipelines of a device. Each is compiled when its key is first requested, and then cached.

use super::Gpu;
use super::compute::{module, specialised_pipeline};
use super::layouts::{BAND_FORMAT, Layouts, TEXTURE_FORMAT};
use super::pass::Pass;
use super::render_pipeline::{FullScreen, full_screen_pipeline};
use super::source::{PipelineKey, Store};
use super::stars::StarPrograms;
use super::tile_queues::{TileClassifier, constants, rows_per_invocation};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use wgpu::*;

/// The pipelines that draw the regions of a picture.
#[derive(Debug)]
pub(super) struct Program {
    pub(super) key: PipelineKey,
    pub(super) kind: ProgramKind,
}

/// The pipelines by the kind of pass.
#[derive(Debug)]
pub(super) enum ProgramKind {
    Compute(ComputeProgram),
    Fragment(RenderPipeline),
}

/// The pipelines of a compute pass.
#[derive(Debug)]
pub(super) struct ComputeProgram {
    /// One pipeline for all pixels, or one for each tile class.
    pub(super) pipelines: Vec<ComputePipeline>,
    /// Classifies the tiles, if there are tile classes.
    pub(super) classifier: Option<Arc<TileClassifier>>,
}

/// The cached pipelines of a device, by key.
#[derive(Debug)]
pub(super) struct Pipelines {
    device: Device,
    pub(super) layouts: Layouts,
    /// [`rows_per_invocation`] without stars and with them.
    rows: [u32; 2],
    cache: Mutex<Cache>,
}

#[derive(Debug, Default)]
struct Cache {
    programs: HashMap<PipelineKey, Arc<Program>>,
    /// By key, and by the rows of an invocation.
    classifiers: HashMap<(PipelineKey, u32), Arc<TileClassifier>>,
    stars: Option<Arc<StarPrograms>>,
}

impl Pipelines {
    pub(super) fn new(gpu: &Gpu) -> Self {
        Pipelines {
            layouts: Layouts::new(gpu),
            rows: [false, true].map(|stars| rows_per_invocation(gpu, stars)),
            device: gpu.device.clone(),
            cache: Mutex::default(),
        }
    }

    /// The program of `key`. Compiles it the first time.
    pub(super) fn program(&self, key: PipelineKey) -> Arc<Program> {
        let mut cache = self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(program) = cache.programs.get(&key) {
            return program.clone();
        }
        let rows = self.rows[usize::from(key.stars)];
        let classifier = key.classifier().map(|key| {
            let (device, layouts) = (&self.device, &self.layouts);
            let new = || Arc::new(TileClassifier::new(device, layouts, key, rows));
            let entry = cache.classifiers.entry((key, rows));
            entry.or_insert_with(new).clone()
        });
        let program = Arc::new(self.compile(key, classifier));
        cache.programs.insert(key, program.clone());
        program
    }

    /// The programs that make the star lists. Compiles them the first time.
    pub(super) fn stars(&self) -> Arc<StarPrograms> {
        let mut cache = self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        let new = || Arc::new(StarPrograms::new(&self.device));
        cache.stars.get_or_insert_with(new).clone()
    }

    fn compile(&self, key: PipelineKey, classifier: Option<Arc<TileClassifier>>) -> Program {
        let layouts = &self.layouts;
        let mut groups = vec![match key.pass {
            Pass::Compute => layouts.compute().draw(key.store),
            Pass::Fragment => &layouts.fragment,
        }];
        groups.extend(key.reads_sky().then_some(&layouts.sky));
        groups.extend(key.stars.then(|| &layouts.compute().star_lists));
        groups.extend(key.disc.then_some(&layouts.disc));
        let module = module(&self.device, key.name(), key.source());
        let constants = constants(self.rows[usize::from(key.stars)]);
        let constants = match classifier {
            Some(_) => constants.as_slice(),
            None => &[],
        };
        let kind = match key.pass {
            Pass::Compute => ProgramKind::Compute(ComputeProgram {
                pipelines: key
                    .entry_points()
                    .iter()
                    .map(|entry_point| {
                        specialised_pipeline(&self.device, entry_point, &groups, &module, constants)
                    })
                    .collect(),
                classifier,
            }),
            Pass::Fragment => ProgramKind::Fragment(full_screen_pipeline(
                &self.device,
                FullScreen {
                    label: key.name(),
                    groups: &groups,
                    module: &module,
                    entry_point: "draw",
                    constants: &[],
                    format: match key.store {
                        Store::Buffer => BAND_FORMAT,
                        Store::Texture => TEXTURE_FORMAT,
                    },
                },
            )),
        };
        Program { key, kind }
    }
}
