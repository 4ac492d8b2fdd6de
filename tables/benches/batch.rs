//! Time of a thousand lookups: one by one, and many at once. The last line is the ratio, which does not depend on how fast
//! the machine is.

use criterion::{Criterion, criterion_group, criterion_main};
use lensbake_core::{Observer, ShadowCoordinate};
use lensbake_tables::{Row, default_atlas};
use std::hint::black_box;
use std::time::{Duration, Instant};

const RAYS: usize = 1000;

/// Rays from next to the edge of the shadow to straight away.
fn rays() -> Vec<ShadowCoordinate> {
    let ray = |i: usize| {
        let log = -6.0 * (i * 619 % RAYS) as f64 / RAYS as f64;
        let one_minus_x = 10f64.powf(log);
        ShadowCoordinate {
            x: 1.0 - one_minus_x,
            one_minus_x,
        }
    };
    (0..RAYS).map(ray).collect()
}

fn one_by_one(row: &Row, at: &[ShadowCoordinate]) -> f64 {
    at.iter().filter_map(|&at| row.bend(at).escaped()).sum()
}

fn lookups(c: &mut Criterion) {
    let row = default_atlas().row(Observer::at(10.0).unwrap()).unwrap();
    let at = rays();
    let one_minus_x: Vec<f32> = at.iter().map(|at| at.one_minus_x as f32).collect();
    let (batch, batch_f32) = (row.batch(), row.batch_f32());
    let (mut bends, mut bends_f32) = (vec![0.0; RAYS], vec![0.0; RAYS]);
    let mut group = c.benchmark_group("1000 lookups");
    group.bench_function("one by one", |b| {
        b.iter(|| one_by_one(&row, black_box(&at)))
    });
    group.bench_function("at once", |b| {
        b.iter(|| batch.bend(black_box(&at), &mut bends));
    });
    group.bench_function("at once in f32", |b| {
        b.iter(|| batch_f32.bend(black_box(&one_minus_x), &mut bends_f32));
    });
    group.finish();
    let mut ratios: Vec<[f64; 2]> = (0..101)
        .map(|_| {
            let single = time(|| {
                black_box(one_by_one(&row, black_box(&at)));
            });
            let many = time(|| batch.bend(black_box(&at), &mut bends));
            let many_f32 = time(|| batch_f32.bend(black_box(&one_minus_x), &mut bends_f32));
            [many, many_f32].map(|many| many.as_secs_f64() / single.as_secs_f64())
        })
        .collect();
    let median = ratios.len() / 2;
    let [f64, f32] = [0, 1].map(|i| {
        ratios.sort_by(|a, b| a[i].total_cmp(&b[i]));
        ratios[median][i]
    });
    #[expect(clippy::print_stdout, reason = "the report of a benchmark")]
    {
        println!(
            "time at once / one by one, median of 101 rounds: {f64:.3} in f64, {f32:.3} in f32"
        );
    }
}

/// The time of 50 calls.
fn time(mut work: impl FnMut()) -> Duration {
    let started = Instant::now();
    for _ in 0..50 {
        work();
    }
    started.elapsed()
}

criterion_group!(benches, lookups);
criterion_main!(benches);
