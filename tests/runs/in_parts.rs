//! Runs that are left and taken further: the same samples, with the same bits, as if nothing had
//! happened.

use std::num::NonZeroU64;

use pendula::integrate::{Every, Run};
use pendula::methods::BlanesMoan6;
use pendula::metrics::EnergyDrift;
use pendula::systems::{Driven, Separable};
use pendula::{
    AnyMethod, Error, Grid, Method, Observer, Pendulum, Phase, Rk4, StormerVerlet, System,
    Unsolved, integrate, integrate_fast, method_named, state,
};

use crate::common::{First, Samples, on};

const STEPS: u64 = 11;

/// Strides that divide the number of steps, that do not, that reach the end, and that do not.
const STRIDES: [u64; 6] = [1, 2, 4, 11, 12, u64::MAX];

/// The samples and the end of a run that is left after `leave` steps, with samples every `every`.
fn in_two_parts(
    mut run: Run<'_, Phase>,
    start: Phase,
    [leave, every]: [u64; 2],
) -> (Samples, Phase) {
    let every = NonZeroU64::new(every).unwrap();
    let mut samples = Samples::default();
    samples.observe(0, 0.0, start);
    run.advance(leave, every, &mut samples).unwrap();
    assert_eq!(run.steps(), leave);
    // Beyond the end there is nothing.
    let end = run.advance(STEPS + 5, every, &mut samples);
    assert_eq!((run.steps(), run.state()), (STEPS, end.unwrap()));
    (samples, run.state())
}

/// For every method, for scenes with time in steps and (where angles are large) in seconds, left
/// after every number of steps, for every stride.
///
/// Catches: a carry that is computed again, which merges half kicks differently; a time or a stride
/// counted from where the run was left; a sample seen twice or never.
fn a_run_in_parts_is_the_run(method: &dyn AnyMethod) {
    let pendulum = Pendulum::new(5.0, 2.0, 3.0).unwrap();
    let grid = Grid::new(0.07, STEPS).unwrap();
    for (theta, omega) in [(1.0, 0.0), (-3.0, 9.0), (2e6, 0.3)] {
        let start = Phase { theta, omega };
        for every in STRIDES {
            let mut watch = Every::new(NonZeroU64::new(every).unwrap(), Samples::default());
            let end = method.run(&pendulum, start, &grid, &mut watch);
            let whole = watch.into_inner();
            for leave in 0..=STEPS {
                let run = method.begin(&pendulum, start, &grid);
                let parts = in_two_parts(run, start, [leave, every]);
                let case = format!("from {start:?}, left after {leave}, every {every}");
                assert_eq!(parts, (whole.clone(), end), "{case}");
            }
        }
    }
}
each_method!(a_run_in_parts_is_the_run);

/// Under a drive, the force depends on the time; every method for such systems.
///
/// Catches: a time that begins anew where a run is left, also within a step.
fn a_driven_run_in_parts_is_the_run(method: &dyn AnyMethod) {
    let driven = Driven::taylor(1.07).unwrap();
    let start = Phase { theta: -0.4, omega: 1.2 };
    let grid = Grid::new(0.01, STEPS).unwrap();
    let method = on(method);
    let mut whole = Samples::default();
    let end = method.run(&driven, start, &grid, &mut whole);
    for leave in 0..=STEPS {
        let run = method.begin(&driven, start, &grid);
        let parts = in_two_parts(run, start, [leave, 1]);
        assert_eq!(parts, (whole.clone(), end), "left after {leave}");
    }
}
each_general_method!(a_driven_run_in_parts_is_the_run);

/// Catches: a run that goes on although its observer has seen enough, or takes no step where it was
/// satisfied; an end that is not the state observed last.
#[test]
fn a_satisfied_observer_ends_a_part() {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let grid = Grid::new(0.07, STEPS).unwrap();
    let mut run = method_named("rk4").unwrap().begin(&pendulum, start, &grid);
    let two = NonZeroU64::new(2).unwrap();
    let end = run.advance(STEPS, two, &mut First::<3>::default()).unwrap();
    assert_eq!(run.steps(), 6);
    assert_eq!(end, integrate_fast(&pendulum, &Rk4, start, &Grid::new(0.07, 6).unwrap()));
    assert_eq!(run.advance(STEPS, two, &mut First::<3>(vec![end; 3])), Ok(end));
    assert_eq!(run.steps(), 6);
}

/// Catches: evaluations before the first step forgotten, those of the last part alone, those of
/// steps that are taken again because the observer was satisfied in the midst of a block.
fn the_evaluations_of_the_parts_add_up(method: &dyn AnyMethod) {
    let pendulum = Pendulum::new(5.0, 2.0, 3.0).unwrap();
    let grid = Grid::new(0.07, STEPS).unwrap();
    // In steps and, where angles are large, in seconds.
    for theta in [1.0, 2e6] {
        let start = Phase { theta, omega: 0.3 };
        let mut run = method.begin(&pendulum, start, &grid);
        run.advance(STEPS, NonZeroU64::MIN, &mut First::<4>::default()).unwrap();
        assert_eq!(run.steps(), 4);
        run.advance(STEPS, NonZeroU64::MIN, &mut EnergyDrift::new(&pendulum)).unwrap();
        assert_eq!(run.evaluations(), method.count_evaluations(&pendulum, start, &grid));
        let info = method.info();
        if !info.implicit {
            let declared = STEPS * info.force_evaluations;
            assert_eq!(run.evaluations(), declared + info.start_evaluations);
        }
    }
}
each_method!(the_evaluations_of_the_parts_add_up);

