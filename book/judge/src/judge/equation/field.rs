//! What a step does as it becomes short: where it starts from, and the rates of angle and velocity.

use crate::integrator::Request;
use crate::judge::probe::Probe;
use crate::judge::series;
use crate::judge::verdict::{Measured, Trouble};
use pendula::systems::Phase;

/// Angle (rad) and velocity over √(g/L) of the starts: no two are mirror images or share an angle,
/// none lies near π/2, where a tangent has its pole, and the short steps from them stay within a
/// turn.
pub const STARTS: [[f64; 2]; 14] = [
    [1.0, 0.0],
    [0.4, 0.3],
    [-0.45, -0.9],
    [0.9, -0.5],
    [-0.85, 0.8],
    [1.2, 1.1],
    [-1.15, -0.2],
    [1.95, -1.2],
    [-2.0, 0.6],
    [2.2, 0.4],
    [-2.3, -0.7],
    [2.6, -0.3],
    [0.15, 1.4],
    [-0.1, -1.5],
];

/// The lengths of steps, in units of 1/√(g/L), by which the limit is told.
const NODES: usize = 8;
/// The longest of them. A limit is told the better from rounding by long steps, and from the higher
/// powers of the step by short ones.
const LONGEST: [f64; 5] = [0.8, 0.3, 0.1, 0.03, 0.01];

/// The way of a step, as a series in x = h √(g/L), for each of [`STARTS`]: in θ (rad) and in
/// ω/√(g/L).
#[derive(Clone, Debug)]
pub struct Field {
    /// What is left of the way as the step becomes short: nothing, of a method.
    pub jump: Vec<[f64; 2]>,
    /// The factors of x: ω/√(g/L) and −sin θ, if the equation is the pendulum's.
    pub rate: Vec<[f64; 2]>,
    /// The factors of x².
    pub second: Vec<[f64; 2]>,
    /// What the three are known to.
    pub known_to: [f64; 3],
}

/// The coefficients by steps of one length.
struct Told {
    by_power: [Vec<[f64; 2]>; 3],
    /// What rounding may make of them.
    noise: [f64; 3],
}

/// Starts at rest that lie far from the bottom, where the sine of a small angle taken in degrees is
/// not the angle.
pub const FAR: [[f64; 2]; 2] = [[40.0, 0.0], [-70.0, 0.0]];

/// The field at this g/L (1/s²), by the step after so many others.
pub fn measure(probe: &Probe<'_>, g_over_l: f64, after: usize) -> Measured<Field> {
    from(probe, &STARTS, g_over_l, after)
}

/// The same, from other starts.
pub fn from(
    probe: &Probe<'_>,
    starts: &[[f64; 2]],
    g_over_l: f64,
    after: usize,
) -> Measured<Field> {
    let mut told = Vec::new();
    let mut refused = None;
    for longest in LONGEST {
        match coefficients(probe, starts, g_over_l, after, longest) {
            Ok(found) => told.push(found),
            // An implicit method may have no solution in a long step.
            Err(trouble @ (Trouble::NoAnswer(_) | Trouble::Lost(_) | Trouble::NotFinite)) => {
                refused = Some(trouble)
            }
            Err(trouble) => return Err(trouble),
        }
    }
    if told.len() < 2 {
        return Err(refused.unwrap_or(Trouble::NotFinite));
    }
    let mut known_to = [0.0; 3];
    let best: [Vec<[f64; 2]>; 3] = core::array::from_fn(|power| {
        // The larger of what two lengths disagree by and of what rounding makes, three times; at
        // the length at which that is least.
        let known = |k: usize| {
            let [a, b] = [&told[k], &told[k + 1]].map(|told| told.by_power[power].as_flattened());
            let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, libm::fmaximum);
            3.0 * libm::fmaximum(apart, told[k].noise[power])
        };
        let all = (0..told.len() - 1).map(|k| (k, known(k))).filter(|(_, known)| !known.is_nan());
        let (k, known) = all.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, f64::INFINITY));
        known_to[power] = known;
        told[k].by_power[power].clone()
    });
    let [jump, rate, second] = best;
    Ok(Field { jump, rate, second, known_to })
}

fn coefficients(
    probe: &Probe<'_>,
    starts: &[[f64; 2]],
    g_over_l: f64,
    after: usize,
    longest: f64,
) -> Measured<Told> {
    let frequency = libm::sqrt(g_over_l);
    let nodes = series::nodes::<NODES>(longest);
    let weights = series::weights::<NODES, 3>(&nodes);
    // States of several times the size of those by which rounding is measured are rounded, each by
    // chance.
    let size = starts.iter().map(|[theta, _]| theta.abs()).fold(4.0, f64::max);
    let rounding = size * probe.rounding + probe.tolerance_a_step();
    let noise = weights.map(|row| rounding * libm::sqrt(row.iter().map(|w| w * w).sum()));
    let mut by_power: [Vec<[f64; 2]>; 3] = Default::default();
    for &[theta, q] in starts {
        let start = Phase { theta, omega: q * frequency };
        let mut sums = [[0.0; 2]; 3];
        for (i, x) in nodes.into_iter().enumerate() {
            let run = Request::run(start, x / frequency, after as u64 + 1).with(g_over_l);
            let states = probe.states(run)?;
            let (end, before) = (states[after], if after == 0 { start } else { states[after - 1] });
            let way = [end.theta - before.theta, (end.omega - before.omega) / frequency];
            for (sum, row) in sums.iter_mut().zip(&weights) {
                for part in 0..2 {
                    sum[part] += row[i] * way[part];
                }
            }
        }
        for (all, sum) in by_power.iter_mut().zip(sums) {
            all.push(sum);
        }
    }
    Ok(Told { by_power, noise })
}

impl Field {
    /// By how much this is off the pendulum's field at most, in parts of what it is known to.
    pub fn off(&self) -> f64 {
        let jump =
            self.jump.as_flattened().iter().fold(0.0, |most, x| libm::fmaximum(most, x.abs()));
        let rates = self.rate.iter().zip(STARTS);
        let off = rates.fold(0.0, |most: f64, (rate, [theta, q])| {
            let apart = [(rate[0] - q).abs(), (rate[1] + libm::sin(theta)).abs()];
            apart.into_iter().fold(most, libm::fmaximum)
        });
        let [jump_known, rate_known, _] = self.known_to;
        // In parts of what is known, the larger.
        let (jump, off) = (jump / jump_known, off / rate_known);
        libm::fmaximum(jump, off)
    }
}
