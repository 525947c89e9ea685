//! The paper's tables, cell by cell: the measured values against the printed ones.

use std::collections::BTreeSet;

use pendula::methods::SymplecticEuler;
use pendula_judge::properties::Ladder;
use pendula_study::claims::stated::CELLS;
use pendula_study::claims::{Ledger, Measured, Verdict};
use pendula_study::experiments::{PaperMethod, STEPS, Study, convergence};
use pendula_study::report::table::Table;
use pendula_study::report::tables;
use rstest::rstest;

use crate::{LEDGER, STUDY};

/// Every measured value lies within half a unit of the last digit that the paper prints, except
/// where the verdict on record is that it does not: a cell called wrong has to miss it, and run
/// times, which depend on the platform, are not measured. RK4's energy error at Δt = 0.001 s is
/// held to 3.2e-12 J ± 10 %, as the paper's second digit is rounding.
///
/// Catches: a wrong coefficient, constant, metric or number of steps anywhere behind the tables; a
/// mean over N samples.
#[rstest]
fn each_printed_cell_is_as_its_verdict_says(#[values(2, 4, 5, 6, 7, 8)] table: u32) {
    let prefix = format!("T{table}.");
    let cells: Vec<_> = CELLS.iter().filter(|cell| cell.id.starts_with(&prefix)).collect();
    assert!(!cells.is_empty());
    for cell in cells {
        let claim = LEDGER.get(&cell.id).expect("every printed cell is in the ledger");
        match cell.verdict {
            Verdict::Wrong => assert_eq!(claim.holds(), Some(false), "{claim:?}"),
            _ if claim.measured == Measured::Nothing => {
                assert_eq!(cell.verdict, Verdict::DependsOnPlatform, "{claim:?}");
            }
            _ => assert_eq!(claim.holds(), Some(true), "{claim:?}"),
        }
    }
}

/// Catches: an id used twice.
#[test]
fn each_claim_has_an_id_of_its_own() {
    let ids: BTreeSet<&str> = LEDGER.claims().iter().map(|claim| claim.id.as_str()).collect();
    assert_eq!(ids.len(), LEDGER.claims().len(), "a claim stands twice");
}

/// What the paper claims: 87 cells, and rows for 113 sentences or parts of them.
const CLAIMS_OF_THE_PAPER: usize = 200;

/// Every claim is judged by a measurement, except those marked as not checkable.
///
/// Catches: a verdict without a measurement, and a claim lost from the ledger; a question of ours
/// that is counted as a claim of the paper.
#[test]
fn every_checkable_claim_is_measured() {
    let stated = || LEDGER.claims().iter().filter(|claim| claim.stated.is_some());
    assert_eq!(
        LEDGER.claims().iter().filter(|claim| claim.is_of_the_paper()).count(),
        CLAIMS_OF_THE_PAPER
    );
    assert_eq!(stated().count(), CLAIMS_OF_THE_PAPER + 3);
    for claim in stated() {
        match claim.verdict {
            Verdict::NotCheckable => assert_eq!(claim.holds(), None, "{claim:?}"),
            Verdict::DependsOnPlatform => assert_ne!(claim.holds(), Some(false), "{claim:?}"),
            Verdict::Wrong | Verdict::NotSupported => {
                assert_eq!(claim.holds(), Some(false), "{claim:?}");
            }
            _ => assert_eq!(claim.holds(), Some(true), "{claim:?}"),
        }
    }
}

/// The measurement of a claim whose definition begins "as A.bounded" is that claim's.
///
/// Catches: two claims judged two ways by the same measurement; "reproduced with a definition", and
/// nobody says with which; a claim without support, and nobody says what else passes.
#[test]
fn the_same_measurement_gives_the_same_verdict() {
    let mut others = 0;
    for claim in LEDGER.claims() {
        let named = claim.definition.strip_prefix("as ").and_then(|rest| {
            LEDGER.get(rest.split([' ', ',']).next().expect("a split has a first part"))
        });
        if let Some(other) = named {
            others += 1;
            assert_eq!(claim.verdict, other.verdict, "{claim:?} against {other:?}");
        }
        let says_why = !claim.because.is_empty();
        let has_to = [Verdict::ReproducedWithDefinition, Verdict::NotSupported];
        assert!(says_why || !has_to.contains(&claim.verdict), "{claim:?}");
    }
    // Three bounds beside A.bounded, two of the orders, and a size.
    assert_eq!(others, 6);
}

