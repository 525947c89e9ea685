//! The judge: what an integrator really is, and whether it keeps what is claimed of it.
//!
//! Any integrator can be judged, in any language: all that is asked of it is a map from (g/L, θ, ω,
//! h, n) to states. Each property is measured with a tolerance that is derived from the stranger's
//! own rounding, which is measured first; and the verdict on a claim is one of three, as a
//! measurement may be too coarse to tell.
//!
//! ```
//! use pendula::methods::StormerVerlet;
//! use pendula::verify::{Claims, judge};
//!
//! let report = judge(&StormerVerlet, Claims::order(2).symplectic().symmetric().evaluations(1));
//! report.assert();
//! ```
//!
//! A wrong claim is refused:
//!
//! ```should_panic
//! use pendula::methods::ForwardEuler;
//! use pendula::verify::{Claims, judge};
//!
//! judge(&ForwardEuler, Claims::order(1).symplectic()).assert();
//! ```
//!
//! Every integrator claims by implication what needs no claim: that it respects the mirror, the
//! unit of time and a full turn, that n steps are n·h, that the same question has the same answer,
//! that it computes in double precision, and that its stages know the time, if it can be driven.

mod area;
mod claims;
mod clock;
mod energy;
mod evaluations;
pub(crate) mod identity;
mod loss;
pub(crate) mod order;
pub(crate) mod probe;
mod repeatable;
mod report;
mod reversal;
mod stage_times;
mod stranger;
mod symmetry;

pub use claims::Claims;
pub use identity::{Identity, Seen};
use probe::{Measured, Probe, Trouble};
pub use report::{Evidence, Finding, Report, Verdict};
pub use stranger::{ByPointer, Drive, Fault, FromFn, Listed, Reply, Request, Stranger};

/// Judges `stranger` by its `claims`.
///
/// # Panics
/// If the stranger breaks the protocol, which a program may do; see [`try_judge`].
#[track_caller]
pub fn judge(stranger: &dyn Stranger, claims: Claims) -> Report {
    match try_judge(stranger, &claims) {
        Ok(report) => report,
        Err(fault) => panic!("{fault}"),
    }
}

/// Judges `stranger` by its `claims`.
///
/// # Errors
/// What the stranger did, if it broke the protocol.
pub fn try_judge(stranger: &dyn Stranger, claims: &Claims) -> Result<Report, String> {
    let broken = |trouble: Trouble| trouble.to_string();
    let mut judge = Judge { probe: Probe::new(stranger).map_err(broken)?, claims, report: empty() };
    judge.take_all().map_err(broken)?;
    let mut report = judge.report;
    let of = |verdict| report.findings.iter().any(|finding| finding.verdict == verdict);
    report.verdict = if of(Verdict::Fails) {
        Verdict::Fails
    } else if of(Verdict::Unclear) {
        Verdict::Unclear
    } else {
        Verdict::Holds
    };
    Ok(report)
}

fn empty() -> Report {
    Report {
        verdict: Verdict::Unclear,
        identity: None,
        description: String::new(),
        findings: Vec::new(),
        evidence: Evidence::default(),
    }
}

/// The report as it grows.
struct Judge<'s> {
    probe: Probe<'s>,
    claims: &'s Claims,
    report: Report,
}

/// What a failed measurement is to a claim that all make.
fn unmeasured(trouble: &Trouble) -> (Verdict, String) {
    match trouble {
        Trouble::NoAnswer(why) => (Verdict::Unclear, format!("not measured: {why}")),
        other => (Verdict::Fails, other.to_string()),
    }
}

/// A claim that everybody makes.
fn implied() -> Option<String> {
    Some("implied".to_string())
}

