//! The judge of solvers that choose their steps by a tolerance, property by property.

mod asked;
mod cause;
mod crossings;
mod driven;
mod equation;
pub(crate) mod found;
mod ladder;
mod look;
mod outputs;
mod refusal;
mod rows;
mod same;
mod short;
mod steps;

use asked::{Asked, Scenes};
#[cfg(feature = "zoo")]
pub(crate) use asked::{errors, single};
pub use cause::{DrivenCause, SolverCause};
use crossings::Passages;
use driven::Driven;
pub use found::OfSolver;
use ladder::Ladder;
use outputs::Outputs;
#[cfg(feature = "zoo")]
pub(crate) use outputs::PARTS;
use steps::Ours;

use crate::forward::Forward;
use crate::integrator::Fault;
use crate::judge::claims::of_degree;
use crate::judge::verdict::{Measured, Trouble};
use crate::property::Property;
use crate::solver::Solver;
use crate::{Claims, Description, Finding, Report};
use pendula::Phase;

/// Judges `solver` by its `claims`.
///
/// ```
/// use pendula::methods::DormandPrince;
/// use pendula_judge::{ByTolerance, Claims, judge_solver};
///
/// let claims = Claims::order(5).estimate(5).free_outputs().crossings();
/// judge_solver(&ByTolerance::new(DormandPrince), claims).assert();
/// ```
///
/// # Panics
/// If the solver breaks the protocol, which a program may do, or does not solve; see
/// [`try_judge_solver`].
#[track_caller]
pub fn judge_solver(solver: &dyn Solver, claims: Claims) -> Report {
    match try_judge_solver(solver, claims) {
        Ok(report) => report,
        Err(fault) => panic!("{fault}"),
    }
}

/// Judges `solver` by its `claims`.
///
/// # Errors
/// [`Fault::Unsupported`] of one that does not solve; [`Fault::Broken`] says what it did, if it
/// broke the protocol.
pub fn try_judge_solver(solver: &dyn Solver, claims: Claims) -> Result<Report, Fault> {
    if solver.solve(&asked::first()) == Err(Fault::Unsupported) {
        return Err(Fault::Unsupported);
    }
    let forward = Forward(solver);
    let asked: &dyn Solver = if claims.forward_only { &forward } else { solver };
    let usual = Scenes::USUAL;
    let scenes = if claims.single_precision { usual.in_single() } else { usual };
    let report = judge_in(asked, &claims, scenes)?;
    Ok(report.without_word("pendulum", claims.of_steps()))
}

/// Judges `solver` in other scenes, as tests do.
fn judge_in(solver: &dyn Solver, claims: &Claims, scenes: Scenes) -> Result<Report, Fault> {
    Ok(properties(Asked { solver, scenes }, claims)?)
}

/// What was measured of a solver, from which is told what to look at.
struct Found {
    scenes: Scenes,
    ladder: Ladder,
    outputs: Option<Outputs>,
    passages: Option<Passages>,
    driven: Option<Driven>,
    /// The state of the rotation after half the time, at the last tolerance.
    halfway: Option<Phase>,
    /// Its states on the way, at these times (s), of one run.
    on_the_way: Option<Vec<(f64, Phase)>>,
}

/// The report, property by property.
fn properties(asked: Asked<'_>, claims: &Claims) -> Measured<Report> {
    let mut report = Report::default();
    let ladder = match Ladder::of(asked) {
        Ok(ladder) => ladder,
        Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
        Err(trouble) => {
            report.findings.push(Finding {
                property: Property::Tolerance,
                claimed: claims.implied(),
                ..Finding::from(trouble)
            });
            // No claim is dropped in silence.
            let order = (Property::Order, claims.order.map(|order| order.to_string()));
            for (name, claim) in claims.of_a_solver().into_iter().chain([order]) {
                let why = || Trouble::NoAnswer("it does not solve".to_string());
                if claim.is_some() {
                    report.note(name, claim, Err(why()))?;
                }
            }
            report.description = Description::SolvesNothing;
            report.conclude(claims.are_none());
            return Ok(report);
        }
    };
    let found = take_all(&mut report, claims, asked, ladder)?;
    report.conclude(claims.are_none());
    report.description = steps::description(&found.ladder);
    report.advice = look::at(&report, &found);
    Ok(report)
}

