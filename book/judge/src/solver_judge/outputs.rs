//! States between the steps: whether they are as good as the steps.

use super::asked::{self, Asked, Power, evenly, largest_of, power, single};
use super::cause::SolverCause;
use super::found::OfSolver;
use super::ladder::Ladder;
use super::steps::by_claim;
use crate::finding::{Finding, Measurement};
use crate::judge::verdict::{Measured, Verdict};

/// States asked for in a run.
pub const OUTPUTS: u32 = 1000;
/// In each of so many parts of the run lies the end of a step, unless the steps are longer than
/// half a second.
pub const PARTS: usize = 20;
/// The tolerances through whose outputs a line is drawn: five decades.
const LAST: usize = 6;
/// Runs that end where another has outputs.
const ENDS: u32 = 10;

/// How the outputs of a run compare with its steps.
#[derive(Clone, Copy, Debug)]
struct Compared {
    tolerance: f64,
    /// The largest error of all outputs (rad).
    outputs: f64,
    /// The largest of the parts' smallest errors (rad), which are those beside the ends of steps.
    steps: f64,
    /// Those smallest errors alone, however large they are (rad).
    least: f64,
    /// What rounding may make of either (rad).
    rounding: f64,
    evaluations: Option<u64>,
}

/// The outputs at several tolerances.
#[derive(Clone, Debug)]
pub struct Outputs {
    compared: Vec<Compared>,
    /// The errors along one run: time (s) and error (rad). It's the run whose outputs are worst
    /// beside its steps, if any are too bad, or else one at a usual tolerance.
    pub run: Vec<(f64, f64)>,
    /// That run's tolerance, and the error beside the ends of its steps (rad).
    pub drawn: Option<(f64, f64)>,
    /// Whether runs that end between the steps of a longer one are as bad there as its outputs.
    interpolated_end: bool,
    /// The degree of the polynomials on which outputs lie, where they are worse than steps.
    degree: Option<usize>,
    /// Whether they are right to seven digits, and numbers of single precision.
    single: bool,
}

