//! The interface between the book and the paper's ledger of claims.
//!
//! The directives `{{stated ID}}`, `{{measured ID}}` and `{{verdict ID}}` depend on a [`Ledger`]
//! only, so that a test can use its own and the library can change its types. [`Paper`] is the only
//! adapter to the library.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Result, anyhow};
use pendula_study::claims::Measured;
use pendula_study::experiments::Study;

use crate::interrupt::unless_interrupted;
use crate::progress::Progress;
use crate::versions::{Made, made, quietly, said};

/// The ledger's entry for one claim. A value is text, such as `2.01e-4`, `5.158 s` or `4`; the book
/// decides how to typeset it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Entry {
    /// The value as the paper prints it.
    pub stated: Option<String>,
    /// The value as the library measures it, in digits that hold on every machine.
    pub measured: Option<String>,
    /// The result of comparing the two.
    pub verdict: Option<String>,
    /// What it is: a cell or a sentence of the paper; a reading or a finding, which are not in it.
    pub kind: String,
}

/// Where values come from.
pub trait Ledger {
    /// The entry of a claim, such as `T4.rk4.0.01`; `None` if there is no such claim.
    fn entry(&self, id: &str) -> Option<Entry>;

    /// What the code makes of the snapshots with these names now, and why it does not make those
    /// that it cannot. A ledger that makes none has nothing to be quoted from them.
    ///
    /// # Errors
    /// If the user interrupts.
    fn snapshots(&self, _: BTreeSet<String>, _: &AtomicBool) -> Result<Made> {
        Ok(Made::default())
    }
}

impl<F: Fn(&str) -> Option<Entry>> Ledger for F {
    fn entry(&self, id: &str) -> Option<Entry> {
        self(id)
    }
}

/// The library's ledger of the paper's claims.
pub struct Paper(Arc<(Study, pendula_study::claims::Ledger)>);

impl Paper {
    /// Runs the study and measures every claim; `progress` shows the current experiment.
    pub fn measure(progress: &Progress) -> Self {
        progress.stage("", Study::EXPERIMENTS as usize);
        let study = Study::run(|experiment| progress.next(experiment));
        let ledger = pendula_study::claims::Ledger::new(&study);
        Self(Arc::new((study, ledger)))
    }
}

impl Ledger for Paper {
    fn entry(&self, id: &str) -> Option<Entry> {
        let claim = self.0.1.get(id)?;
        let measured = match claim.measured {
            Measured::Nothing => None,
            _ => Some(claim.measured_text()),
        };
        Some(Entry {
            stated: claim.stated.map(|_| claim.stated_text()),
            measured,
            verdict: Some(claim.judged().to_string()),
            kind: claim.kind().to_string(),
        })
    }

    fn snapshots(&self, names: BTreeSet<String>, interrupted: &AtomicBool) -> Result<Made> {
        let paper = Arc::clone(&self.0);
        let made = move || quietly(|| made(&paper.0, &paper.1, |name| names.contains(name)));
        unless_interrupted(|| interrupted.load(Ordering::Relaxed), made)
            .ok_or_else(|| anyhow!("interrupted"))?
            .map_err(|panic| anyhow!("the snapshots cannot be computed: {}", said(&*panic)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: an adapter that mixes up what is stated and what is measured, or fills gaps with a
    /// dash.
    #[test]
    fn the_papers_claims_come_through() {
        let paper = Paper::measure(&Progress::hidden());
        let entry = paper.entry("T4.fe.0.1").expect("a claim of Table 4");
        assert_eq!(entry.stated.as_deref(), Some("2.01 × 10²"));
        assert!(entry.measured.is_some_and(|text| text.starts_with("2.0118")));
        assert_eq!(entry.verdict.as_deref(), Some("reproduced"));
        assert_eq!(entry.kind, "cell");
        assert_eq!(paper.entry("T4.no.such"), None);
    }
}
