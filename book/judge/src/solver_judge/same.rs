//! What a right answer does not depend on: direction and origin of time, its unit, the mirror, full
//! turns, and what was asked before.

use core::f64::consts::TAU;

use super::asked::{Asked, Scenes};
use super::ladder::Ladder;
use crate::finding::Measurement;
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Verdict};
use crate::solver::SolveRequest;
use pendula::systems::Phase;

/// What is to be said of an error of `what` (rad) that may be as large as `bound`.
fn off(ladder: &Ladder, what: &str, error: f64, bound: f64) -> Measured<Finding> {
    let verdict = Verdict::of(error, bound, 3.0 * bound);
    let measured = format!("off by {} rad {what}", scientific(error));
    let why = format!(
        "at the same tolerance a usual run is off by {}, and {} is allowed here",
        scientific(ladder.usual_error()?),
        about(bound)
    );
    Ok(Finding {
        measurement: Measurement::Said { measured, why },
        ..Finding::number(error, "rad", bound, verdict)
    })
}

/// The largest error (rad) of a request for each start.
fn largest(asked: Asked<'_>, request: impl Fn(Phase) -> SolveRequest) -> Measured<f64> {
    asked.scenes.starts.into_iter().try_fold(0.0, |largest, start| {
        Ok(libm::fmaximum(largest, asked.errors(&request(start))?[0]))
    })
}

/// Runs backwards, from the start into the past and from the exact end to the start.
pub fn back(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let Scenes { duration, .. } = asked.scenes;
    let past = largest(asked, |start| ladder.run(start).to(&[-duration]))?;
    let returning = largest(asked, |start| {
        ladder.run(asked.scenes.motion(start).at(duration)).from(duration).to(&[0.0])
    })?;
    off(ladder, "backwards", libm::fmaximum(past, returning), 10.0 * ladder.usual_error()?)
}

/// How far from zero time begins (s).
const FAR: f64 = 1e6;
/// And in single precision, where t has steps of 8·10⁻⁶ s there.
const FAR_SINGLE: f64 = 100.0;

/// Runs that begin at t₀ = ±10⁶ s, or ±100 s in single precision. Each step rounds t there by half
/// a unit in the last place, and always alike if the steps are; the state moves no faster than at
/// the bottom.
pub fn start(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let Scenes { g_over_l, starts, duration, epsilon } = asked.scenes;
    let (far, from) = match asked.scenes.coarser() > 1.0 {
        true => (FAR_SINGLE, "from t₀ = ±100 s on"),
        false => (FAR, "from t₀ = ±10⁶ s on"),
    };
    let rung = ladder.rungs.iter().find(|rung| rung.tolerance < 1.1 * ladder.usual());
    let steps = rung.map_or(0.0, |rung| rung.a_run() as f64);
    let fastest = starts.into_iter().map(|z| {
        let height = 2.0 * libm::sin(0.5 * z.theta);
        libm::sqrt(z.omega * z.omega + g_over_l * height * height)
    });
    let clock = steps * 0.5 * epsilon * far * fastest.fold(0.0, f64::max);
    let [later, earlier] = [far, -far]
        .map(|from| largest(asked, |start| ladder.run(start).from(from).to(&[from + duration])));
    let error = libm::fmaximum(later?, earlier?);
    off(ladder, from, error, 10.0 * ladder.usual_error()? + clock)
}

/// How many times as fast, and as slow, time is counted.
const FASTER: f64 = 1e3;

/// Runs in other units of time. A solver with one absolute tolerance for θ and ω, which is a common
/// choice, allows ω up to 1/ω₀ times as much in slow units, and no more.
pub fn units(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let scenes = asked.scenes;
    let [fast, slow] = [FASTER, 1.0 / FASTER].map(|faster| {
        largest(asked, |start| {
            let start = Phase { omega: start.omega * faster, ..start };
            let g_over_l = scenes.g_over_l * faster * faster;
            let request = SolveRequest::new(g_over_l, start, ladder.usual());
            request.to(&[scenes.duration / faster])
        })
    });
    let looser = (FASTER / scenes.frequency()).max(1.0);
    let error = libm::fmaximum(fast?, slow?);
    let what = "with time a thousand times as fast, or slow";
    off(ladder, what, error, 10.0 * ladder.usual_error()? * looser)
}

/// Runs of the mirrored pendulum against those of the pendulum. They take the same steps, to the
/// bit where the arithmetic has no favourite sign; a step that is refused on one side alone changes
/// the end by a part of its error.
pub fn mirror(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let Scenes { starts, duration, .. } = asked.scenes;
    let mut error = 0.0;
    for start in starts {
        let mirrored = |z: Phase| Phase { theta: -z.theta, omega: -z.omega };
        let end = |z: Phase| asked.reply(&ladder.run(z).to(&[duration])).map(|it| it.states[0]);
        let (here, there) = (end(start)?, mirrored(end(mirrored(start))?));
        error = libm::fmaximum(error, asked.scenes.apart(here, there));
    }
    off(ladder, "from the mirrored run", error, ladder.usual_error()? / 30.0)
}

/// Full turns by which a run is moved.
const TURNS: f64 = 10.0;

/// Runs that begin full turns further: the relative tolerance allows θ as much more.
pub fn turn(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let error = largest(asked, |start| {
        let start = Phase { theta: start.theta + TURNS * TAU, ..start };
        ladder.run(start).to(&[asked.scenes.duration])
    })?;
    off(ladder, "from ten turns on", error, 10.0 * ladder.usual_error()? * TURNS * TAU)
}

/// Whether three rungs of the ladder come out the same when they are asked for again, and whether
/// the first counted the same evaluations.
pub fn repeatable(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let Scenes { starts, duration, .. } = asked.scenes;
    let mut others = 0;
    let last = ladder.rungs.iter().rev().filter(|it| it.tolerance > 0.9 * ladder.usual());
    for rung in last.take(3) {
        for (start, before) in starts.into_iter().zip(rung.ends) {
            let request = asked.scenes.run(start, rung.tolerance).to(&[duration]);
            others += u32::from(asked.reply(&request)?.states[0] != before);
        }
    }
    let (verdict, measured) = match (others, ladder.miscount) {
        (0, None) => (Verdict::Holds, "the same answers to the same questions".to_string()),
        (0, Some([first, second])) => (
            Verdict::Fails,
            format!(
                "the same answers, with {first} evaluations the first time and {second} the second"
            ),
        ),
        _ => (Verdict::Fails, format!("{others} of 9 answers are others the second time")),
    };
    others += u32::from(ladder.miscount.is_some());
    let why = "each request starts afresh".to_string();
    Ok(Finding {
        measurement: Measurement::Said { measured, why },
        ..Finding::number(f64::from(others), "", 0.0, verdict)
    })
}
