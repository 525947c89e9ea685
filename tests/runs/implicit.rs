//! Implicit methods: where their iteration ends, in any units, and what is said where it does not.

use std::f64::consts::{PI, TAU};
use std::num::NonZeroU32;

use pendula::internals::ScaledPendulum;
use pendula::methods::{
    CieslinskiRatkiewicz, DiscreteGradient, Gauss4, Gauss6, Gauss16, Implicit, ImplicitMidpoint,
    ImplicitTableau, Iteration, Rk4, Trapezoidal,
};
use pendula::registry::InSteps;
use pendula::systems::{DoublePendulum, DoublePhase, Joint, LinearOscillator};
use pendula::{
    AnyMethod, Counting, Ensemble, Error, Grid, Hamiltonian, Info, METHODS, Method, Pendulum,
    Phase, Unsolved, integrate, integrate_fast, integrate_with, method_named,
};
use rstest::rstest;

use crate::common::{Random, bits, in_seconds};

/// Makes of the function `$test` a test for each implicit method with a tableau, and its limit.
macro_rules! each_implicit {
    ($test:ident) => {
        cases! {
            $test:
            implicit_midpoint(ImplicitMidpoint, limit(&ImplicitMidpoint::TABLEAU)),
            trapezoidal(Trapezoidal, limit(&Trapezoidal::TABLEAU)),
            gauss_4(Gauss4, limit(&Gauss4::TABLEAU)),
            gauss_6(Gauss6, limit(&Gauss6::TABLEAU)),
            gauss_16(Gauss16, limit(&Gauss16::TABLEAU)),
        }
    };
}

/// The largest x = ω₀h at which 100 sweeps leave no more than a rounding of the distance to the
/// solution, whatever the state: by the sweeps themselves, with θ' = xω and |ω'| ≤ x|θ|, as the
/// slope of the pendulum's force is nowhere larger, from slopes that are off by one. Where the
/// signs of the coefficients help, longer steps are solved too.
fn limit<const S: usize>(tableau: &ImplicitTableau<S>) -> f64 {
    let left = |x: f64| {
        let mut k = [[1.0_f64; 2]; S];
        for _ in 0..100 {
            for i in 0..S {
                let [theta, omega] = [0, 1].map(|c| {
                    (0..S)
                        .map(|j| (tableau.b[j] * tableau.parts[i][j]).abs() * k[j][c])
                        .sum::<f64>()
                });
                k[i] = [x * omega, x * theta];
            }
        }
        k.iter().flatten().sum::<f64>()
    };
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if left(middle) <= f64::EPSILON { low = middle } else { high = middle }
    }
    low
}

/// A pendulum with g/L from 1e-12 to 1e12 (1/s²), a start, and a grid whose x = ω₀h is between 1e-6
/// and 0.9 of `limit`. A quarter of the starts each are within a turn, some hundred turns, 1e7 rad,
/// and any number of decades; a third are at rest, a third swing or rotate slowly, and a third
/// rotate up to a hundred times as fast.
fn scene(random: &mut Random, limit: f64) -> (Pendulum, Phase, Grid) {
    let [gravity, length] = [random.between(-6.0, 6.0), random.between(-6.0, 6.0)];
    let pendulum = Pendulum::new(10_f64.powf(gravity), 10_f64.powf(length), 1.0).unwrap();
    let turned = random.between(-1.0, 1.0);
    let theta = match random.below(4) {
        0 => 3.15 * turned,
        1 => 500.0 * turned,
        2 => 1e7 * turned,
        _ => turned * 10_f64.powf(random.between(-15.0, 15.0)),
    };
    let q = [0.0, 4.0, 100.0][random.below(3)] * random.between(-1.0, 1.0);
    let frequency = pendulum.small_angle_frequency();
    let x = 10_f64.powf(random.between(-6.0, (0.9 * limit).log10()));
    (pendulum, Phase { theta, omega: q * frequency }, Grid::new(x / frequency, 50).unwrap())
}

