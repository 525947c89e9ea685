//! What the judge found, and how its numbers are written.

use core::fmt;

use super::claims::Claims;
use super::equation::Departure;
use super::identity::{self, Identity};
use super::look;
use super::verdict::{Measured, Trouble, Verdict};
use crate::known_answers::{self, Known};
use pendula::systems::Phase;

/// What was found of one property.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Finding {
    /// The property.
    pub name: &'static str,
    /// What is claimed; "implied" for what everybody claims as soon as anything is claimed.
    pub claimed: Option<String>,
    /// What was measured, in words.
    pub measured: String,
    /// The numbers of it, in [`unit`](Self::unit); none if it was not measured.
    pub values: Vec<f64>,
    /// The unit of the numbers: "rad", "a step"; empty for pure numbers.
    pub unit: &'static str,
    /// What the value may be at most where the claim holds, if one number decides.
    pub bound: Option<f64>,
    /// What is to be said of the claim.
    pub verdict: Verdict,
    /// The bound, where it comes from, and what follows; or why it was not measured.
    pub why: String,
}

impl Finding {
    /// One number, which `bound` decides.
    pub(crate) fn number(value: f64, unit: &'static str, bound: f64, verdict: Verdict) -> Self {
        Self { values: vec![value], unit, bound: Some(bound), verdict, ..Self::default() }
    }

    /// That nothing is known, and why.
    pub(crate) fn nothing(why: String) -> Self {
        Self { measured: "–".to_string(), why, ..Self::default() }
    }
}

/// What a measurement that was not had says: a stranger without an answer was not measured, one
/// with a wrong answer fails.
impl From<Trouble> for Finding {
    fn from(trouble: Trouble) -> Self {
        match trouble {
            Trouble::NoAnswer(why) => Self::nothing(why),
            other => {
                let why = other.to_string();
                Self { verdict: Verdict::Fails, measured: why.clone(), why, ..Self::default() }
            }
        }
    }
}

/// Measurements that a report can draw.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Evidence {
    /// Step (s) and largest error (rad) on the ladder that shows the order.
    pub ladder: Vec<(f64, f64)>,
    /// Time (s) and relative energy error, (H − H₀)/(g/L), of a long run.
    pub energy: Vec<(f64, f64)>,
    /// The corners of a square, its images after one step, and the centre of both.
    pub square: Option<([Phase; 4], [Phase; 4])>,
    /// States on a way out from the start on, and of the way back.
    pub way: Option<(Vec<Phase>, Vec<Phase>)>,
    /// Angle (rad) and the force that acts there, in units of g/L, if it is not the pendulum's.
    pub force: Vec<(f64, f64)>,
    /// Of a solver: tolerances, the largest error (rad) and the evaluations, if somebody counts.
    pub tolerances: Vec<(f64, f64, Option<u64>)>,
    /// Of a solver: time (s) and error (rad) of the outputs along a run.
    pub outputs: Vec<(f64, f64)>,
}

/// What the judge found.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Of all claims: `Fails` if one does; else `NotMeasured` or `Unclear` if one is; else `Holds`.
    /// Without claims `Unclaimed`, or `NotMeasured` if nothing could be measured at all.
    pub verdict: Verdict,
    /// The known method that it really is, if it is one.
    pub identity: Option<Identity>,
    /// In what it departs from the pendulum that is asked for, if it does.
    pub departure: Option<Departure>,
    /// What it is but for one thing, if a claim fails: "Störmer–Verlet, but each step lacks its
    /// first half kick".
    pub resembles: Option<String>,
    /// The known mistake that it makes, if a claim fails or none is made.
    pub mistake: Option<&'static Known>,
    /// What is to be said of its step where it is none: order, symmetry and leading error.
    pub description: String,
    /// What is to be said of it as a solver, where it was judged as both.
    pub solver: Option<String>,
    /// What to look at to mend it: at most three sentences, the cause first.
    pub look_at: Vec<String>,
    /// Property by property.
    pub findings: Vec<Finding>,
    /// What a report can draw.
    pub evidence: Evidence,
}

