//! The ledger on the command line, where a measurement contradicts it.

use std::process::ExitCode;
use std::sync::LazyLock;

use pendula_output::failure::Failure;
use pendula_program::commands::study::claims::{self, Filter, LedgerFormat};
use pendula_study::claims::Ledger;
use pendula_study::experiments::Study;
use rstest::rstest;

static STUDY: LazyLock<Study> = LazyLock::new(Study::of_the_paper);
pub static LEDGER: LazyLock<Ledger> = LazyLock::new(|| Ledger::new(&STUDY));

/// One cell of Table 4 is off by a hundredth, and so misses its printed digits. The ledger is
/// written whole all the same, says so, and ends with status 1.
///
/// Catches: a verdict that does not hold but ends with status 0, in one of the formats or in both;
/// one that is contradicted and printed as it is on record.
#[rstest]
fn a_contradicted_claim_ends_with_status_1(
    #[values(LedgerFormat::Text, LedgerFormat::Json)] format: LedgerFormat,
) {
    let mut forged = STUDY.clone();
    forged.convergence[0].drift[0] *= 1.01;
    let report = |study: &Study| {
        let mut out = Vec::new();
        let outcome = claims::report(&Ledger::new(study), &Filter::default(), format, &mut out);
        (outcome, String::from_utf8(out).unwrap())
    };
    let (outcome, honest) = report(&STUDY);
    assert!(outcome.is_ok());
    let (outcome, forged) = report(&forged);
    let failure = outcome.unwrap_err();
    assert!(matches!(failure, Failure::No), "{failure:?}");
    assert_eq!(format!("{:?}", failure.exit_code()), format!("{:?}", ExitCode::FAILURE));
    let pairs = honest.lines().zip(forged.lines());
    let moved: Vec<_> = pairs.filter(|(before, after)| before != after).collect();
    assert_eq!(honest.lines().count(), forged.lines().count());
    assert!(moved.iter().any(|(_, after)| after.contains("wrong")), "{moved:?}");
}