/// Whatever the units, wherever a sweep contracts: in a single trajectory in seconds, in one in
/// steps, and in lanes.
///
/// Catches: an iteration that stops only where its changes are small in the units of the state, and
/// loses every tenth run of a fast pendulum.
fn every_step_within_the_limit_is_solved(method: impl Info, limit: f64) {
    assert!((1.0..3.0).contains(&limit), "{limit}");
    let method = method_named(method.info().name).unwrap();
    let mut random = Random::new(17);
    for n in 0..400 {
        let (pendulum, start, grid) = scene(&mut random, limit);
        let case = || format!("scene {n}: {pendulum:?} {start:?} {grid:?}");
        let end = in_seconds(method).try_run(&pendulum, start, &grid, &mut ());
        let finite = end.is_ok_and(|end| end.theta.is_finite() && end.omega.is_finite());
        assert!(finite, "{end:?}, {}", case());
        let fast = method.end(&pendulum, start, &grid);
        assert!(fast.theta.is_finite() && fast.omega.is_finite(), "fast, {}", case());
        let mut ends = [Phase::default()];
        Ensemble::new(&pendulum, &[start], grid).ends(method, &mut ends);
        assert_eq!(bits(ends[0]), bits(fast), "in lanes, {}", case());
        assert_eq!(method.try_run(&pendulum, start, &grid, &mut ()), Ok(fast));
    }
}
each_implicit!(every_step_within_the_limit_is_solved);

/// The double pendulum is not separable, and its momenta have other units than its angles. With
/// g/L from 1e-12 to 1e12, steps of x = √(g/L) h up to 0.05, and angles of many turns.
///
/// Catches: a test of the pendulum's alone, or one that asks each component to be right to its own
/// last digit.
fn so_is_every_step_of_a_double_pendulum(method: impl Info, limit: f64) {
    assert!(limit > 0.05);
    let method = method_named::<DoublePendulum>(method.info().name).unwrap();
    let mut random = Random::new(18);
    for n in 0..200 {
        let [gravity, length, mass] =
            [6.0, 6.0, 3.0].map(|most| 10_f64.powf(random.between(-most, most)));
        let joint = Joint { length, mass };
        let double = DoublePendulum::of_equals(gravity, joint).unwrap();
        let turns = [1.0, 100.0, 1e6][random.below(3)];
        let theta = [0, 1].map(|_| turns * random.between(-3.0, 3.0));
        let start = double.start(theta, [0.0; 2]).unwrap();
        let x = 10_f64.powf(random.between(-5.0, 0.05_f64.log10()));
        let grid = Grid::new(x / (gravity / length).sqrt(), 50).unwrap();
        let end = method.try_run(&double, start, &grid, &mut ());
        assert!(
            end.is_ok_and(|end| end.p1.is_finite()),
            "{n}: {double:?} {start:?} {grid:?} {end:?}"
        );
    }
}
each_implicit!(so_is_every_step_of_a_double_pendulum);