impl Judge<'_> {
    /// Notes what was found of the property `name`. What nobody claims is said and not judged.
    fn note(
        &mut self,
        name: &'static str,
        claimed: Option<String>,
        measured: String,
        (verdict, why): (Verdict, String),
    ) {
        let verdict = if claimed.is_some() { verdict } else { Verdict::Unclaimed };
        self.report.findings.push(Finding { name, claimed, measured, verdict, why });
    }

    /// Notes a property whose measurement may have failed. Only a broken protocol ends it all.
    fn note_measured<T>(
        &mut self,
        name: &'static str,
        claimed: Option<String>,
        found: Measured<T>,
        told: impl FnOnce(&T) -> (String, (Verdict, String)),
    ) -> Measured<Option<T>> {
        match found {
            Ok(found) => {
                let (measured, judged) = told(&found);
                self.note(name, claimed, measured, judged);
                Ok(Some(found))
            }
            Err(Trouble::Broken(why)) => Err(Trouble::Broken(why)),
            Err(trouble) => {
                self.note(name, claimed, "–".to_string(), unmeasured(&trouble));
                Ok(None)
            }
        }
    }

    /// Takes the properties one after the other.
    fn take_all(&mut self) -> Measured<()> {
        let claims = self.claims;
        let symplectic = claims.symplectic.then(|| "symplectic".to_string());
        let symmetric = claims.symmetric.then(|| "symmetric".to_string());
        let shown = self.order()?;

        let defect = area::largest(&self.probe);
        let defect = self.note_measured("area", symplectic, defect, |defect| {
            (
                format!("det J − 1 = {:.1e} at x = {:.1}", defect.value, defect.x),
                area::judge(defect),
            )
        })?;
        let way = reversal::worst(&self.probe);
        let way = self.note_measured("reversal", symmetric, way, |way| {
            (format!("misses the start by {:.1e} rad", way.miss), reversal::judge(way))
        })?;
        let bounded = claims.bounded_energy.then(|| "bounded".to_string());
        let run = energy::worst(&self.probe);
        let run = self
            .note_measured("energy", bounded, run, |run| (energy::line(run), energy::judge(run)))?;
        self.symmetries()?;

        let is_symplectic = defect.as_ref().is_some_and(|d| area::judge(d).0 == Verdict::Holds);
        let is_symmetric = way.as_ref().is_some_and(|w| reversal::judge(w).0 == Verdict::Holds);
        self.identity(shown, is_symplectic, is_symmetric)?;
        self.stage_times(shown)?;

        let evidence = &mut self.report.evidence;
        evidence.energy = run.map(|run| run.samples).unwrap_or_default();
        evidence.square = area::square(&self.probe).ok();
        evidence.way = reversal::drawn(&self.probe).ok();
        Ok(())
    }

    /// The order: as claimed, or as found.
    fn order(&mut self) -> Measured<Option<u32>> {
        let claimed = self.claims.order;
        let ladder = order::ladder(&self.probe, claimed.unwrap_or(4));
        let text = claimed.map(|order| order.to_string());
        let ladder = self.note_measured("order", text, ladder, |ladder| {
            let judged = match claimed {
                Some(order) => order::judge(ladder, order),
                None => (Verdict::Unclaimed, String::new()),
            };
            (order::line(ladder), judged)
        })?;
        let Some(ladder) = ladder else { return Ok(None) };
        let shown = order::shown(&ladder);
        self.report.evidence.ladder = ladder.rungs;
        Ok(shown)
    }

    /// What everybody claims.
    fn symmetries(&mut self) -> Measured<()> {
        type Check<'s> = fn(&Probe<'s>) -> Measured<symmetry::Apart>;
        let checks: [(&'static str, Check<'_>); 3] =
            [("mirror", symmetry::mirror), ("units", symmetry::units), ("turn", symmetry::turn)];
        for (name, check) in checks {
            let apart = check(&self.probe);
            self.note_measured(name, implied(), apart, |apart| {
                let mirror = name == "mirror";
                let judged = if mirror { apart.judge() } else { apart.judge_with_tolerance() };
                (format!("apart by {:.1e} rad", apart.largest), judged)
            })?;
        }
        let clock = clock::clock(&self.probe);
        self.note_measured("clock", implied(), clock, |clock| {
            (format!("{:.2} steps apart", clock.steps_apart), clock.judge())
        })?;
        let claimed = self.claims.evaluations;
        let text = claimed.map(|a_step| format!("{a_step} a step"));
        let counted = evaluations::counted(&self.probe);
        self.note_measured("evaluations", text, counted, |counted| match *counted {
            None => {
                ("not counted".to_string(), (Verdict::Unclear, "nobody counts them".to_string()))
            }
            Some(counted) => {
                let right = claimed.is_some_and(|claimed| counted == claimed as f64);
                let verdict = if right { Verdict::Holds } else { Verdict::Fails };
                (format!("{counted} a step"), (verdict, "counted over a thousand steps".into()))
            }
        })?;
        let repeated = repeatable::other_answers(&self.probe);
        self.note_measured("repeatable", implied(), repeated, |wrong| match wrong {
            None => ("the same bits".to_string(), (Verdict::Holds, "to the bit".to_string())),
            Some(wrong) => ("other answers".to_string(), (Verdict::Fails, (*wrong).to_string())),
        })?;
        Ok(())
    }

    /// What it is, and what follows from it: loss, precision and name.
    fn identity(
        &mut self,
        shown: Option<u32>,
        is_symplectic: bool,
        is_symmetric: bool,
    ) -> Measured<()> {
        let identity = match identity::identify(&self.probe, shown) {
            Ok(identity) => identity,
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            Err(_) => None,
        };
        let claims = self.claims;
        let loss = loss::measure(
            &self.probe,
            identity.as_ref(),
            claims.symmetric || (!claims.symplectic && is_symmetric),
            claims.symplectic || is_symplectic,
        );
        let judged = claims.symplectic || claims.symmetric || identity.is_some();
        if let Some(loss) = loss {
            let claimed = judged.then(implied).flatten();
            self.note_measured("loss", claimed, loss, |loss| (loss.line(), loss.judge()))?;
        } else {
            let why = "it claims nothing that would not lose".to_string();
            self.note("loss", None, "–".to_string(), (Verdict::Unclaimed, why));
        }
        self.precision();
        self.description(shown, is_symplectic, is_symmetric);
        let name = match (&identity, &claims.name) {
            (Some(identity), Some(name)) if identity.is_plain() && identity.method == name => {
                (Verdict::Holds, "its steps are those of the method".to_string())
            }
            (Some(identity), _) => (Verdict::Fails, format!("it is {identity}")),
            (None, _) => (Verdict::Fails, "its steps are those of no method on the list".into()),
        };
        let measured = identity
            .as_ref()
            .map_or("none on the list".to_string(), |identity| identity.method.to_string());
        self.note("name", claims.name.clone(), measured, name);
        self.report.identity = identity;
        Ok(())
    }

    /// The rounding of a step. An f64 rounds by 1.1·10⁻¹⁶; a step of a hundred operations, or one
    /// that is solved to the last digits, by some times that. Single precision makes 6·10⁻⁸.
    fn precision(&mut self) {
        let rounding = self.probe.rounding;
        let why = format!("a step rounds by {rounding:.0e} of a state of order 1");
        let verdict = if rounding <= 2e-14 {
            Verdict::Holds
        } else if rounding <= 1e-11 {
            Verdict::Unclear
        } else {
            Verdict::Fails
        };
        self.note("precision", implied(), format!("{rounding:.0e}"), (verdict, why));
    }

    /// What is to be said of a step that is none of the list's.
    fn description(&mut self, shown: Option<u32>, is_symplectic: bool, is_symmetric: bool) {
        let order = shown.map_or("no clear order".to_string(), |order| format!("order {order}"));
        let area = if is_symplectic { "keeps area" } else { "does not keep area" };
        let back = if is_symmetric { "symmetric" } else { "not symmetric" };
        let error = shown.filter(|order| (1..=8).contains(order)).and_then(|order| {
            let [theta, omega] = identity::leading_error(&self.probe, order).ok()?;
            let power = order + 1;
            Some(format!(
                "; the error of a step at (1 rad, ω₀) is ({theta:.3e}, {omega:.3e}) x^{power} in θ \
                 and ω/ω₀"
            ))
        });
        self.report.description =
            format!("nothing on the list; {order}, {area}, {back}{}", error.unwrap_or_default());
    }

    /// Stages that know the time, where there is a drive.
    fn stage_times(&mut self, shown: Option<u32>) -> Measured<()> {
        let Some(order) = shown.or(self.claims.order) else {
            let why = "there is no order to hold them to".to_string();
            self.note("stage-times", None, "–".to_string(), (Verdict::Unclaimed, why));
            return Ok(());
        };
        let driven = match stage_times::measure(&self.probe, order) {
            Err(Trouble::NoAnswer(why)) => {
                self.note("stage-times", None, why, (Verdict::Unclaimed, String::new()));
                return Ok(());
            }
            driven => driven,
        };
        self.note_measured("stage-times", implied(), driven, |driven| {
            let slopes = driven.slopes.iter().map(|slope| format!("{slope:.2}"));
            let line = slopes.collect::<Vec<_>>().join(", ");
            let line = if line.is_empty() { "rounding".into() } else { format!("slopes {line}") };
            (format!("with a drive: {line}"), stage_times::judge(driven, order))
        })?;
        Ok(())
    }
}
