//! Adaptive steps: what the tolerance promises, dense output, crossings, both directions of time,
//! refusals.

use std::f64::consts::PI;

use pendula::adaptive::{
    Adaptive, AdaptiveSteps, Controlled, Counts, Dense, Direction, SMALLEST_RELATIVE, TaylorSeries,
    Tolerance,
};
use pendula::methods::runge_kutta::Embedded;
use pendula::methods::{Dop853, DormandPrince};
use pendula::state;
use pendula::{
    Counting, Error, Grid, Method, Motion, Observer, Pendulum, Phase, System, exact, integrate,
};
use rstest::rstest;

use crate::random::Random;

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

/// The paper's, and one with L ≠ 1, m ≠ 1 and another ω₀.
fn pendulums() -> [Pendulum; 2] {
    [Pendulum::PAPER, Pendulum::new(9.81, 2.5, 0.7).unwrap()]
}

const START: Phase = Phase { theta: 2.0, omega: 0.3 };

fn tolerance(tolerance: f64) -> Tolerance {
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

// -------------------------------------------------------------------------------------------------
// Tolerance
// -------------------------------------------------------------------------------------------------

/// h is proportional to the tolerance to the power 1/k, and the error of the run to hᵏ, where k is
/// the order of both the step and its estimate: so the error is proportional to the tolerance.
///
/// Where the steps of one run happen to lie changes its error by half a decade either way; the mean
/// of 16 runs by an eighth of a decade; and the slope over 8 decades by 0.02, twice that at worst.
const PROPORTIONALITY: f64 = 0.05;

/// Catches: an error without a scale, or with the wrong one; an error with an h missing or too
/// many; an estimate of the wrong order; a step taken although it was refused.
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
                    .integrate(&pendulum, start, 0.0, 10.0, &mut watch)
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
/// step is off by as much as the tolerance allows. But it is not so much better that the steps are
/// too small: a step of half the size would have an error 2⁹ times smaller.
///
/// Catches: an estimate that is too small, by a factor or for one of the components; one that is
/// far too large.
fn no_step_is_off_by_more_than_the_tolerance<M: Controlled<Pendulum>>(method: M) {
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
each_controlled!(no_step_is_off_by_more_than_the_tolerance);

/// Catches: the larger tolerance used for both, a tolerance that is not used, a mean without its
/// division or its root.
#[test]
fn a_displacement_is_measured_in_tolerances() {
    let tolerance = Tolerance::new(0.5, 0.25).unwrap();
    assert_eq!((tolerance.absolute(), tolerance.relative()), (0.5, 0.25));
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

/// Where nothing is refused, sixteen times the tolerance makes a step 16^(1/k) times longer, up to
/// 2 % because of the first and last steps.
///
/// Catches: an estimate of another order than the method declares. (A wrong exponent of the
/// controller moves where the steps settle by nothing: the counts below show it.)
#[test]
fn steps_lengthen_with_the_root_of_the_tolerance() {
    let steps = |tol| {
        let mut walk = walk(&Pendulum::PAPER, DormandPrince, tol, 20.0);
        assert!(walk.by_ref().all(|step| step.is_ok()));
        assert_eq!(walk.counts().rejected, 0);
        walk.counts().accepted as f64
    };
    let ratio = steps(1e-12) / steps(16e-12);
    assert!((ratio / 16_f64.powf(0.2) - 1.0).abs() < 0.02, "{ratio}");
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

/// Short walks from anywhere to anywhere, either way, with tolerances of 1e-3 to 1e-12: the last
/// time is the end to the bit, each step begins where the one before ended, and none is a scrap of
/// the walk. What is left after a step is more than a hundredth of it, so that a last step that was
/// not refused is no shorter than that.
///
/// Catches: a last step that stops short of the end by a rounding, or beyond it; a tiny step left
/// over for the end, which costs as much as any and is mostly rounding.
fn a_walk_ends_where_it_should<M: Controlled<Pendulum>>(method: M) {
    let mut random = Random::new(7);
    let mut last_steps = 0;
    for n in 0..2000 {
        let from = random.one_of(&[0.0, 1.0, -1e3, 1e6]) * random.between(0.5, 1.0);
        let until = from + random.between(-3.0, 3.0);
        let start = Phase { theta: random.between(-4.0, 4.0), omega: random.between(-4.0, 4.0) };
        let tol = 10_f64.powf(random.between(-12.0, -3.0));
        let adaptive = Adaptive::new(method, tolerance(tol));
        let mut walk = adaptive.steps(&Pendulum::PAPER, start, from, until).unwrap();
        let (mut t, mut z, mut before) = (from, start, None);
        while let Some(step) = walk.next() {
            let step = step.unwrap();
            assert!(step.start_time() == t && step.start() == z, "walk {n}");
            let rejected = walk.counts().rejected;
            assert!(
                step.size().abs() > 1e-12 * (until - from).abs(),
                "walk {n}: {} s",
                step.size()
            );
            if let Some((size, refused)) = before
                && step.end_time() == until
                && rejected == refused
            {
                let share: f64 = step.size() / size;
                assert!(share > 0.0099, "walk {n}: a last step of {share} of the one before");
                last_steps += 1;
            }
            before = Some((step.size(), rejected));
            (t, z) = (step.end_time(), step.end());
        }
        assert!(t == until && walk.time() == until && walk.state() == z, "walk {n}: {t}");
    }
    assert!(last_steps > 500, "{last_steps}");
}
each_controlled!(a_walk_ends_where_it_should);

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

/// Where nothing changes there is no error, and each step is ten times as long as the last.
///
/// Catches: a step that grows without limit where nothing changes, and jumps over what follows.
fn no_step_grows_more_than_tenfold<M: Embedded>(method: M) {
    let calm = Law(|_, _| 0.0);
    let walk =
        Adaptive::new(method, tolerance(1e-6)).steps(&calm, Number { y: 0.0 }, 0.0, 10.0).unwrap();
    let sizes: Vec<f64> = walk.map(|step| step.unwrap().size()).collect();
    // All but the last, which is cut off at the end.
    for pair in sizes[..sizes.len() - 1].windows(2) {
        assert!((pair[1] / pair[0] - 10.0).abs() < 1e-12, "{sizes:?}");
    }
    assert_eq!(sizes.len(), 7);
}
each_pair!(no_step_grows_more_than_tenfold);

// -------------------------------------------------------------------------------------------------
// Fixed steps and dense output
// -------------------------------------------------------------------------------------------------

/// The slopes of the largest error of the angle, between runs over 10 s with steps √2 times shorter
/// each time.
fn slopes_of_runs<M: Method<Pendulum>>(pendulum: &Pendulum, method: &M, steps: f64) -> Vec<f64> {
    let motion = Motion::new(pendulum, START).unwrap();
    let rungs: Vec<(f64, f64)> = (0..4)
        .map(|rung| {
            let steps = (steps * 2_f64.powf(0.5 * f64::from(rung))).round();
            let mut largest = 0.0_f64;
            let mut watch =
                |_, t, z: Phase| largest = largest.max((z.theta - motion.at(t).theta).abs());
            let grid = Grid::new(10.0 / steps, steps as u64).unwrap();
            integrate(pendulum, method, START, &grid, &mut watch);
            (steps, largest)
        })
        .collect();
    rungs.windows(2).map(|w| (w[0].1 / w[1].1).ln() / (w[1].0 / w[0].0).ln()).collect()
}

/// Dormand and Prince's method of order 5, at 700 to 2000 steps: the next term bends the slope by
/// 0.08 at the first, and by less thereafter.
///
/// DOP853 is built so that the leading term of its error is small: as far down as f64 resolves, it
/// is better than order 8, and its slopes are between 8 and 9.5. The test of its trees shows that
/// its order is no higher.
///
/// Catches: with fixed steps, a slope carried over from another state; h used twice.
#[rstest]
#[case::dormand_prince(DormandPrince, 700.0, 4.95, 5.09)]
#[case::dop853(Dop853, 63.0, 8.0, 9.5)]
fn with_fixed_steps_every_slope_is_the_order<M: Method<Pendulum>>(
    #[case] method: M,
    #[case] steps: f64,
    #[case] least: f64,
    #[case] most: f64,
) {
    for pendulum in pendulums() {
        let slopes = slopes_of_runs(&pendulum, &method, steps);
        assert!(slopes.iter().all(|slope| (least..most).contains(slope)), "{slopes:?}");
    }
}

/// Within one step dense output of order q is off by O(h^(q+1)): the largest error of 40 steps
/// spread over a swing, each evaluated at 4 points.
///
/// Where the error is largest moves a little with h: over a factor of √2 that changes a slope by
/// ±0.2 at DOP853's long steps; over the factor of 4 here it is less.
///
/// Catches: dense output of a lower order, as Hermite's cubic alone would be (of order 3); a
/// coefficient that only matters in the middle of a step.
#[rstest]
#[case::dormand_prince(DormandPrince, 4, 0.04, 0.05)]
#[case::dop853(Dop853, 7, 0.11, 0.15)]
fn dense_output_has_its_order<M: Embedded>(
    #[case] method: M,
    #[case] order: u32,
    #[case] longest: f64,
    #[case] tolerance: f64,
) {
    for pendulum in pendulums() {
        let motion = Motion::new(&pendulum, START).unwrap();
        let largest = |h: f64| {
            let mut largest = 0.0_f64;
            for n in 0..40 {
                let z = motion.at(0.17 * f64::from(n));
                let right = Motion::new(&pendulum, z).unwrap();
                let dense = one_step(&pendulum, method, z, h);
                for s in [0.2, 0.4, 0.6, 0.8] {
                    largest = largest.max((dense.after(s).theta - right.at(s * h).theta).abs());
                }
            }
            largest
        };
        let slope = (largest(longest) / largest(longest / 4.0)).log2() / 2.0;
        assert!((slope - f64::from(order + 1)).abs() < tolerance, "{slope}");
    }
}

fn one_step<M: Embedded>(
    pendulum: &Pendulum,
    method: M,
    z: Phase,
    h: f64,
) -> Dense<Phase, M::Dense<Phase>> {
    let (end, stages) = method.attempt(pendulum, 0.0, h, z, pendulum.rate(0.0, z));
    let slope = method.end_slope(pendulum, h, end, &stages);
    Dense::new(0.0, h, z, method.dense(pendulum, 0.0, h, z, &stages, slope))
}

/// Catches: dense output of another step; a time not converted to the fraction of the step.
fn dense_output_meets_both_ends_of_each_step<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let mut walk = walk(&pendulum, method, 1e-8, 5.0);
    let mut last = (0.0, START);
    while let Some(step) = walk.next() {
        let step = step.unwrap();
        assert_eq!((step.start_time(), step.start()), last);
        last = (step.end_time(), step.end());
        let dense = walk.dense(&step);
        assert_eq!((dense.at(step.start_time()), dense.after(1.0)), (step.start(), step.end()));
        assert_eq!(dense.time(0.0), step.start_time());
        assert!((dense.time(1.0) - step.end_time()).abs() <= f64::EPSILON * step.end_time());
    }
}
each_controlled!(dense_output_meets_both_ends_of_each_step);

// -------------------------------------------------------------------------------------------------
// States at given times
// -------------------------------------------------------------------------------------------------

/// DOP853 takes 59 steps, Dormand and Prince 296, the series 17. Each is off by at most 3e-10 in θ;
/// that adds up like √296, and grows with the phase, at most (1 + ω₀ t)-fold, 15: 8e-8. The end of
/// the step in place of the state 1 ms before it, at 6.999 s, is off by 2e-3. The polynomial of a
/// neighbouring step may be off by 1e-9 only: so one state is compared to the bit.
///
/// Catches: the state at an end of the step, or on the polynomial of another; the walk's order of
/// times forgotten where it leads back; a time at the start, at the end or twice that is left out.
fn states_at_given_times_are_those_of_the_motion<M: Controlled<Pendulum>>(method: M) {
    let [_, pendulum] = pendulums();
    let motion = Motion::new(&pendulum, START).unwrap();
    for until in [7.0, -7.0_f64] {
        let times = [0.0, 1e-9, 0.5, 0.5, 0.6, 3.3, 6.999, 7.0].map(|t| t * until.signum());
        let mut walk = walk(&pendulum, method, 1e-10, until);
        let states: Vec<Phase> = walk.states_at(times).map(Result::unwrap).collect();
        assert_eq!(states.len(), times.len());
        let mut alone = self::walk(&pendulum, method, 1e-10, until);
        let is_beyond = |end: f64| (times[5] - end) * until < 0.0;
        let step = alone.by_ref().map(Result::unwrap).find(|step| is_beyond(step.end_time()));
        assert_eq!(states[5], alone.dense(&step.unwrap()).at(times[5]));
        for (t, z) in times.into_iter().zip(states) {
            let off = z - motion.at(t);
            assert!(off.theta.abs() < 1e-7 && off.omega.abs() < 3e-7, "{t} s: {off:?}");
        }
    }
}
each_controlled!(states_at_given_times_are_those_of_the_motion);

/// Catches: a walk whose steps follow the times that are asked for; dense output where a step ends
/// on the time, or computed again for each time in a step; a walk that goes on further than asked.
fn states_at_given_times_leave_the_steps_alone<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let mut alone = walk(&pendulum, method, 1e-9, 5.0);
    let steps: Vec<_> = alone.by_ref().take(6).map(Result::unwrap).collect();
    let before = alone.counts();

    let mut at_ends = walk(&pendulum, method, 1e-9, 5.0);
    let ends: Vec<Phase> =
        at_ends.states_at(steps.iter().map(|step| step.end_time())).map(Result::unwrap).collect();
    assert!(ends.iter().eq(steps.iter().map(|step| step.end()).collect::<Vec<_>>().iter()));
    assert_eq!(at_ends.counts(), before);

    let (last, mut within) = (&steps[5], walk(&pendulum, method, 1e-9, 5.0));
    let times = [0.25, 0.75].map(|part| last.start_time() + part * last.size());
    let states: Vec<Phase> = within.states_at(times).map(Result::unwrap).collect();
    let dense = alone.dense(last);
    assert_eq!(states, times.map(|t| dense.at(t)));
    assert_eq!(within.counts(), alone.counts(), "the dense output of one step, once");
}
each_controlled!(states_at_given_times_leave_the_steps_alone);

/// Catches: a state for a time that the walk has passed, or does not reach; an error of the walk
/// that is lost, or told for ever.
fn a_time_that_is_out_of_turn_is_refused<M: Controlled<Pendulum>>(method: M) {
    for (times, until) in [
        ([1.0, 0.5], 5.0),
        ([-1.0, -0.5], -5.0),
        ([1.0, 5.1], 5.0),
        ([-1.0, -5.1], -5.0),
        ([1.0, f64::NAN], 5.0),
        ([0.0, 1e-300], 0.0),
    ] {
        let mut walk = walk(&Pendulum::PAPER, method, 1e-6, until);
        let mut states = walk.states_at(times);
        assert!(states.next().unwrap().is_ok());
        let refused = states.next();
        assert!(matches!(refused, Some(Err(Error::Parameter { .. }))), "{times:?}: {refused:?}");
        assert!(states.next().is_none());
    }
    let few = Adaptive::new(method, tolerance(1e-9)).max_attempts(3);
    let mut walk = few.steps(&Pendulum::PAPER, START, 0.0, 50.0).unwrap();
    let mut states = walk.states_at([49.0, 50.0]);
    assert!(matches!(states.next(), Some(Err(Error::OutOfSteps { limit: 3, .. }))));
    assert!(states.next().is_none());
}
each_controlled!(a_time_that_is_out_of_turn_is_refused);

// -------------------------------------------------------------------------------------------------
// Crossings
// -------------------------------------------------------------------------------------------------

/// The first fall to the bottom takes a quarter of the period, and four times that is right to what
/// the tolerance allows for a number of the size of T. That is not guaranteed, as the errors of the
/// steps add up; but a fall from rest is most sensitive where it is slowest, and there the error of
/// a step is smallest. 4 ε T is the rounding of the four quarters.
///
/// Catches: a crossing put at an end of the step, or found by linear interpolation; dense output of
/// too low an order; the start time of a step forgotten.
fn the_period_is_exact_within_the_tolerance<M: Controlled<Pendulum>>(method: M) {
    let one = |pendulum: &Pendulum, theta0: f64, tol: f64| {
        let period = exact::period(pendulum, theta0).unwrap();
        let adaptive = Adaptive::new(method, tolerance(tol));
        let mut walk = adaptive.steps(pendulum, Phase::at_rest(theta0), 0.0, period).unwrap();
        let bottom = walk.crossings(Direction::Falling, |_, z| z.theta).next().unwrap().unwrap();
        let off = (4.0 * bottom.t - period).abs();
        let allowed = tol * (1.0 + period) + 4.0 * f64::EPSILON * period;
        assert!(off <= allowed, "{off:e} s, from {theta0} with {tol:e}");
        assert!(bottom.z.theta.abs() <= 1e-15, "{:?}, from {theta0} with {tol:e}", bottom.z);
    };
    for pendulum in pendulums() {
        for theta0 in [0.5, 2.0, 3.0, 3.1] {
            [1e-6, 1e-8, 1e-10, 1e-12].iter().for_each(|tol| one(&pendulum, theta0, *tol));
        }
    }
}
each_controlled!(the_period_is_exact_within_the_tolerance);

/// Rotation over the top. The pendulum turns at 6 rad/s or more; its angle is off by less than 100
/// tolerances after 5 s, as is that of the swing in the tests above.
///
/// Catches: crossings missed, or found twice where one step ends and the next begins; a function of
/// time alone, or of the state alone.
fn each_passage_over_the_top_is_found_once<M: Controlled<Pendulum>>(method: M) {
    for pendulum in pendulums() {
        let start = Phase { theta: -0.5, omega: 9.0 };
        let motion = Motion::new(&pendulum, start).unwrap();
        for tol in [1e-5, 1e-9] {
            let adaptive = Adaptive::new(method, tolerance(tol));
            let mut walk = adaptive.steps(&pendulum, start, 0.0, 5.0).unwrap();
            let tops = walk
                .crossings(Direction::Either, |_, z| pendula::arithmetic::sine::cos(0.5 * z.theta));
            let tops: Vec<_> = tops.map(|top| top.unwrap()).collect();
            let turns = ((motion.at(5.0).theta + PI) / (2.0 * PI)).floor() as usize;
            assert_eq!(tops.len(), turns);
            for (n, top) in tops.iter().enumerate() {
                let angle = PI * (2 * n + 1) as f64;
                assert!((motion.at(top.t).theta - angle).abs() < 100.0 * tol, "{n} at {}", top.t);
                assert!((top.z.theta - angle).abs() < 1e-14 * angle, "{n} at {:?}", top.z);
            }
        }
    }
}
each_controlled!(each_passage_over_the_top_is_found_once);

/// The angle of a swing crosses zero falling, rising, and falling again; a function of time crosses
/// zero twenty times in 3 s, more often than there are steps.
///
/// Catches: a direction ignored or reversed; a zero at the start taken for a crossing; several
/// crossings in a step of which only one is found.
fn a_crossing_has_a_direction<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let start = Phase { theta: 0.0, omega: 2.0 };
    let period = Motion::new(&pendulum, start).unwrap().period().unwrap();
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    let times = |direction, until: f64| {
        let mut walk = adaptive.steps(&pendulum, start, 0.0, until).unwrap();
        let crossings = walk.crossings(direction, |_, z| z.theta);
        crossings.map(|crossing| crossing.unwrap().t / period).collect::<Vec<f64>>()
    };
    let near = |times: Vec<f64>, expected: &[f64]| {
        assert_eq!(times.len(), expected.len(), "{times:?}");
        // 100 tolerances, as above.
        assert!(times.iter().zip(expected).all(|(t, e)| (t - e).abs() < 1e-7), "{times:?}");
    };
    near(times(Direction::Rising, 2.2 * period), &[1.0, 2.0]);
    near(times(Direction::Falling, 2.2 * period), &[0.5, 1.5]);
    near(times(Direction::Either, 2.2 * period), &[0.5, 1.0, 1.5, 2.0]);
    // Backward in time, rising becomes falling.
    near(times(Direction::Rising, -2.2 * period), &[-0.5, -1.5]);
    near(times(Direction::Falling, -2.2 * period), &[-1.0, -2.0]);

    let mut walk =
        Adaptive::new(method, tolerance(1e-3)).steps(&pendulum, start, 0.0, 3.0).unwrap();
    let strikes = walk.crossings(Direction::Either, |t, _| (PI * (t - 0.075) / 0.15).sin());
    let strikes: Vec<f64> = strikes.map(|strike| strike.unwrap().t).collect();
    assert_eq!(strikes.len(), 20, "{strikes:?}");
    // The sine of the test is right to an ulp of its argument, 20 π, and the time to one of 3 s.
    let late = |(n, t): (usize, &f64)| (t - 0.15 * n as f64 - 0.075).abs();
    assert!(strikes.iter().enumerate().map(late).all(|late| late < 1e-14));
}
each_controlled!(a_crossing_has_a_direction);

// -------------------------------------------------------------------------------------------------
// Both directions of time, ends, observers
// -------------------------------------------------------------------------------------------------

/// Backward in time, and from there forward to the start. Either run is off by less than 1000
/// tolerances, as in the test of the tolerance.
///
/// Catches: the sign of the step lost in the first step, in the last or in the limit of growth; an
/// end that is overshot.
fn time_can_run_either_way<M: Controlled<Pendulum>>(method: M) {
    for pendulum in pendulums() {
        let motion = Motion::new(&pendulum, START).unwrap();
        let adaptive = Adaptive::new(method, tolerance(1e-10));
        let (before, counts) = adaptive.integrate(&pendulum, START, 2.0, -8.0, &mut ()).unwrap();
        let right = motion.at(-10.0);
        assert!((before.theta - right.theta).abs() < 1e-7, "{before:?}, not {right:?}");
        let (back, again) = adaptive.integrate(&pendulum, before, -8.0, 2.0, &mut ()).unwrap();
        assert!((back.theta - START.theta).abs() < 2e-7, "{back:?}");
        // The same interval takes as many steps either way, except for the first few.
        let (there, back) = (counts.accepted as f64, again.accepted as f64);
        assert!((there / back - 1.0).abs() < 0.1, "{there} there, {back} back");
    }
}
each_controlled!(time_can_run_either_way);

/// Catches: a last step past the end, short of it, or split in two; a step taken after the end, or
/// when the end is the start.
fn the_last_step_ends_at_the_end<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    for end in [1e-300, 1e-3, 0.7, 5.0, -5.0] {
        let mut times = vec![];
        let mut watch = |n, t, z: Phase| times.push((n, t, z));
        let (last, counts) = adaptive.integrate(&pendulum, START, 0.0, end, &mut watch).unwrap();
        assert_eq!(times[0], (0, 0.0, START));
        assert_eq!(times.last(), Some(&(counts.accepted, end, last)));
        assert!(times.iter().enumerate().all(|(n, time)| time.0 == n as u64));
        assert!(times.windows(2).all(|pair| pair[0].1 != pair[1].1));
        assert!(times.windows(2).all(|pair| (pair[1].1 - pair[0].1).signum() == end.signum()));
    }

    let mut walk = adaptive.steps(&pendulum, START, 3.0, 3.0).unwrap();
    assert!(walk.next().is_none() && walk.next().is_none());
    assert_eq!((walk.time(), walk.state()), (3.0, START));
}
each_controlled!(the_last_step_ends_at_the_end);