/// In steps from far within the limit to far beyond it, a step that is said to be solved is solved:
/// on the linear oscillator these methods turn the state and keep its energy, in any step; and the
/// double pendulum has kept its numbers.
///
/// Catches: an iteration that comes to rest at infinity, where any change is small beside ∞.
fn what_is_solved_is_a_solution<M>(method: M, limit: f64)
where
    M: Method<LinearOscillator> + Method<DoublePendulum> + Info,
{
    let mut random = Random::new(41);
    let oscillator = LinearOscillator::new(Pendulum::PAPER);
    let double = DoublePendulum::of_equals(9.81, Joint { length: 1.0, mass: 1.0 }).unwrap();
    let (mut solved, mut refused) = (0, 0);
    for n in 0..1000 {
        let x = 10_f64.powf(random.between(-1.0, 7.0));
        let h = x / Pendulum::PAPER.small_angle_frequency();
        let (swing, grid) = (10_f64.powf(random.between(0.0, 300.0)), Grid::new(h, 1).unwrap());
        let start = Phase::at_rest(swing);
        match pendula::try_integrate(&oscillator, &method, start, &grid) {
            Ok(Phase { theta, omega }) => {
                let end = Phase { theta: theta / swing, omega: omega / swing };
                let energy = oscillator.energy(end) / oscillator.energy(Phase::at_rest(1.0));
                // What is left of 100 sweeps, 1e-14 of the slopes, is a part of x times that.
                assert!((energy - 1.0).abs() < 1e-12 * (1.0 + x), "{n}: x = {x}: {end:?}");
                solved += 1;
            }
            Err(_) => refused += 1,
        }
        let theta = [0, 1].map(|_| random.between(-3.0, 3.0));
        let start = double.start(theta, [0, 1].map(|_| random.between(-10.0, 10.0))).unwrap();
        let grid = Grid::new(10_f64.powf(random.between(-3.0, 3.0)), 1).unwrap();
        if let Ok(end) = pendula::try_integrate(&double, &method, start, &grid) {
            assert!(end.p1.abs() < 1e6 && end.p2.abs() < 1e6, "{n}: {grid:?}: {end:?}");
        }
    }
    assert!(solved > 0 && refused > 500, "{solved} solved, {refused} refused within {limit}");
    // A start from which the midpoint rule's slopes once rested at 1e308.
    let [theta1, theta2] = [-1.8632240930882658, -1.2775290795807699];
    let [p1, p2] = [5.064716782934567, 1.2072459724857802];
    let start = DoublePhase { theta1, theta2, p1, p2 };
    let grid = Grid::new(1.051486937166502, 1).unwrap();
    if let Ok(end) = pendula::try_integrate(&double, &method, start, &grid) {
        assert!(end.p1.abs() < 1e6, "{end:?}");
    }
}
each_implicit!(what_is_solved_is_a_solution);

/// Steps a little longer than the limit: some runs fail at the first step, some on their way.
///
/// Catches: a step counted twice or not at all; a NaN shown to the observer; a failure of a run
/// that is computed in steps, reported in steps; a run that fails where the one that does not ask
/// goes on.
fn a_step_that_is_not_solved_says_so<M>(method: M, limit: f64)
where
    M: Implicit + Method<Pendulum>,
{
    let listed = method_named(method.info().name).unwrap();
    let pendulum = Pendulum::new(9.81, 1.7, 0.6).unwrap();
    let mut on_the_way = 0;
    for (i, fast) in (0..60).flat_map(|i| [(i, false), (i, true)]) {
        let x = limit * [1.05, 1.2, 1.6][i % 3];
        let start = Phase { theta: 0.05 * i as f64, omega: 0.0 };
        let grid = Grid::new(x / pendulum.small_angle_frequency(), 100).unwrap();
        let mut seen = vec![];
        let mut watch = |n: u64, t: f64, z: Phase| seen.push((n, t, z));
        let tried = if fast {
            listed.try_run(&pendulum, start, &grid, &mut watch)
        } else {
            pendula::try_integrate_with(&pendulum, &method, start, &grid, &mut watch)
        };
        // The run that does not ask, and where it is first NaN.
        let mut lost = None;
        let mut watch = |n: u64, _: f64, z: Phase| {
            if z.theta.is_nan() && z.omega.is_nan() && lost.is_none() {
                lost = Some(n);
            }
        };
        let end = if fast {
            listed.run(&pendulum, start, &grid, &mut watch)
        } else {
            integrate_with(&pendulum, &method, start, &grid, &mut watch)
        };
        let steps = match tried {
            Ok(tried) => {
                assert_eq!((bits(tried), lost), (bits(end), None));
                100
            }
            Err(Error::NotSolved { n, step, sweeps, change, .. }) => {
                assert_eq!((lost, step, sweeps), (Some(n + 1), grid.step(), 100));
                // Its last change was neither rounding nor an overflow.
                assert!(change > 1e-14 && change < 10.0, "{change:e}");
                let text = tried.unwrap_err().to_string();
                let begins = format!(
                    "the equations of a step of {step:?} s were not solved after {n} steps"
                );
                assert!(text.starts_with(&begins), "{text}");
                on_the_way += u32::from(n > 0);
                n
            }
            Err(other) => panic!("{other}"),
        };
        assert_eq!(seen.len() as u64, steps + 1);
        for (n, (count, t, z)) in (0..).zip(&seen) {
            assert!(*count == n && *t == grid.time(n) && z.theta.is_finite(), "{n}: {z:?}");
        }
    }
    assert!(on_the_way > 0);
}
each_implicit!(a_step_that_is_not_solved_says_so);

