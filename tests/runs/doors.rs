//! What a user writes first: a closure as a system, a trajectory in one call, options of steps that
//! vary, a method by its name.

use std::num::NonZeroU64;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use pendula::adaptive::{
    Adaptive, AnyEmbedded, Direction, SymmetricSteps, TaylorSeries, Tolerance,
};
use pendula::integrate::Run;
use pendula::methods::{BlanesMoan6, Dop853, DormandPrince, Gauss4};
use pendula::registry::{ByName, InSteps};
use pendula::systems::{Array, ArrayPhase, FromForce, FromRate};
use pendula::{
    AnyMethod, Components, Counting, Ensemble, Error, Grid, Hamiltonian, METHODS, Method, Motion,
    Pendulum, Phase, Rk4, Separable, StormerVerlet, System, integrate, method_named, trajectory,
};

use crate::common::First;

// -------------------------------------------------------------------------------------------------
// Closures
// -------------------------------------------------------------------------------------------------

/// Two masses on springs to walls and to each other, the middle one of which hardens, pushed at
/// x₁: what [`chain`] is, by hand.
#[derive(Clone)]
struct Chain;

fn accelerations(t: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let middle = (y - x) + 0.5 * (y - x) * (y - x) * (y - x);
    [middle - x + 0.1 * t, (-middle - y) / 4.0]
}

fn potential([x, y]: [f64; 2]) -> f64 {
    let square = (y - x) * (y - x);
    0.5 * (x * x + y * y + square) + 0.125 * square * square
}

impl System for Chain {
    type State = ArrayPhase<2>;

    fn rate(&self, t: f64, z: ArrayPhase<2>) -> ArrayPhase<2> {
        ArrayPhase { positions: z.velocities, velocities: self.force(t, z) }
    }
}

impl Separable for Chain {
    type Force = [f64; 2];

    fn force(&self, t: f64, z: ArrayPhase<2>) -> [f64; 2] {
        accelerations(t, z.positions)
    }

    fn kick(&self, z: ArrayPhase<2>, force: [f64; 2], h: f64) -> ArrayPhase<2> {
        z.kicked(force, h)
    }

    fn drift(&self, z: ArrayPhase<2>, h: f64) -> ArrayPhase<2> {
        z.drifted(h)
    }
}

const START: ArrayPhase<2> = ArrayPhase::new([0.5, -0.2], [0.1, 0.3]);

/// Where four methods end: one that splits, one with a long table, an explicit and an implicit one.
fn ends<S>(system: &S) -> [ArrayPhase<2>; 4]
where
    S: Separable<State = ArrayPhase<2>> + Clone + Send + 'static,
{
    let methods: [&dyn AnyMethod<S>; 4] = [&StormerVerlet, &BlanesMoan6, &Rk4, &Gauss4];
    methods.map(|method| method.end(system, START, &Grid::new(0.1, 100).unwrap()))
}

/// Catches: an acceleration that is told another time or other positions than those of the stage; a
/// kick or a drift of another length; a velocity taken for a position.
#[test]
fn a_closure_of_the_force_has_the_bits_of_a_type() {
    assert_eq!(ends(&FromForce::new(accelerations)), ends(&Chain));
}

/// Of H = Σ ½ mᵢ vᵢ² + V with masses 1 and 4, whose accelerations the closure gives without the
/// push: a step of order 6 with (ωh)⁶ = 0.1⁶ · 3³ keeps it to 1e-5 by far, and it is 0.43 at the
/// start.
///
/// Catches: a mass that is left out, or stands at another position; a potential of the velocities.
#[test]
fn a_closure_with_a_potential_has_an_energy() {
    let free = |_t, x| accelerations(0.0, x);
    let chain = FromForce::new(free).with_potential(potential).with_masses([1.0, 4.0]);
    let kinetic = 0.5 * 0.1 * 0.1 + 0.5 * 4.0 * 0.3 * 0.3;
    assert_eq!(chain.energy(START), kinetic + potential(START.positions));
    let end = integrate(&chain, &BlanesMoan6, START, &Grid::new(0.1, 1000).unwrap());
    assert!((chain.energy(end) - chain.energy(START)).abs() < 1e-5);
    assert!((end - START).positions[0].abs() > 1e-3, "it moves");
}

