//! What the judge found.

use super::advice::{self, Advice};
use super::claims::Claims;
use super::equation::{Departure, Equation};
use super::identity::Identity;
use super::resemblance::Resemblance;
use super::verdict::{Measured, Trouble, Verdict};
use crate::known_answers::Known;
use crate::property::Property;
use pendula::systems::Phase;

pub use crate::finding::Finding;

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
    /// The tolerance of that run, and the error (rad) beside the ends of its steps.
    pub beside_steps: Option<(f64, f64)>,
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
    /// What it is but for one thing, if a claim fails.
    pub resembles: Option<Resemblance>,
    /// The known mistake that it makes, if a claim fails or none is made.
    pub mistake: Option<&'static Known>,
    /// What is known of it where it is no known method.
    pub description: Description,
    /// What is known of it as a solver, where it was judged as both.
    pub solver: Option<Description>,
    /// What to look at to mend it: at most three causes, that of most failures first.
    pub advice: Vec<Advice>,
    /// Property by property.
    pub findings: Vec<Finding>,
    /// What a report can draw.
    pub evidence: Evidence,
}

/// What is known of a program that is no known method.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Description {
    /// Nothing.
    #[default]
    Nothing,
    /// It is one of these methods, as far as its digits tell.
    OneOf(Vec<&'static str>),
    /// It solves another equation, by none of the known methods.
    On(Equation),
    /// It ended before more was measured; on this equation, if it is another one.
    BrokeOff(Option<Equation>),
    /// What its properties are, as far as they were measured.
    Step {
        /// Whether an order was measured, and if it is clear, which.
        order: Option<Option<u32>>,
        /// Whether a step preserves area.
        area: Option<bool>,
        /// Whether a step is symmetric.
        symmetric: Option<bool>,
        /// The leading error of a step at (1 rad, ω₀), in θ and ω/ω₀, over x to the power order +
        /// 1.
        error: Option<(u32, [f64; 2])>,
    },
    /// A solver: its order and the power of its estimate, each with its uncertainty.
    Solver {
        /// The order.
        order: Option<[f64; 2]>,
        /// The power of the estimate.
        estimate: Option<[f64; 2]>,
    },
    /// It does not solve.
    SolvesNothing,
}

