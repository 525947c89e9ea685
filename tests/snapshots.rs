//! The tables and figures of the book, as reviewed: a change shows here row by row before any reader sees it.

use std::sync::LazyLock;

use pendula::paper::Ledger;
use pendula::report::{figures::FIGURES, tables};
use pendula::study::Study;
use rstest::rstest;

static STUDY: LazyLock<Study> = LazyLock::new(|| Study::run(|_| {}));
static LEDGER: LazyLock<Ledger> = LazyLock::new(|| Ledger::of(&STUDY));

/// Compares with `snapshots/NAME.snap`. The content stands between anchors, so that a chapter can include it.
fn assert_reviewed(name: &str, anchor: &str, content: &str) {
    let text = format!("<!-- ANCHOR: {anchor} -->\n{content}<!-- ANCHOR_END: {anchor} -->\n");
    insta::with_settings!({
        snapshot_path => "../snapshots",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, {
        insta::assert_snapshot!(name, text);
    });
}

/// Catches: any printed digit of the paper's tables that moves, and any that was measured otherwise before.
#[rstest]
fn the_papers_tables(#[values(2, 4, 5, 6, 7, 8)] number: u32) {
    let table = tables::table(&LEDGER, number).expect("a table of the paper");
    assert_reviewed(&format!("table_{number}"), "table", &table.to_markdown());
}

/// Catches: a slope that moves in its second or third decimal while it stays within the tolerance of the order test.
#[test]
fn the_slopes() {
    let energy = tables::energy_slopes(&STUDY).to_markdown();
    assert_reviewed("slopes", "table", &energy);
    assert_reviewed("orders", "table", &tables::state_slopes(&STUDY).to_markdown());
}

/// Catches: a prediction that moves within its tolerance, and a tolerance that is widened.
#[test]
fn the_predictions() {
    assert_reviewed("predictions", "table", &tables::predictions(&LEDGER).to_markdown());
}

/// Catches: a verdict or a reason changed in passing.
#[test]
fn the_ledger() {
    assert_reviewed("ledger_cells", "table", &tables::cells(&LEDGER).to_markdown());
    assert_reviewed("ledger_sentences", "table", &tables::sentences(&LEDGER).to_markdown());
}

/// Catches: a curve that moves by more than a tenth of a pixel, and a label or description that says something else.
#[rstest]
fn the_figures(#[values(0, 1, 2, 3, 4, 5, 6)] index: usize) {
    let figure = &FIGURES[index];
    assert_reviewed(figure.name, "figure", &figure.html(&STUDY));
}

/// Catches: a figure added to the list and to no test.
#[test]
fn every_figure_is_reviewed() {
    assert_eq!(FIGURES.len(), 7, "the_figures needs the index of the new one");
}
