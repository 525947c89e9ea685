//! Single measurements behind sentences of the paper: each a function of the parameters that the
//! sentence leaves open.

use pendula::exact::{Motion, period};
use pendula::metrics::order::slopes;
use pendula::metrics::{AngleError, EnergyDrift};
use pendula::systems::Hamiltonian;
use pendula::{AnyMethod, Grid, LinearOscillator, Pendulum, Phase};

use crate::experiments::{MethodRef, grid, released};

const PENDULUM: Pendulum = Pendulum::PAPER;

/// Largest energy error over `steps` steps of `step` (s) from rest at `theta_0` (rad), in J.
pub fn energy_drift(method: &dyn AnyMethod, theta_0: f64, step: f64, steps: u64) -> f64 {
    let mut drift = EnergyDrift::new(&PENDULUM);
    let grid = Grid::new(step, steps).expect("a positive step");
    method.run(&PENDULUM, released(theta_0), &grid, &mut drift);
    drift.largest()
}

/// Energy above the bottom (J) after `steps` steps of `step` (s) from rest at `theta_0` (rad).
pub fn last_energy(method: &dyn AnyMethod, theta_0: f64, step: f64, steps: u64) -> f64 {
    let grid = Grid::new(step, steps).expect("a positive step");
    PENDULUM.energy(method.run(&PENDULUM, released(theta_0), &grid, &mut ()))
}

/// Time (s) of the first step that lowers the energy, from rest at `theta_0` (rad); `None` if no
/// step within `duration` (s) does.
pub fn first_fall(method: &dyn AnyMethod, theta_0: f64, step: f64, duration: f64) -> Option<f64> {
    let (mut before, mut fall) = (f64::NEG_INFINITY, None);
    let mut watch = |_, t, z| {
        let energy = PENDULUM.energy(z);
        if energy < before {
            fall.get_or_insert(t);
        }
        before = energy;
    };
    method.run(&PENDULUM, released(theta_0), &grid(duration, step), &mut watch);
    fall
}

/// Largest and root-mean-square angle error against the small-angle formula, divided by θ₀, from
/// rest at `theta_0` (rad) over 10 s in steps of `step` (s).
pub fn normalised_formula_error(method: &dyn AnyMethod, theta_0: f64, step: f64) -> (f64, f64) {
    let start = released(theta_0);
    let formula = LinearOscillator::new(PENDULUM);
    let mut error = AngleError::new(|t| formula.exact(start, t).theta);
    method.run(&PENDULUM, start, &grid(10.0, step), &mut error);
    (error.largest() / theta_0, error.root_mean_square() / theta_0)
}

/// Root-mean-square angle error (rad) against the exact solution over 10 s from 1 rad, for
/// `evaluations` evaluations of the force.
pub fn error_for_work(method: MethodRef, evaluations: u64) -> f64 {
    let start = released(1.0);
    let truth = Motion::new(&PENDULUM, start).expect("a finite start");
    let steps = evaluations / method.info().force_evaluations;
    let grid = Grid::new(10.0 / steps as f64, steps).expect("a positive step");
    let mut error = AngleError::new(|t| truth.at(t).theta);
    method.run(&PENDULUM, start, &grid, &mut error);
    error.root_mean_square()
}

/// Slope of the error of a single step against the step: one more than the order. From 1 rad and 1
/// rad/s, between 0.02 s and 0.01 s.
pub fn one_step_slope(method: &dyn AnyMethod) -> f64 {
    let start = Phase { theta: 1.0, omega: 1.0 };
    let truth = Motion::new(&PENDULUM, start).expect("a finite start");
    let steps = [0.02, 0.01];
    let errors = steps.map(|h| {
        let z = method.run(&PENDULUM, start, &grid(h, h), &mut ());
        (z.theta - truth.at(h).theta).abs().max((z.omega - truth.at(h).omega).abs())
    });
    slopes(&steps, &errors, 0.0).flatten().next().unwrap_or(f64::NAN)
}

/// How far an orbit misses its start after one exact period in steps of about 0.01 s, from rest at
/// `theta_0` (rad): the distances |Δθ| (rad) and |Δω| (rad/s), and the energy lost (J).
pub fn closure(method: &dyn AnyMethod, theta_0: f64) -> (f64, f64, f64) {
    let start = released(theta_0);
    let period = period(&PENDULUM, theta_0).expect("a finite angle");
    let steps = libm::round(period / 0.01);
    let grid = Grid::new(period / steps, steps as u64).expect("a positive step");
    let end = method.run(&PENDULUM, start, &grid, &mut ());
    let lost = PENDULUM.energy(start) - PENDULUM.energy(end);
    ((end.theta - theta_0).abs(), end.omega.abs(), lost)
}

/// The waveform from rest at `theta_0` (rad): the fraction of time beyond nine tenths of the
/// amplitude, and the third harmonic over the first, in size.
pub fn waveform(theta_0: f64) -> (f64, f64) {
    const SAMPLES: u32 = 4096;
    let motion = Motion::new(&PENDULUM, released(theta_0)).expect("a finite start");
    let period = motion.period().expect("it swings");
    let (mut beyond, mut first, mut third) = (0, 0.0, 0.0);
    for n in 0..SAMPLES {
        let turn = f64::from(n) / f64::from(SAMPLES);
        let theta = motion.at(turn * period).theta;
        let phase = 2.0 * core::f64::consts::PI * turn;
        beyond += u32::from(theta.abs() > 0.9 * theta_0);
        first += theta * pendula::arithmetic::sine::cos(phase);
        third += theta * pendula::arithmetic::sine::cos(3.0 * phase);
    }
    (f64::from(beyond) / f64::from(SAMPLES), (third / first).abs())
}

/// The largest speed ωh (rad a step) of `method` within `steps` steps of the size at which the
/// standard map has the parameter K = (g/L) h²: from a state beside the unstable equilibrium, in
/// the chaotic layer.
pub fn chaotic_speed(method: &dyn AnyMethod, k: f64, steps: u64) -> f64 {
    let step = libm::sqrt(k / PENDULUM.frequency_squared());
    let start = Phase { theta: core::f64::consts::PI - 1e-3, omega: 0.0 };
    let mut fastest = 0.0_f64;
    let grid = Grid::new(step, steps).expect("a positive step");
    method.run(&PENDULUM, start, &grid, &mut |_, _, z: Phase| {
        fastest = fastest.max(z.omega.abs() * step);
    });
    fastest
}

#[cfg(test)]
mod tests {
    use pendula::methods::{ForwardEuler, Rk4};

    use super::*;

    /// Catches: a loss with the wrong sign, or one that is not a difference.
    #[test]
    fn what_an_orbit_loses_is_a_difference() {
        let (_, _, lost) = closure(&Rk4, 2.0);
        assert!(lost > 0.0 && lost < 1e-6, "RK4 loses little: {lost:e}");
        let (theta, omega, gained) = closure(&ForwardEuler, 2.0);
        assert!(gained < -1.0 && theta > 0.0 && omega > 0.0, "forward Euler gains: {gained}");
    }
}
