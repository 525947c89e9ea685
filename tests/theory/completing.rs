//! The laws of the trapezoidal rule, of the discrete gradient, in its own steps and in Cieśliński's
//! and Ratkiewicz's, and of Deuflhard's method.

use std::f64::consts::PI;

use pendula::methods::{
    CieslinskiRatkiewicz, Deuflhard, DiscreteGradient, ImplicitMidpoint, PositionVerlet,
    StormerVerlet, Trapezoidal,
};
use pendula::registry::InSteps;
use pendula::{
    AnyMethod, Grid, Hamiltonian, LinearOscillator, Method, Motion, Pendulum, Phase, exact,
    integrate, integrate_with,
};
use pendula_judge::properties::area::{AREA_TOLERANCE, area_defect};
use pendula_judge::properties::energy;
use pendula_study::theory::period;
use rstest::rstest;

use crate::common::pendulum;
use crate::period_shift::shift;

/// h (s) for x = ω₀h.
fn step(x: f64) -> f64 {
    x / pendulum().small_angle_frequency()
}

fn grid(x: f64, steps: u64) -> Grid {
    Grid::new(step(x), steps).unwrap()
}

/// At rest, moving, over the top, near the top.
const STARTS: [Phase; 4] = [
    Phase { theta: 1.0, omega: 0.0 },
    Phase { theta: -2.0, omega: 3.0 },
    Phase { theta: 0.3, omega: 7.0 },
    Phase { theta: 2.9, omega: -0.4 },
];

// -------------------------------------------------------------------------------------------------
// Area
// -------------------------------------------------------------------------------------------------

/// From θ at the start and θ' at the end of a step of the trapezoidal rule, det J is the ratio of 1
/// + (x²/4) cos θ and the same of θ': the rule conserves area with this weight.
fn of_the_trapezoidal_rule(theta: f64, end: f64, x2: f64) -> f64 {
    let weight = |theta: f64| 1.0 + 0.25 * x2 * theta.cos();
    weight(theta) / weight(end)
}

/// The same of the discrete gradient. Its equations, differentiated, give (1 + (x²/2) ∂g/∂θ)/(1 +
/// (x²/2) ∂g/∂θ') with the mean force g = sin m sin δ/δ, m = (θ + θ')/2 and δ = (θ' − θ)/2.
fn of_the_discrete_gradient(theta: f64, end: f64, x2: f64) -> f64 {
    let (m, d) = (0.5 * (theta + end), 0.5 * (end - theta));
    // The angles of the cases are apart by 0.01 and more, so that the slope of sin δ/δ loses four
    // digits at most.
    let (ratio, slope) = (d.sin() / d, (d.cos() - d.sin() / d) / d);
    let weight = |sign: f64| 1.0 + 0.25 * x2 * (m.cos() * ratio - sign * m.sin() * slope);
    weight(1.0) / weight(-1.0)
}

/// The same in steps of 2 tan(x/2).
fn of_cieslinski_ratkiewicz(theta: f64, end: f64, x2: f64) -> f64 {
    of_the_discrete_gradient(theta, end, 4.0 * (0.5 * x2.sqrt()).tan().powi(2))
}

/// The ruler is right to `AREA_TOLERANCE`, which is derived beside it.
///
/// Catches: the midpoint rule, which preserves area, under either name; an iteration that stops
/// early; the law of one method used for the other.
#[rstest]
#[case::trapezoidal(Trapezoidal, of_the_trapezoidal_rule)]
#[case::discrete_gradient(DiscreteGradient, of_the_discrete_gradient)]
#[case::cieslinski_ratkiewicz(CieslinskiRatkiewicz, of_cieslinski_ratkiewicz)]
fn area_changes_by_the_ratio_of_two_weights<M: AnyMethod>(
    #[case] method: M,
    #[case] law: fn(f64, f64, f64) -> f64,
    #[values(0.2, 0.5, 1.0)] x: f64,
) {
    let tolerance = AREA_TOLERANCE;
    let mut largest = 0.0_f64;
    for start in STARTS {
        let end = method.run(&pendulum(), start, &grid(x, 1), &mut ());
        let defect = area_defect(&method, &pendulum(), start, step(x));
        let expected = law(start.theta, end.theta, x * x) - 1.0;
        assert!((defect - expected).abs() < tolerance, "{defect:e}, not {expected:e} at {start:?}");
        largest = largest.max(expected.abs());
    }
    assert!(largest > 1e5 * tolerance, "the law is lost in its tolerance: {largest:e}");
}

