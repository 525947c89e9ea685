//! What a step costs: each method beside the loop that anyone would write first, in one group and one run.
//!
//! Only ratios within the group mean anything; the machine has other things to do.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use pendula::methods;
use pendula::{Described, Grid, Method, Pendulum, Phase, integrate};

const STEPS: u64 = 10_000;
const STEP: f64 = 0.01;

/// Symplectic Euler as two statements with the platform's sine.
fn naive_symplectic_euler(start: Phase) -> Phase {
    let Phase { mut theta, mut omega } = start;
    for _ in 0..STEPS {
        omega -= 9.81 * theta.sin() * STEP;
        theta += omega * STEP;
    }
    Phase { theta, omega }
}

/// Störmer–Verlet as the paper writes it, with the force kept.
fn naive_stormer_verlet(start: Phase) -> Phase {
    let Phase { mut theta, mut omega } = start;
    let mut alpha = -9.81 * theta.sin();
    for _ in 0..STEPS {
        theta += omega * STEP + 0.5 * alpha * STEP * STEP;
        let next = -9.81 * theta.sin();
        omega += 0.5 * (alpha + next) * STEP;
        alpha = next;
    }
    Phase { theta, omega }
}

/// RK4 as the paper writes it.
fn naive_rk4(start: Phase) -> Phase {
    let f = |theta: f64, omega: f64| (omega, -9.81 * theta.sin());
    let Phase { mut theta, mut omega } = start;
    for _ in 0..STEPS {
        let (a1, b1) = f(theta, omega);
        let (a2, b2) = f(theta + 0.5 * STEP * a1, omega + 0.5 * STEP * b1);
        let (a3, b3) = f(theta + 0.5 * STEP * a2, omega + 0.5 * STEP * b2);
        let (a4, b4) = f(theta + STEP * a3, omega + STEP * b3);
        theta += STEP / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        omega += STEP / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4);
    }
    Phase { theta, omega }
}

fn naive(group: &mut BenchmarkGroup<WallTime>, name: &str, run: fn(Phase) -> Phase, start: Phase) {
    group.bench_function(format!("naive {name}"), |bencher| bencher.iter(|| run(black_box(start))));
}

fn ours<M: Described + Method<Pendulum>>(
    group: &mut BenchmarkGroup<WallTime>,
    method: M,
    start: Phase,
) {
    let grid = Grid::new(STEP, STEPS).expect("a positive step");
    let pendulum = Pendulum::PAPER;
    group.bench_function(method.properties().name, |bencher| {
        bencher.iter(|| {
            integrate(black_box(&pendulum), &method, black_box(start), black_box(&grid), &mut ())
        });
    });
}

fn step(criterion: &mut Criterion) {
    for theta_0 in [1.0, 3.0] {
        let start = Phase::at_rest(theta_0);
        let mut group = criterion.benchmark_group(format!("step from {theta_0} rad"));
        group.throughput(Throughput::Elements(STEPS));
        naive(&mut group, "symplectic-euler", naive_symplectic_euler, start);
        naive(&mut group, "stormer-verlet", naive_stormer_verlet, start);
        naive(&mut group, "rk4", naive_rk4, start);
        macro_rules! every_method {
            ($($module:ident::$method:ident,)+) => {
                $(ours(&mut group, methods::$module::$method, start);)+
            };
        }
        pendula::methods!(every_method);
        group.finish();
    }
}

criterion_group!(benches, step);
criterion_main!(benches);