/// Of 1000 end times, one in a hundred would leave less than a hundredth of a step for the last.
/// The bound is 0.8 of that, as the last step would not be exactly as long as the one before.
///
/// Catches: a sliver of a step at the end.
fn no_sliver_is_left_for_the_last_step<M: Controlled<Pendulum>>(method: M) {
    for n in 0..1000 {
        let until = 1.0 + f64::from(n) / 1000.0;
        let steps = walk(&Pendulum::PAPER, method, 1e-9, until);
        let sizes: Vec<f64> = steps.map(|step| step.unwrap().size()).collect();
        let &[.., before, last] = &sizes[..] else { panic!("{sizes:?}") };
        assert!(last > 0.008 * before, "{last:e} after {before:e} to {until}");
    }
}
each_controlled!(no_sliver_is_left_for_the_last_step);

/// Catches: a force evaluated beyond the end, where it may not be defined; a refusal of the
/// shortest possible step.
fn nothing_is_asked_beyond_the_end<M: Embedded>(method: M) {
    let latest = std::cell::Cell::new(0.0_f64);
    let law = Law(|t: f64, y: f64| {
        latest.set(latest.get().max(t));
        -4.0 * y
    });
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    adaptive.integrate(&law, Number { y: 1.0 }, 0.0, 1e-3, &mut ()).unwrap();
    assert_eq!(latest.get(), 1e-3);
    let (_, counts) =
        adaptive.integrate(&law, Number { y: 1.0 }, 1e6, 1e6_f64.next_up(), &mut ()).unwrap();
    assert_eq!((counts.accepted, latest.get()), (1, 1e6_f64.next_up()));
}
each_pair!(nothing_is_asked_beyond_the_end);

