//! Inputs at the limits of f64 and beyond: an error or a right answer, never an endless loop, and
//! no NaN out of finite numbers.

use std::f64::consts::{PI, TAU};
use std::num::{NonZeroU32, NonZeroU64};

use pendula::adaptive::{Adaptive, Tolerance};
use pendula::error::MAX_STEPS;
use pendula::methods::{Dop853, Gauss6, Implicit, Iteration, Rk4};
use pendula::metrics::EnergyDrift;
use pendula::registry::InSteps;
use pendula::{
    AnyMethod, Error, Grid, Hamiltonian, LinearOscillator, METHODS, Motion, Pendulum, Phase,
    integrate_fast, method_named,
};
use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed};
use rstest::rstest;

use crate::common::in_seconds;

// -------------------------------------------------------------------------------------------------
// Constructors
// -------------------------------------------------------------------------------------------------

/// Catches: an accepted parameter that is NaN, infinite, zero or negative.
#[rstest]
fn a_parameter_out_of_range_is_refused(
    #[values(0.0, -0.0, -9.81, f64::NAN, f64::INFINITY, f64::NEG_INFINITY)] bad: f64,
) {
    for pendulum in
        [Pendulum::new(bad, 1.0, 1.0), Pendulum::new(9.81, bad, 1.0), Pendulum::new(9.81, 1.0, bad)]
    {
        assert!(matches!(pendulum, Err(Error::Parameter { .. })), "{pendulum:?}");
    }
}

/// Catches: accepted parameters that are in range one by one, while g/L, m g L or m L² is infinite,
/// zero or subnormal.
#[rstest]
#[case(1e200, 1e-200, 1.0)]
#[case(1e-200, 1e200, 1.0)]
#[case(1e200, 1.0, 1e200)]
#[case(1.0, 1e200, 1.0)]
#[case(1e-200, 1e-200, 1e-200)]
// Of the three only m g L = 1.5e-308 is subnormal, and twice that is not.
#[case(1e-4, 1.0, 1.5e-304)]
fn parameters_out_of_range_together_are_refused(
    #[case] gravity: f64,
    #[case] length: f64,
    #[case] mass: f64,
) {
    let pendulum = Pendulum::new(gravity, length, mass);
    assert!(matches!(pendulum, Err(Error::Parameter { .. })), "{pendulum:?}");
}

/// Catches: a message that does not say what was asked for and what is allowed, or does not fit one
/// line.
#[test]
fn a_refusal_says_what_is_allowed() {
    let message = Pendulum::new(-9.81, 1.0, 1.0).unwrap_err().to_string();
    assert_eq!(
        message,
        "gravity g (m/s²) cannot be -9.81. It must be finite and greater than zero"
    );
    let error = pendula::Grid::with_duration(0.3, 1.0).unwrap_err();
    assert_eq!(format!("{error:?}"), "PartialStep { duration: 1.0, step: 0.3 }");
    assert_eq!(
        error.to_string(),
        "a duration of 1.0 s is 3.3333333333333335 steps of 0.3 s. It must be a whole number of \
         steps. The nearest steps that fit are 0.3333333333333333 s and 0.25 s"
    );
}

/// Catches: the constant and the constructor giving different pendulums.
#[test]
fn the_papers_pendulum_is_one_that_can_be_built() {
    assert_eq!(Pendulum::new(9.81, 1.0, 1.0), Ok(Pendulum::PAPER));
}

