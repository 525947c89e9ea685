//! Solvers of other people: what each claims, and what the judge found of it.
//!
//! `book/strangers/solvers.toml` has the claims, word by word, and what explains a failure;
//! `book/strangers/solvers.tsv` has what was found, a row for each property, as
//! `book/strangers/run --solvers` wrote it. The chapter "What published solvers do" is made of
//! both: the [`table`] of all, the [`page`] by library, and figures.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use pendula_judge::Verdict;
use serde::Deserialize;

pub mod page;
pub mod table;
mod text;

use text::{number, plain};

/// `book/strangers/solvers.toml`, whose head says what each field is.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Solvers {
    /// What no library promises, whichever fails.
    #[serde(default)]
    pub aside: Vec<Aside>,
    /// Library by library.
    pub library: Vec<Library>,
}

/// A library and its solvers.
#[derive(Debug, Deserialize)]
pub struct Library {
    /// Its name.
    pub name: String,
    /// Its address in the book.
    pub id: String,
    /// The language in which it is called.
    pub language: String,
    /// The version that was judged.
    pub version: String,
    /// The address of its documentation.
    pub docs: String,
    /// Where it comes from.
    pub install: String,
    /// How it was called.
    pub called: String,
    /// Reports on what no property shows.
    #[serde(default)]
    pub also: Vec<String>,
    /// Its solvers.
    pub solver: Vec<Entry>,
}

/// A solver, and what its documentation says.
#[derive(Debug, Deserialize)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// What is claimed, in the words of `pendula verify --claims`.
    pub claims: String,
    /// What its documentation says.
    pub quote: String,
    /// Where it says so.
    pub place: String,
    /// Its name in `solvers.tsv`.
    pub recording: String,
    /// Why its answers are kept in `tests/verify/solvers`, if they are.
    pub kept: Option<String>,
    /// Why it was not judged, if it was not.
    pub unjudged: Option<String>,
    /// A convention or a restriction.
    pub note: Option<String>,
    /// What fails as the documentation says.
    #[serde(default)]
    pub documented: Vec<Documented>,
    /// What fails by a defect.
    #[serde(default)]
    pub defect: Vec<Defect>,
    /// What fails by nobody's fault.
    #[serde(default)]
    pub aside: Vec<Aside>,
}

/// A property that fails as the documentation says it does.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Documented {
    /// Its name.
    pub property: String,
    /// What the documentation says.
    pub quote: String,
    /// Where it says so.
    pub place: String,
}

/// Properties that fail by a defect, which has a report of its own.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Defect {
    /// The name of its report.
    pub id: String,
    /// Their names.
    pub properties: Vec<String>,
}

/// A property that fails, and why that is nobody's fault.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Aside {
    /// Its name.
    pub property: String,
    /// Why it does not count.
    pub why: String,
}

/// What was found of one property.
#[derive(Debug)]
pub struct Finding {
    /// Its name.
    pub name: &'static str,
    /// What is claimed of it; empty if nothing is.
    pub claimed: &'static str,
    /// What is to be said of the claim.
    pub verdict: Verdict,
    /// What its first number may be at most, if one number decides.
    pub bound: Option<f64>,
    /// The unit of bound and numbers; empty for pure numbers.
    pub unit: &'static str,
    /// What was measured, in numbers.
    pub values: Vec<f64>,
    /// What was measured, in words, or why it was not.
    pub measured: &'static str,
}

/// All that was found of one solver.
#[derive(Debug, Default)]
pub struct Found {
    /// Property by property.
    pub findings: Vec<Finding>,
    /// Tolerance and error (rad) of the run whose tolerance is 10⁻⁷.
    pub usual: Option<[f64; 2]>,
    /// What to look at to mend it.
    pub look_at: Vec<&'static str>,
    /// Tolerance, error (rad) and evaluations, if somebody counts them, of each run; empty where
    /// the answers are not kept.
    pub at_tolerances: Vec<Vec<f64>>,
    /// Time (s), largest and smallest error (rad) of each twentieth of a run.
    pub along_a_run: Vec<Vec<f64>>,
}

/// A solver, judged.
#[derive(Debug)]
pub struct Judged {
    /// Whose it is.
    pub library: &'static Library,
    /// What it claims.
    pub entry: &'static Entry,
    /// What was found; nothing if it was not judged.
    pub found: Found,
}

static ROWS: &str = include_str!("../../../strangers/solvers.tsv");

/// The libraries and their claims.
pub static SOLVERS: LazyLock<Solvers> = LazyLock::new(|| {
    let text = include_str!("../../../strangers/solvers.toml");
    toml::from_str(text).unwrap_or_else(|error| panic!("solvers.toml: {error}"))
});

/// All solvers, with what was found of them, in the order of the libraries.
pub static JUDGED: LazyLock<Vec<Judged>> = LazyLock::new(|| {
    let mut found = found();
    let solvers = SOLVERS
        .library
        .iter()
        .flat_map(|library| library.solver.iter().map(move |entry| (library, entry)));
    let judged: Vec<Judged> = solvers
        .map(|(library, entry)| {
            let found = found.remove(entry.recording.as_str());
            assert_eq!(
                found.is_some(),
                entry.unjudged.is_none(),
                "solvers.tsv has rows of {}, or it is unjudged in solvers.toml",
                entry.recording
            );
            Judged { library, entry, found: found.unwrap_or_default() }
        })
        .collect();
    assert!(found.is_empty(), "not in solvers.toml: {:?}", found.keys());
    judged
});

