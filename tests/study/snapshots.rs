//! Snapshots of the book's tables and figures: a change shows here row by row, for review, before
//! it reaches the book.

use std::panic::catch_unwind;
use std::sync::LazyLock;

use pendula::methods::PositionVerlet;
use pendula::{Grid, Info, Pendulum, Phase, integrate, integrate_fast};
use pendula_study::claims::Ledger;
use pendula_study::experiments::{STEPS, Study, convergence, in_paper};
use pendula_study::report::figures::figures;
use pendula_study::report::table::Table;
use pendula_study::report::tables;
use rstest::rstest;

static STUDY: LazyLock<Study> = LazyLock::new(|| Study::run(|_| {}));
static LEDGER: LazyLock<Ledger> = LazyLock::new(|| Ledger::new(&STUDY));

/// Compares with `snapshots/NAME.snap`. The content is between anchors, so that a chapter can
/// include it.
fn assert_reviewed(name: &str, anchor: &str, content: &str) {
    let text = format!("<!-- ANCHOR: {anchor} -->\n{content}<!-- ANCHOR_END: {anchor} -->\n");
    insta::with_settings!({
        snapshot_path => "../../snapshots",
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, {
        insta::assert_snapshot!(name, text);
    });
}

/// Catches: any digit of the paper's tables, printed or measured, that changes.
#[rstest]
fn the_papers_tables(#[values(2, 4, 5, 6, 7, 8)] number: u32) {
    let table = tables::table(&LEDGER, number).expect("a table of the paper");
    assert_reviewed(&format!("table_{number}"), "table", &table.to_markdown());
}

/// Catches: a slope that changes in its second or third decimal, within the tolerance of the order
/// test.
#[rstest]
#[case::of_energy("slopes", tables::energy_slopes(&STUDY))]
#[case::of_state("orders", tables::state_slopes(&STUDY))]
fn the_slopes(#[case] name: &str, #[case] table: Table) {
    assert_reviewed(name, "table", &table.to_markdown());
}

/// Catches: a property of a method that changes, of the paper's methods or any other.
#[test]
fn the_methods() {
    assert_reviewed("methods", "table", &tables::methods(&STUDY).to_markdown());
}

/// Catches: a prediction that changes within its tolerance, and a tolerance that is widened.
#[test]
fn the_predictions() {
    assert_reviewed("predictions", "table", &tables::predictions(&LEDGER).to_markdown());
}

/// Catches: a digit that changes within the tolerance of its own test.
#[test]
fn the_systems_beyond() {
    assert_reviewed("beyond", "table", &tables::beyond().to_markdown());
}

/// Catches: a verdict or a reason changed by accident.
#[rstest]
#[case::of_cells("ledger_cells", tables::cells(&LEDGER))]
#[case::of_sentences("ledger_sentences", tables::sentences(&LEDGER))]
fn the_ledger(#[case] name: &str, #[case] table: Table) {
    assert_reviewed(name, "table", &table.to_markdown());
}

/// The appendix shows what a change looks like to its reviewer: Table 4 before and after
/// Störmer–Verlet is replaced by its position form (drift, kick, drift), an equally good method of
/// the same order.
///
/// Catches: an example in the book that is out of date.
#[test]
fn a_change_as_its_reviewer_sees_it() {
    let mut changed = STUDY.clone();
    for row in &mut changed.convergence {
        if row.method.info().name == "stormer-verlet" {
            row.drift = STEPS.map(|step| convergence::drift(&PositionVerlet, step));
        }
    }
    let table = |study| tables::table(&Ledger::new(study), 4).expect("Table 4").to_markdown();
    let (before, after) = (table(&STUDY), table(&changed));
    let rows =
        before.lines().zip(after.lines()).flat_map(|(before, after)| match before == after {
            true => vec![format!(" {before}\n")],
            false => vec![format!("-{before}\n"), format!("+{after}\n")],
        });
    assert_reviewed("a_change", "diff", &format!("```diff\n{}```\n", rows.collect::<String>()));
}

/// Catches: a curve that moves by more than a tenth of a pixel, and a label or description that
/// changes.
#[test]
fn the_figures() {
    let moved: Vec<_> = figures()
        .filter(|figure| {
            let html = figure.html(&STUDY);
            catch_unwind(|| assert_reviewed(figure.name, "figure", &html)).is_err()
        })
        .map(|figure| figure.name)
        .collect();
    assert!(moved.is_empty(), "moved: {moved:?}");
}

// -------------------------------------------------------------------------------------------------
// The same bits everywhere
// -------------------------------------------------------------------------------------------------

/// FNV-1a of every state's bits over four runs of `steps` steps: swinging, nearly over the top,
/// rotating, and starting many turns from zero; with L ≠ 1 and a step that is not a power of two.
fn hash(steps: u64, run: impl Fn(&Pendulum, Phase, &Grid, &mut dyn FnMut(u64, f64, Phase))) -> u64 {
    let pendulum = Pendulum::new(9.81, 1.3, 0.7).unwrap();
    let grid = Grid::new(0.01, steps).unwrap();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for (theta, omega) in [(1.0, 0.0), (3.1, 0.2), (-0.3, 12.0), (1000.5, -1.0)] {
        run(&pendulum, Phase { theta, omega }, &grid, &mut |_, _, z: Phase| {
            for bits in [z.theta.to_bits(), z.omega.to_bits()] {
                hash = (hash ^ bits).wrapping_mul(0x0100_0000_01b3);
            }
        });
    }
    hash
}

macro_rules! hashes {
    ($($module:ident::$method:ident,)+) => {{
        let mut table = String::from("| Method | in steps | in seconds |\n| --- | --- | --- |\n");
        $({
            use pendula::methods::$method;
            // Without optimisation a million steps of every method would take minutes.
            let steps = if in_paper(&$method) { 250_000 } else { 25_000 };
            let in_steps = hash(steps, |pendulum, start, grid, mut watch| {
                integrate_fast(pendulum, &$method, start, grid, &mut watch);
            });
            let in_seconds = hash(steps, |pendulum, start, grid, mut watch| {
                integrate(pendulum, &$method, start, grid, &mut watch);
            });
            let title = $method.info().title;
            table += &format!("| {title} | `{in_steps:016x}` | `{in_seconds:016x}` |\n");
        })+
        table
    }};
}

/// Debug and release builds and all machines give the same bits: `.ci/run` runs this in both, and
/// for another processor.
///
/// Catches: the platform's sine, a fused multiply-add, a constant folded to another bit, a sum in
/// another order.
#[test]
fn the_bits_of_a_million_steps() {
    assert_reviewed("bits", "table", &pendula::for_each_method!(hashes));
}
