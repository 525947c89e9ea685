//! The solvers of `book/strangers/solvers.toml`, each judged from its recorded answers.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, thread};

use pendula_judge::zoo::recorded::Recorded;
use pendula_judge::{Claims, Report, Verdict, judge_solver};
use serde::Deserialize;

use super::text::{number, plain};
use crate::at_root;

/// `book/strangers/solvers.toml`, whose head says what each field is.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Strangers {
    /// What no library promises, whichever fails.
    #[serde(default)]
    pub aside: Vec<Aside>,
    pub library: Vec<Library>,
}

#[derive(Deserialize)]
pub struct Library {
    pub name: String,
    pub id: String,
    pub language: String,
    pub version: String,
    pub docs: String,
    pub install: String,
    pub called: String,
    /// Reports on what no property shows.
    #[serde(default)]
    pub also: Vec<String>,
    pub solver: Vec<Entry>,
}

#[derive(Deserialize)]
pub struct Entry {
    pub name: String,
    pub claims: String,
    pub quote: String,
    pub place: String,
    pub recording: String,
    pub unjudged: Option<String>,
    pub note: Option<String>,
    #[serde(default)]
    pub documented: Vec<Documented>,
    #[serde(default)]
    pub defect: Vec<Defect>,
    #[serde(default)]
    pub aside: Vec<Aside>,
}

/// A property that fails as the documentation says it does.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Documented {
    pub property: String,
    pub quote: String,
    pub place: String,
}

/// Properties that fail by a defect, which has a report of its own.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Defect {
    pub id: String,
    pub properties: Vec<String>,
}

/// A property that fails, and why that is nobody's fault.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Aside {
    pub property: String,
    pub why: String,
}

pub static STRANGERS: LazyLock<Strangers> = LazyLock::new(|| {
    let text = fs::read_to_string(at_root("book/strangers/solvers.toml")).expect("the solvers");
    toml::from_str(&text).unwrap_or_else(|error| panic!("{error}"))
});

/// A solver, judged.
pub struct Judged {
    pub library: &'static Library,
    pub entry: &'static Entry,
    pub report: Report,
}

pub static JUDGED: LazyLock<Vec<Judged>> = LazyLock::new(|| {
    let all: Vec<(&Library, &Entry)> = STRANGERS
        .library
        .iter()
        .flat_map(|library| library.solver.iter().map(move |entry| (library, entry)))
        .collect();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some((library, entry)) = all.get(index) else { return done };
            done.push((index, Judged::of(library, entry)));
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let judged: BTreeMap<usize, Judged> = thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("a judgement")).collect()
    });
    judged.into_values().collect()
});

/// Whether what is said of one property explains another: many outputs are as wrong as a thousand.
pub fn covers(said: &str, property: &str) -> bool {
    said == property || (said, property) == ("output", "many")
}

impl Judged {
    fn of(library: &'static Library, entry: &'static Entry) -> Self {
        if entry.unjudged.is_some() {
            return Self { library, entry, report: Report::default() };
        }
        let path = format!("tests/verify/solvers/{}.txt", entry.recording);
        let answers =
            fs::read_to_string(at_root(&path)).unwrap_or_else(|error| panic!("{path}: {error}"));
        let claims: Claims = entry.claims.parse().unwrap_or_else(|error| panic!("{path}: {error}"));
        Self { library, entry, report: judge_solver(&Recorded::read(&answers), claims) }
    }

    /// The anchor of its report: letters and digits, with hyphens between.
    pub fn anchor(&self) -> String {
        let words = self.entry.recording.split(|c: char| !c.is_ascii_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        format!("of-{}", words.join("-").to_lowercase())
    }

    /// The defect that explains why this property fails.
    pub fn defect(&self, property: &str) -> Option<&'static Defect> {
        self.entry.defect.iter().find(|it| it.properties.iter().any(|name| covers(name, property)))
    }

