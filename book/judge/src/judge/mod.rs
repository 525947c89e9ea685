//! The judge, property by property, from the order to what to look at.

pub(crate) mod advice;
mod answers;
pub(crate) mod area;
pub(crate) mod causes;
pub(crate) mod claims;
pub(crate) mod energy;
pub(crate) mod equation;
pub(crate) mod expansion;
pub(crate) mod identity;
mod loss;
pub(crate) mod order;
pub(crate) mod probe;
mod range;
mod replies;
pub(crate) mod report;
pub(crate) mod resemblance;
pub(crate) mod reversal;
mod series;
mod stage_times;
pub(crate) mod symmetry;
#[cfg(test)]
mod thresholds;
pub(crate) mod verdict;

pub use advice::{Advice, Cause};
pub use causes::{Rows, Shown as ShownCause, TakenStep};
pub use claims::{ClaimError, Claims};
pub use equation::{Added, Departure, Equation, Kind, Of, Place, Range};
pub use expansion::Deviation;
pub use identity::{Identity, Seen};
pub use report::{Description, Evidence, Report};
pub use resemblance::{But, Nearest, Resemblance};
pub use verdict::{Trouble, Verdict};

use advice::Looking;
use answers::{Answers, Name};
use equation::{Looked, Undo, Undone};
use probe::Probe;
use verdict::{Measured, told};

use super::forward::Forward;
use super::integrator::{Fault, Integrator};
use crate::finding::{Finding, Measurement};
use crate::property::Property;

/// Judges `integrator` by its `claims`.
///
/// # Panics
/// If the integrator breaks the protocol, which a program may do; see [`try_judge`].
#[track_caller]
pub fn judge(integrator: &dyn Integrator, claims: Claims) -> Report {
    match try_judge(integrator, claims) {
        Ok(report) => report,
        Err(fault) => panic!("{fault}"),
    }
}

/// Judges `integrator` by its `claims`.
///
/// # Errors
/// [`Fault::Broken`] says what the integrator did, if it broke the protocol.
pub fn try_judge(integrator: &dyn Integrator, claims: Claims) -> Result<Report, Fault> {
    let forward = Forward(integrator);
    let asked: &dyn Integrator = if claims.forward_only { &forward } else { integrator };
    Ok(report(asked, &claims)?.without_word("solve", claims.of_a_solver()))
}

/// What is found of `integrator`: of its own states, if what it takes or returns was changed in a
/// way that can be undone.
fn report(integrator: &dyn Integrator, claims: &Claims) -> Measured<Report> {
    let probe = Probe::new(integrator)?;
    if let Some((departure, undo)) = told(equation::output(&probe))?.flatten() {
        return behind(&Undone { integrator, undo }, claims, departure);
    }
    let (ready, looked) = ready(integrator, probe)?;
    if let Ok(Some((Looked { departure: Some(departure), .. }, Some(undo)))) = looked {
        return behind(&Undone { integrator, undo }, claims, departure);
    }
    properties(ready, without_undo(looked), claims, None)
}

/// What is found of the program behind a change of what it takes or returns.
fn behind(integrator: &dyn Integrator, claims: &Claims, output: Departure) -> Measured<Report> {
    let (ready, looked) = ready(integrator, Probe::new(integrator)?)?;
    properties(ready, without_undo(looked), claims, Some(output))
}

/// An integrator of which all is measured that has to be before anything is asked.
struct Ready<'s> {
    probe: Probe<'s>,
    /// In the scenes of the known answers.
    answers: Answers,
    /// What is cut off of its numbers.
    cut_off: Option<Departure>,
}

/// What was found of the equation, with what undoes a change of output.
type Solves = Measured<Option<(Looked, Option<Undo>)>>;

fn without_undo(looked: Solves) -> Measured<Option<Looked>> {
    looked.map(|looked| looked.map(|(looked, _)| looked))
}