/// The rotation after half the time, at the last tolerance.
fn halfway(asked: Asked<'_>, ladder: &Ladder) -> Option<Phase> {
    let Scenes { starts, duration, .. } = asked.scenes;
    let run = asked.scenes.run(starts[ladder::RUNS - 1], ladder.rungs.last()?.tolerance);
    Some(asked.reply(&run.to(&[0.5 * duration])).ok()?.states[0])
}

/// So many states of the rotation on its way, at equal distances: few enough to be recorded.
const ON_THE_WAY: u32 = 12;

/// These, at the last tolerance, of a solver that does not come to the right end.
fn on_the_way(asked: Asked<'_>, ladder: &Ladder) -> Option<Vec<(f64, Phase)>> {
    let Scenes { starts, duration, .. } = asked.scenes;
    if ladder.by_tolerance().is_some() && ladder.floor().is_none() {
        return None;
    }
    let times = asked::evenly(ON_THE_WAY, duration);
    let run = asked.scenes.run(starts[ladder::RUNS - 1], ladder.rungs.last()?.tolerance);
    let states = asked.reply(&run.to(&times)).ok()?.states;
    Some(times.into_iter().zip(states).collect())
}

/// What is to be said of what was found.
fn finding<T>(found: &Measured<T>, of: fn(&T) -> Finding) -> Measured<Finding> {
    found.as_ref().map(of).map_err(Trouble::clone)
}