impl Outputs {
    /// Asks for outputs at every second tolerance of the ladder.
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let start = asked.scenes.starts[0];
        let times = evenly(OUTPUTS, asked.scenes.duration);
        let mut outputs = Self {
            compared: Vec::new(),
            run: Vec::new(),
            drawn: None,
            interpolated_end: false,
            degree: None,
            single: true,
        };
        let mut runs = Vec::new();
        for rung in ladder.quick().step_by(2) {
            let request = asked.scenes.run(start, rung.tolerance).to(&times);
            let states = asked.reply(&request)?.states;
            outputs.single &= single(&states[..states.len() - 1]);
            let errors = asked::errors(&request, &states);
            let least = |part: &[f64]| part.iter().copied().fold(f64::INFINITY, libm::fminimum);
            let steps = largest_of(errors.chunks(OUTPUTS as usize / PARTS).map(least));
            // The end itself is no state between steps.
            let between = errors.iter().take(OUTPUTS as usize - 1).copied();
            let largest = largest_of(between);
            outputs.compared.push(Compared {
                tolerance: rung.tolerance,
                outputs: largest,
                // No better than these are the ends of runs.
                steps: steps.min(3.0 * rung.largest()),
                least: steps,
                rounding: rung.rounding,
                evaluations: rung.evaluations,
            });
            runs.push(errors);
        }
        outputs.draw(&times, runs, ladder.usual());
        // A start that is returned again and again may be a number of any precision.
        outputs.single &= outputs.compared.iter().any(|it| it.outputs < SINGLE);
        // Of a solver in single precision they may be.
        outputs.single &= asked.scenes.coarser() == 1.0;
        let worse = outputs.ratios().filter(|(ratio, _)| *ratio > WORSE);
        let tightest = worse.last().map(|(_, it)| *it);
        if let Some(worse) = tightest {
            // Of several ends one is as bad as the worst output, if ends are interpolated.
            let mut largest = 0.0;
            for k in 0..ENDS {
                let end = asked.scenes.duration * (0.5 + 0.043 * f64::from(k));
                let request = asked.scenes.run(start, worse.tolerance).to(&[end]);
                largest = libm::fmaximum(largest, asked.errors(&request)?[0]);
            }
            outputs.interpolated_end = largest > 0.2 * worse.outputs;
            outputs.degree = degree(asked, ladder)?;
        }
        Ok(outputs)
    }

    /// Chooses which of the runs is drawn.
    fn draw(&mut self, times: &[f64], mut runs: Vec<Vec<f64>>, usual: f64) {
        let worst = self.worst().filter(|(ratio, _)| *ratio > WORSE).map(|(_, it)| it.tolerance);
        let is_drawn = |it: &Compared| match worst {
            Some(tolerance) => it.tolerance == tolerance,
            None => it.tolerance >= 0.9 * usual,
        };
        let place = self.compared.iter().rposition(is_drawn).unwrap_or(0);
        let Some(it) = self.compared.get(place) else { return };
        self.drawn = Some((it.tolerance, it.least));
        self.run = times.iter().copied().zip(runs.swap_remove(place)).collect();
    }

    /// The tolerances, and the largest errors of outputs (rad).
    pub fn errors(&self) -> Vec<(f64, f64)> {
        self.compared.iter().map(|it| (it.tolerance, it.outputs)).collect()
    }

    /// What the error of outputs with this tolerance may be (rad): the largest at it and at its
    /// neighbours, 0 where there are none.
    pub fn error_at(&self, tolerance: f64) -> f64 {
        let near = |it: &&Compared| (libm::log10(it.tolerance / tolerance)).abs() < 1.1;
        self.compared.iter().filter(near).map(|it| it.outputs).fold(0.0, libm::fmaximum)
    }

    /// How many times worse than it may be the worst output is, tolerance by tolerance, where the
    /// steps are right. It may be
    /// as bad as the steps; and, since a tolerance is what a user asks for, as many tolerances off
    /// as outputs are at looser ones, which an interpolant of the power of the estimate keeps.
    fn ratios(&self) -> impl Iterator<Item = (f64, &Compared)> {
        let mut tolerances = f64::INFINITY;
        self.compared.iter().filter(|it| it.least < 0.1 || it.outputs < 0.5).map(move |it| {
            let least = it.steps.max(tolerances * it.tolerance).max(it.rounding);
            tolerances = tolerances.min(it.outputs / it.tolerance);
            (it.outputs / least, it)
        })
    }

    fn worst(&self) -> Option<(f64, &Compared)> {
        self.ratios().max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The power of the step with which the error of the outputs falls, where it is not that of the
    /// steps; from the last tolerances, as longer steps bend the line.
    pub fn power(&self) -> Option<Power> {
        let points = self.compared.iter().filter_map(|it| {
            let tells = it.outputs > 3.0 * it.steps.max(it.rounding) && it.outputs < 0.1;
            tells.then_some((libm::log(it.evaluations? as f64), -libm::log(it.outputs)))
        });
        let points: Vec<_> = points.collect();
        power(&points[points.len().saturating_sub(LAST)..])
    }

    /// Why they are worse than the steps.
    pub fn cause(&self) -> SolverCause {
        SolverCause::Outputs {
            single: self.single,
            ends_too: self.interpolated_end,
            degree: self.degree,
            power: self.power().filter(|power| power.value > 0.7).map(Power::numbers),
        }
    }

    /// What is to be said of them: that they are as good as the steps, or, where it is claimed that
    /// they come from polynomials of a `degree`, that their error falls as that of those.
    pub fn finding(&self, degree: Option<u32>) -> Finding {
        let Some((ratio, worst)) = self.worst() else {
            return Finding::nothing("no run is accurate enough to tell".to_string());
        };
        let Compared { tolerance, outputs, steps, .. } = *worst;
        let verdict = match self.single {
            true => Verdict::Fails,
            false => Verdict::of(ratio, HOLDS, WORSE),
        };
        let (worse, power) = (verdict != Verdict::Holds && !self.single, self.power());
        let verdict = match (degree, power) {
            (Some(degree), Some(power)) if worse => match power.value > f64::from(degree + 1) {
                true => Verdict::Holds,
                false => by_claim(power, degree + 1),
            },
            // As far off as the motion is wide, at a tolerance at which the steps are right.
            (Some(_), None) if worse && outputs >= 0.5 && steps < 0.01 => Verdict::Fails,
            // Nobody counts, or too few tolerances tell.
            (Some(_), None) if worse => Verdict::Unclear,
            _ => verdict,
        };
        let told = degree.is_some() || verdict == Verdict::Fails;
        let measurement = OfSolver::Between {
            tolerance,
            outputs,
            steps,
            count: OUTPUTS,
            single: self.single,
            power: power.filter(|_| told).map(Power::numbers),
            claimed: degree.filter(|_| worse),
        };
        if degree.is_some() && worse {
            return Finding {
                measurement: Measurement::OfSolver(measurement),
                values: vec![ratio],
                verdict,
                ..Finding::default()
            };
        }
        Finding {
            measurement: Measurement::OfSolver(measurement),
            ..Finding::number(ratio, "", HOLDS, verdict)
        }
    }
}

