//! The cost of a step in an ensemble: ten thousand pendulums one after the other, and in lanes of
//! vector instructions.
//!
//! Only ratios within a group are meaningful. Where the processor lacks the instructions, the
//! baseline runs, and its time is shown.

mod common;

use std::hint::black_box;
use std::time::Duration;

use common::NAIVE;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pendula::fast::{Avx2, Avx512, Baseline, Best, Ensemble, InLanes};
use pendula::{Grid, Info, Pendulum, Phase, integrate_fast, methods};

const PENDULUMS: u32 = 10_000;
const STEPS: u64 = 300;
const STEP: f64 = 0.01;

/// Starts spread over θ from −3 to 3 rad and ω from −5 to 5 rad/s, successive ones far apart, so
/// that no branch can be predicted: the multiples of 1/φ and of √2 fill the unit interval evenly.
fn starts() -> Vec<Phase> {
    let spread = |j: u32, irrational: f64| 2.0 * (f64::from(j) * irrational).fract() - 1.0;
    (0..PENDULUMS)
        .map(|j| Phase {
            theta: 3.0 * spread(j, 0.618_033_988_749_894_8),
            omega: 5.0 * spread(j, std::f64::consts::SQRT_2),
        })
        .collect()
}

fn ensemble_of<M: Info + InLanes>(criterion: &mut Criterion, method: M) {
    let name = method.info().name;
    let (pendulum, starts) = (Pendulum::PAPER, starts());
    let grid = Grid::new(STEP, STEPS).expect("a positive step");
    let mut ends = vec![Phase::default(); starts.len()];

    let mut group = criterion.benchmark_group(format!("ensemble, {name}"));
    group.throughput(Throughput::Elements(u64::from(PENDULUMS) * STEPS));
    if let Some((_, naive)) = NAIVE.iter().find(|(of, _)| *of == name) {
        group.bench_function("naive, one by one", |bencher| {
            bencher.iter(|| {
                for (start, end) in black_box(&starts).iter().zip(&mut ends) {
                    *end = naive(*start, black_box(STEPS), black_box(STEP));
                }
                black_box(&mut ends);
            });
        });
    }
    group.bench_function("integrate_fast, one by one", |bencher| {
        bencher.iter(|| {
            for (start, end) in black_box(&starts).iter().zip(&mut ends) {
                *end = integrate_fast(&pendulum, &method, *start, black_box(&grid), &mut ());
            }
            black_box(&mut ends);
        });
    });
    macro_rules! lanes {
        ($($instructions:ident)+) => {$(
            let ensemble =
                Ensemble::new(&pendulum, &starts, grid).with_instructions::<$instructions>();
            group.bench_function(concat!("lanes, ", stringify!($instructions)), |bencher| {
                bencher.iter(|| {
                    black_box(&ensemble).ends(&method, &mut ends);
                    black_box(&mut ends);
                });
            });
        )+};
    }
    lanes! { Baseline Avx2 Avx512 Best }
    group.finish();
}

macro_rules! every_method {
    ($($module:ident::$method:ident,)+) => {
        fn ensemble(criterion: &mut Criterion) {
            $(ensemble_of(criterion, methods::$method);)+
        }
    };
}
pendula::for_each_method!(every_method);

criterion_group! {
    name = benches;
    // One iteration is three million steps: ten samples are plenty.
    config = Criterion::default()
        .without_plots()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500));
    targets = ensemble
}
criterion_main!(benches);