/// Where m alone is subnormal, or m g or m L on the way to a normal m g L or m L², a plain product
/// loses digits that the result has room for: the kinetic energy of the first pendulum would be
/// zero, and the depth of the second right to four digits.
///
/// Catches: ½ m L² ω² and m g L multiplied in an order that leaves the range of normal numbers.
#[test]
fn no_digit_is_lost_on_the_way_to_an_energy() {
    let z = Phase { theta: 0.0, omega: 1.0 };
    let light = Pendulum::new(1e300, 1e10, 5e-324).unwrap();
    // Half of 5e-324 × 1e20, with the digits that 5e-324 has: 4.94e-324.
    assert!((light.energy(z) / 2.470_328_229_206_233e-304 - 1.0).abs() < 1e-15);
    let soft = Pendulum::new(1e-20, 1e40, 1e-300).unwrap();
    assert!((soft.depth() / 1e-280 - 1.0).abs() < 1e-15, "{:e}", soft.depth());
    // Conversely, m g overflows on the way, and the pendulum is accepted, as every product that is
    // checked is in range.
    let refused = Pendulum::new(1e20, 1e-30, 1e300);
    assert!(refused.is_ok(), "m g L = 1e290, m L² = 1e240, g/L = 1e50: {refused:?}");
}

/// The energy at the top is 2 m g L, and must be in range too: up to m g L = 8.9e307 J.
///
/// Catches: a pendulum accepted whose energy is infinite upside down, and NaN at the bottom; a
/// start whose kinetic and potential energy are each in range and their sum is not.
#[test]
fn the_energy_at_the_top_is_finite() {
    for gravity in [9.1e307, 1e308, 1.7e308] {
        let refused = Pendulum::new(gravity, 1.0, 1.0);
        assert!(matches!(refused, Err(Error::Parameter { .. })), "{gravity:e}: {refused:?}");
    }
    let heavy = Pendulum::new(8.9e307, 1.0, 1.0).unwrap();
    for theta in [0.0, 1.0, PI, -PI, 3.0 * PI] {
        let z = heavy.start(theta, 0.0).unwrap();
        assert!((0.0..=f64::MAX).contains(&heavy.energy(z)), "{theta}: {}", heavy.energy(z));
    }
    // ½ m L² ω² = 7.2e307 J.
    assert!(heavy.start(0.0, 1.2e154).is_ok() && heavy.start(PI, 1.2e154).is_err());
}

/// ω = 1e302 rad/s is within 3e150 ω₀ of a stiff pendulum, and a product of double-doubles splits
/// its factors, which overflows.
///
/// Catches: a motion accepted that is NaN at its own start.
#[test]
fn the_fastest_motion_is_at_its_start() {
    let stiff = Pendulum::new(1e150, 1e-157, 1e100).unwrap();
    for omega in [1e296, 1e302, -1e303] {
        let refused = Motion::new(&stiff, Phase { theta: 1.0, omega });
        assert!(matches!(refused, Err(Error::Parameter { .. })), "{omega:e}");
    }
    for omega in [1e295, -1e295, 1e290] {
        let motion = Motion::new(&stiff, Phase { theta: 1.0, omega }).unwrap();
        let z = motion.at(0.0);
        assert!((z.theta - 1.0).abs() < 4e-15 && (z.omega / omega - 1.0).abs() < 4e-15, "{z:?}");
    }
}

// -------------------------------------------------------------------------------------------------
// Runs
// -------------------------------------------------------------------------------------------------

/// From a subnormal angle the pendulum is linear and the energy underflows to zero; nothing else
/// happens.
///
/// Catches: a division by the angle or by the energy, a NaN from 0/0.
fn subnormal_starts_swing(method: &dyn AnyMethod) {
    for theta in [5e-324, -5e-324, 1e-310, f64::MIN_POSITIVE] {
        let mut drift = EnergyDrift::new(&Pendulum::PAPER);
        let grid = Grid::new(0.01, 1000).unwrap();
        let end = method.run(&Pendulum::PAPER, Phase::at_rest(theta), &grid, &mut drift);
        // A kick smaller than half a quantum of 5e-324 is lost; otherwise forward Euler grows by
        // e^(x²n/2) = 1.7 at most.
        assert!(end.theta.abs() < 10.0 * theta.abs() && end.omega.is_finite(), "{end:?}");
        assert_eq!(drift.largest(), 0.0);
    }
}
each_method!(subnormal_starts_swing);

