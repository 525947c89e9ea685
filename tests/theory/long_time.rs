//! Ten million steps: the modified energy changes by rounding only, as a random walk.

use pendula::fast::Ensemble;
use pendula::methods::{Rk4, StormerVerlet};
use pendula::metrics::EnergyDrift;
use pendula::{Grid, Hamiltonian, Pendulum, Phase, integrate, integrate_with};
use pendula_study::experiments::rounding_walk;
use pendula_study::theory;
use pendula_study::theory::{Dimensionless, stormer_verlet};
use rstest::rstest;

use crate::common::pendulums;

/// The energy that Störmer–Verlet conserves, in units of m g L: q²/2 + 1 − cos θ + x²(q²c/12 −
/// s²/24) + x⁴(…) + x⁶(…). What it leaves out, x⁸, is 1e-12 of it at x = 0.03 with a coefficient of
/// about 1e-6.
fn modified_energy(pendulum: &Pendulum, x: f64, z: Phase) -> f64 {
    let z = Dimensionless::from_phase(pendulum, z);
    z.energy() + stormer_verlet::correction(z, x)
}

/// The relative errors of the modified energy from each of these starts, after each number of steps
/// in `marks`, of `h` (s) each: many motions at once, which have the bits of one alone.
fn errors<const N: usize>(
    pendulum: &Pendulum,
    starts: &[Phase],
    h: f64,
    marks: [u64; N],
) -> [Vec<f64>; N] {
    let x = pendulum.small_angle_frequency() * h;
    let (mut states, mut done) = (starts.to_vec(), 0);
    marks.map(|mark| {
        let from = states.clone();
        let grid = Grid::new(h, mark - done).unwrap();
        Ensemble::new(pendulum, &from, grid).ends(&StormerVerlet, &mut states);
        done = mark;
        let energy = |z: &Phase| modified_energy(pendulum, x, *z);
        states.iter().zip(starts).map(|(z, start)| energy(z) / energy(start) - 1.0).collect()
    })
}

/// The largest relative error of the modified energy, sampled every thousand steps.
fn largest_error(pendulum: &Pendulum, theta_0: f64, h: f64, steps: u64) -> f64 {
    let x = pendulum.small_angle_frequency() * h;
    let start = Phase::at_rest(theta_0);
    let initial = modified_energy(pendulum, x, start);
    let mut largest = 0.0_f64;
    let mut watch = |n: u64, _: f64, z: Phase| {
        if n.is_multiple_of(1000) {
            let error = (modified_energy(pendulum, x, z) / initial - 1.0).abs();
            largest = if error.is_nan() { error } else { largest.max(error) };
        }
    };
    integrate_with(pendulum, &StormerVerlet, start, &Grid::new(h, steps).unwrap(), &mut watch);
    largest
}

/// The relative change of the energy by rounding in n steps, as a multiple of √n ε: θ and ω are
/// each rounded about twice a step, each by ε/√12 to ε/√48 of themselves (half an ulp, uniform),
/// and E changes with them by factors θV'/E ≤ 2 and ω²/E ≤ 2, both a half on average over a swing.
/// That is √(4/12…4/48) times 1, 0.3 to 0.6; measured, 0.4 to 0.6. The bounds leave a factor of 4.
const WALK: [f64; 2] = [0.1, 2.0];

/// The maximum of a random walk over its standard deviation at the end: it exceeds 4 once in 10⁴.
const PEAK: f64 = 4.0;

/// Asserts that the `largest` error of a random walk of `steps` steps is within its bounds, and
/// that a drift of `smallest_drift` a step would not be.
fn assert_walk(largest: f64, steps: u64, smallest_drift: f64) {
    let walk = f64::EPSILON * (steps as f64).sqrt();
    assert!(largest < PEAK * 0.6 * walk, "{largest:e} is {} walks", largest / walk);
    // The largest over the run is below a fifth of its own deviation at most once in 10⁵.
    assert!(largest > WALK[0] * 0.2 * walk, "{largest:e}: it does not even round");
    // A drift of this much would leave the bounds even if the walk went the other way.
    let drift = 2.0 * PEAK * 0.6 * walk / steps as f64;
    assert!(drift < smallest_drift, "{drift:e} a step is the least that is seen");
}

/// Ten million steps change Störmer–Verlet's modified energy by 3e-12 J: no more than a random walk
/// of n rounding errors, and 10⁶ times less than the oscillation of the energy itself at h = 0.01
/// s.
///
/// Catches: a secular drift of 4e-19 of the energy a step (of less, the test of Brouwer's law);
/// an angle that is cut and not rounded; a modified energy wrong in its x⁴ term, which at h = 0.01
/// s would show as 1e-8.
#[rstest]
fn the_modified_energy_walks_at_random(#[values(0.01, 0.001)] h: f64) {
    const STEPS: u64 = 10_000_000;
    let largest = largest_error(&Pendulum::PAPER, 1.0, h, STEPS);
    assert_walk(largest, STEPS, 4e-19);
}

