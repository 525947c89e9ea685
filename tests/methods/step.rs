//! One step of each of the paper's methods against its equations, written out by hand; those of the
//! others are in `known_answers.rs`.
//!
//! g/L = 2.5, so that g in place of g/L or a forgotten L shows, and the step is large, so that
//! every coefficient counts.

use approx::assert_relative_eq;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{Grid, LinearOscillator, Method, Phase, System, integrate};
use pendula_judge::properties::pendulum;

const H: f64 = 0.3;
const Z: Phase = Phase { theta: 0.8, omega: -0.7 };
/// A few roundings of 1.1e-16 each, in another order than the library's.
const ROUNDING: f64 = 1e-15;

fn alpha(theta: f64) -> f64 {
    -2.5 * theta.sin()
}

fn step<S: System<State = Phase>>(system: &S, method: &impl Method<S>, z: Phase) -> Phase {
    integrate(system, method, z, &Grid::new(H, 1).unwrap())
}

fn assert_same(z: Phase, theta: f64, omega: f64) {
    assert_relative_eq!(z.theta, theta, max_relative = ROUNDING);
    assert_relative_eq!(z.omega, omega, max_relative = ROUNDING);
}

/// Paper, Eqs. 6–7. Catches: the new velocity in the angle, which would be symplectic Euler.
#[test]
fn forward_euler_is_equations_6_and_7() {
    let z = step(&pendulum(), &ForwardEuler, Z);
    assert_same(z, 0.8 + H * -0.7, -0.7 + H * alpha(0.8));
}

/// Paper, Eqs. 8–9. Catches: the old velocity in the angle, and drift before kick.
#[test]
fn symplectic_euler_is_equations_8_and_9() {
    let z = step(&pendulum(), &SymplecticEuler, Z);
    let omega = -0.7 + H * alpha(0.8);
    assert_same(z, 0.8 + H * omega, omega);
}

/// Paper, Eqs. 10–12. Catches: the position form, a stale force, a missing half.
#[test]
fn stormer_verlet_is_equations_10_to_12() {
    let z = step(&pendulum(), &StormerVerlet, Z);
    let theta = 0.8 + H * -0.7 + 0.5 * H * H * alpha(0.8);
    assert_same(z, theta, -0.7 + 0.5 * H * (alpha(0.8) + alpha(theta)));
}

/// Paper, Eqs. 10–12, twice. Catches: a force carried from step to step that is not the force at
/// the new angle.
#[test]
fn stormer_verlet_hands_on_the_right_force() {
    let two = Grid::new(H, 2).unwrap();
    let z = integrate(&pendulum(), &StormerVerlet, Z, &two);
    let twice = step(&pendulum(), &StormerVerlet, step(&pendulum(), &StormerVerlet, Z));
    // In one run two half kicks are merged into one kick: the same numbers up to a rounding.
    assert_same(z, twice.theta, twice.omega);
}

/// Paper, Algorithm 1. Catches: any of its coefficients changed, stages out of order.
#[test]
fn rk4_is_algorithm_1() {
    let f = |z: [f64; 2]| [z[1], alpha(z[0])];
    let along = |k: [f64; 2], h: f64| [0.8 + h * k[0], -0.7 + h * k[1]];
    let k1 = f([0.8, -0.7]);
    let k2 = f(along(k1, H / 2.0));
    let k3 = f(along(k2, H / 2.0));
    let k4 = f(along(k3, H));
    let mean = |i: usize| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0;
    assert_same(step(&pendulum(), &Rk4, Z), 0.8 + H * mean(0), -0.7 + H * mean(1));
}

/// On the linear oscillator a step of RK4 is the Taylor polynomial of degree 4 of a rotation by x =
/// ω₀h.
///
/// Catches: a stage from another one than the algorithm's, a weight off by a rounding's few units.
#[test]
fn rk4_on_the_linear_oscillator_is_a_taylor_polynomial() {
    let linear = LinearOscillator::new(pendulum());
    let z = step(&linear, &Rk4, Phase::at_rest(1.0));
    let x2 = 2.5 * H * H;
    assert_same(z, 1.0 - x2 / 2.0 + x2 * x2 / 24.0, -2.5 * H * (1.0 - x2 / 6.0));
}
