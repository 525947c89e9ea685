//! What a right answer does not depend on: direction and origin of time, its unit, the mirror, full
//! turns, and what was asked before.

use core::f64::consts::TAU;

use super::asked::{Asked, Scenes};
use super::found::OfSolver;
use super::ladder::Ladder;
use crate::finding::{Finding, Measurement};
use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::solver::SolveRequest;
use pendula::systems::Phase;

/// An error (rad) at a tolerance, and what it may be.
struct Off {
    tolerance: f64,
    error: f64,
    bound: f64,
}

/// What is to be said of the errors of a `run` at the usual tolerance and at a tight one, where a
/// usual error covers nothing: `measure` has the error and its bound. Of a tight tolerance without
/// an answer nothing is said.
fn off(
    ladder: &Ladder,
    run: &'static str,
    measure: impl Fn(f64) -> Measured<(f64, f64)>,
) -> Measured<Finding> {
    let of = |tolerance| measure(tolerance).map(|(error, bound)| Off { tolerance, error, bound });
    let usual = of(ladder.usual())?;
    ladder.usual_error()?;
    let tight = if ladder.tight() < ladder.usual() { of(ladder.tight()) } else { Ok(of_none()) };
    let worst = match tight {
        Ok(tight) if tight.error / tight.bound > usual.error / usual.bound => tight,
        Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
        Err(trouble @ (Trouble::Count { .. } | Trouble::NotFinite)) => return Err(trouble),
        Ok(_) | Err(Trouble::NoAnswer(_) | Trouble::Lost(_)) => usual,
    };
    let Off { tolerance, error, bound } = worst;
    let measurement = OfSolver::Off {
        run,
        tolerance: Some(tolerance).filter(|it| *it < 0.9 * ladder.usual()),
        usual: ladder.error_at(tolerance),
    };
    Ok(Finding {
        measurement: Measurement::OfSolver(measurement),
        ..Finding::number(error, "rad", bound, Verdict::of(error, bound, 3.0 * bound))
    })
}

/// Nothing that was asked for.
const fn of_none() -> Off {
    Off { tolerance: 0.0, error: 0.0, bound: 1.0 }
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
    off(ladder, "backwards", |tolerance| {
        let run = |start| asked.scenes.run(start, tolerance);
        let past = largest(asked, |start| run(start).to(&[-duration]))?;
        let returning = largest(asked, |start| {
            run(asked.scenes.motion(start).at(duration)).from(duration).to(&[0.0])
        })?;
        Ok((libm::fmaximum(past, returning), ladder.allowed(tolerance)))
    })
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
    let (far, name) = match asked.scenes.coarser() > 1.0 {
        true => (FAR_SINGLE, "from t₀ = ±100 s on"),
        false => (FAR, "from t₀ = ±10⁶ s on"),
    };
    let fastest = starts.into_iter().map(|z| {
        let height = 2.0 * libm::sin(0.5 * z.theta);
        libm::sqrt(z.omega * z.omega + g_over_l * height * height)
    });
    let fastest = fastest.fold(0.0, f64::max);
    off(ladder, name, |tolerance| {
        let steps = ladder.at(tolerance).map_or(0.0, |rung| rung.a_run() as f64);
        let clock = steps * 0.5 * epsilon * far * fastest;
        let run = |start| asked.scenes.run(start, tolerance);
        let [later, earlier] = [far, -far]
            .map(|from| largest(asked, |start| run(start).from(from).to(&[from + duration])));
        Ok((libm::fmaximum(later?, earlier?), ladder.allowed(tolerance) + clock))
    })
}

/// How many times as fast, and as slow, time is counted.
const FASTER: f64 = 1e3;

/// Runs in other units of time. A solver with one absolute tolerance for θ and ω, which is a common
/// choice, allows ω up to 1/ω₀ times as much in slow units, and no more.
pub fn units(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let scenes = asked.scenes;
    let looser = (FASTER / scenes.frequency()).max(1.0);
    off(ladder, "with time a thousand times as fast, or slow", |tolerance| {
        let [fast, slow] = [FASTER, 1.0 / FASTER].map(|faster| {
            largest(asked, |start| {
                let start = Phase { omega: start.omega * faster, ..start };
                let g_over_l = scenes.g_over_l * faster * faster;
                let request = SolveRequest::new(g_over_l, start, tolerance);
                request.to(&[scenes.duration / faster])
            })
        });
        Ok((libm::fmaximum(fast?, slow?), ladder.allowed(tolerance) * looser))
    })
}

/// Runs of the mirrored pendulum against those of the pendulum. They take the same steps, to the
/// bit where the arithmetic has no favourite sign; a step that is refused on one side alone changes
/// the end by a part of its error.
pub fn mirror(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    let Scenes { starts, duration, .. } = asked.scenes;
    off(ladder, "from the mirrored run", |tolerance| {
        let mut error = 0.0;
        for start in starts {
            let mirrored = |z: Phase| Phase { theta: -z.theta, omega: -z.omega };
            let end = |z: Phase| {
                let run = asked.scenes.run(z, tolerance).to(&[duration]);
                asked.reply(&run).map(|it| it.states[0])
            };
            let (here, there) = (end(start)?, mirrored(end(mirrored(start))?));
            error = libm::fmaximum(error, asked.scenes.apart(here, there));
        }
        let rounding = ladder.at(tolerance).map_or(0.0, |rung| rung.rounding);
        Ok((error, (ladder.error_at(tolerance) / 30.0).max(rounding)))
    })
}

/// Full turns by which a run is moved.
const TURNS: f64 = 10.0;

/// Runs that begin full turns further: the relative tolerance allows θ as much more.
pub fn turn(asked: Asked<'_>, ladder: &Ladder) -> Measured<Finding> {
    off(ladder, "from ten turns on", |tolerance| {
        let error = largest(asked, |start| {
            let start = Phase { theta: start.theta + TURNS * TAU, ..start };
            asked.scenes.run(start, tolerance).to(&[asked.scenes.duration])
        })?;
        Ok((error, ladder.allowed(tolerance) * TURNS * TAU))
    })
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
    let counts = ladder.miscount.filter(|_| others == 0);
    let verdict = match (others, ladder.miscount) {
        (0, None) => Verdict::Holds,
        _ => Verdict::Fails,
    };
    // As they are told; a count that differs is one more.
    let others = others + u32::from(others == 0 && counts.is_some());
    Ok(Finding {
        measurement: Measurement::OfSolver(OfSolver::Again { of: 9, counts }),
        ..Finding::number(f64::from(others), "", 0.0, verdict)
    })
}
