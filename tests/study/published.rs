//! Solvers of other people, judged from their recorded answers by what they claim: the table of all
//! of them, a report for each library, and figures of some.

mod defects;
mod figures;
mod judged;
mod reports;
mod table;
mod text;

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use pendula_judge::Verdict;
use pendula_study::report::snapshots::{Kind, Snapshot};

use self::defects::defects;
use self::figures::DRAWINGS;
use self::judged::{JUDGED, covers};
use self::reports::reports;
use self::table::table;
use crate::at_root;

/// The snapshots that are made here.
pub fn snapshots() -> Vec<Snapshot<'static>> {
    let of =
        |name, about, content: fn() -> String| Snapshot::new(name, Kind::Judged, about, content);
    let mut all = vec![
        of("solvers", "Solvers of other people, judged from their recorded answers", table),
        of("solver_reports", "What was measured of each solver", reports),
        of("defects", "Reports on defects in published integrators and solvers", defects),
    ];
    all.extend(DRAWINGS.iter().map(|drawing| {
        Snapshot::new(drawing.name, Kind::Judged, drawing.title, || drawing.html())
    }));
    all
}

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
            let report = &it.report;
            wrong.push(format!(
                "{name}: {failing:?} fail, and {explained:?} are explained\n{report}"
            ));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Catches: a recording of which nothing is said, one that two solvers share.
#[test]
fn each_recording_is_that_of_a_solver() {
    let folder = fs::read_dir(at_root("tests/verify/solvers")).expect("a folder");
    let name = |path: PathBuf| Some(path.file_stem()?.to_str()?.to_string());
    let mut recorded: Vec<_> =
        folder.filter_map(|entry| name(entry.expect("a file").path())).collect();
    let judged = JUDGED.iter().filter(|it| it.entry.unjudged.is_none());
    let mut listed: Vec<_> = judged.map(|it| it.entry.recording.clone()).collect();
    recorded.sort();
    listed.sort();
    assert_eq!(recorded, listed);
}

/// Catches: a README or a chapter that counts solvers or libraries as they were once.
#[test]
fn solvers_are_counted_as_they_are() {
    let judged = || JUDGED.iter().filter(|it| it.entry.unjudged.is_none());
    let libraries = judged().map(|it| &it.library.id).collect::<BTreeSet<_>>().len();
    let solvers = judged().count();
    let languages = judged().map(|it| &it.library.language).collect::<BTreeSet<_>>().len();
    let with = |verdict| JUDGED.iter().filter(|it| it.verdict() == verdict).count();
    let (holding, failing, documented) = (with("holds"), with("fails"), with("documented"));
    for (path, said) in [
        ("README.md", format!("and {solvers} solvers from {libraries}.")),
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
