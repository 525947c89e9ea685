//! The report in words: what it is, the verdict, and the table.

use core::fmt;

use super::finding::one_of;
use super::numbers::{Scientific, raised};
use crate::finding::Finding;
use crate::judge::identity::{self, Identity};
use crate::judge::report::{Description, Report};
use crate::judge::verdict::Verdict;
use crate::known_answers;
use crate::property::Property;

impl Report {
    /// What to look at to mend it: at most three sentences, the cause of most failures first.
    pub fn look_at(&self) -> Vec<String> {
        self.advice.iter().map(ToString::to_string).collect()
    }

    /// What it is, in words without a full stop.
    pub fn what_it_is(&self) -> String {
        let steps = self.what_its_steps_are();
        match &self.solver {
            Some(solver) => format!("{steps}; with a tolerance, it is {solver}"),
            None => steps,
        }
    }

    /// What it is by its fixed steps, or, of what is a solver alone, what that is.
    fn what_its_steps_are(&self) -> String {
        let of_mistake = || {
            let known = self.mistake?;
            let of = known_answers::method(&known.mistake.as_ref()?.of)?;
            let (_, title) = identity::names(of);
            Some(format!("{title} with a known mistake, {}", known.name))
        };
        let identity = self.identity.as_ref().map(Identity::to_string);
        let known = identity.or_else(of_mistake);
        let known = known.or_else(|| self.resembles.map(|it| it.to_string()));
        known.unwrap_or_else(|| self.description.to_string())
    }

    /// The verdict in a sentence.
    pub fn summary(&self) -> String {
        if !self.anything_claimed() {
            return match self.verdict {
                Verdict::NotMeasured => "Nothing is claimed, and nothing was measured.".to_string(),
                _ => format!("Nothing is claimed. It is {}.", self.what_it_is()),
            };
        }
        let named = |verdict, before: &str| {
            let names: Vec<&str> = self.claimed(verdict).map(Property::name).collect();
            (!names.is_empty()).then(|| format!("{before}: {}.", names.join(", ")))
        };
        let many = self.failures().nth(1).is_some();
        let none = "No claim fails, but some could not be decided.".to_string();
        let parts = [
            named(Verdict::Fails, if many { "Claims fail" } else { "A claim fails" })
                .or(Some(none)),
            named(Verdict::NotMeasured, "Not measured"),
            named(Verdict::Unclear, "Unclear"),
        ];
        match self.verdict {
            Verdict::Holds => "Every claim holds.".to_string(),
            _ => parts.into_iter().flatten().collect::<Vec<_>>().join(" "),
        }
    }
}

impl fmt::Display for Description {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => {
                f.write_str("not known, because nothing was measured that would show it")
            }
            Self::OneOf(names) => write!(f, "{}, as far as its digits show", one_of(names)),
            Self::On(equation) => write!(f, "none of the known methods, on {equation}"),
            Self::BrokeOff(None) => f.write_str("not known"),
            Self::BrokeOff(Some(equation)) => write!(f, "not known, on {equation}"),
            Self::Step { order, area, symmetric, error } => {
                let order = order.map(|order| match order {
                    Some(order) => format!("order {order}"),
                    None => "no clear order".to_string(),
                });
                let which = |holds: bool, yes: &str, no: &str| {
                    if holds { yes.to_string() } else { no.to_string() }
                };
                let properties = [
                    order,
                    area.map(|holds| which(holds, "preserves area", "does not preserve area")),
                    symmetric.map(|holds| which(holds, "symmetric", "not symmetric")),
                ];
                let properties: Vec<String> = properties.into_iter().flatten().collect();
                if properties.is_empty() {
                    return Self::Nothing.fmt(f);
                }
                write!(f, "none of the known methods: {}", properties.join(", "))?;
                let Some((order, error)) = error else { return Ok(()) };
                let [theta, omega] = error.map(|error| Scientific(error, 3));
                let power = raised(*order as usize + 1);
                write!(
                    f,
                    "; from θ = 1 rad and ω = ω₀ a step errs by {theta} x{power} in θ and {omega} \
                     x{power} in ω/ω₀, where x = ω₀h"
                )
            }
            Self::Solver { order: Some(order), estimate: Some(estimate) } => {
                let [order, estimate] = [order, estimate]
                    .map(|[value, off]| format!("{value:.1} ± {:.1}", off.max(0.1)));
                write!(f, "a solver of order {order} with an estimate of power {estimate}")
            }
            Self::Solver { .. } => f.write_str("a solver whose order does not show"),
            Self::SolvesNothing => f.write_str("not known, because it does not solve"),
        }
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
            rows.map(|x| [x.property.to_string(), claimed(x), x.verdict.name().to_string()])
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
            let verdict = finding.verdict;
            match verdict {
                Verdict::NotMeasured => writeln!(f, "{}{}", padded(row), finding.why())?,
                _ => writeln!(f, "{}{}", padded(row), finding.measured())?,
            }
            if matches!(verdict, Verdict::Fails | Verdict::Unclear) {
                writeln!(f, "    {}", finding.why())?;
            }
        }
        if !self.advice.is_empty() {
            writeln!(f, "\nWhat to look at:")?;
            for advice in &self.advice {
                writeln!(f, "  • {advice}")?;
            }
        }
        writeln!(f)?;
        if self.anything_claimed() {
            writeln!(f, "What it is: {}.", self.what_it_is())?;
        }
        writeln!(f, "{}", self.summary())
    }
}