// -------------------------------------------------------------------------------------------------
// Energy
// -------------------------------------------------------------------------------------------------

/// Catches: a wrong mean of the force; a ratio of sine to angle with too few digits; a check that
/// other methods of order 2 would pass.
#[test]
fn the_discrete_gradient_conserves_the_energy_in_any_step() {
    use pendula_judge::zoo::completing::{Midpoint, TwiceTheWay};
    energy::check(&InSteps(DiscreteGradient)).unwrap();
    energy::check(&InSteps(CieslinskiRatkiewicz)).unwrap();
    assert!(energy::check(&TwiceTheWay).is_err());
    assert!(energy::check(&Midpoint(DiscreteGradient)).is_err());
}

/// The trapezoidal rule conserves H + x²(s² + q²c)/12, to order x⁴, in units of m g L, and the
/// midpoint rule H minus half of that correction. From rest s² + q²c − s₀² = (c − c₀)² on the exact
/// orbit: the energy errors are perfect squares, −(x²/12)(c − c₀)² and (x²/24)(c − c₀)², largest at
/// the bottom. The next terms are x² of these; at x = 0.1 the samples pass within 0.05 q of the
/// bottom, where c is 1 less 0.05² q²/2.
///
/// Catches: an energy that drifts; a correction with the sign or the size of the other's.
#[rstest]
#[case::trapezoidal(Trapezoidal, -1.0 / 12.0)]
#[case::implicit_midpoint(ImplicitMidpoint, 1.0 / 24.0)]
fn the_energy_error_is_a_perfect_square<M: Method<Pendulum>>(
    #[case] method: M,
    #[case] coefficient: f64,
    #[values(0.5, 1.5, 2.8)] theta_0: f64,
) {
    let (pendulum, start, x) = (pendulum(), Phase::at_rest(theta_0), 0.1);
    let square = |z: Phase| (z.theta.cos() - theta_0.cos()).powi(2);
    let (mut largest, mut off) = (0.0_f64, 0.0_f64);
    integrate_with(&pendulum, &method, start, &grid(x, 60_000), &mut |_, _, z: Phase| {
        let error = (pendulum.energy(z) - pendulum.energy(start)) / pendulum.depth();
        largest = largest.max(error.abs());
        off = off.max((error - coefficient * x * x * square(z)).abs());
    });
    let most = coefficient.abs() * x * x * square(Phase::default());
    assert!(off < x * x * most, "off by {off:e} of {most:e}");
    assert!((largest / most - 1.0).abs() < 0.02, "{largest:e}, not {most:e}");
}

// -------------------------------------------------------------------------------------------------
// Period
// -------------------------------------------------------------------------------------------------

/// The law leaves out x⁴, which is extrapolated from x and x/2. What is left is the reading of the
/// crossings, at most x³/24 at either end of 200 swings of 2π and more: over x² that is 7e-6. It
/// comes from velocities that are not those of the angles, which for the two methods that are exact
/// in small swings differ as little as the period does: there a hundredth of the law is allowed.
///
/// Catches: a phase error of second order, which order tests accept; the law of one method used for
/// another, where each law is 1/12 or 0 for small swings.
#[rstest]
#[case::trapezoidal(Trapezoidal, period::of_trapezoidal)]
#[case::implicit_midpoint(ImplicitMidpoint, period::of_implicit_midpoint)]
#[case::discrete_gradient(DiscreteGradient, period::of_discrete_gradient)]
#[case::cieslinski_ratkiewicz(CieslinskiRatkiewicz, period::of_cieslinski_ratkiewicz)]
#[case::deuflhard(Deuflhard, period::of_deuflhard)]
fn the_period_shifts_as_predicted<M: Method<Pendulum>>(
    #[case] method: M,
    #[case] law: fn(&Pendulum, f64) -> f64,
    #[values(0.1, 1.0, 2.0, 2.6)] theta_0: f64,
) {
    let law = law(&pendulum(), theta_0) / pendulum().frequency_squared();
    let over = |x: f64| shift(&method, theta_0, x, 200.0) / (x * x);
    let (coarse, fine) = (over(0.1), over(0.05));
    let measured = fine + (fine - coarse) / 3.0;
    assert!((measured - law).abs() < f64::min(2e-5, 0.01 * law.abs()), "{measured:e}, not {law:e}");
}