/// A single step, with a zero of the function exactly at its end.
///
/// Catches: a zero missed because it is reached exactly and not crossed.
fn a_zero_on_the_last_instant_is_a_crossing<M: Embedded>(method: M) {
    let law = Law(|_, y| -4.0 * y);
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    let end = 1.0 / 1024.0;
    for (direction, sign) in [(Direction::Rising, 1.0), (Direction::Falling, -1.0)] {
        let mut walk = adaptive.steps(&law, Number { y: 1.0 }, 0.0, end).unwrap();
        let crossings = walk.crossings(direction, |t, _| sign * (t - end));
        let times: Vec<f64> = crossings.map(|crossing| crossing.unwrap().t).collect();
        assert_eq!(times, [end]);
    }
}
each_pair!(a_zero_on_the_last_instant_is_a_crossing);

/// Catches: a loop that goes on after the observer is satisfied.
fn a_satisfied_observer_ends_the_loop<M: Controlled<Pendulum>>(method: M) {
    struct UntilNinth(u64);
    impl Observer<Phase> for UntilNinth {
        fn observe(&mut self, n: u64, _t: f64, _z: Phase) {
            self.0 = n;
        }
        fn is_satisfied(&self) -> bool {
            self.0 >= 9
        }
    }
    let mut watch = UntilNinth(0);
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    let (end, counts) = adaptive.integrate(&Pendulum::PAPER, START, 0.0, 5.0, &mut watch).unwrap();
    assert_eq!((watch.0, counts.accepted), (9, 9));
    let ninth = walk(&Pendulum::PAPER, method, 1e-9, 5.0).nth(8).unwrap().unwrap();
    assert_eq!(end, ninth.end());
}
each_controlled!(a_satisfied_observer_ends_the_loop);

