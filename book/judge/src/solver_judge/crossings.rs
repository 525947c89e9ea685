//! Passages through zero.

use super::asked::{Asked, Scenes};
use super::ladder::{Ladder, Rung};
use crate::finding::Measurement;
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::solver::CrossingsRequest;
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

/// The tolerances at which they are asked for: steps are long and short. The second is the smallest
/// to 10⁻¹¹ whose runs are not long.
fn tolerances(ladder: &Ladder) -> [f64; 2] {
    let quick = |rung: &&Rung| rung.tolerance > 0.9e-11 && rung.a_run() < 13_000;
    let tolerances = || ladder.rungs.iter().filter(quick).map(|rung| rung.tolerance);
    let loose = tolerances().filter(|it| *it < 1.1e-4).fold(0.0, f64::max);
    let loose = if loose > 0.0 { loose } else { ladder.usual() };
    [loose, tolerances().fold(loose, f64::min)]
}

/// What is wrong with the passages of some runs, and how far off the others are.
#[derive(Clone, Debug)]
pub struct Passages {
    /// The number of a run, and what is wrong there.
    wrong: Vec<(usize, String)>,
    /// The number of a run that is not answered, and why.
    refused: Vec<(usize, String)>,
    /// The largest error, over what it may be.
    ratio: f64,
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
        let mut passages =
            Self { wrong: Vec::new(), refused: Vec::new(), ratio: 0.0, every_second: false };
        let scenes = asked.scenes;
        for tolerance in tolerances(ladder) {
            let bound = 10.0 * ladder.between_at(tolerance);
            for run in runs(&scenes) {
                let span = [run.from, run.from + run.until];
                let request = CrossingsRequest::new(scenes.g_over_l, run.start, span, tolerance);
                match asked.crossings(&request) {
                    Ok(found) => passages.compare(&scenes, run, bound, &found),
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

    /// Compares the passages that were `found` with those that there are.
    fn compare(&mut self, scenes: &Scenes, run: Run, bound: f64, found: &[(f64, Phase)]) {
        let Run { number, start, from, until, times } = run;
        let name = RUNS[number].0;
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
                            let off = format!("{name}: one is off by {} rad", scientific(error));
                            self.wrong.push((number, off));
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
            true => {
                format!("{name}: {} of {there} are at other times", missing.len().max(too_many))
            }
            false => format!("{name}: {came} where there are {there}"),
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

    pub fn finding(&self) -> Finding {
        let Self { wrong, refused, ratio, .. } = self;
        // Whether it runs backwards at all is another property.
        let forwards = |(number, _): &(usize, String)| RUNS[*number].4 > 0.0;
        let verdict = match wrong.is_empty() {
            true if refused.iter().any(forwards) => Verdict::Unclear,
            true => Verdict::of(*ratio, 1.0, 3.0),
            false => Verdict::Fails,
        };
        let refused = refused
            .first()
            .map(|(number, why)| format!("; {} is not answered: {why}", RUNS[*number].0));
        let measured = match &wrong[..] {
            [] => format!("each is found, and off by {} of what it may be", about(*ratio)),
            [(_, first)] => first.clone(),
            [(_, first), .., (_, last)] => format!("{first}; {last}"),
        };
        let why = "in each run there are to be as many as there are, each off by no more than ten \
                   times what a run errs at its end"
            .to_string();
        let measured = measured + &refused.unwrap_or_default();
        Finding {
            measurement: Measurement::Said { measured, why },
            ..Finding::number(*ratio, "", 1.0, verdict)
        }
    }
}