/// The integrator, ready to be judged, and its equation.
fn ready<'s>(integrator: &'s dyn Integrator, probe: Probe<'s>) -> Measured<(Ready<'s>, Solves)> {
    let cut_off = match probe.measured_rounding {
        Ok(rounding) if rounding > replies::DOUBLE => told(equation::cut_off(&probe))?.flatten(),
        _ => None,
    };
    let probe = probe.printing(cut_off.as_ref());
    // The equation first, by short steps: in long ones, or many, numbers may overflow.
    let looked = equation::look(integrator, &probe).map(Some);
    if let Err(Trouble::Broken(why)) = looked {
        return Err(Trouble::Broken(why));
    }
    let departs = |looked: &Solves| {
        looked
            .as_ref()
            .is_ok_and(|found| found.as_ref().is_some_and(|(looked, _)| looked.departure.is_some()))
    };
    let measured = || -> Measured<(f64, f64, Answers)> {
        let tolerance = symmetry::tolerance(&probe)?;
        let in_long_steps = symmetry::in_long_steps(&probe)?;
        let answers = Answers::of(&probe)?.with_tolerance(tolerance);
        Ok((tolerance, in_long_steps, answers.and_in_a_step(in_long_steps)))
    };
    let (tolerance, in_long_steps, answers) = match measured() {
        // What breaks off is broken again where the properties are measured.
        Err(_) if departs(&looked) => (0.0, 0.0, Answers::none()),
        measured => measured?,
    };
    let probe = probe.with_tolerance(tolerance).with_long_steps(in_long_steps);
    Ok((Ready { probe, answers, cut_off }, looked))
}

/// The report, property by property.
fn properties(
    Ready { probe, answers, cut_off }: Ready<'_>,
    looked: Measured<Option<Looked>>,
    claims: &Claims,
    output: Option<Departure>,
) -> Measured<Report> {
    let name = answers.method(claims);
    let report = Report { departure: output, ..Report::default() };
    let mut judge = Judge { probe, answers, name, looked, cut_off, claims, report };
    if let Err(trouble) = judge.take_all() {
        return judge.broken(trouble);
    }
    judge.report.conclude(claims.are_none());
    judge.mistake();
    let looking = told(advice::at(&judge.probe, claims, &judge.report))?;
    let Looking { advice, resembles } = looking.unwrap_or_default();
    let mut report = judge.report;
    // One name: what it is but for one thing goes before the same on another equation.
    if resembles.is_some() {
        report.identity = report.identity.filter(|identity| identity.on.is_none());
    }
    Ok(Report { advice, resembles, ..report })
}

