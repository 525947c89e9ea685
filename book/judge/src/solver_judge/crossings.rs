//! Passages through zero.

use super::asked::{Asked, Scenes};
use super::found::{OfSolver, WrongPassage};
use super::ladder::{Ladder, NOT_LONG};
use crate::finding::{Finding, Measurement};
use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::solver::{CrossingsRequest, SolveRequest};
use pendula::systems::Phase;

/// Runs whose passages are asked for: θ and ω/ω₀ at the start, ω₀t₀, and how long they are, ω₀t.
const RUNS: [(&str, f64, f64, f64, f64); 7] = [
    ("a wide swing", 2.0, 0.0, 0.0, LONG),
    ("a wide swing from another t₀ on", 2.0, 0.0, 20.0, LONG),
    ("a slow passage", 0.02, 0.0, 0.0, LONG),
    ("a rotation", -7.0, 2.3, 0.0, 7.0),
    ("a start on zero", 0.0, 0.85, 0.0, LONG),
    ("an end on zero", 1.0, 0.0, 0.0, f64::NAN),
    ("a run backwards", -0.7, 0.6, 10.0, -LONG),
];
/// Some five swings.
const LONG: f64 = 35.0;
/// The run that differs from the first by its t₀ alone.
const ELSEWHERE: usize = 1;

/// The tolerances at which they are asked for: steps are long and short.
fn tolerances(ladder: &Ladder) -> [f64; 2] {
    let loose = ladder.rungs.iter().filter(|rung| rung.a_run() < NOT_LONG);
    let loose = loose.map(|rung| rung.tolerance).filter(|it| *it < 1.1e-4).fold(0.0, f64::max);
    let loose = if loose > 0.0 { loose } else { ladder.usual() };
    [loose, ladder.smallest().min(loose)]
}

/// How many tolerances θ may be off zero at a passage, at the smaller of these: who finds a root of
/// what its states between steps come from is off by rounding, or by the tolerance of its search.
/// Those of 30 published solvers come to 2; a straight line between the ends of steps, to ten
/// thousand.
const OFF_ZERO: f64 = 100.0;

/// What is wrong with the passages of some runs, and how far off the others are.
#[derive(Clone, Debug, Default)]
pub struct Passages {
    /// The number of a run, and what is wrong there.
    wrong: Vec<(usize, WrongPassage)>,
    /// The number of a run that is not answered, and why.
    refused: Vec<(usize, String)>,
    /// The largest error, over what it may be.
    ratio: f64,
    /// The number of a run, θ (rad) at the passage that is farthest off zero in its own run, and
    /// what it may be.
    off_zero: Option<(usize, f64, f64)>,
    /// Whether all that are missing are of one direction, and every second one is.
    every_second: bool,
}

/// The exact times of the passages of a run, in order.
fn exact_times(scenes: &Scenes, start: Phase, until: f64) -> Vec<f64> {
    const LOOKS: u32 = 4000;
    let motion = scenes.motion(start);
    let theta = |t: f64| motion.at(t).theta;
    let at = |k: u32| until * f64::from(k) / f64::from(LOOKS);
    let mut times = Vec::new();
    for k in 0..LOOKS {
        let (mut low, mut high) = (at(k), at(k + 1));
        let before = theta(low);
        if before == 0.0 {
            times.push(low);
            continue;
        }
        if before.is_sign_negative() == theta(high).is_sign_negative() || theta(high) == 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let same = theta(middle).is_sign_negative() == before.is_sign_negative();
            if same { low = middle } else { high = middle }
        }
        times.push(high);
    }
    times
}

/// A run: its number, when it begins and how long it is (s), and the exact times of its passages
/// since its start (s).
struct Run {
    number: usize,
    start: Phase,
    from: f64,
    until: f64,
    times: Vec<f64>,
}

