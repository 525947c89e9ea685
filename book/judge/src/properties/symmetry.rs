//! The symmetries of the pendulum: the mirror, the units of mass, length and time, and a whole
//! turn.

use core::f64::consts::TAU;

use super::{CheckResult, near, pendulum, same, samples};
use pendula::{AnyMethod, Pendulum, Phase};

const STEP: f64 = 0.05;
const STEPS: u64 = 200;

/// To and fro, and over the top.
const STARTS: [Phase; 2] = [Phase { theta: 1.2, omega: 0.7 }, Phase { theta: -0.4, omega: 5.0 }];

fn built(gravity: f64, length: f64, mass: f64) -> Pendulum {
    Pendulum::new(gravity, length, mass).expect("a pendulum")
}

/// θ → −θ, ω → −ω: the same bits but for the signs.
pub fn check_mirror(method: &dyn AnyMethod) -> CheckResult {
    for start in STARTS {
        let mirrored: Vec<Phase> = samples(method, &pendulum(), start * -1.0, STEP, STEPS)
            .into_iter()
            .map(|z| z * -1.0)
            .collect();
        same("the mirror image", mirrored, samples(method, &pendulum(), start, STEP, STEPS))?;
    }
    Ok(())
}

/// The motion depends on g/L, and not on the mass: with another mass, and with g and L twice as
/// large, the bits are the same.
pub fn check_mass_and_length(method: &dyn AnyMethod) -> CheckResult {
    for start in STARTS {
        let of = |pendulum: Pendulum| samples(method, &pendulum, start, STEP, STEPS);
        same("another mass", of(built(5.0, 2.0, 17.0)), of(pendulum()))?;
        same("the same g/L", of(built(10.0, 4.0, 3.0)), of(pendulum()))?;
    }
    Ok(())
}

/// Time in another unit: with the same (g/L) h², θ is the same. Scaling by powers of two is exact,
/// so that the bits agree.
pub fn check_time(method: &dyn AnyMethod) -> CheckResult {
    for start in STARTS {
        let slow = samples(method, &pendulum(), start, STEP, STEPS);
        for (unit, tolerance) in [
            (8.0, 0.0),
            (0.25, 0.0),
            // Roundings differ, in each step by ε/2 of the largest angle, 20 rad, and as much in
            // phase; errors in phase grow linearly with the number of steps, 200, and add up like
            // √200.
            (3.0, 20.0 * 200.0 * 14.0 * f64::EPSILON),
        ] {
            let pendulum = built(5.0 * unit * unit, 2.0, 3.0);
            let hurried = Phase { omega: start.omega * unit, ..start };
            let fast = samples(method, &pendulum, hurried, STEP / unit, STEPS);
            same("samples", fast.len(), slow.len())?;
            for (fast, slow) in fast.into_iter().zip(&slow) {
                let what = format_args!("θ or ω with time in 1/{unit} s");
                near(what, fast.theta, slow.theta, tolerance)?;
                near(what, fast.omega / unit, slow.omega, tolerance)?;
            }
        }
    }
    Ok(())
}

/// θ → θ + 2πk: whole turns higher, and otherwise the same.
pub fn check_turns(method: &dyn AnyMethod) -> CheckResult {
    for start in STARTS {
        let here = samples(method, &pendulum(), start, STEP, STEPS);
        for turns in [1.0, -3.0, 100.0] {
            let shift = TAU * turns;
            // θ is rounded to the last digit of the sum, 1.1e-13 at 700 rad, in the start and in
            // each step: 200 times at worst, and each rounding grows at most linearly with the 200
            // steps of x = 0.08.
            let tolerance = (shift.abs() + 50.0) * f64::EPSILON * 200.0 * (200.0 * 0.08);
            let start = Phase { theta: start.theta + shift, ..start };
            let there = samples(method, &pendulum(), start, STEP, STEPS);
            same("samples", there.len(), here.len())?;
            for (there, here) in there.into_iter().zip(&here) {
                let what = format_args!("θ or ω, {turns} turns on");
                near(what, there.theta - shift, here.theta, tolerance)?;
                near(what, there.omega, here.omega, tolerance)?;
            }
        }
    }
    Ok(())
}

/// Whether the motion has the symmetries of the pendulum: mirror, mass and length, unit of time,
/// whole turns.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    check_mirror(method)?;
    check_mass_and_length(method)?;
    check_time(method)?;
    check_turns(method)
}
