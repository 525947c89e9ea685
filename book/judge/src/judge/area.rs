//! Area in phase space: the determinant of a step, by a ruler whose own error is measured.

use super::probe::{Probe, frequency, step};
use super::verdict::{Measured, Trouble, Verdict, told};
use crate::finding::{Finding, Measurement};
use crate::integrator::Request;
use crate::properties;
use pendula::systems::Phase;

/// Below and above the horizontal, moving and at rest.
const STATES: [Phase; 5] = [
    Phase { theta: 0.0, omega: 0.0 },
    Phase { theta: 0.5, omega: 1.5 },
    Phase { theta: 1.0, omega: -2.5 },
    Phase { theta: 2.5, omega: 0.4 },
    Phase { theta: -2.8, omega: 1.0 },
];

/// x = ω₀h of the steps. A step keeps area at every h or at none; the longer it is, the better a
/// defect of high order shows.
const STEPS: [f64; 3] = [0.1, 0.4, 1.0];

/// What the ruler found.
#[derive(Clone, Copy, Debug)]
pub struct Defect {
    /// det J − 1.
    pub value: f64,
    /// The ruler's own error.
    pub ruler: f64,
    /// x = ω₀h of the step.
    pub x: f64,
}

/// det J of a run, in θ and ω/ω₀, by differences of the half width `delta`.
fn determinant(probe: &Probe<'_>, run: Request, delta: f64) -> Measured<f64> {
    properties::area::determinant(delta, |right: f64, up: f64| {
        let Phase { theta, omega } = run.start;
        let start = Phase { theta: theta + right * delta, omega: omega + up * delta * frequency() };
        let end = probe.end(Request { start, ..run })?;
        Ok([end.theta, end.omega / frequency()])
    })
}

/// det J − 1 of a run, with differences of half width `delta` whose ends are rounded by `rounding`.
/// The ruler's error is what two widths disagree by, and at least what rounding makes: a derivative
/// is off by 3/2 of a rounding over its half width, four of them enter, and each is of the size of
/// the Jacobian's entries, at most 2.
fn defect(probe: &Probe<'_>, run: Request, delta: f64, rounding: f64) -> Measured<Defect> {
    let [fine, coarse] = [determinant(probe, run, delta)?, determinant(probe, run, 1.5 * delta)?];
    let ruler = (fine - coarse).abs().max(12.0 * rounding / delta);
    Ok(Defect { value: fine - 1.0, ruler, x: run.step * frequency() })
}

/// The defect of one step that stands out most from the ruler's error.
pub fn largest(probe: &Probe<'_>) -> Measured<Defect> {
    let mut largest: Option<Defect> = None;
    // Where rounding over δ equals a fifth derivative times δ⁴.
    let delta = libm::pow(probe.rounding, 0.2);
    let mut trouble = None;
    for x in STEPS {
        for z in STATES {
            match defect(probe, Request::run(z, step(x), 1), delta, probe.rounding) {
                Ok(defect) => {
                    let weight = |d: &Defect| d.value.abs() / d.ruler;
                    if largest.is_none_or(|known| weight(&defect) > weight(&known)) {
                        largest = Some(defect);
                    }
                }
                Err(Trouble::NoAnswer(_) | Trouble::NotFinite) if x > STEPS[0] => {}
                Err(other) => trouble = Some(other),
            }
        }
    }
    match (trouble, largest) {
        (Some(trouble), _) => Err(trouble),
        (None, Some(largest)) => Ok(largest),
        (None, None) => Err(Trouble::NotFinite),
    }
}

/// ln det J of `steps` steps of x = 0.02 about the bottom, a step, and the ruler's error: what a
/// step gains of the area.
pub fn gain(probe: &Probe<'_>, steps: u64) -> Measured<(f64, f64)> {
    let n = steps as f64;
    // So small that the frequency hardly differs across the ruler: over n steps the phase shears by
    // n x δ²/16, and the differences see its square. About the bottom the ends are as small as the
    // ruler, and round accordingly.
    let delta = 1e-4;
    // But where the angle inside is another one: by a random walk, from what a few steps show.
    let few = steps.min(200);
    let beside = told(probe.rounding_at_rest(0.02, few))?.unwrap_or_default();
    let rounding = libm::sqrt(n) * (probe.rounding * delta).max(beside / libm::sqrt(few as f64));
    let run = Request::run(Phase::default(), step(0.02), steps);
    let defect = defect(probe, run, delta, rounding)?;
    Ok((libm::log1p(defect.value) / n, defect.ruler / n))
}

/// A change of the area that is more than this is none that a ruler of three digits, as one of half
/// precision is, would show.
const SHOWN: f64 = 0.03;

/// What is to be said of a claim that a step keeps area.
pub fn judge(&Defect { value, ruler, x }: &Defect) -> Finding {
    // Where the map has a corner the ruler is right to nothing, and shows nothing.
    let verdict = Verdict::of(value.abs(), (10.0 * ruler).min(SHOWN), 100.0 * ruler);
    Finding {
        measurement: Measurement::Area { x, ruler },
        ..Finding::number(value, "", (10.0 * ruler).min(SHOWN), verdict)
    }
}

/// A square and its image, for a report: its centre is (1 rad, 0), its side 0.2.
pub fn square(probe: &Probe<'_>) -> Measured<([Phase; 4], [Phase; 4])> {
    let corner =
        |right: f64, up: f64| Phase { theta: 1.0 + 0.1 * right, omega: 0.1 * up * frequency() };
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let mut images = corners;
    for image in &mut images {
        *image = probe.end(Request::run(*image, step(0.7), 1))?;
    }
    Ok((corners, images))
}
