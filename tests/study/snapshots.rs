//! Snapshots of the book's tables and figures: a change shows here row by row, for review, before
//! it reaches the book.

use std::collections::BTreeSet;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::sync::LazyLock;

use insta::internals::Content;
use pendula_study::report::snapshots::{Kind, RECORDED, Snapshot, snapshots_with};
use pendula_study::report::table::Table;
use rstest::rstest;

use crate::figures::drawn;
use crate::{LEDGER, STUDY, at_root};

/// Each made once for all tests.
pub static SNAPSHOTS: LazyLock<Vec<Snapshot<'static>>> = LazyLock::new(|| {
    let mut all = snapshots_with(&STUDY, &LEDGER, |drawing| drawing.html_of(drawn(drawing.name)));
    let about = "Hashes of all that the library computes, the same on every processor";
    all.push(Snapshot::new("bits", Kind::Hashes, about, bits));
    all.sort_by_key(|snapshot| snapshot.kind);
    all
});

/// A row for each result: its name and the hash of its bits. `.ci/processors` compares these rows
/// with what other processors compute.
fn bits() -> String {
    let mut table = String::from("| Result | Hash |\n| --- | --- |\n");
    for (name, hash) in crate::bits::lines(|_| vec![]) {
        table += &format!("| {name} | `{hash:016x}` |\n");
    }
    table
}

/// The chapters, by name, that include the snapshot.
fn chapters(stem: &str) -> Vec<String> {
    let includes = |path: &PathBuf| {
        let text = fs::read_to_string(path).expect("a chapter");
        text.contains(&format!("snapshots/{stem}.snap"))
    };
    let chapters = files_in("book/src", "md").into_iter().filter(includes);
    chapters.filter_map(|path| Some(path.file_stem()?.to_str()?.to_string())).collect()
}

/// The files in a folder whose names end so, sorted.
fn files_in(folder: &str, extension: &str) -> Vec<PathBuf> {
    let all = fs::read_dir(at_root(folder)).expect("a folder");
    let paths = all.map(|entry| entry.expect("a file").path());
    let mut files: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|it| it == extension)).collect();
    files.sort();
    files
}

/// Makes the snapshot `name` and compares it with its file in `snapshots/`. What it shows and where
/// it stands is above the difference that insta prints, and below it how to see all that moved on
/// one page.
fn assert_reviewed(name: &str) {
    let snapshot = SNAPSHOTS.iter().find(|snapshot| snapshot.name == name).expect("a snapshot");
    let stem = snapshot.kind.file_stem(&snapshot.name);
    let chapters = chapters(&stem).into_iter().map(Content::from).collect();
    let info = vec![(Content::from("chapters"), Content::Seq(chapters))];
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_description(&snapshot.about);
    settings.set_raw_info(&Content::Map(info));
    let compare = || insta::assert_snapshot!(stem.as_str(), snapshot.text());
    if let Err(panic) = catch_unwind(AssertUnwindSafe(|| settings.bind(compare))) {
        eprintln!("\nTo see what moved: cargo run -- review --open");
        resume_unwind(panic);
    }
}

/// Catches: any digit of the paper's tables, printed or measured, that changes.
#[rstest]
fn each_table_of_the_paper(#[values(2, 4, 5, 6, 7, 8)] number: u32) {
    assert_reviewed(&format!("table_{number}"));
}

/// Among them an example for the appendix: Table 4 before and after Störmer–Verlet is replaced by
/// its position form (drift, kick, drift), an equally good method of the same order.
///
/// Catches: a digit, a property or a prediction that changes within the tolerance of its own test;
/// a tolerance that is widened; a verdict or a reason changed by accident; a sentence on one
/// amplitude or step that no longer is true of the others; bounds that are wider, and no less
/// right.
#[rstest]
fn each_other_table(
    #[values(
        "slopes",
        "orders",
        "methods",
        "predictions",
        "ledger_cells",
        "ledger_sentences",
        "beyond",
        "crossings",
        "diffusion",
        "enclosure",
        "questions",
        "zoo",
        "a_change"
    )]
    name: &str,
) {
    assert_reviewed(name);
}