/// Zeros of both signs are the same state of rest, and stay zero.
///
/// Catches: a sign taken by division, a −0 that becomes a turn.
fn negative_zero_is_rest(method: &dyn AnyMethod) {
    for (theta, omega) in [(0.0, -0.0), (-0.0, 0.0), (-0.0, -0.0)] {
        let grid = Grid::new(0.1, 100).unwrap();
        let end = method.run(&Pendulum::PAPER, Phase { theta, omega }, &grid, &mut ());
        assert_eq!(end, Phase::default());
    }
}
each_method!(negative_zero_is_rest);

/// A NaN or an infinity can bypass the constructors, as the fields of a state are public. It is
/// never replaced by a finite number: the energy error is NaN, and the run ends.
///
/// Catches: a `max` that drops NaN, a loop that never ends because a comparison with NaN is false.
fn nan_and_infinity_are_not_healed(method: &dyn AnyMethod) {
    let pendulum = Pendulum::PAPER;
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for start in [Phase { theta: bad, omega: 0.0 }, Phase { theta: 1.0, omega: bad }] {
            let mut drift = EnergyDrift::new(&pendulum);
            let grid = Grid::new(0.01, 100).unwrap();
            let end = method.run(&pendulum, start, &grid, &mut drift);
            assert!(!(end.theta.is_finite() && end.omega.is_finite()), "{start:?} → {end:?}");
            assert!(drift.largest().is_nan(), "{start:?}: {}", drift.largest());
            assert!(Motion::new(&pendulum, start).is_err());
        }
    }
}
each_method!(nan_and_infinity_are_not_healed);

/// A bound on the sum of the sizes of the kicks of one step, of its drifts, or of a row of its
/// tableau, in steps: 1, except for compositions, for Deuflhard's method, where the linear force is
/// the larger one, for Cieśliński's and Ratkiewicz's, whose steps are longer, and for the methods
/// of Dormand and Prince, where the ninth row of DOP853 has 96. It bounds the change in a step of
/// any length. The change in a step of a Taylor series has no such bound, and grows with the 24th
/// power of the step.
fn reach(method: &dyn AnyMethod) -> f64 {
    let entry = method.info();
    match (entry.order, entry.name) {
        (_, "taylor-24") => f64::INFINITY,
        (_, "deuflhard" | "cieslinski-ratkiewicz") => 100.0,
        (0..=2, _) | (_, "rk4") => 1.0,
        _ => 100.0,
    }
}

/// Whether the state after steps of `h` (s) is bounded: not for a Taylor series; and for a
/// processed method where x ≤ 1 and a step turns by a turn at most. In longer steps the gradient in
/// a kick grows with h³, and the change of variables has no inverse.
pub fn is_bounded(method: &dyn AnyMethod, pendulum: &Pendulum, start: Phase, h: f64) -> bool {
    let short = pendulum.frequency_squared() * h * h <= 1.0 && start.omega.abs() * h <= TAU;
    reach(method).is_finite() && (short || !method.info().name.starts_with("processed"))
}

/// Whether `end` is as the library promises for steps that are too long: NaN or bounded for an
/// implicit method, anything where it [is not bounded](is_bounded), and bounded for every other
/// method.
///
/// `end` has been reached from `start` along `grid`.
pub fn is_as_promised(
    method: &dyn AnyMethod,
    pendulum: &Pendulum,
    start: Phase,
    end: Phase,
    grid: &Grid,
) -> bool {
    let duration = grid.time(grid.steps());
    let is_nan = end.theta.is_nan() && end.omega.is_nan();
    if (method.info().implicit && is_nan) || !is_bounded(method, pendulum, start, grid.step()) {
        return true;
    }
    // n roundings of each.
    let (slack, covered) = (1.0 + 1e-12, reach(method) * duration);
    // Kicks are at most h g/L, and drifts follow from them; at 1e15 rad the angle moves in units of
    // its own rounding.
    // Among subnormal numbers each rounding is as large as the kick.
    let omega =
        (start.omega.abs() + covered * pendulum.frequency_squared()) * slack + f64::MIN_POSITIVE;
    let rounding = 1e-9 + 10.0 * f64::EPSILON * start.theta.abs();
    end.omega.abs() <= omega
        && (end.theta - start.theta).abs() <= covered * omega * slack + rounding
}

