//! Reversal: forward, flip the velocity, forward again, flip. A symmetric method returns to the
//! start.

use super::{CheckResult, beyond, flipped, near, run};
use pendula::{AnyMethod, Pendulum, Phase};

/// The error of the angle after 10⁵ steps out and 10⁵ back, by rounding, which is not reversible.
///
/// A step rounds q = ω/ω₀ by 1e-16, with either sign: the energy makes a random walk of √(2·10⁵) ·
/// 1e-16 = 5e-14, and with it the angle at which the pendulum comes to rest. Störmer–Verlet is off
/// by 1.5e-14 rad.
pub const ANGLE_TOLERANCE: f64 = 1e-13;

/// The frequency of a swing falls with its energy, by ⅛ of it, so that the random walk of the
/// energy adds up in the phase, to which ω is sensitive at rest: ⅛ · x · (2·10⁵)^1.5/√3 · 1e-16 =
/// 2e-11, for the larger x = ω₀h, 0.031; with a margin of 5.
pub const VELOCITY_TOLERANCE: f64 = 1e-10;

/// The start of every run.
pub const START: Phase = Phase::at_rest(1.0);

/// The state after 1000 s in steps of 0.01 s and as long a way back.
pub fn there_and_back(method: &dyn AnyMethod, pendulum: &Pendulum) -> Phase {
    there_and_back_in(method, pendulum, 0.01, 100_000)
}

fn there_and_back_in(method: &dyn AnyMethod, pendulum: &Pendulum, step: f64, steps: u64) -> Phase {
    let there = run(method, pendulum, START, step, steps);
    flipped(run(method, pendulum, flipped(there), step, steps))
}

/// Whether the way back leads to the start or not, as the entry says.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    for pendulum in [Pendulum::PAPER, super::pendulum()] {
        let frequency = pendulum.small_angle_frequency();
        let misses = |back: Phase| {
            [(back.theta - START.theta).abs(), (back.omega - START.omega).abs() / frequency]
        };
        if method.info().symmetric {
            let [angle, velocity] = misses(there_and_back(method, &pendulum));
            let after = "after 100 000 steps of 0.01 s and as many back";
            let what = format_args!("{after} the miss of the angle (rad)");
            near(what, angle, 0.0, ANGLE_TOLERANCE)?;
            let what = format_args!("{after} the miss of the velocity (ω₀)");
            near(what, velocity, 0.0, VELOCITY_TOLERANCE)?;
            continue;
        }
        // Of the paper's methods RK4 is the closest to symmetric: it misses by 1e-6 rad, or with
        // g/L = 2.5 by 4e-8. The higher the order, the longer the step at which the miss shows; at
        // order 24, x = 1 has local errors of 1e-10 and more. Longer steps are fewer, and round
        // less.
        let steps = (0..).map(|k| (0.01 * f64::from(1 << k), 100_000 >> k));
        let misses = steps.take_while(|(step, _)| step * frequency < 1.1).map(|(step, steps)| {
            misses(there_and_back_in(method, &pendulum, step, steps)).iter().sum::<f64>()
        });
        let largest = misses.fold(0.0, f64::max);
        beyond(
            "symmetric after all: the largest miss, in steps from 0.01 s on",
            largest,
            10.0 * VELOCITY_TOLERANCE,
        )?;
    }
    Ok(())
}