    pub fn documented(&self, property: &str) -> Option<&'static Documented> {
        self.entry.documented.iter().find(|it| covers(&it.property, property))
    }

    /// The properties that something is said to be wrong with.
    pub fn explained(&self) -> BTreeSet<&'static str> {
        let defects = self.entry.defect.iter().flat_map(|it| &it.properties);
        let documented = self.entry.documented.iter().map(|it| &it.property);
        let aside = self.entry.aside.iter().map(|it| &it.property);
        defects.chain(documented).chain(aside).map(String::as_str).collect()
    }

    /// The claimed properties with this verdict, but for what no library promises.
    pub fn with(&self, verdict: Verdict) -> impl Iterator<Item = &'static str> {
        let claimed = self.report.findings.iter().filter(|it| it.claimed.is_some());
        let those = claimed.filter(move |it| it.verdict == verdict).map(|it| it.name);
        those.filter(|name| STRANGERS.aside.iter().all(|it| it.property != *name))
    }

    /// The verdict in a word or two.
    pub fn verdict(&self) -> &'static str {
        let any = |verdict| self.with(verdict).next().is_some();
        if self.entry.unjudged.is_some() {
            "not judged"
        } else if self.with(Verdict::Fails).any(|it| self.defect(it).is_some()) {
            "fails"
        } else if self.with(Verdict::Fails).any(|it| self.documented(it).is_some()) {
            "documented"
        } else if any(Verdict::Fails) {
            "set aside"
        } else if any(Verdict::NotMeasured) || any(Verdict::Unclear) {
            "unclear"
        } else if any(Verdict::Holds) {
            "holds"
        } else {
            "unclaimed"
        }
    }

    /// What the verdict is about, with links to the defects.
    pub fn why(&self) -> String {
        let mut said: Vec<String> = self.entry.unjudged.iter().map(|why| plain(why)).collect();
        for defect in &self.entry.defect {
            said.push(format!("[{}](others.md#{})", defect.properties.join(", "), defect.id));
        }
        let unexplained = self.with(Verdict::Fails).filter(|name| self.defect(name).is_none());
        said.extend(unexplained.map(str::to_string));
        if said.is_empty() {
            let unknown = [Verdict::NotMeasured, Verdict::Unclear];
            let names = unknown.into_iter().flat_map(|verdict| self.with(verdict));
            said.extend(names.map(str::to_string));
        }
        said.join(", ")
    }

    /// The number of this property, and which of several.
    pub fn value(&self, property: &str, which: usize) -> String {
        let finding = self.report.finding(property);
        number(finding.and_then(|it| it.values.get(which)).copied())
    }

    /// The power that was found, and the one that is claimed, if one is.
    pub fn beside_claim(&self, property: &str) -> String {
        let claimed = self.report.finding(property).and_then(|it| it.claimed.as_deref());
        let found = self.value(property, 0);
        match claimed.filter(|it| it.chars().all(|c| c.is_ascii_digit())) {
            Some(claimed) => format!("{found} / {claimed}"),
            None => found,
        }
    }

    /// Tolerance, error at the end and evaluations, where the tolerance is 10⁻⁷.
    pub fn usual(&self) -> Option<(f64, f64, Option<u64>)> {
        let mut ladder = self.report.evidence.tolerances.iter().copied();
        ladder.find(|(tolerance, ..)| (tolerance / 1e-7 - 1.0).abs() < 0.1)
    }

    /// The error at the end over a tolerance of 10⁻⁷.
    pub fn over_tolerance(&self) -> Option<f64> {
        self.usual().map(|(tolerance, error, _)| error / tolerance)
    }

    pub fn crossings(&self) -> &'static str {
        match self.report.finding("crossings").map(|it| it.verdict) {
            Some(Verdict::Holds) => "found",
            Some(Verdict::Fails) => "wrong",
            Some(Verdict::Unclear) => "unclear",
            _ => "–",
        }
    }
}