/// Catches: an error that is counted as often as it is said; a page that says another number.
#[test]
fn the_errors_are_counted_once() {
    let (claims, errors) = LEDGER.wrong();
    assert_eq!((claims, errors), (20, 15));
    let page = include_str!("../../book/src/appendix-claims.md");
    assert!(page.contains(&format!("the {claims} wrong claims are {errors} different errors")));
    let sentences = CLAIMS_OF_THE_PAPER - CELLS.len();
    let says = format!("{} cells and {sentences} rows for sentences", CELLS.len());
    assert!(page.contains(&says), "{says}");
}

/// The ledger rejects wrong values: a printed digit changed by one unit no longer holds.
///
/// Catches: a tolerance so wide, or a comparison so lenient, that any value would pass.
#[rstest]
#[case("T4.se.0.01", "7.31e-2")]
#[case("T4.rk4.0.005", "7.59e-9")]
#[case("T5.fe.Hend", "475.6")]
#[case("T6.se.0.05", "3.27e-3")]
#[case("T7.Texact", "5.1580")]
#[case("T2.vv.sympl", "No")]
fn a_digit_off_by_one_does_not_hold(#[case] id: &str, #[case] misprint: &'static str) {
    let mut claim = LEDGER.get(id).expect("in the ledger").clone();
    claim.stated = Some(misprint);
    assert_eq!(claim.holds(), Some(false), "{claim:?}");
    assert_eq!(claim.judged(), Verdict::Wrong);
}

// -------------------------------------------------------------------------------------------------
// A change of method moves the verdicts that it breaks
// -------------------------------------------------------------------------------------------------

/// The study, had Störmer–Verlet been symplectic Euler where its energy error and its order are
/// measured.
fn study_of_another_method() -> Study {
    let mut study = STUDY.clone();
    for row in &mut study.convergence {
        if PaperMethod::of(row.method) == Some(PaperMethod::StormerVerlet) {
            row.drift = STEPS.map(|step| convergence::drift(&SymplecticEuler, step));
        }
    }
    for row in &mut study.characteristics {
        if PaperMethod::of(row.method) == Some(PaperMethod::StormerVerlet) {
            row.ladder = Ladder::measure(&SymplecticEuler);
        }
    }
    study
}

/// The cells of a table that are not what they should be: the name of the row, and what they say.
fn marked(table: &Table) -> Vec<(&str, &str)> {
    let cells = table.rows().flat_map(|row| row.cells.iter().map(move |cell| (row.id(), cell)));
    cells.filter(|(_, cell)| cell.differs).map(|(id, cell)| (id, &cell.text[..])).collect()
}

/// Catches: a table that goes on showing the verdict on record beside a number that no longer
/// supports it: in the ledger, in the predictions, in the orders.
#[test]
fn a_change_of_method_moves_the_verdicts_that_it_breaks() {
    let study = study_of_another_method();
    let ledger = Ledger::new(&study);
    let id = "T4.vv.0.1";

    let cells = tables::cells(&ledger);
    assert!(marked(&cells).contains(&(id, "wrong")), "{:?}", marked(&cells));
    let row = cells.rows().find(|row| row.id() == id).expect("a row");
    assert_eq!(row.get("because").expect("a reason").text, "(on record: reproduced)");
    let predictions = tables::predictions(&ledger);
    assert!(marked(&predictions).iter().any(|cell| cell.0 == id), "the prediction is missed");
    let orders = tables::state_slopes(&study);
    assert!(marked(&orders).iter().any(|cell| cell.0 == "Störmer–Verlet"), "{orders:?}");

    // What is right is not marked.
    let unchanged = &*LEDGER;
    for table in
        [tables::cells(unchanged), tables::sentences(unchanged), tables::predictions(unchanged)]
    {
        assert_eq!(marked(&table), []);
    }
}

/// Catches: a claim that is measured on a method that the paper does not have, or that changes with
/// what else is run; a study of the paper that runs more, a ledger of the tables that leaves out a
/// cell.
#[test]
fn the_papers_methods_are_enough_for_its_claims() {
    let study = Study::of_the_paper();
    assert_eq!(study.long_run.len(), PaperMethod::ALL.len());
    assert_eq!(Ledger::new(&study), *LEDGER);
    let cells = Ledger::of_the_tables(&study);
    assert!(LEDGER.claims().starts_with(cells.claims()));
    assert!(CELLS.iter().all(|cell| cells.get(&cell.id).is_some()));
}