state! {
    /// Two bodies in the plane, or their rates of change.
    pub struct TwoBodies {
        pub x1: f64,
        pub y1: f64,
        pub x2: f64,
        pub y2: f64,
        pub u1: f64,
        pub v1: f64,
        pub u2: f64,
        pub v2: f64,
    }
}

/// Two bodies of mass 1 on springs to the origin and to each other.
#[derive(Clone, Copy)]
struct Springs;

impl System for Springs {
    type State = TwoBodies;

    fn rate(&self, _t: f64, z: TwoBodies) -> TwoBodies {
        let TwoBodies { x1, y1, x2, y2, u1, v1, u2, v2 } = z;
        let (x, y) = (x1 - x2, y1 - y2);
        TwoBodies {
            x1: u1,
            y1: v1,
            x2: u2,
            y2: v2,
            u1: -x1 - x,
            v1: -y1 - y,
            u2: -x2 + x,
            v2: -y2 + y,
        }
    }
}

impl Separable for Springs {
    type Force = TwoBodies;

    fn force(&self, t: f64, z: TwoBodies) -> TwoBodies {
        let TwoBodies { u1, v1, u2, v2, .. } = self.rate(t, z);
        TwoBodies { u1, v1, u2, v2, ..TwoBodies::default() }
    }

    fn kick(&self, z: TwoBodies, force: TwoBodies, h: f64) -> TwoBodies {
        z + force * h
    }

    fn drift(&self, z: TwoBodies, h: f64) -> TwoBodies {
        let TwoBodies { u1, v1, u2, v2, .. } = z;
        z + TwoBodies { x1: u1, y1: v1, x2: u2, y2: v2, ..TwoBodies::default() } * h
    }
}

/// A state of eight numbers, with a carry of as many.
///
/// Catches: a run without room for a state and a carry of that size.
#[test]
fn two_bodies_in_the_plane_fit() {
    let start = TwoBodies { x1: 1.0, y2: -0.5, v1: 0.3, u2: 0.7, ..TwoBodies::default() };
    let grid = Grid::new(0.1, 20).unwrap();
    let one = NonZeroU64::MIN;
    let ends = [
        Run::start(&Springs, &StormerVerlet, start, &grid).advance(20, one, &mut ()).unwrap(),
        Run::start(&Springs, &BlanesMoan6, start, &grid).advance(20, one, &mut ()).unwrap(),
        Run::start(&Springs, &Rk4, start, &grid).advance(20, one, &mut ()).unwrap(),
    ];
    assert_eq!(ends[0], integrate(&Springs, &StormerVerlet, start, &grid));
    assert_eq!(ends[1], integrate(&Springs, &BlanesMoan6, start, &grid));
    assert_eq!(ends[2], integrate(&Springs, &Rk4, start, &grid));
}

/// Forward Euler, which finds no solution at one time.
struct Fails;

impl<S: System> Method<S> for Fails {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        z + system.rate(t, z) * h
    }

    fn try_step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        carry: &mut (),
    ) -> Result<S::State, Unsolved> {
        if t == 100.0 {
            return Err(Unsolved { sweeps: 1, change: 1.0 });
        }
        Ok(self.step(system, t, h, z, carry))
    }
}

/// Catches: a run that is said to stand at its last state that was seen, and not where its method
/// stands; states after it that are numbers.
#[test]
fn a_run_that_fails_stands_before_the_step_without_a_solution() {
    let (slow, start) = (Pendulum::new(1e-6, 1.0, 1.0).unwrap(), Phase::at_rest(1.0));
    let grid = |steps| Grid::new(1.0, steps).unwrap();
    let there = integrate(&slow, &Fails, start, &grid(100));
    for every in [1, 64, 100, 1000] {
        let mut run = Run::start(&slow, &Fails, start, &grid(1000));
        let every = NonZeroU64::new(every).unwrap();
        for _ in 0..2 {
            let failed = run.advance(1000, every, &mut ());
            assert!(matches!(failed, Err(Error::NotSolved { n: 100, .. })), "{failed:?}");
            assert_eq!((run.steps(), run.state(), run.evaluations()), (100, there, 100));
        }
        assert_eq!(run.next(), None);
        let mut last = start;
        let end = Run::start(&slow, &Fails, start, &grid(1000))
            .finish(every, &mut |_: u64, _: f64, z: Phase| last = z);
        assert!(end.theta.is_nan() && end.omega.is_nan() && last.theta.is_nan());
    }
}
