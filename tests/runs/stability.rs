//! Linear stability: each of the paper's methods just inside and just outside its limit, where
//! theory gives the rate of growth.

use std::f64::consts::SQRT_2;

use approx::assert_relative_eq;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{
    Grid, Hamiltonian, LinearOscillator, Method, Pendulum, Phase, System, integrate, integrate_with,
};
use rstest::rstest;

use crate::common::pendulums;

/// The relative distance of a step from its limit, on either side.
const BESIDE: f64 = 1e-4;

/// The limit of symplectic Euler and Störmer–Verlet: at x = ω₀h = 2 the trace 2 − x² of their step
/// leaves [−2, 2].
const SYMPLECTIC_LIMIT: f64 = 2.0;

/// The limit of RK4: |R(ix)|² = 1 − x⁶/72 + x⁸/576 passes 1 at x² = 8.
const RK4_LIMIT: f64 = 2.0 * SQRT_2;

/// `steps` steps of x = ω₀h.
fn grid(pendulum: &Pendulum, x: f64, steps: u64) -> Grid {
    Grid::new(x / pendulum.small_angle_frequency(), steps).unwrap()
}

/// Where a release from the angle `theta` (rad) ends.
fn end<S: System<State = Phase>>(
    system: &S,
    method: &impl Method<S>,
    theta: f64,
    grid: &Grid,
) -> Phase {
    integrate(system, method, Phase::at_rest(theta), grid)
}

/// The largest |θ| (rad) from `start`.
fn farthest<S: System<State = Phase>>(
    system: &S,
    method: &impl Method<S>,
    start: Phase,
    grid: &Grid,
) -> f64 {
    let mut largest = 0.0_f64;
    integrate_with(system, method, start, grid, &mut |_, _, z: Phase| {
        largest = if z.theta.is_nan() { f64::NAN } else { largest.max(z.theta.abs()) };
    });
    largest
}

// -------------------------------------------------------------------------------------------------
// Symplectic Euler and Störmer–Verlet
// -------------------------------------------------------------------------------------------------

/// Pushed from the bottom with q = ω/ω₀ = 1, just inside the limit. Störmer–Verlet conserves q² +
/// (1 − x²/4)θ², so that |θ| reaches 1/√(1 − x²/4) = 70.7; symplectic Euler conserves q² − xqθ +
/// θ², whose largest θ is the same. The phase advances by π − 0.0283 a step, so that the highest
/// sample is within (0.0283/2)²/2 = 1e-4 of the top.
///
/// Catches: a Verlet whose force is one step old or that drifts before it kicks by the new
/// velocity, both of which move the limit; forward Euler, RK4 or any damping in place of a
/// symplectic method.
#[rstest]
#[case::symplectic_euler(SymplecticEuler)]
#[case::stormer_verlet(StormerVerlet)]
fn just_inside_the_symplectic_limit_the_swing_is_bounded<M: Method<LinearOscillator>>(
    #[case] method: M,
) {
    /// The gap of sampling, and 1e5 roundings of ε, which are amplified by no more than 70.
    const TOLERANCE: f64 = 1.1e-4;
    for pendulum in pendulums() {
        let x = SYMPLECTIC_LIMIT * (1.0 - BESIDE);
        let start = Phase { theta: 0.0, omega: pendulum.small_angle_frequency() };
        let linear = LinearOscillator::new(pendulum);
        let largest = farthest(&linear, &method, start, &grid(&pendulum, x, 100_000));
        let bound = 1.0 / (1.0 - 0.25 * x * x).sqrt();
        assert_relative_eq!(largest, bound, max_relative = TOLERANCE);
    }
}

/// The exponent by which a step grows, just outside: cosh μ = x²/2 − 1, μ = 2 acosh(x/2) = 0.0283.
fn symplectic_growth(pendulum: &Pendulum, h: f64) -> f64 {
    2.0 * (0.5 * (pendulum.frequency_squared() * h * h).sqrt()).acosh()
}

/// Between steps 1000 and 3000 the angle grows by e^(2000 μ) = e^56.6, each step with the other
/// sign.
///
/// Catches: a limit that is off by more than 1e-4, on the side that the test before does not see; a
/// method without a limit.
#[rstest]
#[case::symplectic_euler(SymplecticEuler)]
#[case::stormer_verlet(StormerVerlet)]
fn just_outside_the_symplectic_limit_it_grows_at_the_predicted_rate<M: Method<LinearOscillator>>(
    #[case] method: M,
) {
    /// h is rounded by ε/2, which changes μ = √(8 · 1e-4) by ε/(4e-4) relatively, and so does the
    /// rounding of the square root; times 56.6: 1e-10.
    const TOLERANCE: f64 = 1e-9;
    for pendulum in pendulums() {
        let linear = LinearOscillator::new(pendulum);
        let at = |steps| {
            let grid = grid(&pendulum, SYMPLECTIC_LIMIT * (1.0 + BESIDE), steps);
            (end(&linear, &method, 1.0, &grid).theta, grid.step())
        };
        let ((early, h), (late, _)) = (at(1000), at(3000));
        let law = 2000.0 * symplectic_growth(&pendulum, h);
        assert!(((late / early).ln() - law).abs() < TOLERANCE, "{} for {law}", (late / early).ln());
        assert!(at(1001).0 * early < 0.0, "it does not alternate");
    }
}