// -------------------------------------------------------------------------------------------------
// Refusals
// -------------------------------------------------------------------------------------------------

/// Catches: an accepted tolerance that is NaN, zero, negative, or finer than f64.
#[test]
fn a_tolerance_that_cannot_be_met_is_refused() {
    for bad in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        assert!(matches!(Tolerance::new(bad, 1e-6), Err(Error::Parameter { .. })), "{bad}");
    }
    for bad in [0.0, -1e-6, f64::NAN, f64::INFINITY, 1.0, SMALLEST_RELATIVE.next_down()] {
        assert!(matches!(Tolerance::new(1e-6, bad), Err(Error::Parameter { .. })), "{bad}");
    }
    assert_eq!(SMALLEST_RELATIVE, 10.0 * f64::EPSILON);
    assert!(Tolerance::new(5e-324, SMALLEST_RELATIVE).is_ok());
    assert_eq!(
        Tolerance::uniform(1e-16).unwrap_err().to_string(),
        "relative tolerance = 1e-16 is refused: it must be at least 2.22e-15, ten roundings of an \
         f64, and less than 1"
    );
}

/// Catches: an accepted tolerance so fine that no step meets it; an error of more than 1000
/// tolerances there.
fn the_finest_tolerance_can_be_met<M: Controlled<Pendulum>>(method: M) {
    let finest = Tolerance::uniform(SMALLEST_RELATIVE).unwrap();
    let adaptive = Adaptive::new(method, finest);
    let (end, _) = adaptive.integrate(&Pendulum::PAPER, START, 0.0, 2.0, &mut ()).unwrap();
    let right = Motion::new(&Pendulum::PAPER, START).unwrap().at(2.0);
    // As everywhere here, less than 1000 tolerances.
    assert!((end.theta - right.theta).abs() < 1000.0 * SMALLEST_RELATIVE);
}
each_controlled!(the_finest_tolerance_can_be_met);

