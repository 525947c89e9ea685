//! The judge, property by property, from the order to what to look at.

mod answers;
mod area;
mod claims;
mod energy;
mod expansion;
mod identity;
mod look;
mod loss;
mod order;
mod probe;
mod replies;
mod report;
mod resemblance;
mod reversal;
mod stage_times;
mod symmetry;
// They look at what the judge keeps to itself.
#[cfg(test)]
#[path = "../../../../tests/verify/thresholds.rs"]
mod thresholds;
mod verdict;

pub use claims::{ClaimError, Claims};
pub use identity::{Identity, Seen};
pub use look::sign_of_slopes;
pub use report::{Evidence, Finding, Report, Scientific, scientific};
pub use verdict::Verdict;

use answers::Answers;
use probe::Probe;
use verdict::{Measured, Trouble};

use super::stranger::{Fault, Stranger};

/// Judges `stranger` by its `claims`.
///
/// # Panics
/// If the stranger breaks the protocol, which a program may do; see [`try_judge`].
#[track_caller]
pub fn judge(stranger: &dyn Stranger, claims: Claims) -> Report {
    match try_judge(stranger, claims) {
        Ok(report) => report,
        Err(fault) => panic!("{fault}"),
    }
}

/// Judges `stranger` by its `claims`.
///
/// # Errors
/// [`Fault::Broken`] says what the stranger did, if it broke the protocol.
pub fn try_judge(stranger: &dyn Stranger, claims: Claims) -> Result<Report, Fault> {
    report(stranger, &claims).map_err(|trouble| match trouble {
        Trouble::Broken(why) => Fault::Broken(why),
        other => Fault::Refused(other.to_string()),
    })
}

/// What is found of `stranger`.
fn report(stranger: &dyn Stranger, claims: &Claims) -> Measured<Report> {
    let probe = Probe::new(stranger)?;
    let tolerance = symmetry::tolerance(&probe)?;
    let probe = probe.with_tolerance(tolerance);
    let answers = Answers::of(&probe)?;
    let mut judge = Judge { probe, answers, claims, report: Report::default() };
    judge.take_all()?;
    judge.report.conclude(claims.are_none());
    if claims.are_none() || judge.report.failures().next().is_some() {
        judge.report.mistake = judge.answers.mistake(claims);
    }
    judge.report.look_at = look::at(&judge.probe, claims, &judge.report)?;
    Ok(judge.report)
}

/// The report as it grows.
struct Judge<'s> {
    probe: Probe<'s>,
    answers: Answers,
    claims: &'s Claims,
    report: Report,
}

/// What its properties are, as far as they were told.
#[derive(Clone, Copy)]
struct Shown {
    order: Option<u32>,
    area: Verdict,
    reversal: Verdict,
}

