//! Time to bake the default atlas.

use criterion::{Criterion, criterion_group, criterion_main};
use lensbake_tables::baking::{Recipe, bake};

fn default_atlas(c: &mut Criterion) {
    let recipe = Recipe::default();
    c.bench_function("bake the default atlas", |b| {
        b.iter(|| bake(&recipe, || ()))
    });
}

criterion_group!(benches, default_atlas);
criterion_main!(benches);