/// ẍ = −x from (1, 0) is cos t.
///
/// Catches: a closure that only the plain loop takes: not an ensemble, crossings, steps that vary
/// symmetrically or a method found by name.
#[test]
fn a_closure_goes_wherever_a_system_goes() {
    let spring = FromForce::new(|_t, [x]: [f64; 1]| [-x]);
    let start = ArrayPhase::at_rest([1.0]);
    let off = |t: f64, z: ArrayPhase<1>| (z.positions[0] - t.cos()).abs();

    let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12).unwrap());
    let mut walk = adaptive.steps(&spring, start, 0.0, 10.0).unwrap();
    let mut falling = walk.crossings(Direction::Falling, |_, z| z.positions[0]);
    let quarter = falling.next().unwrap().unwrap().t;
    assert!((quarter - std::f64::consts::FRAC_PI_2).abs() < 1e-10);

    // With G = 0 the steps are those of Störmer–Verlet, of which each is off by h³/24 at most.
    let mut steps = SymmetricSteps::new(&spring, start, 0.01, |_| 0.0).unwrap();
    let sample = steps.nth(99).unwrap().unwrap();
    assert!(off(sample.t, sample.z) < 1e-5 && (sample.t - 1.0).abs() < 1e-12);

    let grid = Grid::new(0.01, 100).unwrap();
    let mut ends = [ArrayPhase::default(); 2];
    Ensemble::new(&spring, &[start, start * 2.0], grid).ends_one_by_one(&Rk4, &mut ends);
    assert!(off(1.0, ends[0]) < 1e-9 && off(1.0, ends[1] * 0.5) < 1e-9);

    let named = method_named("velocity Verlet").unwrap().end(&spring, start, &grid);
    assert_eq!(named, integrate(&spring, &StormerVerlet, start, &grid));
}

/// Catches: an array that is turned round on its way into the closure or out of it; another time
/// than the stage's.
#[test]
fn a_closure_of_an_array_has_the_bits_of_one_of_names() {
    let grid = Grid::new(0.1, 50).unwrap();
    let named = FromRate::new(|t: f64, z: Phase| Phase {
        theta: z.omega,
        omega: t.cos() - z.theta * z.theta * z.theta,
    });
    let array = FromRate::new(|t: f64, [x, v]: [f64; 2]| [v, t.cos() - x * x * x]);
    for method in ["rk4", "gauss-4", "dormand-prince"] {
        let names = method_named(method).unwrap().end(&named, Phase::from([1.0, 0.5]), &grid);
        let numbers = method_named(method).unwrap().end(&array, [1.0, 0.5].into(), &grid);
        assert_eq!(numbers, [names.theta, names.omega], "{method}");
    }
}

/// Catches: an index that is off, an iterator that goes backwards or leaves one out.
#[test]
fn an_array_is_indexed_iterated_and_converted() {
    let mut array = Array::from([1.0, 2.0, 3.0]);
    array[1] += 0.5;
    assert_eq!((array[0], array[1], array[2]), (1.0, 2.5, 3.0));
    assert_eq!(array.into_iter().collect::<Vec<f64>>(), [1.0, 2.5, 3.0]);
    assert_eq!((&array).into_iter().sum::<f64>(), 6.5);
    assert_eq!(<[f64; 3]>::from(array), [1.0, 2.5, 3.0]);
    assert_eq!(array, [1.0, 2.5, 3.0]);
}

// -------------------------------------------------------------------------------------------------
// Trajectories
// -------------------------------------------------------------------------------------------------

