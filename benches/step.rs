//! The cost of a step: each method compared with the naive loop, in one group and one run; and the
//! cost of observers.
//!
//! Only ratios within a group are meaningful; the machine may be busy otherwise.

mod common;

use std::hint::black_box;

use common::NAIVE;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use pendula::fast::ScaledPendulum;
use pendula::integrate::Record;
use pendula::metrics::EnergyDrift;
use pendula::{Grid, Info, Method, Pendulum, Phase, integrate, integrate_fast, methods};

const STEPS: u64 = 10_000;
const STEP: f64 = 0.01;

fn grid() -> Grid {
    Grid::new(STEP, STEPS).expect("a positive step")
}

/// The final state only: the naive loop, the library in seconds, the library in steps.
fn final_state<M>(group: &mut BenchmarkGroup<WallTime>, method: M, start: Phase)
where
    M: Info + Method<Pendulum> + Method<ScaledPendulum>,
{
    let name = method.info().name;
    let (pendulum, grid) = (Pendulum::PAPER, grid());
    if let Some((_, naive)) = NAIVE.iter().find(|(of, _)| *of == name) {
        group.bench_function(format!("{name}/naive"), |bencher| {
            bencher.iter(|| naive(black_box(start), black_box(STEPS), black_box(STEP)));
        });
    }
    group.bench_function(format!("{name}/integrate"), |bencher| {
        bencher.iter(|| integrate(&pendulum, &method, black_box(start), black_box(&grid), &mut ()));
    });
    group.bench_function(format!("{name}/integrate_fast"), |bencher| {
        bencher.iter(|| {
            integrate_fast(&pendulum, &method, black_box(start), black_box(&grid), &mut ())
        });
    });
}

/// The cost of observing nothing, every state, or the energy.
fn watched<M>(group: &mut BenchmarkGroup<WallTime>, method: M, start: Phase)
where
    M: Info + Method<Pendulum> + Method<ScaledPendulum>,
{
    let name = method.info().name;
    let (pendulum, grid) = (Pendulum::PAPER, grid());
    group.bench_function(format!("{name}/nothing"), |bencher| {
        bencher.iter(|| {
            integrate_fast(&pendulum, &method, black_box(start), black_box(&grid), &mut ())
        });
    });
    let mut states = vec![Phase::default(); grid.samples() as usize];
    group.bench_function(format!("{name}/every state"), |bencher| {
        bencher.iter(|| {
            let mut record = Record::new(&mut states);
            integrate_fast(&pendulum, &method, black_box(start), black_box(&grid), &mut record)
        });
    });
    group.bench_function(format!("{name}/energy drift"), |bencher| {
        bencher.iter(|| {
            let mut drift = EnergyDrift::new(&pendulum);
            integrate_fast(&pendulum, &method, black_box(start), black_box(&grid), &mut drift);
            drift.largest()
        });
    });
}

macro_rules! every_method {
    ($($module:ident::$method:ident,)+) => {
        fn step(criterion: &mut Criterion) {
            for theta_0 in [1.0, 3.0] {
                let start = Phase::at_rest(theta_0);
                let mut group = criterion.benchmark_group(format!("step from {theta_0} rad"));
                group.throughput(Throughput::Elements(STEPS));
                $(final_state(&mut group, methods::$method, start);)+
                group.finish();
            }
        }

        fn watch(criterion: &mut Criterion) {
            let mut group = criterion.benchmark_group("watching from 1 rad");
            group.throughput(Throughput::Elements(STEPS));
            $(watched(&mut group, methods::$method, Phase::at_rest(1.0));)+
            group.finish();
        }
    };
}
pendula::for_each_method!(every_method);

criterion_group! {
    name = benches;
    config = Criterion::default().without_plots();
    targets = step, watch
}
criterion_main!(benches);
