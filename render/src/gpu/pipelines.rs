//! The pipelines of a device. Each is compiled when its key is first requested, and then cached.

use super::Gpu;
use super::compute::{module, specialised_pipeline};
use super::layouts::{BAND_FORMAT, Layouts, TEXTURE_FORMAT};
use super::pass::Pass;
use super::render_pipeline::{FullScreen, full_screen_pipeline};
use super::source::{PipelineKey, Store};
use super::stars::{Group, StarPrograms};
use super::tile_queues::{TileClassifier, constants, rows_per_invocation};
use crate::filter::TileClass;
use crate::scene::Sampling;
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
    on_software: bool,
    cache: Mutex<Cache>,
}

#[derive(Debug, Default)]
struct Cache {
    programs: HashMap<PipelineKey, Arc<Program>>,
    /// By key, and by the rows of an invocation.
    classifiers: HashMap<(PipelineKey, u32), Arc<TileClassifier>>,
    stars: HashMap<Group, Arc<StarPrograms>>,
}

impl Pipelines {
    pub(super) fn new(gpu: &Gpu) -> Self {
        Pipelines {
            layouts: Layouts::new(gpu),
            on_software: gpu.is_software(),
            device: gpu.device.clone(),
            cache: Mutex::default(),
        }
    }

    /// The program of `key`. Compiles it the first time.
    pub(super) fn program(&self, key: PipelineKey) -> Arc<Program> {
        let key = if key.stars {
            key.with_group(self.group(key.pass, key.sampling()))
        } else {
            key
        };
        let mut cache = self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(program) = cache.programs.get(&key) {
            return program.clone();
        }
        let rows = rows_per_invocation(self.on_software, key.integrates());
        let classifier = key.classifier().map(|key| {
            let (device, layouts) = (&self.device, &self.layouts);
            let new = || Arc::new(TileClassifier::new(device, layouts, key, rows));
            let entry = cache.classifiers.entry((key, rows));
            entry.or_insert_with(new).clone()
        });
        let program = Arc::new(self.compile(key, classifier, rows));
        cache.programs.insert(key, program.clone());
        program
    }

    /// The pixels that share a list of stars in a picture of this kind: a tile if an invocation draws a column of a tile.
    pub(super) fn group(&self, pass: Pass, sampling: Sampling) -> Group {
        if self.on_software && pass == Pass::Compute && sampling.averages() {
            Group::Tile
        } else {
            Group::Rows
        }
    }

    /// The programs that make a star list for each `group` of pixels. Compiles them the first time.
    pub(super) fn stars(&self, group: Group) -> Arc<StarPrograms> {
        let mut cache = self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        let new = || Arc::new(StarPrograms::new(&self.device, group));
        cache.stars.entry(group).or_insert_with(new).clone()
    }

    fn compile(
        &self,
        key: PipelineKey,
        classifier: Option<Arc<TileClassifier>>,
        rows: u32,
    ) -> Program {
        let layouts = &self.layouts;
        let mut groups = vec![match key.pass {
            Pass::Compute => layouts.compute().draw(key.store),
            Pass::Fragment => &layouts.fragment,
        }];
        groups.extend(key.reads_sky().then_some(&layouts.sky));
        groups.extend(key.stars.then(|| &layouts.compute().star_lists));
        groups.extend(key.disc.then_some(&layouts.disc));
        let module = module(&self.device, key.name(), key.source());
        let compute = |constants: &[_]| {
            let entry_point = key.entry_points()[0];
            specialised_pipeline(&self.device, entry_point, &groups, &module, constants)
        };
        let kind = match key.pass {
            Pass::Compute => ProgramKind::Compute(ComputeProgram {
                pipelines: match classifier {
                    Some(_) => TileClass::ALL
                        .map(|class| compute(&constants(rows, class)))
                        .into(),
                    None => vec![compute(&[])],
                },
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