/// Takes the properties one after the other; what may end a program comes last.
fn take_all(
    report: &mut Report,
    claims: &Claims,
    asked: Asked<'_>,
    mut ladder: Ladder,
) -> Measured<Found> {
    let implied = || claims.implied();
    // What a solver need not have: claimed by implication where it has it.
    let if_had = |found: &Measured<Finding>| {
        implied().filter(|_| !matches!(found, Err(Trouble::NoAnswer(_))))
    };
    let power = |claim: Option<u32>| claim.map(|power| power.to_string());
    let ours = Ours::of(asked.scenes);
    report.note(Property::Tolerance, implied(), Ok(steps::tolerance(&ladder, &ours)))?;
    let estimate = steps::estimate(&ladder, claims.estimate);
    report.note(Property::Estimate, power(claims.estimate).or(if_had(&estimate)), estimate)?;
    report.note(Property::Order, power(claims.order), steps::order(&ladder, claims.order))?;
    report.note(Property::Precision, implied(), Ok(steps::precision(&ladder)))?;
    let outputs = Outputs::of(asked, &ladder);
    let found = outputs.as_ref().map(|outputs| outputs.finding(claims.outputs));
    let claimed = claims.outputs.map(of_degree).or_else(implied);
    report.note(Property::Output, claimed, found.map_err(Trouble::clone))?;
    if let (Some(_), Ok(outputs)) = (claims.outputs, &outputs) {
        ladder.outputs = outputs.errors();
    }
    let free = claims.free_outputs.then(|| "free".to_string()).or_else(implied);
    report.note(Property::FreeOutputs, free, rows::free(asked, &ladder, claims.free_outputs))?;
    report.note(Property::Rows, implied(), rows::all(asked, &ladder, claims.forward_only))?;
    let passages = Passages::of(asked, &ladder);
    let found = finding(&passages, Passages::finding);
    let claimed = claims.crossings.then(|| Property::Crossings.to_string()).or(if_had(&found));
    report.note(Property::Crossings, claimed, found)?;
    let both_ways = implied().filter(|_| !claims.forward_only);
    report.note(Property::Back, both_ways, same::back(asked, &ladder))?;
    report.note(Property::Start, implied(), same::start(asked, &ladder))?;
    report.note(Property::Units, implied(), same::units(asked, &ladder))?;
    report.note(Property::Mirror, implied(), same::mirror(asked, &ladder))?;
    report.note(Property::Turn, implied(), same::turn(asked, &ladder))?;
    report.note(Property::Repeatable, implied(), same::repeatable(asked, &ladder))?;
    let driven = Driven::of(asked, &ladder, outputs.as_ref().ok());
    let found = finding(&driven, Driven::finding);
    report.note(Property::Driven, if_had(&found), found)?;
    report.note(Property::Many, implied(), rows::many(asked, &ladder))?;
    report.note(Property::Effort, None, steps::effort(&ladder, &ours))?;
    let drawn = |rung: &ladder::Rung| (rung.tolerance, rung.largest(), rung.evaluations);
    report.evidence.tolerances = ladder.rungs.iter().map(drawn).collect();
    let outputs = outputs.ok();
    report.evidence.beside_steps = outputs.as_ref().and_then(|outputs| outputs.drawn);
    report.evidence.outputs =
        outputs.as_ref().map(|outputs| outputs.run.clone()).unwrap_or_default();
    report.departure = equation::departure(asked, &ladder);
    let halfway = halfway(asked, &ladder);
    let on_the_way = on_the_way(asked, &ladder);
    let refuses = claims.refuses.then(|| "refuses".to_string());
    report.note(Property::Refusal, refuses, refusal::finding(asked, claims.refuses))?;
    let (passages, driven) = (passages.ok(), driven.ok());
    Ok(Found { scenes: asked.scenes, ladder, outputs, passages, driven, halfway, on_the_way })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::solver::ByTolerance;
    use pendula::adaptive::TaylorSeries;
    use pendula::methods::{Dop853, DormandPrince};

    /// Evenly spread numbers between 0 and 1, by the golden ratio and its kin (Roberts).
    fn spread(k: u32, j: u32) -> f64 {
        const ROOT: f64 = 1.135_724_135_6;
        (0.5 + f64::from(k) * ROOT.powi(-(j as i32 + 1))).fract()
    }

    /// Scenes of all sizes: g/L from 10⁻² to 10⁴ 1/s², swings of 0.1 to 2.6 rad and rotations of
    /// 1.15 to 2 times the speed that reaches the top, for 4 to 8 small swings. Nearer to the top
    /// errors grow by more than the bounds say.
    fn scenes(k: u32) -> Scenes {
        let between = |j, low: f64, high: f64| low + (high - low) * spread(k, j);
        let g_over_l = libm::pow(10.0, between(0, -2.0, 4.0));
        let frequency = g_over_l.sqrt();
        let swing = |j, low, high| {
            let theta = between(j, low, high);
            // Somewhere on its way.
            let part = between(j + 1, -1.0, 1.0);
            let [top, here] = [0.5 * theta, 0.5 * theta * part].map(libm::sin);
            let height = top * top - here * here;
            Phase { theta: theta * part, omega: 2.0 * frequency * height.max(0.0).sqrt() }
        };
        let top = |theta: f64| 2.0 * frequency * libm::cos(0.5 * theta).abs();
        let theta = between(5, -3.0, 3.0);
        let speed =
            (top(theta).powi(2) + 4.0 * g_over_l * (between(6, 1.15, 2.0).powi(2) - 1.0)).sqrt();
        Scenes {
            g_over_l,
            starts: [swing(1, 1.0, 2.6), swing(3, 0.1, 1.5), Phase { theta, omega: speed }],
            duration: between(7, 25.0, 50.0) / frequency,
            epsilon: f64::EPSILON,
        }
    }

    /// Catches: a bound that holds in the scenes for which it was made and in no other.
    #[test]
    fn right_solvers_hold_in_random_scenes() {
        let count = std::env::var("PENDULA_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(4);
        let five = ByTolerance::new(DormandPrince);
        let eight = ByTolerance::new(Dop853);
        let series = ByTolerance::undriven(TaylorSeries);
        let mut wrong = Vec::new();
        for k in 0..count {
            let scenes = scenes(k);
            for (solver, claims) in [
                (&five as &dyn Solver, "order=5 estimate=5 free-outputs crossings"),
                (&eight, "order=8 estimate=8 free-outputs crossings"),
                (&series, "free-outputs crossings"),
            ] {
                let claims: Claims = claims.parse().unwrap();
                let report = judge_in(solver, &claims, scenes).unwrap();
                if report.verdict != Verdict::Holds {
                    let told: Vec<String> = report
                        .findings
                        .iter()
                        .filter(|it| it.claimed.is_some() && it.verdict != Verdict::Holds)
                        .map(|it| {
                            format!(
                                "{} {:?}: {} ({})",
                                it.property,
                                it.verdict,
                                it.measured(),
                                it.why()
                            )
                        })
                        .collect();
                    wrong.push(format!("{k} {claims}: {scenes:?}: {told:#?}"));
                }
            }
        }
        assert!(wrong.is_empty(), "{} of {count}\n{}", wrong.len(), wrong.join("\n"));
    }
}