/// Catches: a curve that moves by more than a tenth of a pixel, and a label or description that
/// changes.
#[test]
fn figures_of_the_book() {
    let figures = SNAPSHOTS.iter().filter(|snapshot| snapshot.kind == Kind::Figure);
    let names = figures.map(|figure| figure.name.as_str());
    let moved: Vec<&str> =
        names.filter(|name| catch_unwind(|| assert_reviewed(name)).is_err()).collect();
    assert!(moved.is_empty(), "moved: {moved:?}");
}

// -------------------------------------------------------------------------------------------------
// The same bits everywhere
// -------------------------------------------------------------------------------------------------

/// Debug and release builds and all machines give the same bits: `.ci/processors` computes these
/// hashes in both, and on other processors.
///
/// Catches: the platform's sine, a fused multiply-add, a constant folded to another bit, a sum in
/// another order.
#[test]
fn hashes_of_the_bits_of_a_million_steps() {
    assert_reviewed("bits");
}

/// The table between the anchors of a snapshot's file.
fn table_of(stem: &str) -> Table {
    let text = fs::read_to_string(at_root(&format!("snapshots/{stem}.snap"))).expect("a snapshot");
    let inner = text.split_once(" -->\n").expect("an anchor").1;
    let inner = inner.split_once("<!-- ANCHOR_END").expect("an anchor").0;
    Table::read(inner).expect("a table")
}

/// The table is recorded by whoever maintains the project, with `.ci/processors --record`, in
/// minutes and under emulators: a result that is new since then is not asked for here, and
/// `.ci/processors` computes it.
///
/// Catches: a processor that computed other bits, or fewer results than another; a table that was
/// recorded without one of the processors.
#[test]
fn every_processor_had_every_hash() {
    let (processors, hashes) = (table_of("4_processors"), table_of("3_bits").rows().len());
    let says = |heading: &str| -> Vec<&str> {
        let cells = processors.rows().map(|row| row.get(heading).expect(heading));
        cells.map(|cell| cell.text.as_str()).collect()
    };
    let equal = says("hashes equal")[0];
    let [found, all] = [0, 1].map(|part| equal.split(" of ").nth(part).expect("two numbers"));
    assert_eq!(found, all, "{equal}");
    assert!(all.parse::<usize>().expect("a number") <= hashes, "{equal}, and there are {hashes}");
    for found in says("hashes equal") {
        assert_eq!(found, equal, "`.ci/processors --record` records it anew");
    }
    let expected = ["x86_64", "x86_64", "x86_64", "x86", "aarch64", "riscv64", "s390x", "wasm32"];
    let names: Vec<&str> =
        processors.rows().map(|row| row.cells[processors.first()].text.as_str()).collect();
    assert_eq!(names, expected);
    let orders = says("order of bytes");
    assert!(names.iter().zip(orders).any(|row| row == (&"s390x", "big")));
}

/// Catches: a snapshot that `pendula review` would not show, and one of that list without a test.
#[test]
fn the_list_of_snapshots_is_the_folder() {
    let stem = |path: PathBuf| Some(path.file_stem()?.to_str()?.to_string());
    let files: BTreeSet<String> =
        files_in("snapshots", "snap").into_iter().filter_map(stem).collect();
    assert!(SNAPSHOTS.is_sorted_by_key(|snapshot| snapshot.kind), "not in the order of review");
    let recorded = RECORDED.map(|(name, _)| Kind::Recorded.file_stem(name));
    let stems = SNAPSHOTS.iter().map(|snapshot| snapshot.kind.file_stem(&snapshot.name));
    let listed: BTreeSet<String> = stems.chain(recorded).collect();
    let missing: Vec<_> = listed.difference(&files).collect();
    let unknown: Vec<_> = files.difference(&listed).collect();
    assert!(
        missing.is_empty() && unknown.is_empty(),
        "not in snapshots/, though they are computed: {missing:?}; there, and computed by nothing: \
         {unknown:?}. `.ci/after --accept` accepts a new one; `git rm` takes away an old one"
    );
}
