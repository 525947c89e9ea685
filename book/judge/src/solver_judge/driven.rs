//! Runs under a drive: whether the stages know the time.

use super::asked::Asked;
use super::ladder::Ladder;
use crate::judge::probe::pendulum;
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::stranger::{Drive, driven as system};
use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::Dop853;
use pendula::systems::Phase;

/// The force A cos Ωt of these runs, A in units of g/L and Ω in units of ω₀: nearly half as strong
/// as gravity, and off resonance.
const DRIVE: [f64; 2] = [0.4, 0.65];
/// θ and ω/ω₀ at their start.
const START: [f64; 2] = [-0.7, 0.6];
/// Their ends, ω₀t.
const ENDS: [f64; 2] = [9.0, 18.0];

/// The worst of runs at several tolerances. A drive makes steps shorter, and errors of the same
/// tolerance somewhat larger: thirty times those of free runs are allowed.
pub fn finding(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let scenes = asked.scenes;
    let frequency = scenes.frequency();
    let drive = Drive { amplitude: DRIVE[0] * scenes.g_over_l, frequency: DRIVE[1] * frequency };
    let start = scenes.state(START[0], START[1]);
    let ends = ENDS.map(|until| until / frequency);
    let truth = exact(scenes.g_over_l, start, drive, ends)?;
    let mut worst: Option<(f64, f64, f64)> = None;
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let allowed = ladder.error_at(tolerance);
        // Not reached, or nothing to compare with.
        if !(allowed > 0.0 && allowed < 0.1) {
            continue;
        }
        let bound = 30.0 * allowed + 1e-11;
        for (until, exact) in ends.into_iter().zip(truth) {
            let request = scenes.run(start, tolerance).driven(drive).to(&[until]);
            let error = scenes.apart(asked.reply(&request)?.states[0], exact);
            if worst.is_none_or(|worst| error / bound > worst.0 / worst.1) {
                worst = Some((error, bound, tolerance));
            }
        }
    }
    let unknown = || Trouble::NoAnswer("no run is accurate enough to tell".to_string());
    let (error, bound, tolerance) = worst.ok_or_else(unknown)?;
    let verdict = Verdict::of(error, bound, 10.0 * bound);
    let measured = format!(
        "under a force A cos Ωt off by {} rad at a tolerance of {}",
        scientific(error),
        about(tolerance)
    );
    let why = format!("thirty times what a free run errs there: {}", about(bound));
    Ok(Finding { measured, why, ..Finding::number(error, "rad", bound, verdict) })
}

/// The driven motion by the library's method of order 8 with a tolerance of 10⁻¹⁴, in units of time
/// in which ω₀ is 1: off by less than 10⁻¹² rad, as runs at tighter tolerances show.
fn exact(g_over_l: f64, start: Phase, drive: Drive, ends: [f64; 2]) -> Measured<[Phase; 2]> {
    let unknown = |error: &dyn core::fmt::Display| Trouble::NoAnswer(error.to_string());
    let frequency = libm::sqrt(g_over_l);
    let drive =
        Drive { amplitude: drive.amplitude / g_over_l, frequency: drive.frequency / frequency };
    let driven = system(pendulum(1.0), drive).map_err(|fault| unknown(&fault))?;
    let tolerance = Tolerance::uniform(1e-14).map_err(|error| unknown(&error))?;
    let adaptive = Adaptive::new(Dop853, tolerance);
    let scaled = Phase { omega: start.omega / frequency, ..start };
    let mut states = [scaled; 2];
    for (state, until) in states.iter_mut().zip(ends) {
        let end = adaptive.integrate(&driven, scaled, 0.0, until * frequency, &mut ());
        let end = end.map_err(|error| unknown(&error))?.0;
        *state = Phase { omega: end.omega * frequency, ..end };
    }
    Ok(states)
}
