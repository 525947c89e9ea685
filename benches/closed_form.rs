//! The cost of the closed form, to prepare and to evaluate, compared with the platform's sine of
//! the same times, and with a thousand seconds of RK4, which is less accurate.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pendula::methods::Rk4;
use pendula::{Grid, Motion, Pendulum, Phase, integrate_fast};

const TIMES: u32 = 1000;
const DURATION: f64 = 1000.0;
const STEP: f64 = 1e-3;

/// Times spread over the run, successive ones far apart.
fn times() -> Vec<f64> {
    (0..TIMES).map(|j| DURATION * (f64::from(j) * 0.618_033_988_749_894_8).fract()).collect()
}

fn closed_form(criterion: &mut Criterion) {
    let (pendulum, times) = (Pendulum::PAPER, times());
    for theta_0 in [1.0, 3.0] {
        let start = Phase::at_rest(theta_0);
        let motion = Motion::new(&pendulum, start).expect("a pendulum's motion");

        let mut group = criterion.benchmark_group(format!("closed form from {theta_0} rad"));
        group.bench_function("prepare", |bencher| {
            bencher.iter(|| Motion::new(black_box(&pendulum), black_box(start)));
        });
        group.throughput(Throughput::Elements(u64::from(TIMES)));
        group.bench_function("at 1000 times", |bencher| {
            bencher.iter(|| {
                for t in black_box(&times) {
                    black_box(motion.at(*t));
                }
            });
        });
        group.bench_function("sine of 1000 times", |bencher| {
            bencher.iter(|| {
                for t in black_box(&times) {
                    black_box(t.sin());
                }
            });
        });
        group.finish();
    }
}

/// The last state only, at the end of the run.
fn instead(criterion: &mut Criterion) {
    let pendulum = Pendulum::PAPER;
    let grid = Grid::with_duration(STEP, DURATION).expect("a whole number of steps");
    let mut group = criterion.benchmark_group("the state at 1000 s");
    group.sample_size(10).measurement_time(Duration::from_millis(1500));
    for theta_0 in [1.0, 3.0] {
        let start = Phase::at_rest(theta_0);
        group.bench_function(
            format!("closed form, prepared anew, from {theta_0} rad"),
            |bencher| {
                bencher.iter(|| Motion::new(&pendulum, black_box(start)).map(|m| m.at(DURATION)));
            },
        );
        group.bench_function(format!("RK4 at 1e-3 s from {theta_0} rad"), |bencher| {
            bencher.iter(|| {
                integrate_fast(&pendulum, &Rk4, black_box(start), black_box(&grid), &mut ())
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().without_plots();
    targets = closed_form, instead
}
criterion_main!(benches);