/// Catches: a trajectory without its start or its end, or with a state twice; another loop than
/// that of the method.
#[test]
fn a_trajectory_has_the_states_of_the_loop() {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let grid = |steps| Grid::new(0.01, steps).unwrap();
    let states = trajectory(&pendulum, &StormerVerlet, start, &grid(40));
    let ends: Vec<Phase> =
        (0..=40).map(|n| integrate(&pendulum, &StormerVerlet, start, &grid(n))).collect();
    assert_eq!(states, ends);
    let by_pointer: &dyn AnyMethod = &StormerVerlet;
    assert_eq!(by_pointer.trajectory(&pendulum, start, &grid(40)), states);
}

/// Within 1e-12 a step the states of some twenty steps are off by less than 1e-10.
///
/// Catches: a solution or states of another walk, or at other times; a walk that ends before the
/// last time.
#[test]
fn states_at_given_times_and_a_solution_are_the_motion() {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let motion = Motion::new(&pendulum, start).unwrap();
    let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12).unwrap());
    let times = [0.0, 0.3, 0.3, 1.7, 2.5];
    let states = adaptive.states(&pendulum, start, 0.0, &times).unwrap();
    let solution = adaptive.solve(&pendulum, start, 0.0, 2.5).unwrap();
    assert_eq!(states.len(), times.len());
    for (t, z) in times.into_iter().zip(states) {
        assert!((z - motion.at(t)).theta.abs() < 1e-10, "at {t} s");
        assert_eq!(solution.at(t), Some(z), "at {t} s");
    }
    let back = adaptive.states(&pendulum, start, 0.0, &[-0.5, -1.0]).unwrap();
    assert!((back[1] - motion.at(-1.0)).theta.abs() < 1e-10);
    assert_eq!(adaptive.states(&pendulum, start, 0.0, &[]), Ok(vec![]));
    assert!(adaptive.states(&pendulum, start, 0.0, &[1.0, 0.5]).is_err());
    assert!(adaptive.states(&pendulum, start, 0.0, &[1.0, f64::NAN]).is_err());
}

// -------------------------------------------------------------------------------------------------
// Steps that vary
// -------------------------------------------------------------------------------------------------

/// The sizes of the steps of a walk of the pendulum from 1 rad.
fn sizes<M: pendula::adaptive::Controlled<Pendulum>>(
    adaptive: &Adaptive<'_, M>,
    until: f64,
) -> Vec<f64> {
    let walk = adaptive.steps(&Pendulum::PAPER, Phase::at_rest(1.0), 0.0, until).unwrap();
    walk.map(|step| step.unwrap().size()).collect()
}

/// Catches: a first step that is not taken, in its sign, or that bounds the later ones too; one
/// that a largest step does not bound; a series that takes a longer step than its powers allow.
#[test]
fn a_walk_begins_with_the_step_that_was_asked_for() {
    let tolerance = Tolerance::uniform(1e-9).unwrap();
    let adaptive = Adaptive::new(Dop853, tolerance);
    let with = |first| adaptive.first_step(first).unwrap();
    let steps = sizes(&with(1e-4), 2.0);
    assert!(steps[0] == 1e-4 && steps[1] > 1e-4, "{steps:?}");
    assert_eq!(sizes(&with(1e-4), -2.0)[0], -1e-4);
    assert_eq!(sizes(&with(1e-4).max_step(1e-5).unwrap(), 1e-3)[0], 1e-5);
    // Far too long, it is tried and rejected.
    let mut walk = with(1.9).steps(&Pendulum::PAPER, Phase::at_rest(1.0), 0.0, 20.0).unwrap();
    assert!(walk.next().unwrap().unwrap().size() < 1.0 && walk.counts().rejected > 0);

    let series = Adaptive::new(TaylorSeries, tolerance);
    assert_eq!(sizes(&series.first_step(1e-4).unwrap(), 2.0)[0], 1e-4);
    assert_eq!(sizes(&series.first_step(1.9).unwrap(), 2.0), sizes(&series, 2.0));
    for first in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(adaptive.first_step(first).is_err());
    }
}