/// Catches: an explicit method that is said to have no solution.
#[test]
fn an_explicit_method_has_nothing_to_solve() {
    let (start, grid) = (Phase { theta: 1.0, omega: f64::NAN }, Grid::new(1e3, 10).unwrap());
    for method in METHODS.iter().filter(|method| !method.info().implicit) {
        let end = method.try_run(&Pendulum::PAPER, start, &grid, &mut ());
        assert!(end.is_ok_and(|end| end.omega.is_nan()), "{method:?}: {end:?}");
    }
    let mut asked = 0;
    let mut watch = |_, _, _: Phase| asked += 1;
    let start = Phase::at_rest(1.0);
    let end = pendula::try_integrate_with(&Pendulum::PAPER, &Rk4, start, &grid, &mut watch);
    assert_eq!(end, Ok(integrate(&Pendulum::PAPER, &Rk4, start, &grid)));
    assert_eq!(asked, 11);
}

// -------------------------------------------------------------------------------------------------
// Tolerance and sweeps of the caller's
// -------------------------------------------------------------------------------------------------

/// Catches: defaults that are not those of the method alone.
fn the_default_iteration_has_the_methods_bits<M>(method: M, limit: f64)
where
    M: Implicit + Copy + Method<Pendulum> + Method<ScaledPendulum>,
{
    let listed = method_named(method.info().name).unwrap();
    let with = method.with(Iteration::default());
    assert_eq!(with.info(), method.info());
    let mut random = Random::new(19);
    for _ in 0..50 {
        let (pendulum, start, grid) = scene(&mut random, limit);
        let end = in_seconds(listed).try_run(&pendulum, start, &grid, &mut ()).unwrap();
        assert_eq!(bits(integrate(&pendulum, &with, start, &grid)), bits(end));
        let end = listed.end(&pendulum, start, &grid);
        assert_eq!(bits(integrate_fast(&pendulum, &with, start, &grid)), bits(end));
    }
}
each_implicit!(the_default_iteration_has_the_methods_bits);

