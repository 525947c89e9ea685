//! Snapshots of the book's tables and figures: a change shows here row by row, for review, before
//! it reaches the book.

use std::fs;
use std::panic::catch_unwind;
use std::path::Path;
use std::sync::LazyLock;

use pendula_study::claims::Ledger;
use pendula_study::experiments::Study;
use pendula_study::report::figures::figures;
use pendula_study::report::snapshots::{self, Snapshot};
use rstest::rstest;

static STUDY: LazyLock<Study> = LazyLock::new(|| Study::run(|_| {}));
static LEDGER: LazyLock<Ledger> = LazyLock::new(|| Ledger::new(&STUDY));

/// The chapters, by name, that include the snapshot.
fn chapters(name: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let mut chapters: Vec<String> = fs::read_dir(folder)
        .expect("the chapters")
        .map(|entry| entry.expect("a chapter").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .filter(|path| {
            let text = fs::read_to_string(path).expect("a chapter");
            text.contains(&format!("snapshots/{name}.snap"))
        })
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_string()))
        .collect();
    chapters.sort();
    chapters
}

/// Compares with `snapshots/NAME.snap`. What it shows and where stands above the difference that
/// insta prints.
fn assert_reviewed(snapshot: &Snapshot) {
    let chapters = chapters(&snapshot.name);
    let place = match &chapters[..] {
        [] => "in no chapter".to_string(),
        chapters => format!("in {}", chapters.join(", ")),
    };
    insta::with_settings!({
        snapshot_path => "../../snapshots",
        prepend_module_to_snapshot => false,
        omit_expression => true,
        description => format!("{}; {place}", snapshot.about),
    }, {
        insta::assert_snapshot!(snapshot.name.as_str(), snapshot.text());
    });
}

/// Catches: any digit of the paper's tables, printed or measured, that changes.
#[rstest]
fn the_papers_tables(#[values(2, 4, 5, 6, 7, 8)] number: u32) {
    assert_reviewed(&snapshots::of_table(&LEDGER, number));
}

/// Catches: a slope that changes in its second or third decimal, within the tolerance of the order
/// test.
#[rstest]
#[case::of_energy(snapshots::of_energy_slopes(&STUDY))]
#[case::of_state(snapshots::of_state_slopes(&STUDY))]
fn the_slopes(#[case] snapshot: Snapshot) {
    assert_reviewed(&snapshot);
}

/// Catches: a property of a method that changes, of the paper's methods or any other.
#[test]
fn the_methods() {
    assert_reviewed(&snapshots::of_methods(&STUDY));
}

/// Catches: a prediction that changes within its tolerance, and a tolerance that is widened.
#[test]
fn the_predictions() {
    assert_reviewed(&snapshots::of_predictions(&LEDGER));
}

/// Catches: a digit that changes within the tolerance of its own test.
#[test]
fn the_systems_beyond() {
    assert_reviewed(&snapshots::of_systems());
}

/// Catches: a verdict or a reason changed by accident.
#[rstest]
#[case::of_cells(snapshots::of_cells(&LEDGER))]
#[case::of_sentences(snapshots::of_sentences(&LEDGER))]
fn the_ledger(#[case] snapshot: Snapshot) {
    assert_reviewed(&snapshot);
}

/// The appendix shows what a change looks like to its reviewer: Table 4 before and after
/// Störmer–Verlet is replaced by its position form (drift, kick, drift), an equally good method of
/// the same order.
///
/// Catches: an example in the book that is out of date.
#[test]
fn a_change_as_its_reviewer_sees_it() {
    assert_reviewed(&snapshots::of_a_change(&STUDY));
}

/// Catches: a curve that moves by more than a tenth of a pixel, and a label or description that
/// changes.
#[test]
fn the_figures() {
    let moved: Vec<_> = figures()
        .filter(|figure| {
            let snapshot = snapshots::of_figure(figure, &STUDY);
            catch_unwind(|| assert_reviewed(&snapshot)).is_err()
        })
        .map(|figure| figure.name)
        .collect();
    assert!(moved.is_empty(), "moved: {moved:?}");
}

// -------------------------------------------------------------------------------------------------
// The same bits everywhere
// -------------------------------------------------------------------------------------------------

/// Debug and release builds and all machines give the same bits: `.ci/run` runs this in both, and
/// for another processor.
///
/// Catches: the platform's sine, a fused multiply-add, a constant folded to another bit, a sum in
/// another order.
#[test]
fn the_bits_of_a_million_steps() {
    assert_reviewed(&snapshots::of_bits());
}

/// Catches: a snapshot that `pendula review` would not show, and one of that list without a test.
#[test]
fn the_list_of_snapshots_is_the_folder() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../snapshots");
    let mut files: Vec<String> = fs::read_dir(folder)
        .expect("the snapshots")
        .map(|entry| entry.expect("a snapshot").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "snap"))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_string()))
        .collect();
    files.sort();
    let all = snapshots::all(&STUDY, &LEDGER);
    assert!(all.is_sorted_by_key(|snapshot| snapshot.kind), "not in the order of review");
    let mut listed: Vec<String> = all.into_iter().map(|snapshot| snapshot.name).collect();
    listed.sort();
    assert_eq!(files, listed);
}