/// The largest angle, and steps of subnormal, huge and absurd size.
///
/// Catches: a sine that fails at large arguments; h/2 or h/6 that underflows into something other
/// than no step; an iteration that does not end, or that returns its last iterate as a solution
/// without having converged.
fn absurd_steps_end(method: &dyn AnyMethod) {
    let pendulum = Pendulum::PAPER;
    for (theta, h) in [(1e15, 0.01), (1.0, 5e-324), (1.0, 1e-300), (1.0, 1e10), (1.0, 1e70)] {
        let start = pendulum.start(theta, 1.0).unwrap();
        let grid = Grid::new(h, 10).unwrap();
        let end = method.run(&pendulum, start, &grid, &mut ());
        assert!(is_as_promised(method, &pendulum, start, end, &grid), "{end:?}");
        if h < 1e-200 {
            assert_eq!(end.theta, theta);
        }
        if h > 1.0 && method.info().implicit {
            assert!(end.theta.is_nan() && end.omega.is_nan(), "{end:?}");
        }
    }
}
each_method!(absurd_steps_end);

/// The exact motion of the linear oscillator is finite from every finite state.
///
/// Catches: a product that overflows on the way, an angle lost at t = 0.
#[test]
fn the_linear_oscillator_is_exact_at_the_edges() {
    let linear = LinearOscillator::new(Pendulum::PAPER);
    for x in [5e-324, f64::MIN_POSITIVE, 1e-8, 1.0, 1e300] {
        let start = Phase { theta: x, omega: -x };
        assert_eq!(linear.exact(start, 0.0), start);
        let z = linear.exact(start, 1e6);
        assert!(z.theta.is_finite() && z.omega.is_finite());
    }
}

/// A processor has powers of the step up to the fourth, which overflows for 1e144 s and underflows
/// for 1e-146 s. In other units of time, powers of two, the run in seconds is the same to the bit.
/// The fast run differs by rounding: it measures time in steps, where their unit is within range.
///
/// Catches: a power of a step that overflows or vanishes on its way into a state.
#[rstest]
#[case::processed_4("processed-4")]
#[case::processed_6("processed-6")]
fn a_processor_takes_steps_of_any_length(#[case] name: &str) {
    let method = method_named(name).unwrap();
    let end = |scale: f64| {
        let pendulum = Pendulum::new(9.81 * scale * scale, 1.0, 1.0).unwrap();
        let start = Phase { theta: 1.0, omega: 0.5 * scale };
        let grid = Grid::new(0.1 / scale, 20).unwrap();
        let seconds = in_seconds(method).try_run(&pendulum, start, &grid, &mut ()).unwrap();
        let fast = method.run(&pendulum, start, &grid, &mut ());
        [seconds, fast].map(|z| (z.theta, z.omega / scale))
    };
    let [right, _] = end(1.0);
    for power in [-240, -130, 0, 130, 240] {
        let [seconds, fast] = end(4.0_f64.powi(power));
        assert_eq!(seconds, right, "units of 4^{power}");
        let off = (fast.0 - right.0).abs().max((fast.1 - right.1).abs());
        // In each of 20 steps four roundings of numbers below 4, by at most 2 ε each.
        assert!(off < 20.0 * 4.0 * 2.0 * f64::EPSILON, "{fast:?} in units of 4^{power}");
    }
}

// -------------------------------------------------------------------------------------------------
// Whole numbers
// -------------------------------------------------------------------------------------------------

/// A count of none, the smallest ones, those about the limits, and the largest.
const COUNTS: [u64; 8] = [0, 1, 2, u32::MAX as u64, 1 << 32, MAX_STEPS, MAX_STEPS + 1, u64::MAX];

