//! The pipelines of a device. Each is compiled when its key is first requested, and then cached.

use super::compute::{module, pipeline};
use super::layouts::Layouts;
use super::source::PipelineKey;
use super::stars::StarPrograms;
use super::tile_queues::TileClassifier;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use wgpu::*;

/// The pipelines that draw the regions of a picture.
#[derive(Debug)]
pub(super) struct Program {
    pub(super) key: PipelineKey,
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
    cache: Mutex<Cache>,
}

#[derive(Debug, Default)]
struct Cache {
    programs: HashMap<PipelineKey, Arc<Program>>,
    classifiers: HashMap<PipelineKey, Arc<TileClassifier>>,
    stars: Option<Arc<StarPrograms>>,
}

impl Pipelines {
    pub(super) fn new(device: &Device) -> Self {
        Pipelines {
            layouts: Layouts::new(device),
            device: device.clone(),
            cache: Mutex::default(),
        }
    }

    /// The program of `key`. Compiles it the first time.
    pub(super) fn program(&self, key: PipelineKey) -> Arc<Program> {
        let mut cache = self.cache.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(program) = cache.programs.get(&key) {
            return program.clone();
        }
        let classifier = key.classifier().map(|key| {
            let new = || Arc::new(TileClassifier::new(&self.device, &self.layouts, key));
            cache.classifiers.entry(key).or_insert_with(new).clone()
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
        let mut groups = vec![layouts.draw(key.store)];
        groups.extend(key.reads_sky().then_some(&layouts.sky));
        groups.extend(key.stars.then_some(&layouts.star_lists));
        let module = module(&self.device, key.name(), key.source());
        let entry_points = key.entry_points().iter();
        Program {
            key,
            pipelines: entry_points
                .map(|entry_point| pipeline(&self.device, entry_point, &groups, &module))
                .collect(),
            classifier,
        }
    }
}
