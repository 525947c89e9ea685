//! What asking for outputs does: whether it changes the run, whether there are as many rows as were
//! asked for, and how the time goes with their number.

use super::asked::{self, Asked, evenly, largest_of};
use super::found::{Ends, OfSolver, WrongRows};
use super::ladder::Ladder;
use super::outputs::OUTPUTS;
use crate::finding::{Finding, Measurement};
use crate::judge::verdict::{Measured, Trouble, Verdict};

/// By how many ε an interpolant may miss the end of its own step, relative to the state: it is a
/// sum of some ten terms, each up to ten times the state, as coefficients of high order are large
/// and have both signs, and rounded by ε/2; their factors round as much again. A step that was
/// moved changes the end by a part of the tolerance, which is thousands of times more.
const ROUNDED: f64 = 100.0;

/// By how much more than the end of a run a state between steps may be off at a tight tolerance,
/// where it may be as much worse than the steps as [outputs](super::outputs) may.
const OUTPUT: f64 = 3.0;

/// Whether a run ends in the same state with outputs and without; where it is claimed that they are
/// free, but for rounding. At the usual tolerance, and at a tight one, where an end that is off by
/// less shows: what is found there is said if it is not right.
pub fn free(asked: Asked<'_>, ladder: &Ladder, claimed: bool) -> Measured<Finding> {
    ladder.usual_error()?;
    let usual = free_at(asked, ladder, ladder.usual(), claimed)?;
    if usual.verdict == Verdict::Fails || ladder.tight() >= ladder.usual() {
        return Ok(usual);
    }
    match free_at(asked, ladder, ladder.tight(), claimed) {
        Ok(tight) if tight.verdict == Verdict::Fails => Ok(tight),
        Ok(_) | Err(Trouble::NoAnswer(_) | Trouble::Lost(_)) => Ok(usual),
        Err(trouble) => Err(trouble),
    }
}

fn free_at(asked: Asked<'_>, ladder: &Ladder, tolerance: f64, claimed: bool) -> Measured<Finding> {
    let run = asked.scenes.run(asked.scenes.starts[0], tolerance);
    let alone = run.clone().to(&[asked.scenes.duration]);
    let outputs = run.to(&evenly(OUTPUTS, asked.scenes.duration));
    let replies = [asked.reply(&alone)?, asked.reply(&outputs)?];
    let ends = replies.each_ref().map(|reply| reply.states[reply.states.len() - 1]);
    let [without, with] = ends.map(|end| asked::errors(&alone, &[end])[0]);
    let bound = ladder.allowed(tolerance);
    let largest = ends[0].theta.abs().max(ends[0].omega.abs() / asked.scenes.frequency());
    let to_the_bit = ends[0] == ends[1];
    let same = to_the_bit
        || asked.scenes.apart(ends[0], ends[1]) <= ROUNDED * asked.scenes.epsilon * largest;
    let more = match replies.map(|reply| reply.evaluations) {
        [Some(without), Some(with)] if ladder.counts() => with as f64 / without as f64,
        _ => 1.0,
    };
    let verdict = match Verdict::of(with, bound, bound) {
        Verdict::Holds if claimed && !same => Verdict::Fails,
        other => other,
    };
    let ends = match (same, with > bound) {
        (true, _) if to_the_bit => Ends::Same,
        (true, _) => Ends::ButForRounding,
        (_, true) => Ends::Wrong,
        _ => Ends::AsGood,
    };
    let measurement = OfSolver::Free { ends, without, count: OUTPUTS, more };
    Ok(Finding {
        measurement: Measurement::OfSolver(measurement),
        ..Finding::number(with, "rad", bound, verdict)
    })
}

/// Times that are easily forgotten, in units of the duration.
const ROWS: [(&str, &[f64]); 5] = [
    ("equal times", &[0.4, 0.4, 0.4, 0.7, 0.7]),
    ("times at the start", &[0.0, 0.0, 0.5]),
    ("the start alone", &[0.0]),
    ("the last time twice", &[0.3, 1.0, 1.0]),
    ("times of a run backwards", &[0.0, -0.3, -0.3, -1.0]),
];

/// And a thousand times within a step, so far apart; in single precision, whose time has fewer
/// digits, ten thousand times as far.
const CLOSE: f64 = 1e-10;
const CLOSE_SINGLE: f64 = 1e-6;

/// Whether there are as many rows as were asked for, each at its time; of a solver that runs
/// `forward_only`, of runs forward.
pub fn all(asked: Asked<'_>, ladder: &Ladder, forward_only: bool) -> Measured<Finding> {
    let usual = all_at(asked, ladder.usual(), 10.0 * ladder.usual_between()?, forward_only)?;
    if usual.verdict != Verdict::Holds || ladder.tight() >= ladder.usual() {
        return Ok(usual);
    }
    let tight = ladder.tight();
    match all_at(asked, tight, OUTPUT * ladder.allowed_between(tight), forward_only) {
        Ok(tight) if tight.verdict == Verdict::Fails => Ok(tight),
        // What a small tolerance is refused for is no matter of rows.
        Ok(_) | Err(Trouble::Lost(_)) => Ok(usual),
        Err(trouble) => Err(trouble),
    }
}