/// A step of x = 0.2: each sweep leaves at most a fifth of what is missing, so that a tolerance τ
/// leaves less than τ of the slopes and of the state over the step, and 1e-12 takes more sweeps
/// than 1e-3.
///
/// Catches: a tolerance that is not used, or in other units; an iteration that goes on to a tenth
/// of it, or far beyond rounding; sweeps that are not counted.
fn a_tolerance_is_kept_and_saves_sweeps<M>(method: M, limit: f64)
where
    M: Implicit + Copy + Method<Pendulum> + Method<Counting<Pendulum>>,
{
    assert!(limit > 0.2);
    let pendulum = Pendulum::new(9.81, 1.7, 0.6).unwrap();
    let (h, start) = (0.2 / pendulum.small_angle_frequency(), Phase { theta: 1.0, omega: 0.7 });
    let step = Grid::new(h, 1).unwrap();
    let exact = integrate(&pendulum, &method, start, &step);
    let counting = Counting::new(pendulum);
    let mut before = 0;
    let mut evaluations = vec![];
    for tolerance in [0.1, 1e-3, 1e-6, 1e-9, 1e-12, 0.0] {
        let with = method.with(Iteration::TO_ROUNDING.tolerance(tolerance).unwrap());
        let end = integrate(&counting, &with, start, &step);
        evaluations.push(counting.evaluations() - before);
        before = counting.evaluations();
        let off = (end.theta - exact.theta).abs() + (end.omega - exact.omega).abs();
        // The slopes here are below 1 rad/s and 9 rad/s², and the state is 1.7.
        let stages = method.info().force_evaluations as f64;
        let allowed = tolerance * (1.7 + 10.0 * h * stages);
        assert!(off <= allowed, "{tolerance:e}: {off:e}");
    }
    // What each sweep changes, down to 1e-14: the first within the tolerance is the last.
    let after = |n| {
        let with = method.with(Iteration::TO_ROUNDING.sweeps(NonZeroU32::new(n)?));
        with.try_step(&pendulum, 0.0, h, start, &mut ()).err().map(|unsolved| unsolved.change)
    };
    let changes: Vec<f64> = (1..).map_while(after).collect();
    let needed = |tolerance: f64| 1 + changes.iter().filter(|change| **change > tolerance).count();
    let expected = [0.1, 1e-3, 1e-6, 1e-9, 1e-12].map(|tolerance| needed(tolerance) as u64);
    // One to begin, then one a stage in each sweep.
    let stages = method.info().force_evaluations;
    assert!(evaluations.iter().all(|count| (count - 1) % stages == 0), "{evaluations:?}");
    let sweeps: Vec<u64> = evaluations.iter().map(|count| (count - 1) / stages).collect();
    assert_eq!(sweeps[..5], expected, "{changes:?}");
    // Two sweeps leave x²/4 of a change or less; after 1e-14, two lead to rounding, and up to two
    // more show no improvement.
    assert!(changes.windows(3).all(|c| c[2] < 0.01 * c[0]), "{changes:?}");
    let further = sweeps[5] - needed(1e-14) as u64;
    assert!((2..=4).contains(&further), "{sweeps:?} {changes:?}");

    // Two sweeps are not enough for all digits, and are said to be two.
    let two = method.with(Iteration::TO_ROUNDING.sweeps(NonZeroU32::new(2).unwrap()));
    let failed = two.try_step(&pendulum, 0.0, h, start, &mut ());
    let Err(Unsolved { sweeps: 2, change }) = failed else { panic!("{failed:?}") };
    assert!((1e-6..0.1).contains(&change), "{change:e}");
    assert!(two.step(&pendulum, 0.0, h, start, &mut ()).theta.is_nan());
    let coarse = method
        .with(Iteration::default().tolerance(0.1).unwrap().sweeps(NonZeroU32::new(2).unwrap()));
    assert!(coarse.try_step(&pendulum, 0.0, h, start, &mut ()).is_ok());
}
each_implicit!(a_tolerance_is_kept_and_saves_sweeps);

/// Catches: a tolerance that is NaN, negative, or met by any slopes.
#[test]
fn a_tolerance_is_at_least_zero_and_below_one() {
    for tolerance in [-1e-3, 1.0, f64::INFINITY, f64::NAN] {
        let refused = Iteration::default().tolerance(tolerance);
        assert!(matches!(refused, Err(Error::Parameter { .. })), "{refused:?}");
    }
    assert_eq!(Iteration::default().tolerance(0.0), Ok(Iteration::TO_ROUNDING));
}

