//! Long runs of every method, through each of the loops.

use std::num::NonZeroU64;

use pendula::fast::Instructions;
use pendula::internals::in_seconds;
use pendula::{
    AnyMethod, Compensated, CompensatedPhase, Ensemble, Grid, METHODS, Observer, Pendulum, Phase,
    System, method_named,
};

use super::{Hash, InThreads, Line, common};

/// The hash of every state of four runs of `steps` steps: swinging, nearly over the top, rotating,
/// and starting many turns from zero; with L ≠ 1 and a step that is not a power of two.
fn hash<Z>(
    steps: u64,
    add: fn(&mut Hash, Z),
    run: impl Fn(&Pendulum, Phase, &Grid, &mut dyn FnMut(u64, f64, Z)),
) -> u64 {
    let pendulum = Pendulum::new(9.81, 1.3, 0.7).expect("parameters in range");
    let grid = Grid::new(0.01, steps).expect("a positive step");
    let mut hash = Hash::new();
    for (theta, omega) in [(1.0, 0.0), (3.1, 0.2), (-0.3, 12.0), (1000.5, -1.0)] {
        run(&pendulum, Phase { theta, omega }, &grid, &mut |_, _, z: Z| add(&mut hash, z));
    }
    hash.value()
}

/// The states of a hundred pendulums, each with its own g and L, after every seventh of 300
/// steps and at the end; in blocks of lanes of which the last is not full. Two starts cannot be
/// computed in lanes.
fn of_ensemble(method: &dyn AnyMethod, instructions: Instructions) -> u64 {
    let pendulum = |j| Pendulum::new(9.81 + 0.01 * j, 1.0 + 0.005 * j, 1.0);
    let start = |j| Phase { theta: -3.3 + 0.066 * j, omega: 0.1 * j - 4.0 };
    let numbers = || (0..100).map(f64::from);
    let pendulums: Result<Vec<Pendulum>, _> = numbers().map(pendulum).collect();
    let pendulums = pendulums.expect("parameters in range");
    let mut starts: Vec<Phase> = numbers().map(start).collect();
    starts[40] = Phase { theta: 0.0, omega: 1e-150 };
    starts[70] = Phase { theta: 1e9, omega: 1.0 };
    let grid = Grid::new(0.017, 300).expect("a positive step");
    let ensemble = Ensemble::with_systems(&pendulums, &starts, grid);
    let ensemble = ensemble.with_instructions(instructions);

    let mut ends = vec![Phase::default(); starts.len()];
    ensemble.ends(method, &mut ends);
    let mut hashes = vec![Hash::new(); starts.len()];
    let mut watches: Vec<_> =
        hashes.iter_mut().map(|hash| move |_: u64, _: f64, z: Phase| hash.add_state(z)).collect();
    ensemble.watch(method, NonZeroU64::new(7).expect("seven"), &mut watches);

    let mut hash = Hash::new();
    ends.into_iter().for_each(|z| hash.add_state(z));
    hashes.into_iter().for_each(|watched| hash.word(watched.value()));
    hash.value()
}

/// The hash of the ensemble, with the best instructions that there are and with those that every
/// processor of its kind has, in whatever number of threads.
fn of_lanes(method: &dyn AnyMethod, in_threads: InThreads) -> u64 {
    let [best, baseline] =
        [Instructions::Best, Instructions::Baseline].map(|with| of_ensemble(method, with));
    let mut hashes = vec![best, baseline];
    hashes.extend(in_threads(&|| of_ensemble(method, Instructions::Best)));
    common(&hashes)
}

/// Passes every state of a run of `method` on `system` to `watch`, the start included.
fn run<S: System + 'static>(
    system: &S,
    method: &dyn AnyMethod<S>,
    start: S::State,
    grid: &Grid,
    watch: &mut dyn Observer<S::State>,
) {
    let end = method.try_run(system, start, grid, watch);
    assert!(end.is_ok(), "steps short enough for every method");
}

/// Adds a state and what is still to be added to it.
fn with_lost(hash: &mut Hash, z: CompensatedPhase) {
    hash.add_state(z.phase);
    hash.add_state(z.lost);
}

/// A line for each method and each of the loops; in lanes for some of each family.
pub fn lines(in_threads: InThreads) -> Vec<Line> {
    let mut lines = Vec::new();
    for (index, method) in METHODS.iter().enumerate() {
        let name = method.info().name;
        // Without optimisation a million steps of every method would take minutes: so many are for
        // the paper's four.
        let steps = if index < 4 { 250_000 } else { 25_000 };
        let mut line = |how: &str, hash: u64| lines.push((format!("{name} {how}"), hash));
        line(
            "in steps",
            hash(steps, Hash::add_state, |pendulum, start, grid, mut watch| {
                method.run(pendulum, start, grid, &mut watch);
            }),
        );
        let by_seconds = in_seconds(name).expect("a method of the library");
        line(
            "in seconds",
            hash(steps, Hash::add_state, |pendulum, start, grid, mut watch| {
                run(pendulum, by_seconds, start, grid, &mut watch);
            }),
        );
        let compensated = method_named::<Compensated<Pendulum>>(name).expect("every method");
        line(
            "compensated",
            hash(5_000, with_lost, |pendulum, start, grid, mut watch| {
                let start = CompensatedPhase::from(start);
                run(&Compensated::new(*pendulum), compensated, start, grid, &mut watch);
            }),
        );
    }
    for name in [
        "forward-euler",
        "symplectic-euler",
        "rk4",
        "stormer-verlet",
        "blanes-moan-6",
        "dormand-prince",
        "gauss-4",
        "deuflhard",
    ] {
        let method = method_named(name).expect("a method of the library");
        lines.push((format!("{name} in lanes"), of_lanes(method, in_threads)));
    }
    lines
}