fn runs(scenes: &Scenes) -> impl Iterator<Item = Run> {
    RUNS.into_iter().enumerate().map(|(number, (_, theta, omega, from, until))| {
        let start = scenes.state(theta, omega);
        let long = LONG / scenes.frequency();
        let until = match until.is_nan() {
            true => exact_times(scenes, start, long).last().copied().unwrap_or(long),
            false => until / scenes.frequency(),
        };
        let from = from / scenes.frequency();
        Run { number, start, from, until, times: exact_times(scenes, start, 1.001 * until) }
    })
}

impl Passages {
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let mut passages = Self::default();
        let scenes = asked.scenes;
        let [loose, tight] = tolerances(ladder);
        for tolerance in [loose, tight] {
            let bound = 10.0 * ladder.between_at(tolerance);
            for run in runs(&scenes) {
                let span = [run.from, run.from + run.until];
                let request = CrossingsRequest::new(scenes.g_over_l, run.start, span, tolerance);
                match asked.crossings(&request) {
                    Ok(found) => {
                        if tolerance < loose {
                            let off = off_zero(asked, &request, &found, run.number == 0)?;
                            passages.hold_to_zero(run.number, off, OFF_ZERO * tolerance + 1e-12);
                        }
                        passages.compare(&scenes, run, bound, &found);
                    }
                    // Who answers the first finds passages, if not in every run.
                    Err(Trouble::NoAnswer(why) | Trouble::Lost(why)) if run.number > 0 => {
                        passages.refused.push((run.number, why));
                    }
                    Err(trouble) => return Err(trouble),
                }
            }
        }
        Ok(passages)
    }

    /// Keeps what is farthest off zero.
    fn hold_to_zero(&mut self, number: usize, off: f64, bound: f64) {
        if off > bound && self.off_zero.is_none_or(|(_, it, bound)| off > it.max(bound)) {
            self.off_zero = Some((number, off, bound));
        }
    }

    /// Compares the passages that were `found` with those that there are.
    fn compare(&mut self, scenes: &Scenes, run: Run, bound: f64, found: &[(f64, Phase)]) {
        let Run { number, start, from, until, times } = run;
        let motion = scenes.motion(start);
        // At either end one may be told or not.
        let optional = |t: f64| {
            let speed = motion.at(t).omega.abs();
            [0.0, until].into_iter().any(|end| (t - end).abs() * speed <= bound.max(1e-9))
        };
        let inside = |t: &f64| t.abs() <= until.abs() || optional(*t);
        let times: Vec<f64> = times.into_iter().filter(inside).collect();
        let mut left: Vec<(f64, Phase)> = found.iter().map(|(t, z)| (t - from, *z)).collect();
        let mut missing = Vec::new();
        for (index, time) in times.iter().enumerate() {
            let nearest = left
                .iter()
                .enumerate()
                .min_by(|a, b| (a.1.0 - time).abs().total_cmp(&(b.1.0 - time).abs()));
            let half = times
                .windows(2)
                .map(|w| 0.5 * (w[1] - w[0]).abs())
                .fold(f64::INFINITY, f64::min)
                .min(2.0 / scenes.frequency());
            match nearest.filter(|(_, it)| (it.0 - time).abs() < half) {
                Some((k, _)) => {
                    let (t, z) = left.remove(k);
                    let exact = motion.at(*time);
                    let error = scenes.apart(z, exact).max((t - time).abs() * exact.omega.abs());
                    if error / bound > self.ratio {
                        self.ratio = error / bound;
                        if self.ratio > 3.0 {
                            self.wrong.push((number, WrongPassage::Off(error)));
                        }
                    }
                }
                None if optional(*time) => {}
                None => missing.push(index),
            }
        }
        let too_many = left.iter().filter(|it| !optional(it.0)).count();
        if missing.is_empty() && too_many == 0 {
            return;
        }
        let half = missing.len().abs_diff(times.len() - missing.len()) < 2;
        let alternate = half && missing.len() > 1 && missing.windows(2).all(|w| w[1] - w[0] == 2);
        self.every_second |= alternate;
        let (came, there) = (found.len(), times.len());
        let told = match came == there {
            true => WrongPassage::Elsewhere([missing.len().max(too_many), there]),
            false => WrongPassage::Count([came, there]),
        };
        self.wrong.push((number, told));
    }

    /// Whether every second one is missing: those of one direction.
    pub const fn only_one_way(&self) -> bool {
        self.every_second
    }

    /// Whether it is t₀ that matters: runs from 0 on are right, and one of them from another is
    /// not.
    pub fn only_elsewhere(&self) -> bool {
        let wrong = || self.wrong.iter().map(|(index, _)| *index);
        wrong().all(|index| RUNS[index].3 != 0.0) && wrong().any(|index| index == ELSEWHERE)
    }

    /// Whether they are those of the run, but not where θ is 0.
    pub const fn only_off_zero(&self) -> bool {
        self.wrong.is_empty() && self.off_zero.is_some()
    }

    pub fn finding(&self) -> Finding {
        let Self { wrong, refused, ratio, .. } = self;
        // Whether it runs backwards at all is another property.
        let forwards = |(number, _): &(usize, String)| RUNS[*number].4 > 0.0;
        let verdict = match (wrong.is_empty(), self.off_zero) {
            (true, Some((_, off, bound))) => Verdict::of(off, bound, 10.0 * bound),
            (true, None) if refused.iter().any(forwards) => Verdict::Unclear,
            (true, None) => Verdict::of(*ratio, 1.0, 3.0),
            (false, _) => Verdict::Fails,
        };
        let name = |number: usize| RUNS[number].0;
        let refused = refused.first().map(|(number, why)| (name(*number), why.clone()));
        let mut wrong: Vec<_> = wrong.iter().map(|(number, what)| (name(*number), *what)).collect();
        if let (true, Some((number, off, _))) = (wrong.is_empty(), self.off_zero) {
            wrong.push((name(number), WrongPassage::NotZero(off)));
        }
        Finding {
            measurement: Measurement::OfSolver(OfSolver::Passages { wrong, refused }),
            ..Finding::number(*ratio, "", 1.0, verdict)
        }
    }
}