/// Brouwer's law: the rounding error of the energy grows as √t. Over 96 starts its mean square
/// grows as the number of steps, 64-fold from 4000 to 256 000, and its mean is zero within its
/// scatter.
///
/// Catches: an error that grows as t, from a biased rounding or a lost digit; one that does not
/// grow because nothing is integrated.
#[rstest]
fn rounding_errors_grow_as_the_square_root_of_time(#[values(0.01, 0.001)] h: f64) {
    const STARTS: u32 = 96;
    const MARKS: [u64; 4] = [4_000, 16_000, 64_000, 256_000];
    /// A variance of 96 samples scatters by √(2/96) = 14 %, and a ratio of two by 20 %: a factor of
    /// 2, 0.69 in its logarithm, is more than three standard deviations.
    const SCATTER: f64 = 2.0;
    for pendulum in pendulums() {
        let starts: Vec<Phase> =
            (0..STARTS).map(|j| Phase::at_rest(0.5 + 0.02 * f64::from(j))).collect();
        let errors = errors(&pendulum, &starts, h, MARKS);
        let mean = |of: fn(f64) -> f64| {
            errors.each_ref().map(|all| all.iter().map(|e| of(*e)).sum::<f64>() / f64::from(STARTS))
        };
        let (squares, means) = (mean(|error| error * error), mean(|error| error));
        for (i, steps) in MARKS.into_iter().enumerate() {
            let walk = squares[i].sqrt() / (f64::EPSILON * (steps as f64).sqrt());
            assert!(walk > WALK[0] && walk < WALK[1], "{walk} √n ε after {steps} steps");
            let bias = means[i].abs() / (squares[i] / f64::from(STARTS)).sqrt();
            assert!(bias < 4.0, "a bias of {bias} standard deviations after {steps} steps");
        }
        let growth = squares[MARKS.len() - 1] / squares[0] / 64.0;
        assert!(growth > 1.0 / SCATTER && growth < SCATTER, "grew {growth} times 64-fold");
    }
}

/// The figure of the book: over eight starts the modified energy changes as √n in n steps, from 10³
/// steps to 10⁷.
///
/// Up to 10⁶ steps there are at least 80 stretches, whose root mean square scatters by 1/√160, 8 %:
/// two of them are within a factor of 1.4, four standard deviations of their ratio. The first
/// points include the rounding of the energy itself, one or two ε.
///
/// Catches: stretches that overlap or are counted from the start only, a change that is not
/// squared, a biased rounding.
#[test]
fn the_walks_of_the_figure_move_as_the_square_root() {
    let growth = rounding_walk::growth(rounding_walk::walks());
    let size = |(n, movement): (u64, f64)| movement / (f64::EPSILON * (n as f64).sqrt());
    assert_eq!(growth[0].0, rounding_walk::SAMPLED);
    for point in &growth {
        assert!(size(*point) > WALK[0] && size(*point) < WALK[1], "{point:?}");
    }
    let clear: Vec<f64> =
        growth.into_iter().filter(|(n, _)| (10_000..=1_000_000).contains(n)).map(size).collect();
    let (least, most) = clear.iter().fold((f64::MAX, 0.0_f64), |(l, m), s| (l.min(*s), m.max(*s)));
    assert!(most < 1.4 * least, "{clear:?}");
}

// -------------------------------------------------------------------------------------------------
// RK4 against Störmer–Verlet
// -------------------------------------------------------------------------------------------------

/// The set-up of Table 5.
const THETA_0: f64 = 1.0;
const STEP: f64 = 0.01;

/// Energy lost by RK4 (J) after `steps` steps, close enough to a whole number of swings: what is
/// left of the oscillation is 2e-8 J.
fn lost(pendulum: &Pendulum, steps: u64) -> f64 {
    let start = Phase::at_rest(THETA_0);
    let end = integrate(pendulum, &Rk4, start, &Grid::new(STEP, steps).unwrap());
    pendulum.energy(start) - pendulum.energy(end)
}

/// RK4's energy error is 240 times below Störmer–Verlet's after 1000 s, but it grows with time, and
/// Verlet's does not. Extrapolated from the loss between 1000 and 4000 s it overtakes at 2.4e5 s,
/// as theory predicts: Verlet's amplitude over the secular rate.
///
/// Catches: an RK4 whose loss is not secular, or follows another power of h; a Verlet whose energy
/// error is secular.
#[test]
fn rk4_will_overtake_verlet_after_240_000_seconds() {
    let pendulum = Pendulum::PAPER;
    let rate = (lost(&pendulum, 400_000) - lost(&pendulum, 100_000)) / 3000.0;
    // The oscillation, h⁴ × 1.7 J/s⁴ = 1.7e-8 J, at both ends of 1.3e-5 J: 2.6e-3. It cancels in
    // part.
    let law = -theory::rk4::secular_rate(&pendulum, THETA_0, STEP);
    assert!((rate / law - 1.0).abs() < 2.6e-3, "{rate:e} J/s for {law:e} J/s");
    let mut verlet = EnergyDrift::new(&pendulum);
    let start = Phase::at_rest(THETA_0);
    let grid = Grid::new(STEP, 400_000).unwrap();
    integrate_with(&pendulum, &StormerVerlet, start, &grid, &mut verlet);
    let amplitude = stormer_verlet::energy_error(&pendulum, THETA_0, STEP);
    assert!((verlet.largest() / amplitude - 1.0).abs() < 1e-5, "{:e} J", verlet.largest());
    let overtakes = amplitude / rate;
    assert!((overtakes - 2.40e5).abs() < 0.01e5, "{overtakes} s");
}
