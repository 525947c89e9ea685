//! Adaptive steps: what the tolerance promises, what they cost, where they end.

use std::f64::consts::PI;

use pendula::adaptive::{
    Adaptive, AdaptiveSteps, Controlled, Counts, Dense, Direction, EventFunction,
    SMALLEST_RELATIVE, TaylorSeries, Tolerance,
};
use pendula::internals::Controller;
use pendula::methods::runge_kutta::Embedded;
use pendula::methods::{Dop853, DormandPrince};
use pendula::state;
use pendula::{Counting, Error, Motion, Pendulum, Phase, System, exact};
use rstest::rstest;

use crate::common::{First, Random, pendulums};

/// Makes of the function `$test` a test for each embedded pair.
macro_rules! each_pair {
    ($test:ident) => {
        cases! { $test: dormand_prince(DormandPrince), dop853(Dop853), }
    };
}

/// Makes of the function `$test` a test for each method that estimates its error.
macro_rules! each_controlled {
    ($test:ident) => {
        cases! {
            $test:
            dormand_prince(DormandPrince),
            dop853(Dop853),
            taylor_series(TaylorSeries),
        }
    };
}

mod between;
mod ends;
mod events;
mod events_looks;
mod largest_error;

const START: Phase = Phase { theta: 2.0, omega: 0.3 };

fn tolerance(tolerance: f64) -> Tolerance<'static> {
    Tolerance::uniform(tolerance).unwrap()
}

fn walk<M: Controlled<Pendulum>>(
    pendulum: &Pendulum,
    method: M,
    tol: f64,
    until: f64,
) -> AdaptiveSteps<'_, Pendulum, M> {
    Adaptive::new(method, tolerance(tol)).steps(pendulum, START, 0.0, until).unwrap()
}

fn minus(x: Phase, y: Phase) -> Phase {
    x + y * -1.0
}

state! {
    /// A number as a state.
    pub struct Number {
        pub y: f64,
    }
}

/// ẏ = a function of time and y.
struct Law<F>(F);

impl<F: Fn(f64, f64) -> f64> System for Law<F> {
    type State = Number;

    fn rate(&self, t: f64, z: Number) -> Number {
        Number { y: (self.0)(t, z.y) }
    }
}

// -------------------------------------------------------------------------------------------------
// Tolerance
// -------------------------------------------------------------------------------------------------

/// h is proportional to the tolerance to the power 1/k, and the error of the run to hᵏ, where k is
/// the order of both the step and its estimate: so the error is proportional to the tolerance.
///
/// Where the steps of one run happen to lie changes its error by half a decade either way; the mean
/// of 16 runs by an eighth of a decade; and the slope over 8 decades by 0.02, twice that at worst.
const PROPORTIONALITY: f64 = 0.05;

/// Catches: an error without its scale, or with the wrong one; an error with one factor h too few
/// or too many; an estimate of the wrong order; a step that is taken although it was rejected.
fn the_error_falls_with_the_tolerance<M: Controlled<Pendulum>>(method: M) {
    for pendulum in pendulums() {
        let mean_of_logarithms = |tol: f64| {
            let logarithm = |n: u32| {
                let start = Phase { theta: 0.4 + 0.15 * f64::from(n), omega: 0.3 };
                let motion = Motion::new(&pendulum, start).unwrap();
                let mut largest = 0.0_f64;
                let mut watch = |_, t, z: Phase| {
                    largest = largest.max((z.theta - motion.at(t).theta).abs());
                };
                Adaptive::new(method, tolerance(tol))
                    .integrate_with(&pendulum, start, 0.0, 10.0, &mut watch)
                    .unwrap();
                largest.log10()
            };
            (0..16).map(logarithm).sum::<f64>() / 16.0
        };
        let slope = (mean_of_logarithms(1e-4) - mean_of_logarithms(1e-12)) / 8.0;
        assert!((slope - 1.0).abs() < PROPORTIONALITY, "{slope}");
    }
}
each_controlled!(the_error_falls_with_the_tolerance);

/// The method that steps is better by an order than the one whose error is estimated: below 1e-7 no
/// step of a swing is off by as much as the tolerance allows. (Elsewhere the estimate may vanish by
/// chance: see `largest_error`.) But it is not so much better that the steps are too small: a step
/// of half the size would have an error 2⁹ times smaller.
///
/// Catches: an estimate of the error that is too small, by a factor or in one component, or far too
/// large.
fn no_step_of_a_swing_is_off_by_more_than_the_tolerance<M: Controlled<Pendulum>>(method: M) {
    for pendulum in pendulums() {
        for tol in [1e-7, 1e-9, 1e-11] {
            let mut largest = 0.0_f64;
            for step in walk(&pendulum, method, tol, 20.0) {
                let step = step.unwrap();
                let right = Motion::new(&pendulum, step.start()).unwrap().at(step.size());
                let off = minus(step.end(), right);
                largest = largest.max(tolerance(tol).error_norm(step.start(), step.end(), off));
            }
            assert!(largest <= 1.0 && largest > 1.0 / 512.0, "{largest} at {tol:e}");
        }
    }
}
each_controlled!(no_step_of_a_swing_is_off_by_more_than_the_tolerance);