impl Report {
    /// The finding of this name.
    pub fn finding(&self, name: &str) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.name == name)
    }

    /// Names of the claimed properties with this verdict.
    fn claimed(&self, verdict: Verdict) -> impl Iterator<Item = &'static str> {
        let those = self.findings.iter().filter(|finding| finding.claimed.is_some());
        those.filter(move |finding| finding.verdict == verdict).map(|finding| finding.name)
    }

    /// Names of the properties whose claims fail.
    pub fn failures(&self) -> impl Iterator<Item = &'static str> {
        self.claimed(Verdict::Fails)
    }

    /// Notes what was found of the property `name`, and returns its verdict. What nobody claims is
    /// said and not judged. Only a broken protocol ends it all.
    pub(crate) fn note(
        &mut self,
        name: &'static str,
        claimed: Option<String>,
        found: Measured<Finding>,
    ) -> Measured<Verdict> {
        let told = match found {
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            found => found.unwrap_or_else(Finding::from),
        };
        let shown = told.verdict;
        let verdict = match shown {
            Verdict::NotMeasured => shown,
            _ if claimed.is_none() => Verdict::Unclaimed,
            _ => shown,
        };
        self.findings.push(Finding { name, claimed, verdict, ..told });
        Ok(shown)
    }

    /// Notes the verdict on all claims, or on none.
    #[doc(hidden)]
    pub fn conclude(&mut self, none_made: bool) {
        let of = |verdict| self.claimed(verdict).next().is_some();
        let measured = |finding: &Finding| !finding.values.is_empty();
        let worst = [Verdict::Fails, Verdict::NotMeasured, Verdict::Unclear];
        self.verdict = if none_made {
            let any = self.findings.iter().any(measured);
            if any { Verdict::Unclaimed } else { Verdict::NotMeasured }
        } else {
            worst.into_iter().find(|verdict| of(*verdict)).unwrap_or(Verdict::Holds)
        };
    }

    /// With the claims that are not measured, as the word of the protocol that they need is not
    /// known.
    pub(crate) fn without_word<const N: usize>(
        mut self,
        word: &str,
        claims: [(&'static str, Option<String>); N],
    ) -> Self {
        let made = claims.into_iter().filter(|(_, claimed)| claimed.is_some());
        let unknown = made.map(|(name, claimed)| {
            let why = format!("it does not know {word}");
            Finding { name, claimed, ..Finding::nothing(why) }
        });
        let before = self.findings.len();
        self.findings.extend(unknown);
        if self.findings.len() > before {
            self.conclude(false);
        }
        self
    }

    /// The report on a program that knows both words of the protocol: this one on its equal steps,
    /// and `solver` on the same program as a solver. Where both have a property of the same name,
    /// such as order, the solver's is called solve-order.
    pub fn joined_with_solver(mut self, solver: Self) -> Self {
        // What the one does not know, the other does.
        let of_a_solver = Claims::none().of_a_solver().map(|(name, _)| name);
        let of_steps = Claims::none().of_steps().map(|(name, _)| name);
        self.findings.retain(|finding| !of_a_solver.contains(&finding.name));
        self.solver = Some(solver.what_it_is());
        let findings = solver.findings.into_iter();
        let findings = findings.filter(|finding| !of_steps.contains(&finding.name));
        self.findings.extend(findings.map(|it| Finding { name: beside_steps(it.name), ..it }));
        self.look_at.extend(solver.look_at);
        self.look_at.truncate(look::MOST);
        self.evidence.tolerances = solver.evidence.tolerances;
        self.evidence.outputs = solver.evidence.outputs;
        self.conclude(!self.anything_claimed());
        self
    }

    /// What it is, in words without a full stop.
    pub fn what_it_is(&self) -> String {
        let steps = self.what_its_steps_are();
        match &self.solver {
            Some(solver) => format!("{steps}; with a tolerance, it is {solver}"),
            None => steps,
        }
    }

    /// What it is by its equal steps, or, of what is a solver alone, what that is.
    fn what_its_steps_are(&self) -> String {
        let of_mistake = || {
            let known = self.mistake?;
            let of = known_answers::method(&known.mistake.as_ref()?.of)?;
            let (_, title) = identity::names(of);
            Some(format!("{title} with a known mistake, {}", known.name))
        };
        let identity = self.identity.as_ref().map(Identity::to_string);
        let known = identity.or_else(of_mistake).or_else(|| self.resembles.clone());
        known.unwrap_or_else(|| self.description.clone())
    }

    /// Whether claims were made.
    fn anything_claimed(&self) -> bool {
        self.findings.iter().any(|finding| finding.claimed.is_some())
    }

    /// The verdict in a sentence.
    pub fn summary(&self) -> String {
        if !self.anything_claimed() {
            return match self.verdict {
                Verdict::NotMeasured => "No claims made, and nothing was measured.".to_string(),
                _ => format!("No claims made. It is {}.", self.what_it_is()),
            };
        }
        let named = |verdict, before: &str| {
            let names: Vec<&str> = self.claimed(verdict).collect();
            (!names.is_empty()).then(|| format!("{before}{}", names.join(", ")))
        };
        let many = self.failures().nth(1).is_some();
        let parts = [
            named(Verdict::Fails, if many { "Claims fail: " } else { "A claim fails: " }),
            named(Verdict::NotMeasured, "not measured: "),
            named(Verdict::Unclear, "unclear: "),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        match self.verdict {
            Verdict::Holds => "Every claim holds.".to_string(),
            Verdict::Fails => format!("{}.", parts.join("; ")),
            _ => format!("No claim fails, but not every one is shown; {}.", parts.join("; ")),
        }
    }

    /// Panics with the report unless every claim was measured and holds.
    ///
    /// # Panics
    /// That is what it is for, in a test.
    #[track_caller]
    pub fn assert(&self) {
        assert!(self.verdict == Verdict::Holds, "\n{self}");
    }
}

/// The name of a property of a solver in a report that has those of equal steps too.
fn beside_steps(name: &'static str) -> &'static str {
    match name {
        "order" => "solve-order",
        "output" => "solve-output",
        "precision" => "solve-precision",
        "mirror" => "solve-mirror",
        "units" => "solve-units",
        "turn" => "solve-turn",
        "repeatable" => "solve-repeatable",
        other => other,
    }
}

/// The most characters to which a column is filled up: a formatter panics beyond 65 535, and a name
/// that is claimed may be of any length.
const WIDEST: usize = 100;

/// The report as a table.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let claimed =
            |finding: &Finding| finding.claimed.clone().unwrap_or_else(|| "–".to_string());
        let rows = || {
            let rows = self.findings.iter();
            rows.map(|x| [x.name.to_string(), claimed(x), x.verdict.name().to_string()])
        };
        let head = ["property", "claimed", "verdict"].map(str::to_string);
        let widths = rows().chain([head.clone()]).fold([0; 3], |widths, row| {
            core::array::from_fn(|i| widths[i].max(row[i].chars().count()).min(WIDEST))
        });
        let padded = |row: [String; 3]| {
            let cells = row.into_iter().zip(widths);
            let cells = cells.map(|(cell, width)| format!("{cell:width$}  "));
            cells.collect::<String>()
        };
        writeln!(f, "{}measured", padded(head))?;
        for (finding, row) in self.findings.iter().zip(rows()) {
            let Finding { measured, verdict, why, .. } = finding;
            match verdict {
                Verdict::NotMeasured => writeln!(f, "{}{why}", padded(row))?,
                _ => writeln!(f, "{}{measured}", padded(row))?,
            }
            if matches!(verdict, Verdict::Fails | Verdict::Unclear) {
                writeln!(f, "    {}: {why}", verdict.name())?;
            }
        }
        if !self.look_at.is_empty() {
            writeln!(f, "\nWhat to look at:")?;
            for line in &self.look_at {
                writeln!(f, "  • {line}")?;
            }
        }
        writeln!(f)?;
        if self.anything_claimed() {
            writeln!(f, "What it is: {}.", self.what_it_is())?;
        }
        writeln!(f, "{}", self.summary())
    }
}

// -------------------------------------------------------------------------------------------------
// Numbers, as the book prints them
// -------------------------------------------------------------------------------------------------

/// A number in scientific notation with this many digits after the point: 8.0 × 10⁻¹⁵; 0 is 0.
#[derive(Clone, Copy, Debug)]
pub struct Scientific(pub f64, pub usize);

impl fmt::Display for Scientific {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value, digits) = *self;
        if value == 0.0 || !value.is_finite() {
            return write!(f, "{value:.0}");
        }
        let text = format!("{value:.digits$e}").replace('-', "−");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        if exponent == "0" {
            return f.write_str(mantissa);
        }
        let raised = |c: char| match c {
            '−' => '⁻',
            digit => DIGITS[digit.to_digit(10).unwrap_or(0) as usize],
        };
        write!(f, "{mantissa} × 10{}", exponent.chars().map(raised).collect::<String>())
    }
}

