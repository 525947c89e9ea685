//! Solvers of other people, by what they claim: the table of what was found of them, beside the
//! answers of some that are kept.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use pendula_judge::zoo::recorded::Recorded;
use pendula_judge::{Verdict, judge_solver};
use pendula_study::solvers::{JUDGED, Judged, Outcome, covers};

use crate::at_root;

/// Catches: a claim that fails and of which nobody has said why; a defect or a sentence that is
/// said to explain a failure that there is not.
#[test]
fn each_failure_is_explained() {
    let mut wrong = Vec::new();
    for it in JUDGED.iter() {
        let failing: BTreeSet<&str> = it.with(Verdict::Fails).collect();
        let explained = it.explained();
        let explains = |name: &&&str| explained.iter().any(|said| covers(said, name));
        // A sentence stands whether it is needed or not.
        let needless = |name: &&str| it.documented(name).is_none() && !failing.contains(*name);
        if !failing.iter().all(|name| explains(&name)) || explained.iter().any(needless) {
            let name = &it.entry.recording;
            wrong.push(format!("{name}: {failing:?} fail, and {explained:?} are explained"));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// The solvers whose answers are kept.
fn kept() -> impl Iterator<Item = &'static Judged> {
    JUDGED.iter().filter(|it| it.entry.kept.is_some())
}

/// Catches: answers that nobody judges, and a solver that is said to be kept and is not.
#[test]
fn what_is_kept_is_there() {
    let folder = fs::read_dir(at_root("tests/verify/solvers")).expect("a folder");
    let name = |path: PathBuf| Some(path.file_stem()?.to_str()?.to_string());
    let files: BTreeSet<_> =
        folder.filter_map(|entry| name(entry.expect("a file").path())).collect();
    assert_eq!(files, kept().map(|it| it.entry.recording.clone()).collect());
}

/// Two numbers of four digits, one of which was written with more.
fn alike(row: f64, found: f64) -> bool {
    row == found || (row - found).abs() <= 5e-4 * found.abs() || row.is_nan() && found.is_nan()
}

/// Catches: a judge that says something else of a published solver than its row does, in a verdict,
/// a number or a word.
#[test]
fn what_is_kept_is_judged_as_its_rows_say() {
    let mut other = Vec::new();
    for it in kept() {
        let name = &it.entry.recording;
        let answers = fs::read_to_string(at_root(&format!("tests/verify/solvers/{name}.txt")));
        let answers = answers.expect("the answers that are kept");
        let report = judge_solver(&Recorded::read(&answers), it.entry.claims.parse().unwrap());
        for finding in &report.findings {
            let Some(row) = it.found.finding(finding.property.name()) else {
                other.push(format!("{name}: no row for {}", finding.property));
                continue;
            };
            let said = match finding.verdict {
                Verdict::NotMeasured => finding.why(),
                _ => finding.measured(),
            };
            let claimed = finding.claimed.as_deref().unwrap_or_default();
            let numbers = row.values.len() == finding.values.len()
                && row.values.iter().zip(&finding.values).all(|(a, b)| alike(*a, *b))
                && row.bound.is_some() == finding.bound.is_some()
                && row.bound.zip(finding.bound).is_none_or(|(a, b)| alike(a, b));
            if (row.claimed, row.verdict, row.unit) != (claimed, finding.verdict, finding.unit)
                || row.measured != said
                || !numbers
            {
                other.push(format!("{name}: {row:?} was found, and now {finding:?}"));
            }
        }
        if it.found.findings.len() != report.findings.len() || it.found.look_at != report.look_at()
        {
            other.push(format!("{name}: other rows, or another cause: {:?}", report.look_at()));
        }
    }
    let how = "`book/strangers/run --solvers --kept` writes these rows anew from the answers, and \
               `book/strangers/run --solvers` asks all solvers again";
    assert!(other.is_empty(), "\n{}\n{how}", other.join("\n"));
}

/// Catches: a README or a chapter that counts solvers or libraries as they were once.
#[test]
fn solvers_are_counted_as_they_are() {
    let judged = || JUDGED.iter().filter(|it| it.entry.unjudged.is_none());
    let libraries = judged().map(|it| &it.library.id).collect::<BTreeSet<_>>().len();
    let solvers = judged().count();
    let languages = judged().map(|it| &it.library.language).collect::<BTreeSet<_>>().len();
    let with = |outcome| JUDGED.iter().filter(|it| it.outcome() == outcome).count();
    let (holding, failing) = (with(Outcome::Holds), with(Outcome::Fails));
    let documented = with(Outcome::Documented);
    for (path, said) in [
        ("README.md", format!("and {solvers} adaptive solvers from {libraries}.")),
        (
            "book/src/others.md",
            format!("{solvers} solvers of {libraries} libraries, in {languages} languages"),
        ),
        (
            "book/src/others.md",
            format!("{holding} keep every claim, {failing} fail one, and {documented} fall short"),
        ),
    ] {
        let text = fs::read_to_string(at_root(path)).expect("a text");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(&said), "{path} does not say {said:?}");
    }
}