/// Asserts that after 10⁵ steps on the linear oscillator angle and energy are exact but for
/// rounding, which a step makes `a_step` ε of the state, at random; and the angle of a pendulum
/// that swings by 2⁻⁴⁰ rad, which is one.
fn assert_exact_in_small_swings<M>(method: &M, x: f64, a_step: f64)
where
    M: Method<LinearOscillator> + Method<Pendulum>,
{
    const STEPS: u64 = 100_000;
    let (linear, start) = (LinearOscillator::new(pendulum()), Phase { theta: 1.0, omega: 0.7 });
    let grid = grid(x, STEPS);
    let end = integrate(&linear, method, start, &grid);
    let exact = linear.exact(start, grid.time(STEPS));
    let rounding = 20.0 * f64::EPSILON * x * STEPS as f64 + a_step * f64::EPSILON * 316.0;
    assert!((end.theta - exact.theta).abs() < rounding, "{:e}", end.theta - exact.theta);
    let drift = linear.energy(end) / linear.energy(start) - 1.0;
    assert!(drift.abs() < rounding, "{drift:e}");
    // In units of its size, which is a power of two, the pendulum has the same end.
    let tiny = 2.0_f64.powi(-40);
    let end = integrate(&pendulum(), method, start * tiny, &grid);
    assert!((end.theta / tiny - exact.theta).abs() < rounding, "{end:?}");
}

// -------------------------------------------------------------------------------------------------
// Cieśliński's and Ratkiewicz's method
// -------------------------------------------------------------------------------------------------

/// Whatever the step, small swings have the right period, to the last digits. After n steps the
/// angle on the linear oscillator is exact but for rounding: ω₀, h and the tangent round the phase
/// by an ε each, and each step the state by ten, as the iteration leaves it, at random.
///
/// Catches: a step that is off by a billionth; an iteration that ends early and lets the energy
/// drift.
#[rstest]
fn small_swings_have_the_exact_period(#[values(0.01, 0.7, 1.2)] x: f64) {
    assert_exact_in_small_swings(&CieslinskiRatkiewicz, x, 200.0);
}

// -------------------------------------------------------------------------------------------------
// Deuflhard's method
// -------------------------------------------------------------------------------------------------

/// After n steps its angle on the linear oscillator is exact but for rounding: ω₀ and h round the
/// phase by an ε each, and the tangent, which is ten times as long as the step at x = 2.9, by ten;
/// each step rounds the state by as much again, at random.
///
/// Catches: a rotation by anything but ω₀h; one whose determinant is not 1, so that 10⁵ steps of it
/// grow or shrink.
#[rstest]
fn deuflhard_is_exact_on_the_linear_oscillator(#[values(0.01, 0.7, 2.0, 2.9)] x: f64) {
    assert_exact_in_small_swings(&Deuflhard, x, 20.0);
}

/// It conserves H + x²((c − 1)q² − θ(s − θ))/12 − x²(s − θ)²/24. In small swings of θ₀ sin and cos
/// that is, beside H₀, −(x²θ₀⁴/12)(u(1 − u)/2 − u²/6) with u = cos²: largest at u = 3/8, where H
/// exceeds H₀ by 25x²θ₀⁴/1152. Relative to the energy that falls with θ₀², as no error of
/// Störmer–Verlet's does. θ₀² and x² of it are left out.
///
/// Catches: an error that does not fall with the amplitude, since kicks and rotation do not fit.
#[rstest]
fn its_energy_error_falls_with_the_fourth_power_of_the_amplitude(
    #[values(0.02, 0.05, 0.1)] theta_0: f64,
) {
    let x = 0.1;
    let (pendulum, start) = (pendulum(), Phase::at_rest(theta_0));
    let mut largest = 0.0_f64;
    integrate_with(&pendulum, &Deuflhard, start, &grid(x, 1000), &mut |_, _, z: Phase| {
        largest = largest.max((pendulum.energy(z) - pendulum.energy(start)) / pendulum.depth());
    });
    let law = 25.0 * x * x * theta_0.powi(4) / 1152.0;
    assert!(
        (largest / law - 1.0).abs() < theta_0 * theta_0 + 2.0 * x * x,
        "{largest:e}, not {law:e}"
    );
}

/// The lag (s) after 20 periods of 66 steps from rest at 1 rad, where ω' = −ω₀² sin θ₀.
fn lag<M: Method<Pendulum>>(method: &M) -> f64 {
    let h = exact::period(&pendulum(), 1.0).unwrap() / 66.0;
    let grid = Grid::new(h, 20 * 66).unwrap();
    let end = integrate(&pendulum(), method, Phase::at_rest(1.0), &grid);
    end.omega / (pendulum().frequency_squared() * 1.0_f64.sin())
}

