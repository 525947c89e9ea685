//! The cost of a step, in one group and one run: each method by its name, as the library has it
//! compiled; and the paper's four by their types, which compiles their loops here, as it does those
//! of anybody's own method, compared with the naive loop. Then the cost of observers.
//!
//! Only ratios within a group are meaningful; the machine may be busy otherwise.

mod common;

use std::hint::black_box;

use common::NAIVE;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use pendula::integrate::Record;
use pendula::internals::ScaledPendulum;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::EnergyDrift;
use pendula::{
    AnyMethod, Grid, Info, METHODS, Method, Pendulum, Phase, integrate, integrate_fast,
    integrate_fast_with,
};

const STEPS: u64 = 10_000;
const STEP: f64 = 0.01;

fn grid() -> Grid {
    Grid::new(STEP, STEPS).expect("a positive step")
}

/// The final state only, of a method known by its type: the naive loop, the library in seconds, the
/// library in steps.
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
        bencher.iter(|| integrate(&pendulum, &method, black_box(start), black_box(&grid)));
    });
    group.bench_function(format!("{name}/integrate_fast"), |bencher| {
        bencher.iter(|| integrate_fast(&pendulum, &method, black_box(start), black_box(&grid)));
    });
}

/// The final state only, of a method known by its name.
fn end(group: &mut BenchmarkGroup<WallTime>, method: &dyn AnyMethod, start: Phase) {
    let grid = grid();
    group.bench_function(format!("{}/end", method.info().name), |bencher| {
        bencher.iter(|| method.end(&Pendulum::PAPER, black_box(start), black_box(&grid)));
    });
}

/// The cost of observing nothing, every state, or the energy; of a method known by its type.
fn watched<M>(group: &mut BenchmarkGroup<WallTime>, method: M, start: Phase)
where
    M: Info + Method<Pendulum> + Method<ScaledPendulum>,
{
    let name = method.info().name;
    let (pendulum, grid) = (Pendulum::PAPER, grid());
    group.bench_function(format!("{name}/integrate_fast/nothing"), |bencher| {
        bencher.iter(|| integrate_fast(&pendulum, &method, black_box(start), black_box(&grid)));
    });
    let mut states = vec![Phase::default(); grid.samples() as usize];
    group.bench_function(format!("{name}/integrate_fast/every state"), |bencher| {
        bencher.iter(|| {
            let mut record = Record::new(&mut states);
            integrate_fast_with(&pendulum, &method, black_box(start), black_box(&grid), &mut record)
        });
    });
    group.bench_function(format!("{name}/integrate_fast/energy drift"), |bencher| {
        bencher.iter(|| {
            let mut drift = EnergyDrift::new(&pendulum);
            integrate_fast_with(&pendulum, &method, black_box(start), black_box(&grid), &mut drift);
            drift.largest()
        });
    });
}

/// The same of a method known by its name.
fn watched_by_name(group: &mut BenchmarkGroup<WallTime>, method: &dyn AnyMethod, start: Phase) {
    let name = method.info().name;
    let (pendulum, grid) = (Pendulum::PAPER, grid());
    end(group, method, start);
    let mut states = vec![Phase::default(); grid.samples() as usize];
    group.bench_function(format!("{name}/run/every state"), |bencher| {
        bencher.iter(|| {
            let mut record = Record::new(&mut states);
            method.run(&pendulum, black_box(start), black_box(&grid), &mut record)
        });
    });
    group.bench_function(format!("{name}/run/energy drift"), |bencher| {
        bencher.iter(|| {
            let mut drift = EnergyDrift::new(&pendulum);
            method.run(&pendulum, black_box(start), black_box(&grid), &mut drift);
            drift.largest()
        });
    });
}

fn step(criterion: &mut Criterion) {
    for theta_0 in [1.0, 3.0] {
        let start = Phase::at_rest(theta_0);
        let mut group = criterion.benchmark_group(format!("step from {theta_0} rad"));
        group.throughput(Throughput::Elements(STEPS));
        final_state(&mut group, ForwardEuler, start);
        final_state(&mut group, SymplecticEuler, start);
        final_state(&mut group, Rk4, start);
        final_state(&mut group, StormerVerlet, start);
        for method in METHODS {
            end(&mut group, *method, start);
        }
        group.finish();
    }
}

fn watch(criterion: &mut Criterion) {
    let start = Phase::at_rest(1.0);
    let mut group = criterion.benchmark_group("watching from 1 rad");
    group.throughput(Throughput::Elements(STEPS));
    watched(&mut group, ForwardEuler, start);
    watched(&mut group, SymplecticEuler, start);
    watched(&mut group, Rk4, start);
    watched(&mut group, StormerVerlet, start);
    for method in METHODS {
        watched_by_name(&mut group, *method, start);
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().without_plots();
    targets = step, watch
}
criterion_main!(benches);