/// Catches: the larger tolerance used for both, a tolerance that is not used, a mean without its
/// division or its root.
#[test]
fn a_displacement_is_measured_in_tolerances() {
    let tolerance = Tolerance::new(0.5, 0.25).unwrap();
    assert_eq!((tolerance.absolute(0), tolerance.relative()), (0.5, 0.25));
    let (from, to) = (Phase { theta: -2.0, omega: 1.0 }, Phase { theta: 1.0, omega: -6.0 });
    // Allowed: 0.5 + 0.25 · 2 = 1 and 0.5 + 0.25 · 6 = 2.
    let ratio = tolerance.error_norm(from, to, Phase { theta: -3.0, omega: 8.0 });
    assert_eq!(ratio, ((9.0_f64 + 16.0) / 2.0).sqrt());
}

// -------------------------------------------------------------------------------------------------
// Work
// -------------------------------------------------------------------------------------------------

/// Choosing the first step takes two evaluations, one of which is its first slope.
///
/// Catches: a known slope evaluated again, in the next step or after a refusal; refused steps not
/// counted.
#[rstest]
#[case::dormand_prince(DormandPrince, 6, 6, 0)]
#[case::dop853(Dop853, 12, 11, 3)]
fn each_evaluation_is_counted_and_none_is_wasted<M: Embedded>(
    #[case] method: M,
    #[case] of_accepted: u64,
    #[case] of_rejected: u64,
    #[case] of_dense: u64,
) {
    for pendulum in pendulums() {
        let counting = Counting::new(pendulum);
        let adaptive = Adaptive::new(method, tolerance(1e-6));
        let mut walk = adaptive.steps(&counting, START, 0.0, 20.0).unwrap();
        let mut steps = 0;
        while let Some(step) = walk.next() {
            walk.dense(&step.unwrap());
            steps += 1;
        }
        let Counts { accepted, rejected, evaluations, .. } = walk.counts();
        assert!(accepted == steps && rejected > 0, "{accepted} of {steps}, {rejected} refused");
        let expected = 2 + (of_accepted + of_dense) * accepted + of_rejected * rejected;
        assert_eq!((evaluations, counting.evaluations()), (expected, expected));
    }
}

/// The steps that Dormand and Prince's method takes and refuses from (2, 0.3) to 20 s, from
/// `tests/data/adaptive_counts.py`, which was written from the literature. Its arithmetic is f64
/// too, in another order: over 1000 steps the last bits of a factor do not change a count.
///
/// Catches: a controller with other exponents, limits or memory, an estimate with a wrong
/// coefficient, another first step: all keep the tolerance, and only the counts show them.
#[test]
fn the_counts_are_those_of_an_independent_program() {
    for (tol, (accepted, rejected)) in [
        (1e-3, (62, 28)),
        (1e-4, (89, 16)),
        (1e-5, (140, 17)),
        (1e-6, (220, 23)),
        (1e-7, (343, 22)),
        (1e-8, (539, 0)),
        (1e-9, (859, 0)),
        (1e-10, (1366, 0)),
        (1e-11, (2168, 0)),
        (1e-12, (3439, 0)),
    ] {
        let mut walk = walk(&Pendulum::PAPER, DormandPrince, tol, 20.0);
        assert!(walk.by_ref().all(|step| step.is_ok()));
        let Counts { accepted: taken, rejected: refused, .. } = walk.counts();
        assert_eq!((taken, refused), (accepted, rejected), "{tol:e}");
    }
}

/// The first step by hand, after Hairer, Nørsett and Wanner (Sect. II.4). In units of the allowed
/// error, 2e-6 at y = 1:
///
/// * ẏ = −4 y: y is 5e5, ẏ is 2e6, and so 0.01 · 5e5/2e6 s is tried; ẏ changes by 0.01 · 2e6 in it,
///   or 8e6 a second; the step is (0.01/8e6)^(1/k).
/// * ẏ = −4 y³ + 9 t: the same step is tried, and the change of ẏ in it comes from both the cube
///   and the time.
/// * ẏ = 1 from 0 gives no time scale: 1e-6 of the duration is tried, and the step is 100 times
///   that.
/// * ẏ = 0 gives none either: the step is 1e-6 of the duration.
///
/// Catches: a wrong constant or unit in the rule; a trial step in the wrong direction of time.
#[rstest]
#[case::dormand_prince(DormandPrince, 0.2)]
#[case::dop853(Dop853, 0.125)]
fn the_first_step_follows_the_state<M: Embedded>(#[case] method: M, #[case] root: f64) {
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    let first = |law: &dyn Fn(f64, f64) -> f64, y: f64, until: f64| {
        let law = Law(law);
        let mut walk = adaptive.steps(&law, Number { y }, 0.0, until).unwrap();
        let size = walk.next().unwrap().unwrap().size();
        assert_eq!(walk.counts().rejected, 0);
        size
    };
    for way in [1.0, -1.0] {
        let bent = |t, y: f64| -4.0 * way * y.powi(3) + 9.0 * t;
        let bend = (4.0 - 4.0 * 0.99_f64.powi(3) + 9.0 * 0.0025) / 2e-6 / 0.0025;
        for (size, expected) in [
            (first(&|_, y| -4.0 * way * y, 1.0, 10.0 * way), (0.01_f64 / 8e6).powf(root)),
            (first(&bent, 1.0, 10.0 * way), (0.01 / bend).powf(root)),
            (first(&|_, _| 1.0, 0.0, 10.0 * way), 1e-3),
            (first(&|_, _| 0.0, 0.0, 10.0 * way), 1e-5),
            (first(&|_, _| 0.0, 1.0, 10.0 * way), 1e-5),
            // No longer than the whole duration.
            (first(&|_, y| -4.0 * way * y, 1.0, 1e-3 * way), 1e-3),
        ] {
            // A few roundings, and another library's power function.
            assert!((size * way / expected - 1.0).abs() < 1e-9, "{size}, not {expected}");
        }
    }
}

