//! Beyond the states and steps of most requests: a fast rotation, a swing of a fraction of a
//! degree, a step of more than 1/ω₀. Programs are right in one range and wrong beyond it where a
//! velocity is limited, where a body is put to sleep, where a step is cut into shorter ones.

use super::probe::{G_OVER_L, Probe, distance, exact, frequency, states_after, step};
use super::verdict::{Measured, Trouble, Verdict};
use crate::finding::{Beyond, Finding, Measurement};
use crate::integrator::Request;
use pendula::method_named;
use pendula::systems::Phase;

/// What was found beyond; `None` for what the integrator does not answer, or cannot show.
#[derive(Clone, Copy, Debug, Default)]
pub struct Range {
    /// With which power of the step its error falls in a fast rotation.
    pub fast: Option<Fast>,
    /// By how much a small swing is another one than a larger one, in its proportion.
    pub small: Option<Apart>,
    /// By how much a long step is another one than its method's.
    pub long: Option<Apart>,
}

/// The error of a step, from a fast rotation and from usual states.
#[derive(Clone, Copy, Debug)]
pub struct Fast {
    /// The velocity, in ω₀.
    pub velocity: f64,
    /// The power of the step with which its error falls there.
    pub power: f64,
    /// And from usual states, the least.
    pub usual: f64,
}

/// A difference that should not be.
#[derive(Clone, Copy, Debug, Default)]
pub struct Apart {
    /// Where: an amplitude (rad), or x = ω₀h.
    pub at: f64,
    /// The difference: in parts of the amplitude, or in rad.
    pub apart: f64,
    /// What it may be.
    pub bound: f64,
}

impl Apart {
    fn worse(a: Option<Self>, b: Self) -> Option<Self> {
        let weight = |x: &Self| x.apart / x.bound;
        match a {
            // Written so that a NaN is kept.
            Some(a) if weight(&b) <= weight(&a) => Some(a),
            _ => Some(b),
        }
    }
}

/// What is found beyond, of a method that has at most this order, or none, and is perhaps one of
/// the library, of this name.
pub fn measure(probe: &Probe<'_>, order: Option<f64>, name: Option<&str>) -> Measured<Range> {
    let range = Range {
        fast: match order {
            Some(order) => answered(fast(probe, order))?,
            None => None,
        },
        small: answered(small(probe))?,
        long: answered(long(probe, name))?,
    };
    if range.fast.is_none() && range.small.is_none() && range.long.is_none() {
        let why = "it answers nothing beyond the usual states and steps, or too coarsely";
        return Err(Trouble::NoAnswer(why.to_string()));
    }
    Ok(range)
}

/// `None` for what it does not answer; states that are no numbers are an answer.
fn answered<T>(found: Measured<Option<T>>) -> Measured<Option<T>> {
    match found {
        Err(Trouble::NoAnswer(_)) => Ok(None),
        found => found,
    }
}

/// Velocities of a fast rotation, in ω₀.
const VELOCITIES: [f64; 3] = [4.5, -8.0, 30.0];

/// Usual states, of θ (rad) and ω (ω₀).
const USUAL: [[f64; 2]; 3] = [[1.0, 0.5], [-2.0, 0.8], [0.4, -1.3]];

/// The power with which the largest error of a step from these states falls, as far as it is no
/// rounding: by steps in which the angle changes by 0.8, 0.4, 0.2 and 0.1 rad at most, the finest
/// pair that shows it. The error at one state may pass zero.
fn power(probe: &Probe<'_>, states: &[[f64; 2]]) -> Measured<Option<f64>> {
    let mut errors = [0.0_f64; 4];
    let mut fastest = 1.0_f64;
    for &[theta, q] in states {
        let start = Phase { theta, omega: q * frequency() };
        let truth = exact(G_OVER_L, start);
        fastest = fastest.max(q.abs());
        for (error, turned) in errors.iter_mut().zip([0.8, 0.4, 0.2, 0.1]) {
            let h = step(turned / q.abs().max(1.0));
            let end = probe.end(Request::run(start, h, 1))?;
            *error = libm::fmaximum(*error, distance(end, truth.at(h)));
        }
    }
    // A slope is bent by less than log₂(1 + 1/30) = 0.05.
    let rounding = 30.0 * (probe.rounding + probe.tolerance_a_step()) * (1.0 + fastest);
    let shown = errors.windows(2).rev().find(|pair| pair[1] > rounding);
    Ok(shown.map(|pair| libm::log2(pair[0] / pair[1])))
}

/// A step from a fast rotation has an error of the same power of the step as from usual states, or
/// of a higher one; from usual states it may be more than that of the order, where a term of that
/// order is small.
fn fast(probe: &Probe<'_>, order: f64) -> Measured<Option<Fast>> {
    // A step whose error does not fall with h² is no step of this pendulum anywhere.
    let usual = power(probe, &USUAL)?.filter(|usual| *usual > 1.3);
    let Some(usual) = usual.map(|usual| usual.min(order + 1.0)) else { return Ok(None) };
    let mut worst: Option<Fast> = None;
    for velocity in VELOCITIES {
        let power = power(probe, &[[0.3, velocity], [-1.9, velocity]])?;
        let less = |power: &f64| worst.is_none_or(|known: Fast| *power < known.power);
        if let Some(power) = power.filter(less) {
            worst = Some(Fast { velocity, power, usual });
        }
    }
    Ok(worst)
}

