//! The energy itself: the methods of the discrete gradient conserve it in steps of any length.
//!
//! Hairer, Lubich, Wanner, *Geometric Numerical Integration* (2006), Sect. V.5.

use super::{CheckResult, near, pendulum, samples};
use pendula::{AnyMethod, Hamiltonian, MethodInfo, Phase};

const STEPS: u64 = 2000;

/// What a step may add to the energy, over 1 + q² in units of m g L: the roundings of angle and
/// velocity and of an equation solved to the last digits, each of half an ε or one.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Whether the method is one that conserves the energy, in steps of any length.
pub fn is_conserved_by(method: &MethodInfo) -> bool {
    matches!(method.name, "discrete-gradient" | "cieslinski-ratkiewicz")
}

/// Whether a method that conserves the energy does so, to and fro and over the top, in steps of x =
/// ω₀h from short ones to those that are hardly solved. It accepts all other methods.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    if !is_conserved_by(&method.info()) {
        return Ok(());
    }
    let pendulum = pendulum();
    let frequency = pendulum.small_angle_frequency();
    for (theta, q) in [(1.0, 0.0), (-2.5, 0.5), (0.3, 3.0)] {
        let start = Phase { theta, omega: q * frequency };
        let energy = |z: Phase| pendulum.energy(z) / pendulum.depth();
        // The largest q², at the bottom.
        let tolerance = STEPS as f64 * ROUNDING * (1.0 + 2.0 * energy(start));
        for x in [0.05, 0.3, 1.0] {
            for z in samples(method, &pendulum, start, x / frequency, STEPS) {
                let what = format_args!("the energy from {start:?} at x = {x}");
                near(what, energy(z), energy(start), tolerance)?;
            }
        }
    }
    Ok(())
}