// -------------------------------------------------------------------------------------------------
// RK4 and forward Euler
// -------------------------------------------------------------------------------------------------

/// The logarithm of the factor by which the energy of `system` changes along `grid`, from rest at
/// 1e-6 rad.
fn log_energy_change<S>(system: &S, method: &impl Method<S>, grid: &Grid) -> f64
where
    S: Hamiltonian + System<State = Phase>,
{
    let start = Phase::at_rest(1e-6);
    (system.energy(end(system, method, start.theta, grid)) / system.energy(start)).ln()
}

/// What `steps` roundings may add up to in the logarithm of the energy: a few dozen operations of
/// ε/2 a step at the worst.
fn roundings(steps: u64) -> f64 {
    16.0 * f64::EPSILON * steps as f64
}

/// RK4 multiplies the energy of the linear oscillator by |R(ix)|² at each step, on both sides of
/// its limit, at its strongest damping, x² = 6, and where it hardly damps. The pendulum from 1e-6
/// rad is the same to θ² = 1e-12 a step.
///
/// Catches: any change of a coefficient or node of RK4; a method of order 4 with another
/// polynomial.
#[rstest]
fn rk4_damps_and_grows_by_its_polynomial(
    #[values(
        0.1,
        1.0,
        2.449_489_742_783_178,
        RK4_LIMIT * (1.0 - BESIDE),
        RK4_LIMIT * (1.0 + BESIDE)
    )]
    x: f64,
) {
    // Where the energy falls by a factor of 4 a step, so few steps that it stays a normal number.
    let steps = if x == 2.449_489_742_783_178 { 200 } else { 2000 };
    for pendulum in pendulums() {
        let grid = grid(&pendulum, x, steps);
        let x2 = pendulum.frequency_squared() * grid.step() * grid.step();
        let a_step = (-x2.powi(3) / 72.0 + x2.powi(4) / 576.0).ln_1p();
        let law = steps as f64 * a_step;
        let linear = log_energy_change(&LinearOscillator::new(pendulum), &Rk4, &grid);
        assert!((linear - law).abs() < roundings(steps), "{linear} for {law}");
        let swing = log_energy_change(&pendulum, &Rk4, &grid);
        // Just outside, it grows by e^2.8 = 17 in energy, to θ² = 2e-11: that times a derivative of
        // x⁶/6 < 100.
        let nonlinear = 2e-9 * steps as f64;
        assert!((swing - law).abs() < nonlinear, "{swing} for {law}");
    }
}

/// So close to the limit the logarithm is ± x⁶δ/36 = ± 1.422e-3 a step, of either sign.
///
/// Catches: a method with another polynomial, and, as the limit is a number, a polynomial in this
/// file that is wrong in the same way as the method.
#[rstest]
#[case(1.0 - BESIDE, -1.0)]
#[case(1.0 + BESIDE, 1.0)]
fn rk4_beside_its_limit(#[case] factor: f64, #[case] sign: f64) {
    for pendulum in pendulums() {
        let grid = grid(&pendulum, RK4_LIMIT * factor, 1000);
        let change = log_energy_change(&LinearOscillator::new(pendulum), &Rk4, &grid) / 1000.0;
        // The next term is 13 δ/2 = 6.5e-4 of this one, from the second derivative, 7x⁷/72 − 5x⁵/12
        // over x⁵/36.
        assert_relative_eq!(change, sign * 512.0 / 36.0 * BESIDE, max_relative = 1e-3);
    }
}

/// Forward Euler multiplies the energy by 1 + x² at every step, however small: it has no stability
/// limit.
///
/// Catches: symplectic Euler, or an implicit step, posing as forward Euler; a damping added to hide
/// the growth.
#[rstest]
fn forward_euler_is_never_stable(#[values(1e-3, 0.03, 1.0, 2.0, RK4_LIMIT, 10.0)] x: f64) {
    let steps = if x < 0.01 { 100_000 } else { 100 };
    for pendulum in pendulums() {
        let grid = grid(&pendulum, x, steps);
        let law = steps as f64 * (pendulum.frequency_squared() * grid.step() * grid.step()).ln_1p();
        let linear = log_energy_change(&LinearOscillator::new(pendulum), &ForwardEuler, &grid);
        assert!(law > 0.05 && (linear - law).abs() < roundings(steps), "{linear} for {law}");
        if x < 0.1 {
            // The pendulum stays below 2e-6 rad: θ² of x² at each step is negligible.
            let swing = log_energy_change(&pendulum, &ForwardEuler, &grid);
            assert!((swing - law).abs() < roundings(steps), "{swing} for {law}");
        }
    }
}
