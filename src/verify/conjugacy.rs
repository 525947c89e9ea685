//! Conjugacy: n steps of Störmer–Verlet are half a kick back, n steps of symplectic Euler, and half
//! a kick; and n steps of the trapezoidal rule and half a step of forward Euler are the half step
//! and n steps of the implicit midpoint rule.
//!
//! (K½ D K½)ⁿ = K½ (D K)ⁿ K½⁻¹, where the map on the right is applied first; with E half a step of
//! forward Euler and I half a step of backward Euler, E (I E)ⁿ = (E I)ⁿ E. Hairer, Lubich, Wanner,
//! *Geometric Numerical Integration* (2006), Example V.3.6; Sect. VI.8 on conjugate methods in
//! general.

use super::{CheckResult, near, pendulum, run};
use crate::methods::{ImplicitMidpoint, StormerVerlet, SymplecticEuler, Trapezoidal};
use crate::{AnyMethod, Phase, Separable, System};

const STEP: f64 = 0.05;

/// 1000 steps differ by 1e-16 or so each. On an orbit the difference in phase grows linearly on
/// top: √n · n · ε = 7e-12 at worst, if every rounding changes the energy.
const ROUNDING: f64 = 7e-12;

/// Whether `verlet` is `euler` between two half kicks.
///
/// # Errors
/// Says where they differ, and by how much.
pub fn check_pair(verlet: &dyn AnyMethod, euler: &dyn AnyMethod) -> CheckResult {
    let pendulum = pendulum();
    let half_kick = |z: Phase, h: f64| pendulum.kick(z, pendulum.force(0.0, z), 0.5 * h);
    for start in [Phase::at_rest(1.0), Phase { theta: -2.0, omega: 3.0 }] {
        for steps in [1, 2, 1000] {
            let z = run(verlet, &pendulum, start, STEP, steps);
            let way = run(euler, &pendulum, half_kick(start, -STEP), STEP, steps);
            let other = half_kick(way, STEP);
            near(format_args!("θ after {steps} steps"), z.theta, other.theta, ROUNDING)?;
            near(format_args!("ω after {steps} steps"), z.omega, other.omega, ROUNDING)?;
        }
    }
    Ok(())
}

/// Whether n steps of `trapezoidal` and half a step of forward Euler are the half step and n steps
/// of `midpoint`.
///
/// # Errors
/// Says where they differ, and by how much.
pub fn check_implicit_pair(trapezoidal: &dyn AnyMethod, midpoint: &dyn AnyMethod) -> CheckResult {
    let pendulum = pendulum();
    let half_a_step = |z: Phase| z + pendulum.rate(0.0, z) * (0.5 * STEP);
    for start in [Phase::at_rest(1.0), Phase { theta: -2.0, omega: 3.0 }] {
        for steps in [1, 2, 1000] {
            let z = half_a_step(run(trapezoidal, &pendulum, start, STEP, steps));
            let other = run(midpoint, &pendulum, half_a_step(start), STEP, steps);
            near(format_args!("θ after {steps} steps"), z.theta, other.theta, ROUNDING)?;
            near(format_args!("ω after {steps} steps"), z.omega, other.omega, ROUNDING)?;
        }
    }
    Ok(())
}

/// Checks either of two methods with the other one of the library. It accepts all other
/// methods.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    match method.info().name {
        "stormer-verlet" => check_pair(method, &SymplecticEuler),
        "symplectic-euler" => check_pair(&StormerVerlet, method),
        "trapezoidal" => check_implicit_pair(method, &ImplicitMidpoint),
        "implicit-midpoint" => check_implicit_pair(&Trapezoidal, method),
        _ => Ok(()),
    }
}