/// Catches: a count out of range accepted, or rounded to another on its way to an f64; a refusal
/// that does not say what is allowed.
#[test]
fn a_count_out_of_range_is_refused() {
    for count in COUNTS {
        let grid =
            Grid::new(0.5, count).map(|grid| (grid.steps(), grid.samples(), grid.time(count)));
        let expected = (count, count.saturating_add(1), 0.5 * count as f64);
        let is_as_it_should = match grid {
            Err(Error::TooManySteps { steps, .. }) => count > MAX_STEPS && steps == count as f64,
            grid => count <= MAX_STEPS && grid == Ok(expected),
        };
        assert!(is_as_it_should, "{count}: {grid:?}");
    }
}

/// Steps of RK4 from 1 rad at rest, so that no number is a zero or a NaN.
const PAUSES: [u64; 5] = [0, 1, 3, 10, u64::MAX];

/// Catches: a run that goes on behind the end of its grid, or before where it stands; a stride that
/// overflows.
#[test]
fn a_run_may_be_left_and_taken_up_at_any_count() {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let (grid, rk4) = (Grid::new(0.1, 10).unwrap(), InSteps(Rk4));
    let states: Vec<Phase> = (0..=10)
        .map(|n| integrate_fast(&pendulum, &Rk4, start, &Grid::new(0.1, n).unwrap()))
        .collect();
    for [first, then] in PAUSES.map(|first| PAUSES.map(|then| [first, then])).concat() {
        for every in [1, 3, 11, 1 << 33, u64::MAX].map(|every| NonZeroU64::new(every).unwrap()) {
            let mut run = rk4.begin(&pendulum, start, &grid);
            let mut seen = Vec::new();
            let mut watch = |n: u64, _: f64, z: Phase| seen.push((n, z));
            run.advance(first, every, &mut watch).unwrap();
            let end = run.advance(then, every, &mut watch).unwrap();
            let last = first.max(then).min(10);
            assert_eq!(end, states[last as usize], "to {first}, then to {then}");
            let expected = (1..=last).filter(|n| n % every.get() == 0);
            assert!(expected.eq(seen.iter().map(|(n, _)| *n)), "{seen:?} by {every}");
            assert!(seen.iter().all(|(n, z)| *z == states[*n as usize]), "{seen:?}");
        }
    }
}

/// Catches: a limit of attempts that overflows, or is off by one; a limit of sweeps taken for
/// another, one that is used up although the iteration has ended.
#[test]
fn attempts_and_sweeps_are_limited_as_asked_for() {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-9).unwrap());
    let run = |limit| adaptive.max_attempts(limit).integrate(&pendulum, start, 0.0, 5.0);
    let (end, counts) = run(u64::MAX).unwrap();
    let attempts = counts.accepted + counts.rejected;
    for limit in [attempts, attempts + 1, u64::MAX - 1] {
        assert_eq!(run(limit), Ok((end, counts)));
    }
    for limit in [0, 1, attempts - 1] {
        assert!(matches!(run(limit), Err(Error::OutOfSteps { limit: of, .. }) if of == limit));
    }

    let grid = Grid::new(0.05, 20).unwrap();
    let with = |sweeps| {
        let iteration = Iteration::TO_ROUNDING.sweeps(NonZeroU32::new(sweeps).unwrap());
        InSteps(Gauss6.with(iteration)).try_run(&pendulum, start, &grid, &mut ())
    };
    let enough = with(100).unwrap();
    assert_eq!([with(u32::MAX), with(u32::MAX - 1)], [Ok(enough); 2]);
    assert!(matches!(with(1), Err(Error::NotSolved { n: 0, sweeps: 1, .. })), "{:?}", with(1));
}

// -------------------------------------------------------------------------------------------------
// Random scenes
// -------------------------------------------------------------------------------------------------

/// A scene in dimensionless quantities: angle, q = ω/ω₀, and x = ω₀h; the pendulum's parameters
/// over many orders of magnitude.
#[derive(Clone, Copy, Debug)]
struct Scene {
    pendulum: Pendulum,
    start: Phase,
    grid: Grid,
    x: f64,
}