/// How far off zero (rad) θ is at the passages that were `found`, by what is told of them, and by
/// the states that the solver has at those times, if it is `asked_again` and that does not move its
/// run.
fn off_zero(
    asked: Asked<'_>,
    request: &CrossingsRequest,
    found: &[(f64, Phase)],
    asked_again: bool,
) -> Measured<f64> {
    let largest = |thetas: &mut dyn Iterator<Item = f64>| thetas.fold(0.0, libm::fmaximum);
    let told = largest(&mut found.iter().map(|(_, z)| z.theta.abs()));
    let CrossingsRequest { g_over_l, start, span: [from, until], tolerance } = *request;
    let run = SolveRequest::new(g_over_l, start, tolerance).from(from);
    let inside = |t: &f64| (t - from) * (until - t) > 0.0;
    let mut times: Vec<f64> = found.iter().map(|(t, _)| *t).filter(inside).collect();
    let in_order = times.windows(2).all(|two| (two[1] - two[0]) * (until - from) >= 0.0);
    if times.is_empty() || !in_order || !asked_again {
        return Ok(told);
    }
    times.push(until);
    let answers = [run.clone().to(&[until]), run.to(&times)].map(|run| asked.reply(&run));
    match answers {
        [Ok(alone), Ok(with)] if alone.states[0] == with.states[times.len() - 1] => {
            let own = &with.states[..times.len() - 1];
            Ok(libm::fmaximum(told, largest(&mut own.iter().map(|z| z.theta.abs()))))
        }
        [Err(Trouble::Broken(why)), _] | [_, Err(Trouble::Broken(why))] => {
            Err(Trouble::Broken(why))
        }
        _ => Ok(told),
    }
}