impl Report {
    /// The finding of this property.
    pub fn finding(&self, property: Property) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.property == property)
    }

    /// The finding of this property, if it has this verdict.
    pub(crate) fn found(&self, property: Property, verdict: Verdict) -> Option<&Finding> {
        self.finding(property).filter(|finding| finding.verdict == verdict)
    }

    /// The claimed properties with this verdict.
    pub(crate) fn claimed(&self, verdict: Verdict) -> impl Iterator<Item = Property> {
        let those = self.findings.iter().filter(|finding| finding.claimed.is_some());
        those.filter(move |finding| finding.verdict == verdict).map(|finding| finding.property)
    }

    /// The properties whose claims fail.
    pub fn failures(&self) -> impl Iterator<Item = Property> {
        self.claimed(Verdict::Fails)
    }

    /// Notes what was found of a property, and returns its verdict. What nobody claims is noted and
    /// not judged. Only a broken protocol ends it all.
    pub(crate) fn note(
        &mut self,
        property: Property,
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
        self.findings.push(Finding { property, claimed, verdict, ..told });
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
        claims: [(Property, Option<String>); N],
    ) -> Self {
        let made = claims.into_iter().filter(|(_, claimed)| claimed.is_some());
        let unknown = made.map(|(property, claimed)| {
            let why = format!("it does not know {word}");
            Finding { property, claimed, ..Finding::nothing(why) }
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
        let of_a_solver = Claims::none().of_a_solver().map(|(property, _)| property);
        let of_steps = Claims::none().of_steps().map(|(property, _)| property);
        self.findings.retain(|finding| !of_a_solver.contains(&finding.property));
        self.solver = Some(solver.description);
        let findings = solver.findings.into_iter();
        let findings = findings.filter(|finding| !of_steps.contains(&finding.property));
        self.findings
            .extend(findings.map(|it| Finding { property: it.property.of_solver(), ..it }));
        self.advice.extend(solver.advice);
        self.advice.truncate(advice::MOST);
        self.evidence.tolerances = solver.evidence.tolerances;
        self.evidence.outputs = solver.evidence.outputs;
        self.evidence.beside_steps = solver.evidence.beside_steps;
        self.conclude(!self.anything_claimed());
        self
    }

    /// Whether claims were made.
    pub(crate) fn anything_claimed(&self) -> bool {
        self.findings.iter().any(|finding| finding.claimed.is_some())
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use pendula::methods::{DormandPrince, StormerVerlet};

    use super::*;
    use crate::{ByTolerance, judge, judge_solver};

    /// What is said of the claim of this property.
    #[track_caller]
    fn said(report: &Report, property: Property) -> (Option<&str>, Verdict, String) {
        let mut those = report.findings.iter().filter(|finding| finding.property == property);
        let (Some(finding), None) = (those.next(), those.next()) else {
            panic!("{property}: {report}")
        };
        (finding.claimed.as_deref(), finding.verdict, finding.why())
    }

    /// Catches: a claim of a solver made of what takes equal steps, or the other way round, that is
    /// dropped in silence, holds, fails, or is said of what nobody claims.
    #[test]
    fn a_claim_that_has_no_word_is_not_measured() {
        let unknown = |claimed, why: &str| (Some(claimed), Verdict::NotMeasured, why.to_string());
        let claims = Claims::order(2).symplectic().estimate(5).free_outputs().crossings();
        let steps = judge(&StormerVerlet, claims);
        for (name, claimed) in [
            (Property::Estimate, "5"),
            (Property::FreeOutputs, "free"),
            (Property::Crossings, "crossings"),
        ] {
            assert_eq!(said(&steps, name), unknown(claimed, "it does not know solve"));
        }
        assert_eq!(
            (steps.verdict, said(&steps, Property::Area).1),
            (Verdict::NotMeasured, Verdict::Holds)
        );
        let of_another = judge(&StormerVerlet, Claims::order(4).estimate(5));
        assert_eq!(of_another.verdict, Verdict::Fails);
        for claims in [Claims::none(), Claims::order(2)] {
            assert_eq!(judge(&StormerVerlet, claims).finding(Property::Estimate), None);
        }

        let solver = ByTolerance::new(DormandPrince);
        let claims = Claims::order(5).symplectic().symmetric().bounded_energy();
        let solver = judge_solver(&solver, claims.evaluations(6).name("dormand-prince"));
        for (name, claimed) in [
            (Property::Area, "symplectic"),
            (Property::Reversal, "symmetric"),
            (Property::Energy, "bounded"),
            (Property::Evaluations, "6 a step"),
            (Property::Name, "dormand-prince"),
        ] {
            assert_eq!(said(&solver, name), unknown(claimed, "it does not know pendulum"));
        }
        assert_eq!(
            (solver.verdict, said(&solver, Property::Order).1),
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
        let names: BTreeSet<Property> =
            joined.findings.iter().map(|finding| finding.property).collect();
        assert_eq!(names.len(), joined.findings.len(), "{joined}");
        for (name, alone, of) in [
            (Property::Order, Property::Order, &steps),
            (Property::SolveOrder, Property::Order, &solver),
            (Property::SolveOutput, Property::Output, &solver),
        ] {
            let alone = of.finding(alone).unwrap();
            assert_eq!(joined.finding(name).unwrap(), &Finding { property: name, ..alone.clone() });
        }
        let [of_steps, of_solver] = [&steps, &solver].map(Report::what_it_is);
        assert_eq!(joined.what_it_is(), format!("{of_steps}; with a tolerance, it is {of_solver}"));
        assert_eq!(joined.evidence.ladder, steps.evidence.ladder);
        assert_eq!(joined.evidence.tolerances, solver.evidence.tolerances);
        assert!(!joined.evidence.outputs.is_empty() && !joined.evidence.tolerances.is_empty());

        let (_, solver, joined) = both(&claims.clone().estimate(9));
        assert_eq!(
            (joined.verdict, joined.failures().next()),
            (Verdict::Fails, Some(Property::Estimate))
        );
        assert_eq!(joined.advice, solver.advice);
        let (steps, solver, joined) = both(&claims.estimate(9).symplectic().evaluations(5));
        assert_eq!(
            joined.failures().collect::<Vec<_>>(),
            [Property::Area, Property::Evaluations, Property::Estimate]
        );
        let advice = [steps.advice, solver.advice].concat();
        assert_eq!(joined.advice, advice[..advice.len().min(3)]);
        let (.., joined) = both(&Claims::none());
        assert_eq!(joined.verdict, Verdict::Unclaimed, "{joined}");
    }
}
