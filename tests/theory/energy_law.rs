//! The laws of the energy error, each against its method.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use pendula::methods::{ForwardEuler, PositionVerlet, Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::EnergyDrift;
use pendula::{
    Grid, Hamiltonian, LinearOscillator, METHODS, Method, Pendulum, Phase, exact, integrate,
    integrate_with, method_named,
};
use pendula_judge::properties::flipped;
use pendula_study::experiments::convergence;
use pendula_study::theory::{self, Dimensionless, stormer_verlet, symplectic_euler};
use rstest::rstest;

use crate::common::pendulum;

/// The step at which x = ω₀h.
fn step(x: f64) -> f64 {
    x / pendulum().small_angle_frequency()
}

fn largest_energy_error<M: Method<Pendulum>>(method: &M, theta_0: f64, grid: &Grid) -> f64 {
    let pendulum = pendulum();
    let mut drift = EnergyDrift::new(&pendulum);
    integrate_with(&pendulum, method, Phase::at_rest(theta_0), grid, &mut drift);
    drift.largest()
}

/// The slope between two errors at x and x/2.
fn slope(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

// -------------------------------------------------------------------------------------------------
// Symplectic methods
// -------------------------------------------------------------------------------------------------

/// A swing, and a rotation fast enough for the highest powers of q to matter.
const SWINGING: Phase = Phase { theta: 1.5, omega: 0.4 };
const ROTATING: Phase = Phase { theta: 0.3, omega: 6.0 };

/// The range of H + `correction`, in units of m g L, over a time of 40 √(L/g).
fn spread<M: Method<Pendulum>>(
    method: &M,
    start: Phase,
    x: f64,
    correction: impl Fn(Dimensionless) -> f64,
) -> f64 {
    let (pendulum, mut low, mut high) = (pendulum(), f64::INFINITY, f64::NEG_INFINITY);
    let grid = Grid::new(step(x), (40.0 / x) as u64).unwrap();
    integrate_with(&pendulum, method, start, &grid, &mut |_, _, z: Phase| {
        let z = Dimensionless::from_phase(&pendulum, z);
        let energy = z.energy() + correction(z);
        (low, high) = (f64::min(low, energy), f64::max(high, energy));
    });
    high - low
}

/// On these steps the next term, x or x² of the one measured, bends the slope by less than 0.1, and
/// rounding by less still.
const SLOPE_TOLERANCE: f64 = 0.12;

/// With its terms up to xᵏ, H̃ is conserved to xᵏ⁺¹, for each k.
///
/// Catches: any wrong coefficient of H̃, at its own order; drift before kick; forward Euler in
/// place of symplectic Euler.
#[rstest]
fn symplectic_euler_conserves_its_energy_to_each_order(
    #[values(0, 1, 2, 3, 4, 5, 6, 7)] order: usize,
    #[values((SWINGING, 0.12), (ROTATING, 0.08))] (start, x): (Phase, f64),
) {
    let spread = |x: f64| {
        spread(&SymplecticEuler, start, x, |z| {
            let terms = symplectic_euler::modified_hamiltonian_terms(z);
            (0..order).map(|k| terms[k] * x.powi(k as i32 + 1)).sum()
        })
    };
    let slope = slope(spread(x), spread(0.5 * x));
    let expected = (order + 1) as f64;
    assert!((slope - expected).abs() < SLOPE_TOLERANCE, "slope {slope}, not {expected}");
}

/// H̃ to x⁷ is conserved to x⁸, as the odd powers vanish: that of either form, each its own.
///
/// Catches: the position form in place of the velocity form, which an order test cannot tell apart,
/// or its law; a shift by a whole kick.
#[test]
fn stormer_verlet_conserves_its_energy_to_the_eighth_order() {
    let of = |x| spread(&StormerVerlet, SWINGING, x, |z| stormer_verlet::correction(z, x));
    let law = |z, x| stormer_verlet::correction_of_position_form(z, x);
    let of_position = |x| spread(&PositionVerlet, SWINGING, x, |z| law(z, x));
    for (coarse, fine) in [(of(0.2), of(0.1)), (of_position(0.2), of_position(0.1))] {
        let slope = slope(coarse, fine);
        assert!((slope - 8.0).abs() < SLOPE_TOLERANCE, "slope {slope}");
    }
    let other = spread(&StormerVerlet, SWINGING, 0.1, |z| law(z, 0.1));
    assert!(other > 1e4 * of(0.1), "the two forms cannot be told apart");
}

/// The highest sample lies below the maximum of the curve by at most x²/2 relatively, where the
/// maximum falls midway between two samples. Over 500 maxima the smallest gap is less than a
/// hundredth of that.
const SAMPLING: f64 = 0.02 * 0.02 / 2.0 / 100.0;

/// Steps of x = 0.02, over about 200 swings.
fn long_grid() -> Grid {
    Grid::new(step(0.02), 80_000).unwrap()
}

/// Catches: m, g or L in the wrong place in the law or the method; a law that is valid only at π/3.
#[rstest]
fn symplectic_euler_strays_along_its_level_curve(#[values(0.3, 1.0, 2.0, 2.8, -1.0)] theta_0: f64) {
    let measured = largest_energy_error(&SymplecticEuler, theta_0, &long_grid());
    let law = symplectic_euler::largest_energy_error(&pendulum(), theta_0, step(0.02));
    assert_relative_eq!(measured, law, max_relative = SAMPLING);
}

/// Of either form, each by its own closed form.
///
/// Catches: m, g or L in the wrong place in the law or the method; a half kick taken whole; the
/// position form in place of the velocity form.
#[rstest]
fn stormer_verlet_strays_as_its_closed_form_says(#[values(0.3, 1.0, 2.0, 2.8, -1.0)] theta_0: f64) {
    let measured = largest_energy_error(&StormerVerlet, theta_0, &long_grid());
    let law = stormer_verlet::energy_error(&pendulum(), theta_0, step(0.02));
    assert_relative_eq!(measured, law, max_relative = SAMPLING);
    let measured = largest_energy_error(&PositionVerlet, theta_0, &long_grid());
    let law = stormer_verlet::energy_error_of_position_form(&pendulum(), theta_0, step(0.02));
    assert_relative_eq!(measured, law, max_relative = SAMPLING);
}

// -------------------------------------------------------------------------------------------------
// RK4
// -------------------------------------------------------------------------------------------------

/// The energy change of a single step is the series to x⁸; the remainder is of order x⁹.
///
/// Catches: a wrong coefficient in e₅ … e₈, and any change of RK4 that its order does not show.
#[rstest]
#[case(1.0, 6.0)]
#[case(-0.5, 5.0)]
#[case(2.0, -6.0)]
fn the_energy_change_of_a_step_is_its_series(#[case] theta: f64, #[case] omega: f64) {
    let (pendulum, z) = (pendulum(), Phase { theta, omega });
    let left = |x: f64| {
        let grid = Grid::new(step(x), 1).unwrap();
        let end = integrate(&pendulum, &Rk4, z, &grid);
        let change = (pendulum.energy(end) - pendulum.energy(z)) / pendulum.depth();
        let terms = theory::rk4::energy_change_terms(Dimensionless::from_phase(&pendulum, z));
        let series: f64 = (0..4).map(|k| terms[k] * x.powi(k as i32 + 5)).sum();
        (change - series).abs()
    };
    let order = slope(left(0.1), left(0.05));
    assert!((order - 9.0).abs() < 0.2, "slope {order}");
}

/// Over whole periods only the secular part is left: h⁵⟨e₆⟩ + h⁷⟨e₈⟩ per unit time, at every
/// amplitude.
///
/// A hundredth of a period is x = 0.06 at 0.3 rad and 0.14 at 2.8. The next term is x⁴ of the
/// first, 1e-5 to 4e-4, with a coefficient of order 1; the numerical period, longer by x⁴, adds as
/// much, as the swings are not quite complete. Over 10 periods the relative energy loss is at least
/// 5e-7, of which rounding is 1e-8.
///
/// Catches: an RK4 that loses energy at another rate; a law that is valid only at π/3; wrong
/// dimensions.
#[rstest]
fn rk4_loses_energy_at_the_secular_rate(#[values(0.3, 1.0, 2.0, 2.8)] theta_0: f64) {
    let (pendulum, start) = (pendulum(), Phase::at_rest(theta_0));
    let period = exact::period(&pendulum, theta_0).unwrap();
    let steps = 100;
    let grid = Grid::new(period / f64::from(steps), 10 * u64::from(steps as u32)).unwrap();
    let end = integrate(&pendulum, &Rk4, start, &grid);
    let rate = (pendulum.energy(end) - pendulum.energy(start)) / (10.0 * period);
    let law = theory::rk4::secular_rate(&pendulum, theta_0, grid.step());
    assert!(law < 0.0);
    assert_relative_eq!(rate, law, max_relative = 1e-3);
}

// -------------------------------------------------------------------------------------------------
// Forward Euler
// -------------------------------------------------------------------------------------------------

/// The modified equation to order x⁵ agrees with forward Euler to order x⁶.
///
/// Catches: a wrong coefficient of the modified equation at any order, and a solver that is not
/// accurate enough for it.
#[rstest]
fn forward_euler_follows_its_modified_equation(#[values(0.3, 1.5, 2.9)] theta_0: f64) {
    let pendulum = pendulum();
    let largest = |x: f64| {
        let grid = Grid::new(step(x), (6.0 / x).round() as u64).unwrap();
        let mut truth = theory::forward_euler::trajectory(&pendulum, theta_0, grid.step());
        let mut largest = 0.0_f64;
        let mut watch = |_, _, z: Phase| {
            let (z, truth) = (Dimensionless::from_phase(&pendulum, z), truth.next().unwrap());
            largest = largest.max((z.theta - truth.theta).abs()).max((z.q - truth.q).abs());
        };
        integrate_with(&pendulum, &ForwardEuler, Phase::at_rest(theta_0), &grid, &mut watch);
        largest
    };
    let order = slope(largest(0.03), largest(0.015));
    assert!((order - 6.0).abs() < 0.08, "slope {order}");
}

/// Swinging: (1 + x²)ⁿ is exact on the linear oscillator, but for n roundings; on the pendulum it
/// holds up to θ² = 4e-4.
///
/// Catches: growth by x²/2 or (1 + x)ⁿ; a forward Euler whose drift uses the new velocity.
#[test]
fn forward_euler_grows_a_small_swing_exponentially() {
    fn growth<S: Hamiltonian<State = Phase>>(system: &S, grid: &Grid) -> f64 {
        let start = Phase::at_rest(0.01);
        let end = integrate(system, &ForwardEuler, start, grid);
        system.energy(end) / system.energy(start)
    }
    let (pendulum, grid) = (pendulum(), Grid::new(step(0.05), 500).unwrap());
    let law = theory::forward_euler::small_angle_growth(&pendulum, grid.step(), 500);
    let linear = growth(&LinearOscillator::new(pendulum), &grid);
    assert_relative_eq!(linear, law, max_relative = 1e-12);
    assert_relative_eq!(growth(&pendulum, &grid), law, max_relative = 4e-4);
}

/// Wide swings: h ⟨sin²θ⟩ times (g/L)² m L², over one period. What the law leaves out is of
/// relative order x, and halves with the step: after extrapolation it is of order x² ≈ 1e-4, times
/// the growth of the logarithm of the amplitude near the top.
///
/// Catches: a rate that is valid only for small angles.
#[rstest]
fn forward_euler_grows_any_swing_by_the_mean_of_sin_squared(#[values(0.5, 1.5, 2.5)] theta_0: f64) {
    let (pendulum, start) = (pendulum(), Phase::at_rest(theta_0));
    let period = exact::period(&pendulum, theta_0).unwrap();
    let ratio = |steps: u64| {
        let grid = Grid::new(period / steps as f64, steps).unwrap();
        let end = integrate(&pendulum, &ForwardEuler, start, &grid);
        let rate = (pendulum.energy(end) - pendulum.energy(start)) / period;
        rate / theory::forward_euler::swinging_rate(&pendulum, theta_0, grid.step())
    };
    assert_relative_eq!(2.0 * ratio(8000) - ratio(4000), 1.0, max_relative = 1e-4);
}

/// Rotating: the gain from one mean over 2000 steps, a whole number of turns, to the next. The law
/// leaves out (ω₀/Ω)² = 1/1600, and the growth of the angle a per step in the meantime, by 1e-3, to
/// which the cotangent at a = 2.7 is five times as sensitive.
///
/// Catches: the small-step law, ω₀⁴h/2, used for all steps. It is 1.5 times too large at a = 1.9
/// and 3.3 times at 2.7.
#[rstest]
#[case::turn_0_3(95)]
#[case::turn_1_1(350)]
#[case::turn_1_9(605)]
#[case::turn_2_7(860)]
fn forward_euler_rotating_gains_less_the_larger_the_turn_of_a_step(#[case] turns: u32) {
    const STEPS: u64 = 2000;
    let pendulum = pendulum();
    let spin = 40.0 * pendulum.small_angle_frequency();
    let h = 2.0 * PI * f64::from(turns) / STEPS as f64 / spin;
    let (grid, mut sums) = (Grid::new(h, 2 * STEPS - 1).unwrap(), [0.0; 2]);
    let start = Phase { theta: 0.0, omega: spin };
    integrate_with(&pendulum, &ForwardEuler, start, &grid, &mut |n: u64, _, z| {
        sums[usize::from(n >= STEPS)] += pendulum.energy(z);
    });
    let rate = (sums[1] - sums[0]) / STEPS as f64 / grid.time(STEPS);
    let law = theory::forward_euler::rotating_rate(&pendulum, spin, h);
    assert_relative_eq!(rate, law, max_relative = 1e-2);
}

/// Saturated: at half a turn a step the gain stops. Alternating kicks make ω oscillate by hω₀²/2,
/// and the energy by x²/π of itself; the potential adds 4x²/π². With x = 0.2 that is 2.9 %, all of
/// it above the law.
///
/// Catches: energy that grows without bound; growth that stops only at a whole turn per step.
#[test]
fn forward_euler_locks_at_half_a_turn_a_step() {
    let (pendulum, h, steps) = (pendulum(), step(0.2), 100_000);
    let grid = Grid::new(h, steps).unwrap();
    let mut largest = 0.0_f64;
    let start = Phase::at_rest(1.0);
    let end = integrate_with(&pendulum, &ForwardEuler, start, &grid, &mut |_, _, z| {
        largest = largest.max(pendulum.energy(z));
    });
    let law = theory::forward_euler::saturation_energy(&pendulum, h);
    assert!(largest > law && largest < 1.03 * law, "{largest} for {law}");
    assert_relative_eq!(end.omega.abs() * h, PI, max_relative = 1e-2);
}

/// The largest energy errors (J) of the splitting methods in the set-up of Table 4 with steps of
/// 0.025 s, computed with 60 digits.
const ERRORS: &str = include_str!("../data/energy_errors.csv");

/// Rounding changes the energy, 5 J, by 0.6 ε of itself at each of n ≤ 34 000 force evaluations:
/// 0.6 ε · 5 √n J, and at most twice that. So the error of Forest and Ruth's method is tested to
/// nine digits, that of Yoshida's of order 8 to two; those of the best are all rounding.
///
/// Catches: a table of coefficients of the right order with a wrong free parameter, which no slope
/// and no order condition shows.
#[test]
fn energy_errors_are_those_of_sixty_digits() {
    let rows: Vec<(&str, f64)> = ERRORS
        .lines()
        .skip(1)
        .map(|row| row.split_once(',').map(|(name, error)| (name, error.parse().unwrap())).unwrap())
        .collect();
    for (name, error) in &rows {
        let method = method_named(name).expect("on the list");
        let evaluations = 2000.0 * method.info().force_evaluations as f64;
        let rounding = 2.0 * 0.6 * f64::EPSILON * 5.0 * evaluations.sqrt();
        let drift = convergence::drift(method, 0.025);
        assert!(
            (drift - error).abs() < rounding,
            "{name}: {drift:e}, not {error:e} ± {rounding:e}"
        );
    }
    let splits = METHODS.iter().map(|method| method.info());
    let splits = splits.filter(|of| of.symplectic && !of.implicit && of.order > 2);
    let missing = splits.filter(|of| rows.iter().all(|(name, _)| *name != of.name));
    let missing: Vec<&str> = missing.map(|of| of.name).collect();
    assert!(
        missing.is_empty(),
        "tests/data/energy_errors.csv has no error of {missing:?}: name them in `CONSTANTS` of \
         book/judge/known-answers/errors.py, and run `book/judge/known-answers/run errors`"
    );
}

/// RK4 loses as much energy on the way back as on the way there. The law leaves out x⁴ = 1e-6 of
/// the rate, and the incomplete swing at the end of 500 to 1000 on each way; the two mirror each
/// other, except for the loss.
///
/// Catches: an RK4 whose loss of energy is reversible, as an error of order h⁴ would be.
#[rstest]
#[case(Pendulum::PAPER)]
#[case(pendula_judge::properties::pendulum())]
fn rk4_returns_with_less_by_what_it_loses(#[case] pendulum: Pendulum) {
    let (start, grid) = (Phase::at_rest(1.0), Grid::new(0.01, 100_000).unwrap());
    let there = integrate(&pendulum, &Rk4, start, &grid);
    let back = integrate(&pendulum, &Rk4, flipped(there), &grid);
    let lost = pendulum.energy(start) - pendulum.energy(back);
    let law = -2000.0 * theory::rk4::secular_rate(&pendulum, 1.0, 0.01);
    assert_relative_eq!(lost, law, max_relative = 1e-3);
}
