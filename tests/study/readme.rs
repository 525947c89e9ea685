//! The results that the README shows must equal those of the snapshots.

use std::fs;

use pendula_study::claims::{CellId, Ledger};
use pendula_study::experiments::{PaperMethod, Study};
use pendula_study::report::figures::figures;

fn read(path: &str) -> String {
    fs::read_to_string(format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"))).expect(path)
}

/// Catches: a headline table that was not updated when a number changed.
#[test]
fn the_headline_table_is_table_5() {
    let ledger = Ledger::new(&Study::run(|_| {}));
    let readme = read("README.md");
    for method in PaperMethod::ALL {
        let claim = ledger.cell(CellId::of_row(5, method, "dH")).expect("every method has a row");
        let (stated, measured) = (claim.stated_text(), claim.measured_text());
        let row = format!("| {:<16} | {stated:>10} | {measured:>14} |", method.title());
        assert!(readme.contains(&row), "the README lacks\n{row}");
    }
}

/// Catches: a number of claims that was not updated with the ledger.
#[test]
fn the_number_of_claims_is_that_of_the_ledger() {
    let ledger = Ledger::new(&Study::run(|_| {}));
    let count = ledger.claims().iter().filter(|claim| claim.is_of_the_paper()).count();
    let says = format!("all {count} claims of the paper");
    assert!(read("README.md").contains(&says), "the README does not say {says}");
}

/// Catches: a release whose citation names the one before.
#[test]
fn the_citation_is_of_this_version() {
    let says = concat!("\nversion: ", env!("CARGO_PKG_VERSION"), "\n");
    assert!(read("CITATION.cff").contains(says), "CITATION.cff does not say{says}");
}

/// The picture is Figure 2 in a file of its own, as a README cannot include a snapshot. To
/// regenerate it, run this test with `INSTA_UPDATE=always`, as for the snapshots.
///
/// Catches: a picture that was not updated when the figure changed.
#[test]
fn the_picture_is_figure_2() {
    let path = format!("{}/../src/assets/energy-error.svg", env!("CARGO_MANIFEST_DIR"));
    let figure = figures().find(|figure| figure.name == "figure_2").expect("the paper's Figure 2");
    let svg = figure.svg(&Study::run(|_| {}));
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        fs::write(&path, &svg).expect("the assets folder exists");
    }
    assert!(
        fs::read_to_string(&path).is_ok_and(|picture| picture == svg),
        "{path} is not Figure 2"
    );
}