/// With as many sines as position Verlet takes. The two laws give 0.0225/0.000489, and x⁴ changes
/// the ratio by some x² = 0.01 of it.
///
/// Catches: the splitting rotation, kick, rotation, whose lag is only 7 times less.
#[test]
fn its_phase_lag_at_1_rad_is_46_times_less_than_position_verlets() {
    let ratio = lag(&PositionVerlet) / lag(&Deuflhard);
    assert!((ratio - 46.0).abs() < 0.5, "{ratio}");
}

/// Störmer–Verlet's limit is x = 2, and that of the rotation half a turn. The swing of a tenth of a
/// radian is nearly linear: what the kicks change is a hundredth of the energy, and in a hundred
/// steps less of the phase.
///
/// Catches: a limit like Störmer–Verlet's; a rotation by another angle in long steps, which keeps
/// the energy as well; energy that wanders off.
#[rstest]
fn its_steps_may_be_longer_than_verlets(#[values(2.1, 2.5, 2.9)] x: f64) {
    let (pendulum, start) = (pendulum(), Phase::at_rest(0.1));
    let worst = |method: &dyn AnyMethod| {
        let mut worst = 0.0_f64;
        method.run(&pendulum, start, &grid(x, 100_000), &mut |_: u64, _: f64, z: Phase| {
            worst = worst.max((pendulum.energy(z) / pendulum.energy(start) - 1.0).abs());
        });
        worst
    };
    assert!(worst(&Deuflhard) < 0.05, "{:e}", worst(&Deuflhard));
    assert!(worst(&StormerVerlet) > 1.0, "{:e}", worst(&StormerVerlet));
    let hundred = grid(x, 100);
    let end = integrate(&pendulum, &Deuflhard, start, &hundred);
    let truth = Motion::new(&pendulum, start).unwrap().at(hundred.time(100));
    assert!((end.theta - truth.theta).abs() < 0.05 * 0.1, "{end:?}, not {truth:?}");
}

/// Over the top the linear force about one bottom gives way to that about the next, and with it the
/// kick jumps by 2π(2 tan(x/2) − x) = 2πx³/12. The step meets the top anywhere, evenly: so the
/// energy that it conserves between two tops changes by that jump times a part of the step, −½ to
/// ½, times q: at random, without a mean, and by πx³q/(6√12) in the root mean square. Between the
/// tops the truncated energy varies by some x⁴. Of 800 passages the root mean square is uncertain
/// by 1/√(2 · 800), the mean by it over √800.
///
/// Catches: angles always counted from the same bottom, which do not jump and in the end turn back;
/// a jump with a bias, which would let the energy of a rotation drift.
#[rstest]
fn over_the_top_its_energy_steps_at_random(#[values(0.02, 0.05)] x: f64) {
    let (pendulum, frequency) = (pendulum(), pendulum().small_angle_frequency());
    let start = Phase { theta: 0.3, omega: 3.0 * frequency };
    let conserved = |z: Phase| {
        let rest = z.theta - 2.0 * PI * (z.theta / (2.0 * PI)).round();
        let (q, sin, cos) = (z.omega / frequency, z.theta.sin(), z.theta.cos());
        let beyond = sin - rest;
        let second = ((cos - 1.0) * q * q - rest * beyond) / 12.0 - beyond * beyond / 24.0;
        pendulum.energy(z) / pendulum.depth() + x * x * second
    };
    // One state in each turn, the first past the bottom.
    let mut passages: Vec<f64> = vec![];
    let mut turn = 0.0;
    let grid = grid(x, (800.0 * 2.0 * PI / 2.6 / x) as u64);
    integrate_with(&pendulum, &Deuflhard, start, &grid, &mut |_, _, z: Phase| {
        if (z.theta / (2.0 * PI)).floor() > turn {
            turn += 1.0;
            passages.push(conserved(z));
        }
    });
    let steps: Vec<f64> = passages.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let count = steps.len() as f64;
    assert!(count > 700.0, "{count}");
    let mean = steps.iter().sum::<f64>() / count;
    let deviation = (steps.iter().map(|step| step * step).sum::<f64>() / count).sqrt();
    let at_the_top = (2.0 * (conserved(start) - 2.0)).sqrt();
    let law = PI * x * x * x * at_the_top / 6.0 / 12.0_f64.sqrt();
    assert!((deviation / law - 1.0).abs() < 0.1, "{deviation:e}, not {law:e}");
    assert!(mean.abs() < 4.0 * law / count.sqrt(), "{mean:e} beside {law:e}");
}