fn all_at(asked: Asked<'_>, tolerance: f64, bound: f64, forward_only: bool) -> Measured<Finding> {
    let (mut wrong, mut refused, mut worst) = (Vec::new(), Vec::new(), 0.0);
    let close = if asked.scenes.coarser() > 1.0 { CLOSE_SINGLE } else { CLOSE };
    let close: Vec<f64> = (0..1000).map(|k| 0.5 + close * f64::from(k)).collect();
    let within = ("a thousand times within a step", &close[..]);
    let possible = |times: &[f64]| !(forward_only && times.iter().any(|time| *time < 0.0));
    for (name, times) in ROWS.into_iter().chain([within]).filter(|it| possible(it.1)) {
        let times: Vec<f64> = times.iter().map(|part| part * asked.scenes.duration).collect();
        match asked.errors(&asked.scenes.run(asked.scenes.starts[0], tolerance).to(&times)) {
            Ok(errors) => {
                let largest = largest_of(errors);
                worst = libm::fmaximum(worst, largest);
                if largest > bound {
                    wrong.push((name, WrongRows::Off(largest)));
                }
            }
            Err(trouble @ (Trouble::Broken(_) | Trouble::Lost(_))) => return Err(trouble),
            Err(Trouble::NoAnswer(why)) => refused.push((name, why)),
            Err(trouble) => wrong.push((name, WrongRows::Trouble(trouble))),
        }
    }
    let verdict = match (&wrong[..], &refused[..]) {
        ([], []) => Verdict::Holds,
        ([], _) => Verdict::Unclear,
        _ => Verdict::Fails,
    };
    Ok(Finding {
        measurement: Measurement::OfSolver(OfSolver::Rows { wrong, refused }),
        ..Finding::number(worst, "rad", bound, verdict)
    })
}

/// As many outputs as are asked for at most, if there is time.
const MANY: u32 = 100_000;

/// Whether the time goes with the number of outputs.
pub fn many(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let timed = |count: u32| -> Measured<(f64, Vec<f64>)> {
        let times = evenly(count, asked.scenes.duration);
        let request = ladder.run(asked.scenes.starts[0]).to(&times);
        let begun = asked.solver.clock();
        let states = asked.reply(&request)?.states;
        let took = asked.solver.clock().saturating_sub(begun);
        Ok((took.as_secs_f64(), asked::errors(&request, &states)))
    };
    let patience = asked.solver.patience().as_secs_f64();
    let slow = |tenth, all| is_slow(tenth, all, patience);
    let mut count = MANY / 10;
    let ((mut tenth, _), (mut took, mut errors)) = (timed(count / 10)?, timed(count)?);
    let in_time = 10.0 * took < 0.25 * patience;
    if in_time && !slow(tenth, took) {
        match timed(MANY) {
            // Then it is judged by fewer.
            Err(Trouble::NoAnswer(_) | Trouble::Lost(_)) => {}
            found => {
                (count, tenth) = (MANY, took);
                (took, errors) = found?;
            }
        }
    }
    // A short answer that was delayed would hide a long one: the least of three.
    if took > patience / 30.0 {
        for _ in 0..2 {
            tenth = tenth.min(timed(count / 10)?.0);
        }
    }
    // The first answer of a size may take longer, as of a program that compiles for it; and other
    // programs may take the time, but ten times a tenth is as much work, which they delay alike.
    for _ in 0..3 {
        if slow(tenth, took) {
            tenth = 0.0;
            for _ in 0..10 {
                tenth += timed(count / 10)?.0 / 10.0;
            }
            took = timed(count)?.0;
        }
    }
    let (mut largest, mut bound) = (largest_of(errors), 10.0 * ladder.usual_between()?);
    let mut tolerance = None;
    // Where an error of the usual size covers nothing.
    if ladder.tight() < ladder.usual() {
        let request = asked.scenes.run(asked.scenes.starts[0], ladder.tight());
        let tight = asked.errors(&request.to(&evenly(MANY / 10, asked.scenes.duration)));
        let allowed = OUTPUT * ladder.allowed_between(ladder.tight());
        match tight.map(largest_of) {
            Ok(error) if error > allowed && error / allowed > largest / bound => {
                (largest, bound) = (error, allowed);
                tolerance = Some(ladder.tight());
            }
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            _ => {}
        }
    }
    let (verdict, too_long) = match slow(tenth, took) {
        true => (Verdict::Fails, Some(took)),
        false => (Verdict::of(largest, bound, bound), None),
    };
    let measurement = OfSolver::Many { count, took: [too_long, Some(tenth)], tolerance };
    Ok(Finding {
        measurement: Measurement::OfSolver(measurement),
        ..Finding::number(largest, "rad", bound, verdict)
    })
}

/// Whether all outputs take too long (s) beside a tenth of them: ten times as long where the time
/// is linear, and a hundred times where it is not. Less than a thirtieth of what is waited for is
/// not worth a complaint, and nobody waits for what is recorded.
fn is_slow(tenth: f64, all: f64, patience: f64) -> bool {
    all > 40.0 * tenth.max(1e-9) && all > patience / 30.0
}