/// Catches: an accepted time that is not finite, or an infinite duration.
fn a_time_that_is_none_is_refused<M: Controlled<Pendulum>>(method: M) {
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    for (from, until) in
        [(f64::NAN, 1.0), (0.0, f64::INFINITY), (f64::NEG_INFINITY, 0.0), (-1e308, 1e308)]
    {
        let walk = adaptive.steps(&Pendulum::PAPER, START, from, until);
        assert!(matches!(walk.err(), Some(Error::Parameter { .. })), "{from} to {until}");
    }
}
each_controlled!(a_time_that_is_none_is_refused);

state! {
    /// A number as a state.
    struct Number {
        y: f64,
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

/// ẏ = y² from 1 has the solution 1/(1 − t). Towards its pole the steps become shorter and shorter,
/// and stop where they are lost in the rounding of the time, at 10 ε. Every step is off by a
/// tolerance of 1e-9, and so the computed pole lies within a thousand tolerances of t = 1.
///
/// Catches: steps that never end, or jump over the pole; an error without the time at which it
/// occurred.
fn a_pole_is_not_crossed<M: Embedded>(method: M) {
    let pole = Law(|_, y| y * y);
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    let mut walk = adaptive.steps(&pole, Number { y: 1.0 }, 0.0, 2.0).unwrap();
    let error = walk.find_map(|step| step.err());
    let Some(Error::StepTooSmall { t, step }) = error else { panic!("{error:?}") };
    assert!((t - 1.0).abs() < 1e-6 && (t, walk.time()) == (walk.time(), t), "{t}");
    assert!(step > 0.0 && step <= 10.0 * f64::EPSILON, "{step:e}");
    assert!(walk.next().is_none(), "it has ended");
    let message = error.unwrap().to_string();
    assert!(
        message.contains("no step meets the tolerance") && !message.contains('\n'),
        "{message}"
    );
}
each_pair!(a_pole_is_not_crossed);

/// Catches: a NaN that is accepted, or retried for ever.
fn a_rate_that_is_no_number_is_an_error<M: Embedded>(method: M) {
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    for (law, from) in [(f64::NAN, 0.0), (f64::INFINITY, 0.0), (f64::NAN, 1.0)] {
        let law = Law(move |_, _| law);
        let end = adaptive.integrate(&law, Number { y: 1.0 }, from, 2.0, &mut ());
        let Err(Error::StepTooSmall { t, .. }) = end else { panic!("{end:?}") };
        assert_eq!(t, from);
    }
    // A rate that becomes NaN on the way is found there.
    let law = Law(|t, _| if t < 1.0 { 1.0 } else { f64::NAN });
    let end = adaptive.integrate(&law, Number { y: 1.0 }, 0.0, 2.0, &mut ());
    let Err(Error::StepTooSmall { t, .. }) = end else { panic!("{end:?}") };
    assert!(t < 1.0 && t > 0.999, "{t}");
}
each_pair!(a_rate_that_is_no_number_is_an_error);

/// Catches: a limit that is off by one, counts only accepted steps, or ends the run without an
/// error.
fn a_limit_is_kept<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    let (_, Counts { accepted, rejected, .. }) =
        adaptive.integrate(&pendulum, START, 0.0, 20.0, &mut ()).unwrap();
    let attempts = accepted + rejected;
    assert!(
        adaptive.max_attempts(attempts).integrate(&pendulum, START, 0.0, 20.0, &mut ()).is_ok()
    );
    let error = adaptive
        .max_attempts(attempts - 1)
        .integrate(&pendulum, START, 0.0, 20.0, &mut ())
        .unwrap_err();
    let Error::OutOfSteps { t, limit } = error else { panic!("{error:?}") };
    assert!(limit == attempts - 1 && t > 15.0 && t < 20.0, "{error}");
    assert!(error.to_string().starts_with(&format!("{limit} steps have led no further")));
}
each_controlled!(a_limit_is_kept);

/// ẏ = −100 y + 100 cos t is smooth after a short transient, and then the step is limited by
/// stability alone: |R(−100 h)| ≤ 1 up to h = 0.033 for Dormand and Prince's method of order 5,
/// 0.061 for DOP853. The controller keeps the steps near that bound. At order 5 it refuses less
/// than one step for every 50 it takes; at order 8, where a step slightly too long is off by much
/// more, one for every 4.
///
/// Catches: a controller that ignores the error of the step before, whose steps oscillate there;
/// one that lets them grow after a refusal.
#[rstest]
#[case::dormand_prince(DormandPrince, 0.033, 50)]
#[case::dop853(Dop853, 0.061, 4)]
fn at_the_limit_of_stability_few_steps_are_refused<M: Embedded>(
    #[case] method: M,
    #[case] bound: f64,
    #[case] one_in: u64,
) {
    let law = Law(|t: f64, y: f64| -100.0 * y + 100.0 * t.cos());
    let adaptive = Adaptive::new(method, tolerance(1e-4));
    let (end, counts) = adaptive.integrate(&law, Number { y: 0.0 }, 0.0, 20.0, &mut ()).unwrap();
    // y = (cos t + 0.01 sin t)/1.0001 once the transient has decayed.
    let right = (20_f64.cos() + 0.01 * 20_f64.sin()) / 1.0001;
    assert!((end.y - right).abs() < 1e-3, "{}", end.y);
    assert!(counts.rejected * one_in < counts.accepted, "{counts:?}");
    let mean = 20.0 / counts.accepted as f64;
    assert!(mean < bound && mean > 0.8 * bound, "{mean}");
}
