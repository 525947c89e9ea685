//! The judge of solvers that choose their steps by a tolerance, property by property.

mod asked;
mod crossings;
mod extremes;
mod ladder;
mod look;
mod outputs;
mod same;
mod steps;

#[cfg(feature = "zoo")]
pub(crate) use asked::errors;
use asked::{Asked, Scenes};
use ladder::Ladder;
use outputs::{Asking, Many, Outputs, Rows};

use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::solver::Solver;
use crate::stranger::Fault;
use crate::{Claims, Finding, Report};

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
    if solver.solve(&extremes::first()) == Err(Fault::Unsupported) {
        return Err(Fault::Unsupported);
    }
    let report = judge_in(solver, &claims, Scenes::USUAL)?;
    Ok(report.without_word("pendulum", claims.of_steps()))
}

/// Judges `solver` in other scenes, as tests do.
fn judge_in(solver: &dyn Solver, claims: &Claims, scenes: Scenes) -> Result<Report, Fault> {
    properties(Asked { solver, scenes }, claims).map_err(|trouble| match trouble {
        Trouble::Broken(why) => Fault::Broken(why),
        other => Fault::Refused(other.to_string()),
    })
}

/// What was measured of a solver, from which is told what to look at.
struct Found {
    scenes: Scenes,
    ladder: Ladder,
    outputs: Option<Outputs>,
    only_one_way: bool,
}

/// The report, property by property.
fn properties(asked: Asked<'_>, claims: &Claims) -> Measured<Report> {
    let mut judge = Judge { claims, report: Report::default() };
    let ladder = match Ladder::of(asked) {
        Ok(ladder) => ladder,
        Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
        Err(trouble) => {
            judge.report.findings.push(Finding {
                name: "tolerance",
                claimed: judge.implied(),
                ..Finding::from(trouble)
            });
            judge.report.description = "not known, as it does not solve".to_string();
            judge.report.conclude(claims.are_none());
            return Ok(judge.report);
        }
    };
    let found = judge.take_all(asked, ladder)?;
    judge.report.conclude(claims.are_none());
    judge.report.description = steps::description(&found.ladder);
    judge.report.look_at = look::at(&judge.report, &found);
    Ok(judge.report)
}

/// The report as it grows.
struct Judge<'c> {
    claims: &'c Claims,
    report: Report,
}