/// A fast oscillation of 1e-6 beside a slow one of 1: with 1e-6 allowed in the fast one and 1e-9 in
/// the slow one, no step needs to follow the fast one; with 1e-12 each does.
///
/// Catches: a tolerance that is taken for another component, or for all; a list that is shorter or
/// longer than the state and goes unnoticed; other bits for equal tolerances.
#[test]
fn each_component_has_its_own_tolerance() {
    let two = FromRate::new(|_t, [x, v, y, w]: [f64; 4]| [v, -x, w, -100.0 * y]);
    let start = [1.0, 0.0, 1e-8, 0.0];
    let walk = |tolerance: Tolerance<'_>| {
        Adaptive::new(DormandPrince, tolerance).integrate(&two, start, 0.0, 10.0)
    };
    let each = |absolute: &[f64]| walk(Tolerance::for_each(absolute, 1e-9).unwrap());
    let same = walk(Tolerance::new(1e-9, 1e-9).unwrap()).unwrap();
    assert_eq!(each(&[1e-9; 4]), Ok(same));
    let steps = |absolute: &[f64]| each(absolute).unwrap().1.accepted;
    let (coarse, fine) = (steps(&[1e-9, 1e-9, 1e-6, 1e-6]), steps(&[1e-9, 1e-9, 1e-14, 1e-14]));
    let turned = steps(&[1e-6, 1e-6, 1e-14, 1e-14]);
    assert!(fine > 2 * coarse && turned > 2 * coarse, "{coarse}, {fine}, {turned}");
    for wrong in [&[1e-9; 3][..], &[1e-9; 5]] {
        assert!(matches!(each(wrong), Err(Error::Parameter { .. })));
    }
    assert!(Tolerance::for_each(&[], 1e-9).is_err());
    assert!(Tolerance::for_each(&[1e-9, 0.0], 1e-9).is_err());
}

/// Catches: a start that is no number, of which the walk says that no step meets the tolerance.
#[test]
fn a_start_that_is_no_number_is_refused_as_such() {
    let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-9).unwrap());
    for omega in [f64::NAN, f64::INFINITY] {
        let start = Phase { theta: 1.0, omega };
        let error = adaptive.integrate(&Pendulum::PAPER, start, 0.0, 1.0).unwrap_err();
        assert!(error.to_string().starts_with("component of the start cannot be "), "{error}");
    }
}

/// Catches: a method by name that is another one, or keeps the stages of another; one that is
/// found though it has no estimate.
#[test]
fn a_method_that_estimates_its_error_is_found_by_name() {
    let tolerance = Tolerance::uniform(1e-8).unwrap();
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(2.0));
    let walk = |name: &str| {
        let adaptive = Adaptive::new(AnyEmbedded::named(name).unwrap(), tolerance);
        let solution = adaptive.solve(&pendulum, start, 0.0, 5.0).unwrap();
        (adaptive.integrate(&pendulum, start, 0.0, 5.0), solution.at(3.21))
    };
    let five = Adaptive::new(DormandPrince, tolerance);
    let by_five = five.solve(&pendulum, start, 0.0, 5.0).unwrap().at(3.21);
    for name in ["dormand-prince", "RK45", "dopri5"] {
        assert_eq!(walk(name), (five.integrate(&pendulum, start, 0.0, 5.0), by_five));
    }
    let eight = Adaptive::new(Dop853, tolerance);
    let by_eight = eight.solve(&pendulum, start, 0.0, 5.0).unwrap().at(3.21);
    assert_eq!(walk("DOP853"), (eight.integrate(&pendulum, start, 0.0, 5.0), by_eight));
    for name in ["rk4", "stormer-verlet", "", "no-such-method"] {
        assert_eq!(AnyEmbedded::named(name), None, "{name:?}");
    }
}

