//! What the judge found.

use core::fmt;

use super::identity::Identity;
use crate::systems::Phase;

/// What is to be said of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds.
    Holds,
    /// It does not.
    Fails,
    /// It cannot be told, as from rounding.
    Unclear,
    /// Nobody claims it; what was measured is said all the same.
    Unclaimed,
}

impl Verdict {
    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::Unclear => "unclear",
            Self::Unclaimed => "unclaimed",
        }
    }
}

/// What was found of one property.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The property.
    pub name: &'static str,
    /// What is claimed; "implied" for what everybody claims.
    pub claimed: Option<String>,
    /// What was measured.
    pub measured: String,
    /// What is to be said of the claim.
    pub verdict: Verdict,
    /// The bound, where it comes from, and what follows.
    pub why: String,
}

/// Measurements that a report can draw.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evidence {
    /// Step (s) and largest error (rad) on the ladder that shows the order.
    pub ladder: Vec<(f64, f64)>,
    /// Time (s) and relative energy error, (H − H₀)/(g/L), of a long run.
    pub energy: Vec<(f64, f64)>,
    /// The corners of a square, its images after one step, and the centre of both.
    pub square: Option<([Phase; 4], [Phase; 4])>,
    /// States on a way out, and of the way back.
    pub way: Option<(Vec<Phase>, Vec<Phase>)>,
}

/// What the judge found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// `Fails` if a claim does, else `Unclear` if one is, else `Holds`.
    pub verdict: Verdict,
    /// The method of the library that it really is, if it is one.
    pub identity: Option<Identity>,
    /// What is to be said of its step where it is none: order, symmetry and leading error.
    pub description: String,
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

    /// Names of the properties whose claims fail.
    pub fn failures(&self) -> impl Iterator<Item = &'static str> {
        let failed = self.findings.iter().filter(|finding| finding.verdict == Verdict::Fails);
        failed.map(|finding| finding.name)
    }

    /// Panics with the report if a claim fails.
    ///
    /// # Panics
    /// That is what it is for, in a test.
    #[track_caller]
    pub fn assert(&self) {
        assert!(self.verdict != Verdict::Fails, "\n{self}");
    }
}

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
            core::array::from_fn(|i| widths[i].max(row[i].chars().count()))
        });
        let padded = |row: [String; 3]| {
            let cells = row.into_iter().zip(widths);
            let cells = cells.map(|(cell, width)| format!("{cell:width$}  "));
            cells.collect::<String>()
        };
        writeln!(f, "{}measured", padded(head))?;
        for (finding, row) in self.findings.iter().zip(rows()) {
            writeln!(f, "{}{}", padded(row), finding.measured)?;
            if matches!(finding.verdict, Verdict::Fails | Verdict::Unclear) {
                writeln!(f, "    {}: {}", finding.verdict.name(), finding.why)?;
            }
        }
        let is = match &self.identity {
            Some(identity) => identity.to_string(),
            None => self.description.clone(),
        };
        writeln!(f, "\nWhat it is: {is}.")?;
        match self.verdict {
            Verdict::Fails => {
                let failed: Vec<&str> = self.failures().collect();
                writeln!(f, "A claim fails: {}.", failed.join(", "))
            }
            Verdict::Unclear => writeln!(f, "No claim fails; some cannot be told."),
            _ => writeln!(f, "Every claim holds."),
        }
    }
}