/// The same rule for two components, each in units of its own tolerance: fast near the bottom,
/// where the velocity changes most.
///
/// Catches: a sum over the components where their mean is meant, a component left out.
#[rstest]
#[case::dormand_prince(DormandPrince, 0.2)]
#[case::dop853(Dop853, 0.125)]
fn the_first_step_weighs_every_component<M: Embedded>(#[case] method: M, #[case] root: f64) {
    let (pendulum, start) = (Pendulum::PAPER, Phase { theta: 0.1, omega: 4.0 });
    let size = |x: Phase| {
        let theta = x.theta / (1e-6 + 1e-6 * start.theta);
        let omega = x.omega / (1e-6 + 1e-6 * start.omega);
        (0.5 * (theta * theta + omega * omega)).sqrt()
    };
    let slope = pendulum.rate(0.0, start);
    let tried = 0.01 * (size(start) / size(slope));
    let bend = size(minus(pendulum.rate(0.0, start + slope * tried), slope)) / tried;
    assert!(bend > 2.0 * size(slope), "the step tried has to matter");
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    let mut walk = adaptive.steps(&pendulum, start, 0.0, 10.0).unwrap();
    let first = walk.next().unwrap().unwrap().size();
    assert_eq!(walk.counts().rejected, 0);
    // A few roundings of a difference that loses three digits, some 1e-13; the root reduces them.
    let expected = (0.01 / bend).powf(root);
    assert!((first / expected - 1.0).abs() < 1e-12, "{first}, not {expected}");
}

// -------------------------------------------------------------------------------------------------
// The size of the next step
// -------------------------------------------------------------------------------------------------

/// A few roundings, and the powers of another library.
const ROUNDING: f64 = 1e-14;

/// What `controller` makes of these errors, one after the other, is that.
#[track_caller]
fn assert_judged(mut controller: Controller, judged: &[(f64, bool, f64)]) {
    for &(error, accepted, factor) in judged {
        let (found, by) = controller.judge(error);
        assert!(found == accepted, "{error}: {found}");
        assert!((by / factor - 1.0).abs() < ROUNDING, "{error}: {by}, not {factor}");
    }
}

/// Factors computed with 40 digits: 0.9 error^(−0.85/k) last^(0.2/k) after a step that is
/// accepted, where the `last` is 1e-4 before the first, and 0.9 error^(−1/k) after one that is
/// not.
///
/// Catches: a wrong exponent of either error, or a swapped sign, which leaves the tolerance
/// kept and only takes more steps; the order of the method in place of that of its estimate; a
/// memory of the error that was refused.
#[test]
fn a_step_is_judged_by_its_error_and_the_one_before() {
    for (order, factors) in [
        (
            5,
            [
                0.700_515_273_422_561_8,
                1.915_143_450_563_941_6,
                0.748_587_393_992_403_9,
                0.722_467_405_584_207_6,
            ],
        ),
        (
            8,
            [
                0.769_532_464_874_439_2,
                1.442_835_301_480_292_3,
                0.802_125_844_320_371,
                0.784_516_988_584_562_1,
            ],
        ),
    ] {
        let [first, second, third, refused] = factors;
        assert_judged(
            Controller::new(order),
            &[(0.5, true, first), (0.01, true, second), (1.0, true, third)],
        );
        // The error of a step that was refused is not remembered; what was before it is, and
        // the next step does not grow.
        assert_judged(
            Controller::new(order),
            &[(0.5, true, first), (3.0, false, refused), (0.01, true, 1.0), (1.0, true, third)],
        );
    }
}

/// Catches: a step that grows or shrinks without limit; a NaN or an infinity that is accepted,
/// or from which the next step is NaN.
#[test]
fn a_step_changes_within_limits() {
    for order in [5, 8] {
        let judged = [
            (0.0, true, 10.0),
            (1e-300, true, 10.0),
            (1.0_f64.next_up(), false, 0.9),
            (1e9, false, 0.2),
            (f64::INFINITY, false, 0.2),
            (f64::NAN, false, 0.2),
            // After a refusal no growth, once.
            (0.0, true, 1.0),
            (0.0, true, 10.0),
        ];
        assert_judged(Controller::new(order), &judged);
    }
}