// -------------------------------------------------------------------------------------------------
// Names
// -------------------------------------------------------------------------------------------------

/// Catches: an alias that finds another method, that two methods share, or that needs its capitals,
/// hyphens or accents.
#[test]
fn every_name_of_a_method_finds_that_method() {
    for method in METHODS {
        let info = method.info();
        for name in [info.name, info.title].into_iter().chain(info.aliases.iter().copied()) {
            let plain = name.replace(['–', '-', ' '], "_");
            for name in [name.to_string(), name.to_uppercase(), plain] {
                let called = METHODS.iter().filter(|method| method.info().is_called(&name));
                assert_eq!(called.count(), 1, "{name}");
                let found = method_named::<Pendulum>(&name).map(|found| found.info().name);
                assert_eq!(found, Some(info.name), "{name}");
            }
        }
    }
    for name in ["", "–", "verlet", "rk", "rk44", "position"] {
        assert!(method_named::<Pendulum>(name).is_none(), "{name:?}");
    }
}

// -------------------------------------------------------------------------------------------------
// Runs
// -------------------------------------------------------------------------------------------------

/// A pendulum with a table that is dear to copy.
#[derive(Debug, Default)]
struct WithTable {
    clones: Arc<AtomicU64>,
}

impl Clone for WithTable {
    fn clone(&self) -> Self {
        self.clones.fetch_add(1, Ordering::Relaxed);
        Self { clones: Arc::clone(&self.clones) }
    }
}

impl System for WithTable {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        Pendulum::PAPER.rate(t, z)
    }
}

/// Catches: a system that is copied for every block of steps, or for every step of an iterator;
/// evaluations that are lost on the way.
#[test]
fn a_run_copies_its_system_once() {
    let (start, grid) = (Phase::at_rest(1.0), Grid::new(0.01, 1000).unwrap());
    let end = integrate(&Pendulum::PAPER, &Rk4, start, &grid);
    let system = WithTable::default();
    let clones = || system.clones.load(Ordering::Relaxed);
    assert_eq!(AnyMethod::end(&Rk4, &system, start, &grid), end);
    assert_eq!(clones(), 1);
    assert_eq!(AnyMethod::run(&Rk4, &system, start, &grid, &mut First::<500>::default()), {
        integrate(&Pendulum::PAPER, &Rk4, start, &Grid::new(0.01, 499).unwrap())
    });
    assert_eq!(clones(), 2);
    let mut run = Run::start(&system, &Rk4, start, &grid);
    assert_eq!(run.by_ref().last(), Some(Ok(end)));
    assert_eq!((clones(), run.evaluations()), (3, 4000));
}

/// Catches: a run that is bound to the thread in which it began.
#[test]
fn a_run_goes_on_in_another_thread() {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let grid = Grid::new(0.01, 200).unwrap();
    let methods: [&'static dyn AnyMethod; 3] = [&Rk4, &InSteps(StormerVerlet), METHODS[0]];
    for method in methods {
        let mut run = method.begin(&pendulum, start, &grid);
        run.advance(77, NonZeroU64::MIN, &mut ()).unwrap();
        let there = thread::spawn(move || run.finish(NonZeroU64::MIN, &mut ()));
        assert_eq!(there.join().unwrap(), method.end(&pendulum, start, &grid));
    }
}

/// Whether the functions of a generic program can be written: over the methods by type, and over
/// those by name.
#[allow(dead_code, reason = "it has to compile")]
fn generic<S, M>(system: &S, method: &M, start: S::State, grid: &Grid) -> [S::State; 2]
where
    S: ByName<State: Components> + Clone + Send,
    M: Method<S> + Method<Counting<S>> + pendula::Info + Sync,
{
    let by_pointer: &dyn AnyMethod<S> = method;
    [integrate(system, method, start, grid), by_pointer.end(system, start, grid)]
}
