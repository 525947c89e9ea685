//! What a right answer does not depend on: direction and origin of time, its unit, the mirror, full
//! turns, and what was asked before.

use core::f64::consts::TAU;

use super::asked::{Asked, Scenes};
use super::ladder::Ladder;
use super::outputs::rounded;
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Verdict};
use crate::solver::SolveRequest;
use pendula::systems::Phase;

/// An error, and what it may be (rad).
#[derive(Clone, Copy, Debug)]
pub struct Off {
    largest: f64,
    bound: f64,
    usual: f64,
}

impl Off {
    /// What is to be said of the error of `what`.
    pub fn judge(&self, what: &str) -> Finding {
        let Self { largest, bound, usual } = *self;
        let verdict = Verdict::of(largest, bound, 3.0 * bound);
        let measured = format!("off by {} rad {what}", scientific(largest));
        let why = format!(
            "at the same tolerance a usual run is off by {}, and {} is allowed here",
            scientific(usual),
            about(bound)
        );
        Finding { measured, why, ..Finding::number(largest, "rad", bound, verdict) }
    }
}

/// The largest error of these requests (rad).
fn largest(asked: Asked<'_>, requests: impl IntoIterator<Item = SolveRequest>) -> Measured<f64> {
    requests.into_iter().try_fold(0.0, |largest, request| {
        let errors = asked.errors(&request)?;
        Ok(errors.into_iter().fold(largest, libm::fmaximum))
    })
}

/// Runs backwards, from the start into the past and from the exact end to the start.
pub fn back(asked: Asked<'_>, ladder: &Ladder) -> Measured<Off> {
    let scenes = asked.scenes;
    let Scenes { starts, duration, .. } = scenes;
    let past = starts.map(|start| scenes.run(start, ladder.usual()).to(&[-duration]));
    let returning = starts.map(|start| {
        scenes.run(scenes.motion(start).at(duration), ladder.usual()).from(duration).to(&[0.0])
    });
    let usual = ladder.usual_error()?;
    Ok(Off {
        largest: largest(asked, past.into_iter().chain(returning))?,
        bound: 10.0 * usual,
        usual,
    })
}

/// How far from zero time begins (s).
const FAR: f64 = 1e6;

/// Runs that begin at t₀ = ±10⁶ s. Each step rounds t there by half a unit in the last place, and
/// always alike if the steps are; the state moves no faster than at the bottom.
pub fn start(asked: Asked<'_>, ladder: &Ladder) -> Measured<Off> {
    let scenes = asked.scenes;
    let Scenes { starts, duration, .. } = scenes;
    let usual = ladder.usual_error()?;
    let rung = ladder.rungs.iter().find(|rung| rung.tolerance < 1.1 * ladder.usual());
    let steps = rung.map_or(0.0, |rung| rung.a_run() as f64);
    let fastest = starts.into_iter().map(|z| {
        let height = 2.0 * libm::sin(0.5 * z.theta);
        libm::sqrt(z.omega * z.omega + scenes.g_over_l * height * height)
    });
    let clock = steps * 0.5 * f64::EPSILON * FAR * fastest.fold(0.0, f64::max);
    let far = [FAR, -FAR].into_iter().flat_map(|from| {
        starts.map(|start| scenes.run(start, ladder.usual()).from(from).to(&[from + duration]))
    });
    Ok(Off { largest: largest(asked, far)?, bound: 10.0 * usual + clock, usual })
}

/// How many times as fast, and as slow, time is counted.
const FASTER: f64 = 1e3;

/// Runs in other units of time. A solver with one absolute tolerance for θ and ω, which is a common
/// choice, allows ω up to 1/ω₀ times as much in slow units, and no more.
pub fn units(asked: Asked<'_>, ladder: &Ladder) -> Measured<Off> {
    let scenes = asked.scenes;
    let Scenes { starts, duration, .. } = scenes;
    let usual = ladder.usual_error()?;
    let looser = FASTER / scenes.frequency();
    let counted = [FASTER, 1.0 / FASTER].into_iter().flat_map(|faster| {
        starts.map(|start| {
            let start = Phase { omega: start.omega * faster, ..start };
            let g_over_l = scenes.g_over_l * faster * faster;
            SolveRequest::new(g_over_l, start, ladder.usual()).to(&[duration / faster])
        })
    });
    Ok(Off { largest: largest(asked, counted)?, bound: 10.0 * usual * looser, usual })
}

/// Runs of the mirrored pendulum against those of the pendulum. They take the same steps, to the
/// bit where the arithmetic has no favourite sign; a step that is refused on one side alone changes
/// the end by a part of its error.
pub fn mirror(asked: Asked<'_>, ladder: &Ladder) -> Measured<Off> {
    let scenes = asked.scenes;
    let Scenes { starts, duration, .. } = scenes;
    let usual = ladder.usual_error()?;
    let mut largest = 0.0;
    for start in starts {
        let mirrored = Phase { theta: -start.theta, omega: -start.omega };
        let [here, there] =
            [start, mirrored].map(|start| scenes.run(start, ladder.usual()).to(&[duration]));
        let (here, there) = (asked.reply(&here)?.states[0], asked.reply(&there)?.states[0]);
        let back = Phase { theta: -there.theta, omega: -there.omega };
        largest = libm::fmaximum(largest, scenes.apart(here, back));
    }
    Ok(Off { largest, bound: usual / 30.0, usual })
}

/// Runs that begin ten full turns further: the relative tolerance allows θ as much more.
pub fn turn(asked: Asked<'_>, ladder: &Ladder) -> Measured<Off> {
    let scenes = asked.scenes;
    let Scenes { starts, duration, .. } = scenes;
    let usual = ladder.usual_error()?;
    let further = starts.map(|start| {
        let start = Phase { theta: start.theta + 10.0 * TAU, ..start };
        scenes.run(start, ladder.usual()).to(&[duration])
    });
    Ok(Off { largest: largest(asked, further)?, bound: 10.0 * usual * 10.0 * TAU, usual })
}

/// Whether the ends of the ladder come out the same when they are asked for again.
pub fn other_answers(asked: Asked<'_>, ladder: &Ladder) -> Measured<usize> {
    let scenes = asked.scenes;
    let Scenes { starts, duration, .. } = scenes;
    let mut other = 0;
    for rung in
        ladder.rungs.iter().filter(|rung| rung.tolerance > 0.9 * ladder.usual()).rev().take(3)
    {
        for (start, before) in starts.into_iter().zip(rung.ends) {
            let now = asked.reply(&scenes.run(start, rung.tolerance).to(&[duration]))?.states[0];
            other += usize::from(now != before);
        }
    }
    Ok(other)
}

/// What is to be said of other answers.
pub fn judge_repeatable(other: usize) -> Finding {
    let verdict = if other == 0 { Verdict::Holds } else { Verdict::Fails };
    let measured = match other {
        0 => "the same answers to the same questions".to_string(),
        other => format!(
            "{} of 9 answers are others when they are asked for again",
            rounded(other as f64).trim_end_matches(".0")
        ),
    };
    let why = "each request starts afresh".to_string();
    Finding { measured, why, ..Finding::number(other as f64, "", 0.0, verdict) }
}