/// Up to this ratio outputs are as good as steps: the error swings with the motion by a factor of 2
/// or 3, and a step more or less makes as much. In a thousand scenes right solvers come to 6.9.
const HOLDS: f64 = 8.0;
/// What single precision makes of a state of up to 64 rad, and ten times as much (rad).
const SINGLE: f64 = 4e-5;
/// Beyond this ratio they are worse.
const WORSE: f64 = 10.0;

// -------------------------------------------------------------------------------------------------
// The polynomial they lie on
// -------------------------------------------------------------------------------------------------

/// Windows of a run, and the states in each.
const WINDOWS: u32 = 12;
const STATES: u32 = 11;
/// How far these are apart, ω₀t: all of them lie in one step, if it is not short.
const APART: f64 = 0.02;
/// Beyond this degree, differences of the motion itself are rounding.
const HIGHEST: usize = 5;

/// The degree of the polynomials on which outputs lie, if in three windows all differences of the
/// next order are rounding, which those of the motion are not.
fn degree(asked: Asked<'_>, ladder: &Ladder) -> Measured<Option<usize>> {
    let scenes = asked.scenes;
    let loosest = ladder.rungs.first().map_or(1e-3, |rung| rung.tolerance);
    let mut found = [0; HIGHEST + 1];
    for window in 0..WINDOWS {
        let begin = scenes.duration * (0.13 + 0.07 * f64::from(window));
        let apart = |k| begin + APART / scenes.frequency() * f64::from(k);
        let times: Vec<f64> = (0..STATES).map(apart).chain([scenes.duration]).collect();
        let states = asked.reply(&scenes.run(scenes.starts[0], loosest).to(&times))?.states;
        let mut theta: Vec<f64> = states[..STATES as usize].iter().map(|z| z.theta).collect();
        for (degree, found) in found.iter_mut().enumerate() {
            theta = theta.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let power = degree as i32 + 1;
            // Each state rounds by some ε, of which a difference has a binomial sum.
            let rounding = 100.0 * f64::EPSILON * f64::from(1 << power);
            let of_the_motion = 1e-2 * libm::pow(APART, f64::from(power));
            let vanish = theta.iter().all(|difference| difference.abs() < rounding);
            if vanish && rounding < of_the_motion {
                *found += 1;
                break;
            }
        }
    }
    Ok(found.iter().position(|windows| *windows >= 3))
}
