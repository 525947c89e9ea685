//! The interface between the book and the paper's ledger of claims.
//!
//! The directives `{{stated ID}}`, `{{measured ID}}` and `{{verdict ID}}` depend on a [`Ledger`]
//! only, so that a test can use its own and the library can change its types. [`Paper`] is the only
//! adapter to the library.

use std::collections::BTreeSet;
use std::sync::Arc;

use anyhow::{Result, anyhow};
use pendula_study::claims::{Claim, Measured, Verdict};
use pendula_study::experiments::Study;
use pendula_study::questions::{self, Truth};
use pendula_study::report::snapshots::some;

use crate::book::progress::Progress;
use crate::book::versions::{Content, Made, quietly, said};

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
}

/// Where values come from.
pub trait Ledger {
    /// The entry of a claim, such as `T4.rk4.0.01`; `None` if there is no such claim.
    fn entry(&self, id: &str) -> Option<Entry>;

    /// What is right in the question with this id; `None` if there is no such question.
    fn truth(&self, id: &str) -> Option<Truth> {
        questions::truth(id)
    }

    /// How many claims of the paper are wrong; `None` where nobody counts.
    fn wrong(&self) -> Option<usize> {
        None
    }

    /// What the code makes of the snapshots with these names now, and why it does not make those
    /// that it cannot. A ledger that makes none has nothing to be quoted from them.
    fn snapshots(&self, _: BTreeSet<String>) -> Result<Made> {
        Ok(Made::default())
    }
}

impl<F: Fn(&str) -> Option<Entry>> Ledger for F {
    fn entry(&self, id: &str) -> Option<Entry> {
        self(id)
    }
}

/// The library's ledger of the paper's claims.
#[derive(Clone)]
pub struct Paper(Arc<(Study, pendula_study::claims::Ledger)>);

impl Paper {
    /// Runs the study and measures every claim; `progress` shows the current experiment.
    pub fn measure(progress: &Progress) -> Self {
        progress.stage("", Study::EXPERIMENTS as usize);
        Self::new(Study::run(|experiment| progress.next(experiment)))
    }

    /// Measures every claim in a study that has been run.
    pub fn new(study: Study) -> Self {
        let ledger = pendula_study::claims::Ledger::new(&study);
        Self(Arc::new((study, ledger)))
    }

    /// Those of the snapshots that are `wanted`, as the code makes them, and why it does not make
    /// what it cannot.
    pub(crate) fn made(&self, wanted: impl Fn(&str) -> bool) -> Made {
        let (study, ledger) = &*self.0;
        let (mut version, mut failed) = Made::default();
        for (name, made) in some(study, ledger, wanted) {
            match made {
                Ok(snapshot) => {
                    let text = snapshot.content().to_string();
                    version.insert(name, Content { kind: snapshot.kind, text });
                }
                Err(panic) => {
                    failed.insert(name, said(&*panic));
                }
            }
        }
        (version, failed)
    }

    /// Its claims.
    pub fn claims(&self) -> &[Claim] {
        self.0.1.claims()
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
        })
    }

    fn wrong(&self) -> Option<usize> {
        let is_wrong = |claim: &&Claim| claim.is_of_the_paper() && claim.judged() == Verdict::Wrong;
        Some(self.claims().iter().filter(is_wrong).count())
    }

    fn snapshots(&self, names: BTreeSet<String>) -> Result<Made> {
        quietly(|| self.made(|name| names.contains(name)))
            .map_err(|panic| anyhow!("the snapshots cannot be computed: {}", said(&*panic)))
    }
}