/// The rows of `solvers.tsv`, by solver.
///
/// # Panics
/// If a row is none.
fn found() -> BTreeMap<&'static str, Found> {
    let mut all = BTreeMap::<_, Found>::new();
    for line in ROWS.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split('\t').collect();
        let [solver, name, claimed, verdict, bound, unit, values, measured] = cells[..] else {
            panic!("solvers.tsv: no row of eight: {line}");
        };
        let number = |text: &str| -> f64 {
            text.parse().unwrap_or_else(|_| panic!("solvers.tsv: no number {text:?}: {line}"))
        };
        let values: Vec<f64> = values.split_whitespace().map(number).collect();
        let of = all.entry(solver).or_default();
        match name {
            "usual" => of.usual = Some([values[0], values[1]]),
            "look at" => of.look_at.push(measured),
            "at a tolerance" => of.at_tolerances.push(values),
            "along a run" => of.along_a_run.push(values),
            _ => of.findings.push(Finding {
                name,
                claimed,
                verdict: named(verdict)
                    .unwrap_or_else(|| panic!("solvers.tsv: no verdict {verdict:?}: {line}")),
                bound: Some(bound).filter(|bound| !bound.is_empty()).map(number),
                unit,
                values,
                measured,
            }),
        }
    }
    all
}

/// The verdict of this name.
fn named(name: &str) -> Option<Verdict> {
    use Verdict::{Fails, Holds, NotMeasured, Unclaimed, Unclear};
    [Holds, Fails, Unclear, NotMeasured, Unclaimed].into_iter().find(|it| it.name() == name)
}

/// What is to be said of a solver, after its documentation was read too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Every claim holds.
    Holds,
    /// A claim fails, by a defect.
    Fails,
    /// A claim fails, as the documentation says.
    Documented,
    /// A claim fails, by nobody's fault.
    SetAside,
    /// Something that is claimed was not shown.
    Unclear,
    /// Nothing is claimed.
    Unclaimed,
    /// It was not judged.
    NotJudged,
}

impl Outcome {
    /// Its name in the book.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::Documented => "documented",
            Self::SetAside => "set aside",
            Self::Unclear => "unclear",
            Self::Unclaimed => "unclaimed",
            Self::NotJudged => "not judged",
        }
    }
}

/// Whether what is said of one property explains another: many outputs are as wrong as a thousand.
pub fn covers(said: &str, property: &str) -> bool {
    said == property || (said, property) == ("output", "many")
}

impl Found {
    /// What was found of the property of this name.
    pub fn finding(&self, name: &str) -> Option<&Finding> {
        self.findings.iter().find(|it| it.name == name)
    }

    /// The names of the properties whose claims fail.
    pub fn failures(&self) -> impl Iterator<Item = &'static str> {
        let claimed = self.findings.iter().filter(|it| !it.claimed.is_empty());
        claimed.filter(|it| it.verdict == Verdict::Fails).map(|it| it.name)
    }
}

impl Judged {
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

    /// What the documentation says of this property where it fails.
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
        let claimed = self.found.findings.iter().filter(|it| !it.claimed.is_empty());
        let those = claimed.filter(move |it| it.verdict == verdict).map(|it| it.name);
        those.filter(|name| SOLVERS.aside.iter().all(|it| it.property != *name))
    }

    /// What is to be said of it.
    pub fn outcome(&self) -> Outcome {
        let any = |verdict| self.with(verdict).next().is_some();
        if self.entry.unjudged.is_some() {
            Outcome::NotJudged
        } else if self.with(Verdict::Fails).any(|it| self.defect(it).is_some()) {
            Outcome::Fails
        } else if self.with(Verdict::Fails).any(|it| self.documented(it).is_some()) {
            Outcome::Documented
        } else if any(Verdict::Fails) {
            Outcome::SetAside
        } else if any(Verdict::NotMeasured) || any(Verdict::Unclear) {
            Outcome::Unclear
        } else if any(Verdict::Holds) {
            Outcome::Holds
        } else {
            Outcome::Unclaimed
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
        let finding = self.found.finding(property);
        number(finding.and_then(|it| it.values.get(which)).copied())
    }

    /// The power that was found, and the one that is claimed, if one is.
    pub fn beside_claim(&self, property: &str) -> String {
        let claimed = self.found.finding(property).map_or("", |it| it.claimed);
        let found = self.value(property, 0);
        match claimed.parse::<u32>() {
            Ok(claimed) => format!("{found} / {claimed}"),
            Err(_) => found,
        }
    }

    /// The error at the end over a tolerance of 10⁻⁷.
    pub fn over_tolerance(&self) -> Option<f64> {
        self.found.usual.map(|[tolerance, error]| error / tolerance)
    }

    /// What was found of passages through zero, in a word.
    pub fn crossings(&self) -> &'static str {
        match self.found.finding("crossings").map(|it| it.verdict) {
            Some(Verdict::Holds) => "found",
            Some(Verdict::Fails) => "wrong",
            Some(Verdict::Unclear) => "unclear",
            _ => "–",
        }
    }
}