/// The report as it grows.
struct Judge<'s> {
    probe: Probe<'s>,
    answers: Answers,
    name: Name,
    /// What was found of the equation, unless the method is known.
    looked: Measured<Option<Looked>>,
    /// What is cut off of the numbers.
    cut_off: Option<Departure>,
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
    /// Notes what was found of a property, as `judge` has it, and returns what was measured.
    fn note<T>(
        &mut self,
        property: Property,
        claimed: Option<String>,
        found: Measured<T>,
        judge: impl FnOnce(&T) -> Finding,
    ) -> Measured<(Option<T>, Verdict)> {
        let told = found.as_ref().map(judge).map_err(Trouble::clone);
        let shown = self.report.note(property, claimed, told)?;
        let found = found.ok();
        // What was not measured shows nothing, whatever it fails.
        let shown = if found.is_some() { shown } else { Verdict::NotMeasured };
        Ok((found, shown))
    }

    /// Takes the properties one after the other.
    fn take_all(&mut self) -> Measured<()> {
        let claims = self.claims;
        self.equation()?;
        let order = self.order()?;
        let symplectic = claims.symplectic.then(|| "symplectic".to_string());
        let (_, area) =
            self.note(Property::Area, symplectic, area::largest(&self.probe), area::judge)?;
        let symmetric = claims.symmetric.then(|| "symmetric".to_string());
        let way = reversal::worst(&self.probe);
        let (_, reversal) = self.note(Property::Reversal, symmetric, way, reversal::judge)?;
        let bounded = claims.bounded_energy.then(|| "bounded".to_string());
        let (run, _) =
            self.note(Property::Energy, bounded, energy::worst(&self.probe), energy::judge)?;
        self.report.evidence.energy = run.map(|run| run.samples).unwrap_or_default();
        self.symmetries()?;
        let shown = Shown { order, area, reversal };
        self.identity(shown)?;
        self.stage_times(order)?;
        self.report.evidence.square = area::square(&self.probe).ok();
        self.report.evidence.way = reversal::drawn(&self.probe).ok();
        self.range(shown.order)
    }

    /// Beyond the usual states and steps, last of all: a program may break off there.
    fn range(&mut self, shown: Option<u32>) -> Measured<()> {
        let departs = self.report.departure.as_ref();
        let order = self.report.finding(Property::Order).map(|found| found.verdict);
        let range = match departs.filter(|found| found.place() == Place::Equation) {
            Some(_) => Err(Trouble::NoAnswer("the equation is another one".to_string())),
            None => {
                // What is cut out of the states, as turns are, is not found again in long steps.
                let itself = |known: &&Identity| known.is_plain() && departs.is_none();
                let plain = self.report.identity.as_ref().filter(itself);
                let order = match (shown, order) {
                    (Some(order), _) => Some(f64::from(order)),
                    // Slopes that show no order and fail its claim have no power to fall with.
                    (None, Some(Verdict::Fails)) => None,
                    (None, _) => Some(f64::INFINITY),
                };
                range::measure(&self.probe, order, plain.map(|known| known.method))
            }
        };
        // A program need not answer what lies beyond.
        let claimed = match range {
            Err(Trouble::NoAnswer(_)) => None,
            _ => self.claims.implied(),
        };
        self.note(Property::Range, claimed, range, range::Range::judge)?;
        Ok(())
    }

    /// The equation that is solved, and the form of what is taken and returned.
    fn equation(&mut self) -> Measured<()> {
        let found = core::mem::replace(&mut self.looked, Ok(None));
        let told = equation::Told::new(&found, self.report.departure.take(), self.name.one());
        self.looked = found;
        // Who does not answer need not be asked; who is late, or at fault, need.
        let is_asked = |found: &Measured<Finding>| matches!(found, Ok(_) | Err(Trouble::Lost(_)));
        let claimed = |found: &Measured<Finding>| self.claims.implied().filter(|_| is_asked(found));
        let [of_equation, of_output] = [claimed(&told.equation), claimed(&told.output)];
        self.note(Property::Equation, of_equation, told.equation, Finding::clone)?;
        self.note(Property::Output, of_output, told.output, Finding::clone)?;
        self.report.departure = told.departure;
        self.report.evidence.force = told.force;
        Ok(())
    }

    /// The known mistake that it makes, if a claim fails or none is made. It has one name: that of
    /// the mistake, unless it is a method but for what the mistake is made with.
    fn mistake(&mut self) {
        if !self.claims.are_none() && self.report.failures().next().is_none() {
            return;
        }
        let known = self.answers.mistake(self.claims);
        let Some(mistake) = known.and_then(|known| known.mistake.as_ref()) else { return };
        if !self.agrees(mistake.converges()) {
            return;
        }
        let of = mistake.of.as_str();
        let other = |known: &Identity| known.method != of;
        // A method on another equation has its name, and a mistake in another method is none.
        if self.report.identity.as_ref().is_some_and(|known| known.on.is_some() && other(known)) {
            return;
        }
        self.report.identity = self.report.identity.take().filter(|known| !other(known));
        self.report.mistake = known;
        let Some(known) = self.report.mistake.filter(|_| self.report.identity.is_none()) else {
            return;
        };
        let findings = self.report.findings.iter_mut();
        for finding in findings.filter(|finding| finding.property == Property::Name) {
            finding.measurement = Measurement::Mistake(&known.name);
        }
    }

    /// What was found before the integrator broke the protocol, as a program does that ends where
    /// its numbers overflow: enough for a report if the equation is another one.
    fn broken(self, trouble: Trouble) -> Measured<Report> {
        let Self { claims, mut report, .. } = self;
        let Some(departure) = report.departure.clone() else { return Err(trouble) };
        report.description = Description::BrokeOff(departure.equation().cloned());
        report
            .findings
            .push(Finding { property: Property::Order, ..Finding::nothing(trouble.to_string()) });
        let causes = [Cause::Equation { departure, method: None }, Cause::BrokeOff(trouble)];
        report.advice =
            causes.map(|cause| Advice { cause, explains: Vec::new() }).into_iter().collect();
        report.conclude(claims.are_none());
        Ok(report)
    }

    /// Whether a mistake that converges to the pendulum's motion, or does not, agrees with the
    /// equation that was found: a mistake is told from a few steps of one pendulum.
    fn agrees(&self, converges: bool) -> bool {
        let departure = self.report.departure.as_ref();
        match departure.filter(|found| found.place() == Place::Equation) {
            Some(Departure::Units(_)) => converges,
            // The mistake of this kind that is known has this damping.
            Some(Departure::Damping(equation)) => equation.damping() == Some(0.1),
            // Its numbers are others, or may be.
            Some(found) if matches!(found.kind(), Kind::Values | Kind::Torque) => false,
            Some(_) => !converges,
            None => {
                let equation = self.report.finding(Property::Equation);
                let right = equation.is_some_and(|found| found.verdict == Verdict::Holds);
                !right || converges || self.name.one().is_some()
            }
        }
    }

    /// The order: as claimed, or as found.
    fn order(&mut self) -> Measured<Option<u32>> {
        let claimed = self.claims.order;
        let ladder = order::ladder(&self.probe, claimed.unwrap_or(4));
        let text = claimed.map(|order| order.to_string());
        let known = self.name.one().map(|found| found.known.order);
        let (ladder, _) =
            self.note(Property::Order, text, ladder, |it| order::judge(it, claimed, known))?;
        let Some(ladder) = ladder else { return Ok(None) };
        let shown = order::shown(&ladder);
        self.report.evidence.ladder = ladder.rungs;
        Ok(shown)
    }

    /// What everybody claims, and the evaluations.
    fn symmetries(&mut self) -> Measured<()> {
        let apart = symmetry::mirror(&self.probe);
        self.note(Property::Mirror, self.claims.implied(), apart, |apart| apart.judge(false))?;
        let apart = symmetry::units(&self.probe);
        self.note(Property::Units, self.claims.implied(), apart, |apart| apart.judge(true))?;
        let wrapped = self.report.departure.clone();
        let wrapped = wrapped.filter(|found| found.kind() == Kind::Wrapped);
        let apart = symmetry::turn(&self.probe);
        self.note(Property::Turn, self.claims.implied(), apart, |apart| match &wrapped {
            Some(departure) => Finding {
                measurement: Measurement::OtherOutput(departure.clone()),
                ..Finding::number(apart.largest, "rad", apart.bound, Verdict::Fails)
            },
            None => apart.judge(true),
        })?;
        let clock = replies::clock(&self.probe);
        self.note(Property::Clock, self.claims.implied(), clock, replies::Clock::judge)?;
        let claimed = self.claims.evaluations;
        let text = claimed.map(|a_step| format!("{a_step} a step"));
        let counted = replies::counted(&self.probe);
        self.note(Property::Evaluations, text, counted, |&counted| {
            replies::judge_evaluations(counted, claimed)
        })?;
        let other = replies::other_answers(&self.probe);
        self.note(Property::Repeatable, self.claims.implied(), other, |&other| {
            replies::judge_repeatable(other)
        })?;
        let rounding = self.probe.measured_rounding.clone();
        let (cut_off, single) = (self.cut_off.take(), self.claims.single_precision);
        self.note(Property::Precision, self.claims.implied(), rounding, |&rounding| {
            replies::judge_precision(rounding, cut_off.as_ref(), single)
        })?;
        self.report.departure = self.report.departure.take().or(cut_off);
        Ok(())
    }

    /// What it is, and what follows from it: loss and name.
    fn identity(&mut self, shown: Shown) -> Measured<()> {
        let identity = match self.identified(shown.order) {
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            identity => identity,
        };
        let known = identity.as_ref().ok().and_then(Option::as_ref).cloned();
        let claims = self.claims;
        // Only of what the library has can the energy be compared.
        let listed = known.as_ref().filter(|known| {
            let own = known.on.is_none() && !known.angles_only;
            own && pendula::method_named::<pendula::Pendulum>(known.method).is_some()
        });
        let is = |verdict| verdict == Verdict::Holds;
        let loss = loss::measure(
            &self.probe,
            listed,
            claims.symmetric || (!claims.symplectic && is(shown.reversal)),
            claims.symplectic || is(shown.area),
        );
        let judged = claims.symplectic || claims.symmetric || listed.is_some();
        let claimed = if judged { self.claims.implied() } else { None };
        let loss = loss.unwrap_or_else(|| {
            Err(Trouble::NoAnswer(
                "nothing that it conserves was found in which a loss would show".to_string(),
            ))
        });
        self.note(Property::Loss, claimed, loss, loss::Loss::judge)?;
        let name = self.name.clone();
        self.note(Property::Name, claims.name.clone(), identity, |identity| {
            identity::judge(&name, identity.as_ref(), claims)
        })?;
        self.description(shown);
        self.report.identity = known;
        Ok(())
    }

    /// The method that it is, on the equation that it solves.
    fn identified(&self, shown: Option<u32>) -> Measured<Option<Identity>> {
        let looked = match &self.looked {
            Ok(Some(looked)) => looked,
            _ => return identity::identify(&self.probe, &self.name, shown),
        };
        let Looked { departure, solved, .. } = looked;
        let Some(departure) = departure.as_ref().filter(|it| it.place() == Place::Equation) else {
            return identity::identify(&self.probe, &self.name, shown);
        };
        let Some(solved) = solved else { return Ok(None) };
        let solver = solved.method(&identity::Asked::of(&self.probe)?);
        let solver = solver.zip(departure.equation().cloned());
        Ok(solver.map(|(solver, equation)| Identity::solving(solver, equation)))
    }

    /// What is to be said of a step that is none of the list's.
    fn description(&mut self, shown: Shown) {
        if let Name::OneOf(those) = &self.name {
            self.report.description = Description::OneOf(identity::may_be(those));
            return;
        }
        let departure = self.report.departure.as_ref();
        if let Some(equation) = departure.and_then(Departure::equation) {
            self.report.description = Description::On(equation.clone());
            return;
        }
        let told = |verdict: Verdict| match verdict {
            Verdict::Holds => Some(true),
            Verdict::Fails => Some(false),
            _ => None,
        };
        let order = self.report.finding(Property::Order);
        let order = order.filter(|order| !order.values.is_empty()).map(|_| shown.order);
        let error = shown.order.filter(|order| (1..=8).contains(order));
        let error = error
            .and_then(|order| Some((order, identity::leading_error(&self.probe, order).ok()?)));
        let (area, symmetric) = (told(shown.area), told(shown.reversal));
        self.report.description = Description::Step { order, area, symmetric, error };
    }

    /// Stages that know the time, where there is a drive: at the order that is claimed, or shown.
    fn stage_times(&mut self, shown: Option<u32>) -> Measured<()> {
        let nothing = |why: &str| Err(Trouble::NoAnswer(why.to_string()));
        // A method that has a name has its order; slopes of few digits may show another.
        let known = self.name.one().map(|found| found.known.order);
        let order = self.claims.order.or(known).or(shown);
        let driven = match order {
            Some(order) => stage_times::measure(&self.probe, order),
            None => nothing("no order is claimed, and none was found"),
        };
        // A program need not know how to drive a pendulum.
        let claimed = match driven {
            Err(Trouble::NoAnswer(_)) => None,
            _ => self.claims.implied(),
        };
        self.note(Property::StageTimes, claimed, driven, |driven| {
            stage_times::judge(driven, order.unwrap_or_default())
        })?;
        Ok(())
    }
}