const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// A whole number as an exponent: ⁴.
pub fn raised(power: usize) -> String {
    power.to_string().chars().map(|c| DIGITS[c.to_digit(10).unwrap_or(0) as usize]).collect()
}

/// With one digit after the point.
pub fn scientific(value: f64) -> Scientific {
    Scientific(value, 1)
}

/// A bound, of which only the size matters.
pub fn about(value: f64) -> Scientific {
    Scientific(value, 0)
}

/// Slopes, with two digits: "2.11, 2.00, −0.03".
pub fn slopes(slopes: &[f64]) -> String {
    // Without the sign of a slope that rounds to zero.
    let text = slopes.iter().map(|slope| format!("{slope:.2}").replace('-', "−"));
    let text = text.map(|text| if text == "−0.00" { "0.00".to_string() } else { text });
    text.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use pendula::methods::{DormandPrince, StormerVerlet};

    use super::*;
    use crate::{ByTolerance, judge, judge_solver};

    /// What is said of the claim of this property.
    #[track_caller]
    fn said<'r>(report: &'r Report, name: &str) -> (Option<&'r str>, Verdict, &'r str) {
        let mut those = report.findings.iter().filter(|finding| finding.name == name);
        let (Some(finding), None) = (those.next(), those.next()) else {
            panic!("{name}: {report}")
        };
        (finding.claimed.as_deref(), finding.verdict, &finding.why)
    }

    /// Catches: a claim of a solver made of what takes equal steps, or the other way round, that is
    /// dropped in silence, holds, fails, or is said of what nobody claims.
    #[test]
    fn a_claim_that_has_no_word_is_not_measured() {
        let unknown = |claimed, why| (Some(claimed), Verdict::NotMeasured, why);
        let claims = Claims::order(2).symplectic().estimate(5).free_outputs().crossings();
        let steps = judge(&StormerVerlet, claims);
        for (name, claimed) in
            [("estimate", "5"), ("free-outputs", "free"), ("crossings", "crossings")]
        {
            assert_eq!(said(&steps, name), unknown(claimed, "it does not know solve"));
        }
        assert_eq!((steps.verdict, said(&steps, "area").1), (Verdict::NotMeasured, Verdict::Holds));
        let of_another = judge(&StormerVerlet, Claims::order(4).estimate(5));
        assert_eq!(of_another.verdict, Verdict::Fails);
        for claims in [Claims::none(), Claims::order(2)] {
            assert_eq!(judge(&StormerVerlet, claims).finding("estimate"), None);
        }

        let solver = ByTolerance::new(DormandPrince);
        let claims = Claims::order(5).symplectic().symmetric().bounded_energy();
        let solver = judge_solver(&solver, claims.evaluations(6).name("dormand-prince"));
        for (name, claimed) in [
            ("area", "symplectic"),
            ("reversal", "symmetric"),
            ("energy", "bounded"),
            ("evaluations", "6 a step"),
            ("name", "dormand-prince"),
        ] {
            assert_eq!(said(&solver, name), unknown(claimed, "it does not know pendulum"));
        }
        assert_eq!(
            (solver.verdict, said(&solver, "order").1),
            (Verdict::NotMeasured, Verdict::Holds)
        );
    }

    /// Catches: two properties of one name, a claim that is known to one of the two and told to be
    /// unknown by the other, or judged by one alone; a verdict on steps, or on the solver, alone;
    /// what it is, what to look at, or a figure, of one of them lost.
    #[test]
    fn reports_on_steps_and_solver_are_one() {
        let both = |claims: &Claims| {
            let steps = judge(&DormandPrince, claims.clone());
            let solver = judge_solver(&ByTolerance::new(DormandPrince), claims.clone());
            (steps.clone(), solver.clone(), steps.joined_with_solver(solver))
        };
        let claims = Claims::order(5).estimate(5).free_outputs().crossings();
        let (steps, solver, joined) = both(&claims.clone().name("dormand-prince"));
        joined.assert();
        let names: BTreeSet<&str> = joined.findings.iter().map(|finding| finding.name).collect();
        assert_eq!(names.len(), joined.findings.len(), "{joined}");
        for (name, of) in [("order", &steps), ("solve-order", &solver), ("solve-output", &solver)] {
            let alone = of.finding(name.trim_start_matches("solve-")).unwrap();
            assert_eq!(joined.finding(name).unwrap(), &Finding { name, ..alone.clone() });
        }
        let [of_steps, of_solver] = [&steps, &solver].map(Report::what_it_is);
        assert_eq!(joined.what_it_is(), format!("{of_steps}; with a tolerance, it is {of_solver}"));
        assert_eq!(joined.evidence.ladder, steps.evidence.ladder);
        assert_eq!(joined.evidence.tolerances, solver.evidence.tolerances);
        assert!(!joined.evidence.outputs.is_empty() && !joined.evidence.tolerances.is_empty());

        let (_, solver, joined) = both(&claims.clone().estimate(9));
        assert_eq!((joined.verdict, joined.failures().next()), (Verdict::Fails, Some("estimate")));
        assert_eq!(joined.look_at, solver.look_at);
        let (steps, solver, joined) = both(&claims.estimate(9).symplectic().evaluations(5));
        assert_eq!(joined.failures().collect::<Vec<_>>(), ["area", "evaluations", "estimate"]);
        let look_at = [steps.look_at, solver.look_at].concat();
        assert_eq!(joined.look_at, look_at[..look_at.len().min(3)]);
        let (.., joined) = both(&Claims::none());
        assert_eq!(joined.verdict, Verdict::Unclaimed, "{joined}");
    }
}