/// Amplitudes of small swings (rad), and that of the swing with which they are compared.
const AMPLITUDES: [f64; 2] = [1e-2, 1e-4];
const LARGER: f64 = 0.1;

/// A small swing is a larger one in proportion: θ̈ = −(g/L) θ but for θ²/6 of it, which makes a
/// swing of 0.1 rad slower by 0.1²/16, in 150 steps of x = 0.1 late by 0.01 rad of its phase. Five
/// times that is allowed, and what rounding adds.
fn small(probe: &Probe<'_>) -> Measured<Option<Apart>> {
    const STEPS: u64 = 150;
    const X: f64 = 0.1;
    // From both sides: what pushes to one of them is told by the mirror.
    let swing = |amplitude: f64| -> Measured<Vec<Phase>> {
        let from = |theta| probe.states(Request::run(Phase { theta, omega: 0.0 }, step(X), STEPS));
        let (right, left) = (from(amplitude)?, from(-amplitude)?);
        Ok(right.into_iter().zip(left).map(|(a, b)| (a - b) * (0.5 / amplitude)).collect())
    };
    let larger = swing(LARGER)?;
    let size = larger.iter().map(|z| distance(*z, Phase::default())).fold(1.0, libm::fmaximum);
    let mut worst = None;
    for at in AMPLITUDES {
        let bound = 0.05 * size + probe.bound(STEPS, X) / at;
        if bound > 0.3 * size {
            continue;
        }
        let pairs = larger.iter().zip(swing(at)?);
        let apart = pairs.map(|(a, b)| distance(*a, b)).fold(0.0, libm::fmaximum);
        worst = Apart::worse(worst, Apart { at, apart, bound });
    }
    Ok(worst)
}

/// Long steps, x = ω₀h, of which the exact motion tells nothing, and short ones from a fast
/// rotation, of which it tells little: as those of the method, if it is an explicit one of the
/// library.
fn long(probe: &Probe<'_>, name: Option<&str>) -> Measured<Option<Apart>> {
    const COUNT: u64 = 2;
    let Some(method) = name.and_then(method_named).filter(|method| !method.info().implicit) else {
        return Ok(None);
    };
    let mut worst = None;
    let fast = VELOCITIES.map(|q| Phase { theta: 0.3, omega: q * frequency() });
    let slow = [Phase { theta: 1.0, omega: 0.7 }, Phase { theta: -2.4, omega: 3.0 }];
    for (at, starts) in [(1.3, &slow[..]), (1.9, &slow), (0.01, &fast)] {
        for &start in starts {
            let Some(own) = states_after(method, G_OVER_L, start, step(at), COUNT) else {
                continue;
            };
            let own: Vec<Phase> = own.into_iter().filter(|z| z.theta.is_finite()).collect();
            let states = probe.states(Request::run(start, step(at), COUNT))?;
            // As where names are given: sixteen roundings a step, of states of their size, of a
            // method whose steps make ten of one, and coefficients of up to x²⁴/24! of a series.
            let size = own.iter().map(|z| distance(*z, Phase::default())).fold(1.0, f64::max);
            let rounding = 10.0 * 16.0 * 10.0 * COUNT as f64 * probe.rounding * size;
            // And a tolerance inside it, in steps of this length as in short ones.
            let tolerance = 100.0 * probe.tolerance_a_step() + 10.0 * probe.in_long_steps();
            let bound = rounding + COUNT as f64 * tolerance * size;
            let apart = own.iter().zip(states).map(|(a, b)| distance(*a, b));
            let apart = apart.fold(0.0, libm::fmaximum);
            worst = Apart::worse(worst, Apart { at, apart, bound });
        }
    }
    Ok(worst)
}

/// By how much a power may be less than the usual one: by what long steps bend it, which is the
/// more the higher it is.
fn less(usual: f64) -> f64 {
    (0.2 * usual).max(0.8)
}

impl Range {
    /// What is to be said of a claim that it is the same beyond.
    pub fn judge(&self) -> Finding {
        let Self { fast, small, long } = *self;
        let far = |found: &Apart| found.apart.is_nan() || found.apart > found.bound;
        let (value, bound, beyond) = match (fast, small.filter(far), long.filter(far)) {
            (Some(Fast { velocity, power, usual }), ..) if usual - power > less(usual) => {
                let beyond = Beyond::Fast { velocity: velocity.abs(), power, usual };
                (usual - power, less(usual), beyond)
            }
            (_, Some(Apart { at, apart, bound }), _) => {
                (apart, bound, Beyond::Small { amplitude: at, larger: LARGER })
            }
            (_, _, Some(Apart { at, apart, bound })) => (apart, bound, Beyond::Long { x: at }),
            _ => {
                let beyond = Beyond::Same {
                    fast: fast.is_some(),
                    small: small.is_some(),
                    long: long.is_some(),
                };
                // What decides most often: the share of a small swing that is another one.
                let share = small.unwrap_or_default();
                let measurement = Measurement::Beyond(beyond);
                let finding = Finding::number(share.apart, "", share.bound, Verdict::Holds);
                return Finding { measurement, ..finding };
            }
        };
        let measurement = Measurement::Beyond(beyond);
        Finding { measurement, ..Finding::number(value, "", bound, Verdict::Fails) }
    }
}