impl Judge<'_> {
    /// A claim that everybody makes who makes any.
    fn implied(&self) -> Option<String> {
        (!self.claims.are_none()).then(|| "implied".to_string())
    }

    /// Notes what was found of the property `name`. Only a broken protocol ends it all.
    fn note<T>(
        &mut self,
        name: &'static str,
        claimed: Option<String>,
        found: Measured<T>,
        judge: impl FnOnce(&T) -> Finding,
    ) -> Measured<Option<T>> {
        let (found, told) = match found {
            Ok(found) => {
                let told = judge(&found);
                (Some(found), told)
            }
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            Err(trouble) => (None, Finding::from(trouble)),
        };
        let verdict = match told.verdict {
            Verdict::NotMeasured => Verdict::NotMeasured,
            _ if claimed.is_none() => Verdict::Unclaimed,
            verdict => verdict,
        };
        self.report.findings.push(Finding { name, claimed, verdict, ..told });
        Ok(found)
    }

    /// Takes the properties one after the other; what may end a program comes last.
    fn take_all(&mut self, asked: Asked<'_>, ladder: Ladder) -> Measured<Found> {
        let claims = self.claims;
        let implied = self.implied();
        let claim = |value: Option<u32>| value.map(|value| value.to_string());
        self.note("tolerance", implied.clone(), Ok(()), |()| steps::tolerance(&ladder))?;
        // Nobody has to count.
        let counted = implied.clone().filter(|_| steps::counted(&ladder).is_ok());
        let estimate = claim(claims.estimate).or(counted);
        self.note("estimate", estimate, steps::counted(&ladder), |()| {
            steps::estimate(&ladder, claims.estimate)
        })?;
        self.note("order", claim(claims.order), steps::counted(&ladder), |()| {
            steps::order(&ladder, claims.order)
        })?;
        self.note("precision", implied.clone(), Ok(()), |()| steps::precision(&ladder))?;
        let outputs = Outputs::of(asked, &ladder);
        let outputs = self.note("output", implied.clone(), outputs, Outputs::judge)?;
        let free = claims.free_outputs.then(|| "free".to_string()).or_else(|| implied.clone());
        let asking = Asking::of(asked, &ladder);
        self.note("free-outputs", free, asking, |asking| asking.judge(claims.free_outputs))?;
        self.note("rows", implied.clone(), Rows::of(asked, &ladder), Rows::judge)?;
        let crossings = crossings::Passages::of(asked, &ladder);
        // A solver need not find them.
        let claimed = match (&crossings, claims.crossings) {
            (_, true) => Some("crossings".to_string()),
            (Err(Trouble::NoAnswer(_)), false) => None,
            _ => implied.clone(),
        };
        let passages = self.note("crossings", claimed, crossings, crossings::Passages::judge)?;
        let of = [
            ("back", same::back(asked, &ladder), "backwards"),
            ("start", same::start(asked, &ladder), "from t₀ = ±10⁶ s on"),
            ("units", same::units(asked, &ladder), "with time a thousand times as fast, or slow"),
            ("mirror", same::mirror(asked, &ladder), "from the mirrored run"),
            ("turn", same::turn(asked, &ladder), "from ten turns on"),
        ];
        for (name, off, what) in of {
            self.note(name, implied.clone(), off, |off| off.judge(what))?;
        }
        let other = same::other_answers(asked, &ladder);
        self.note("repeatable", implied.clone(), other, |other| same::judge_repeatable(*other))?;
        let driven = extremes::DrivenRuns::of(asked, &ladder);
        let claimed = implied.clone().filter(|_| !matches!(driven, Err(Trouble::NoAnswer(_))));
        self.note("driven", claimed, driven, extremes::DrivenRuns::judge)?;
        self.note("many", implied.clone(), Many::of(asked, &ladder), Many::judge)?;
        self.note("effort", None, steps::counted(&ladder), |()| steps::effort(&ladder))?;
        let refusal = extremes::Refusal::of(asked);
        self.note("refusal", implied, Ok(refusal), extremes::Refusal::judge)?;
        let only_one_way = passages.is_some_and(|passages| passages.only_one_way());
        self.report.evidence.tolerances = ladder
            .rungs
            .iter()
            .map(|rung| (rung.tolerance, rung.largest(), rung.evaluations))
            .collect();
        if let Some(outputs) = &outputs {
            self.report.evidence.outputs.clone_from(&outputs.run);
        }
        Ok(Found { scenes: asked.scenes, ladder, outputs, only_one_way })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::ByTolerance;
    use pendula::adaptive::TaylorSeries;
    use pendula::methods::{Dop853, DormandPrince};
    use pendula::systems::Phase;

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
        let g_over_l = 10.0_f64.powf(between(0, -2.0, 4.0));
        let frequency = g_over_l.sqrt();
        let swing = |j, low, high| {
            let theta = between(j, low, high);
            // Somewhere on its way.
            let part = between(j + 1, -1.0, 1.0);
            let height = (0.5 * theta).sin().powi(2) - (0.5 * theta * part).sin().powi(2);
            Phase { theta: theta * part, omega: 2.0 * frequency * height.max(0.0).sqrt() }
        };
        let top = |theta: f64| 2.0 * frequency * (0.5 * theta).cos().abs();
        let theta = between(5, -3.0, 3.0);
        let speed =
            (top(theta).powi(2) + 4.0 * g_over_l * (between(6, 1.15, 2.0).powi(2) - 1.0)).sqrt();
        Scenes {
            g_over_l,
            starts: [swing(1, 1.0, 2.6), swing(3, 0.1, 1.5), Phase { theta, omega: speed }],
            duration: between(7, 25.0, 50.0) / frequency,
        }
    }

    /// Catches: a bound that holds in the scenes for which it was made and in no other.
    #[test]
    fn right_solvers_hold_in_random_scenes() {
        let count = std::env::var("PENDULA_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(8);
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
                            format!("{} {:?}: {} ({})", it.name, it.verdict, it.measured, it.why)
                        })
                        .collect();
                    wrong.push(format!("{k} {claims}: {scenes:?}: {told:#?}"));
                }
            }
        }
        assert!(wrong.is_empty(), "{} of {count}\n{}", wrong.len(), wrong.join("\n"));
    }
}