/// Angles of up to `theta` (rad), |q| of up to `q`, steps of 1e-4 < x < `x`, up to `steps` of them.
fn scenes(theta: f64, q: f64, x: f64, steps: u64) -> impl Strategy<Value = Scene> {
    let decades = || (-30.0..30.0_f64).prop_map(power_of_ten);
    let parameters = (decades(), decades(), decades());
    let motion = (-theta..theta, -q..q, -4.0..x.log10(), 1..steps);
    (parameters, motion).prop_map(|((gravity, length, mass), (theta, q, log_x, steps))| {
        let pendulum = Pendulum::new(gravity, length, mass).unwrap();
        let frequency = pendulum.small_angle_frequency();
        let x = power_of_ten(log_x);
        let start = pendulum.start(theta, q * frequency).unwrap();
        Scene { pendulum, start, grid: Grid::new(x / frequency, steps).unwrap(), x }
    })
}

/// 10ˣ; the scenes need not have the same bits on two machines, as each property holds for all
/// scenes.
fn power_of_ten(x: f64) -> f64 {
    10.0_f64.powf(x)
}

/// The same scenes on each run; a failure is kept beside this file, and tried first from then on.
fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 256,
        rng_seed: RngSeed::Fixed(0x0050_E4D0_1A00),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    }
}

/// Runs the scene and returns (end, largest energy error in units of m g L).
fn run(method: &dyn AnyMethod, scene: &Scene) -> (Phase, f64) {
    let mut drift = EnergyDrift::new(&scene.pendulum);
    let end = method.run(&scene.pendulum, scene.start, &scene.grid, &mut drift);
    (end, drift.largest() / scene.pendulum.depth())
}

proptest! {
    #![proptest_config(config())]

    /// Every method is finite where it converges: in steps in which the pendulum swings or rotates
    /// by a radian at the most.
    ///
    /// Catches: an iteration that does not converge, or a series that overflows, where the method
    /// is of use.
    #[test]
    fn within_reach_is_finite_out(scene in scenes(1e6, 1.0, 0.5, 300), turn in 0.0..0.5_f64) {
        let omega = turn / scene.grid.step();
        let fast = Scene { start: Phase { omega, ..scene.start }, ..scene };
        for method in METHODS {
            for scene in [&scene, &fast] {
                let (end, drift) = run(*method, scene);
                let finite = end.theta.is_finite() && end.omega.is_finite();
                prop_assert!(finite, "{:?}: {:?}", method, end);
                prop_assert!(drift.is_finite());
            }
        }
    }
}

proptest! {
    // Its runs are ten times as long, and each scene is one of all symplectic methods.
    #![proptest_config(ProptestConfig { cases: 96, ..config() })]

    /// Well inside the stability limit the symplectic methods' energy errors are bounded for the
    /// whole run: by twice the largest of their leading terms, x|q s|/2, or x²(q²/12 + s²/24), both
    /// at the start and at the extreme. The next terms are of relative order x (|q| + 1) ≤ 0.2 · 3.
    ///
    /// Catches: an energy drift of a symplectic method, at any amplitude of any pendulum.
    #[test]
    fn symplectic_energy_is_bounded(scene in scenes(PI, 2.0, 0.2, 3000)) {
        // The largest q on the orbit: q² = q₀² + 2(1 − c₀) at the bottom.
        let energy = scene.pendulum.energy(scene.start) / scene.pendulum.depth();
        let q = (2.0 * energy).sqrt();
        let rounding = 1e-13 * (1.0 + energy);
        let x = scene.x;
        for method in METHODS.iter().filter(|method| method.info().symplectic) {
            let leading = match method.info().order {
                1 => 2.0 * x * q / 2.0,
                _ => 2.0 * x * x * (q * q / 12.0 + 1.0 / 24.0),
            };
            let (_, drift) = run(*method, &scene);
            let allowed = 2.0 * leading + rounding;
            prop_assert!(drift <= allowed, "{:?}: {:e} > {:e}", method, drift, leading);
        }
    }
}