impl Judge<'_> {
    /// Notes what was found of the property `name`, as `judge` has it, and returns what was
    /// measured. What nobody claims is said and not judged. Only a broken protocol ends it all.
    fn note<T>(
        &mut self,
        name: &'static str,
        claimed: Option<String>,
        found: Measured<T>,
        judge: impl FnOnce(&T) -> Finding,
    ) -> Measured<(Option<T>, Verdict)> {
        let (found, told) = match found {
            Ok(found) => {
                let told = judge(&found);
                (Some(found), told)
            }
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            Err(trouble) => (None, Finding::from(trouble)),
        };
        let shown = told.verdict;
        let verdict = match shown {
            Verdict::NotMeasured => shown,
            _ if claimed.is_none() => Verdict::Unclaimed,
            _ => shown,
        };
        self.report.findings.push(Finding { name, claimed, verdict, ..told });
        Ok((found, shown))
    }

    /// A claim that everybody makes who makes any.
    fn implied(&self) -> Option<String> {
        (!self.claims.are_none()).then(|| "implied".to_string())
    }

    /// Takes the properties one after the other.
    fn take_all(&mut self) -> Measured<()> {
        let claims = self.claims;
        let order = self.order()?;
        let symplectic = claims.symplectic.then(|| "symplectic".to_string());
        let (_, area) = self.note("area", symplectic, area::largest(&self.probe), area::judge)?;
        let symmetric = claims.symmetric.then(|| "symmetric".to_string());
        let way = reversal::worst(&self.probe);
        let (_, reversal) = self.note("reversal", symmetric, way, reversal::judge)?;
        let bounded = claims.bounded_energy.then(|| "bounded".to_string());
        let (run, _) = self.note("energy", bounded, energy::worst(&self.probe), energy::judge)?;
        self.report.evidence.energy = run.map(|run| run.samples).unwrap_or_default();
        self.symmetries()?;
        let shown = Shown { order, area, reversal };
        self.identity(shown)?;
        self.stage_times(order)?;
        self.report.evidence.square = area::square(&self.probe).ok();
        self.report.evidence.way = reversal::drawn(&self.probe).ok();
        Ok(())
    }

    /// The order: as claimed, or as found.
    fn order(&mut self) -> Measured<Option<u32>> {
        let claimed = self.claims.order;
        let ladder = order::ladder(&self.probe, claimed.unwrap_or(4));
        let text = claimed.map(|order| order.to_string());
        let (ladder, _) =
            self.note("order", text, ladder, |ladder| order::judge(ladder, claimed))?;
        let Some(ladder) = ladder else { return Ok(None) };
        let shown = order::shown(&ladder);
        self.report.evidence.ladder = ladder.rungs;
        Ok(shown)
    }

    /// What everybody claims, and the evaluations.
    fn symmetries(&mut self) -> Measured<()> {
        let apart = symmetry::mirror(&self.probe);
        self.note("mirror", self.implied(), apart, |apart| apart.judge(false))?;
        let apart = symmetry::units(&self.probe);
        self.note("units", self.implied(), apart, |apart| apart.judge(true))?;
        let apart = symmetry::turn(&self.probe);
        self.note("turn", self.implied(), apart, |apart| apart.judge(true))?;
        let clock = replies::clock(&self.probe);
        self.note("clock", self.implied(), clock, replies::Clock::judge)?;
        let claimed = self.claims.evaluations;
        let text = claimed.map(|a_step| format!("{a_step} a step"));
        let counted = replies::counted(&self.probe);
        self.note("evaluations", text, counted, |&counted| {
            replies::judge_evaluations(counted, claimed)
        })?;
        let other = replies::other_answers(&self.probe);
        self.note("repeatable", self.implied(), other, |&other| replies::judge_repeatable(other))?;
        let rounding = self.probe.measured_rounding.clone();
        self.note("precision", self.implied(), rounding, |&rounding| {
            replies::judge_precision(rounding)
        })?;
        Ok(())
    }

    /// What it is, and what follows from it: loss and name.
    fn identity(&mut self, shown: Shown) -> Measured<()> {
        let named = self.answers.method(self.claims);
        let identity = match identity::identify(&self.probe, named, shown.order) {
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            identity => identity,
        };
        let known = identity.as_ref().ok().and_then(Option::as_ref).cloned();
        let claims = self.claims;
        // Only of what the library has can the energy be compared.
        let listed = known.as_ref().filter(|known| pendula::method_named(known.method).is_some());
        let is = |verdict| verdict == Verdict::Holds;
        let loss = loss::measure(
            &self.probe,
            listed,
            claims.symmetric || (!claims.symplectic && is(shown.reversal)),
            claims.symplectic || is(shown.area),
        );
        let judged = claims.symplectic || claims.symmetric || listed.is_some();
        let claimed = if judged { self.implied() } else { None };
        let loss = loss.unwrap_or_else(|| {
            Err(Trouble::NoAnswer("it has nothing that would not lose".to_string()))
        });
        self.note("loss", claimed, loss, loss::Loss::judge)?;
        let name = claims.name.clone();
        self.note("name", name.clone(), identity, |identity| {
            identity::judge(identity.as_ref(), claims)
        })?;
        self.description(shown);
        self.report.identity = known;
        Ok(())
    }

    /// What is to be said of a step that is none of the list's.
    fn description(&mut self, shown: Shown) {
        let told = |verdict: Verdict, holds: &str, fails: &str| match verdict {
            Verdict::Holds => Some(holds.to_string()),
            Verdict::Fails => Some(fails.to_string()),
            _ => None,
        };
        let order = self.report.finding("order").filter(|order| !order.values.is_empty());
        let order = order.map(|_| match shown.order {
            Some(order) => format!("order {order}"),
            None => "no clear order".to_string(),
        });
        let properties = [
            order,
            told(shown.area, "keeps area", "does not keep area"),
            told(shown.reversal, "symmetric", "not symmetric"),
        ];
        let properties: Vec<String> = properties.into_iter().flatten().collect();
        let error = shown.order.filter(|order| (1..=8).contains(order));
        let error = error.and_then(|order| identity::error_in_words(&self.probe, order).ok());
        self.report.description = if properties.is_empty() {
            "not known, as nothing that would tell was measured".to_string()
        } else {
            let error = error.map(|error| format!("; {error}")).unwrap_or_default();
            format!("none of the known methods: {}{error}", properties.join(", "))
        };
    }

    /// Stages that know the time, where there is a drive: at the order that is claimed, or shown.
    fn stage_times(&mut self, shown: Option<u32>) -> Measured<()> {
        let nothing = |why: &str| Err(Trouble::NoAnswer(why.to_string()));
        let order = self.claims.order.or(shown);
        let driven = match order {
            Some(order) => stage_times::measure(&self.probe, order),
            None => nothing("there is no order to hold them to"),
        };
        // A program need not know how to drive a pendulum.
        let claimed = match driven {
            Err(Trouble::NoAnswer(_)) => None,
            _ => self.implied(),
        };
        self.note("stage-times", claimed, driven, |driven| {
            stage_times::judge(driven, order.unwrap_or_default())
        })?;
        Ok(())
    }
}