/// The discrete gradient takes no iteration of the caller's, and is solved as well: in whatever
/// units in steps of x up to 0.9, and in longer ones it says where it is not. Its mean force is
/// nowhere steeper than the force by more than a half, so that two sweeps leave 0.9²/4 · 3/2 at
/// most, and where steps are longer tan²(0.45) · 3/2.
///
/// Catches: a ratio of sine and angle that is not a number at rest; a failure that is not said, or
/// a state that is not NaN.
#[rstest]
#[case::itself(DiscreteGradient)]
#[case::in_longer_steps(CieslinskiRatkiewicz)]
fn the_discrete_gradient_is_solved_or_says_so<M>(#[case] method: M)
where
    M: Method<Pendulum> + Method<ScaledPendulum>,
{
    let mut random = Random::new(23);
    for n in 0..400 {
        let (pendulum, start, grid) = scene(&mut random, 1.0);
        let end = integrate(&pendulum, &method, start, &grid);
        let fast = integrate_fast(&pendulum, &method, start, &grid);
        let case = || format!("scene {n}: {pendulum:?} {start:?} {grid:?}");
        for end in [end, fast] {
            assert!(end.theta.is_finite() && end.omega.is_finite(), "{}", case());
        }
        let tried = pendula::try_integrate(&pendulum, &method, start, &grid);
        assert_eq!(tried, Ok(end), "{}", case());
    }
    let long = Grid::new(4.0 / Pendulum::PAPER.small_angle_frequency(), 10).unwrap();
    let start = Phase::at_rest(1.0);
    let tried = pendula::try_integrate(&Pendulum::PAPER, &method, start, &long);
    assert!(matches!(tried, Err(Error::NotSolved { n: 0, sweeps: 100, .. })), "{tried:?}");
    let end = integrate(&Pendulum::PAPER, &method, start, &long);
    assert!(end.theta.is_nan() && end.omega.is_nan(), "{end:?}");
}

/// The tangent that lengthens the steps has its pole at x = π; beyond, it is negative, and from 2π
/// on small once more, so that a step of its length would be solved, and be another one. Small
/// swings end at x = 1.25, where a hundred sweeps leave tan¹⁰⁰(x/2) = 1e-14.
///
/// Catches: a step that goes back, or is too short, where the run should end; lanes that do not see
/// it; a long step in the other direction.
#[test]
fn steps_of_half_a_turn_are_refused() {
    let (pendulum, method) = (Pendulum::new(9.0, 1.0, 1.0).unwrap(), &CieslinskiRatkiewicz);
    let start = Phase::at_rest(0.1);
    let is_nan = |z: Phase| z.theta.is_nan() && z.omega.is_nan();
    let grid = |x: f64| Grid::new(x / 3.0, 10).unwrap();
    for x in [1.3, 2.0, 2.9, 3.0, 3.1, PI, 3.2, 4.0, 6.0, TAU, 6.3, 6.5, 9.0, 12.6, 1e9] {
        let tried = pendula::try_integrate(&pendulum, method, start, &grid(x));
        assert!(matches!(tried, Err(Error::NotSolved { n: 0, .. })), "{x}: {tried:?}");
        let tried = InSteps(*method).try_run(&pendulum, start, &grid(x), &mut ());
        assert!(matches!(tried, Err(Error::NotSolved { n: 0, .. })), "{x}: {tried:?}");
        assert!(is_nan(integrate(&pendulum, method, start, &grid(x))), "{x}");
        assert!(is_nan(integrate_fast(&pendulum, method, start, &grid(x))), "{x}");
        let mut pace = method.start(&pendulum, 0.0, -x / 3.0, start);
        assert!(is_nan(method.step(&pendulum, 0.0, -x / 3.0, start, &mut pace)), "{x}");
        // A slower pendulum in the next lane does not mind.
        let pendulums = [pendulum, Pendulum::new(9e-20, 1.0, 1.0).unwrap()];
        let mut ends = [Phase::default(); 2];
        let starts = [start; 2];
        let ensemble = Ensemble::with_systems(&pendulums, &starts, grid(x));
        ensemble.ends(method, &mut ends);
        assert!(is_nan(ends[0]) && ends[1].theta.is_finite(), "{x}: {ends:?}");
    }
    for x in [1e-9, 0.5, 1.2] {
        assert!(!is_nan(integrate_fast(&pendulum, method, start, &grid(x))), "{x}");
    }
}
