//! The grid: integer steps, computed time, and what is refused.

use pendula::error::MAX_STEPS;
use pendula::{Error, Grid};
use proptest::prelude::*;
use rstest::rstest;

/// Catches: a quotient truncated instead of rounded (0.3 / 0.1 is 2.9999999999999996), and a step
/// too many.
#[rstest]
#[case(50.0, 0.1, 500)]
#[case(50.0, 0.001, 50_000)]
#[case(0.3, 0.1, 3)]
#[case(1000.0, 0.01, 100_000)]
#[case(4.35, 0.01, 435)]
#[case(1e-300, 1e-300, 1)]
fn decimals_are_taken_at_their_word(#[case] duration: f64, #[case] step: f64, #[case] steps: u64) {
    let grid = Grid::with_duration(step, duration).unwrap();
    assert_eq!((grid.step(), grid.steps(), grid.samples()), (step, steps, steps + 1));
}

/// Catches: a duration silently rounded to the nearest whole number of steps.
#[rstest]
#[case(1.0, 0.3)]
#[case(0.05, 0.1)]
#[case(1.0, 0.1 + 1e-12)]
fn part_of_a_step_is_refused(#[case] duration: f64, #[case] step: f64) {
    assert_eq!(Grid::with_duration(step, duration), Err(Error::PartialStep { duration, step }));
}

/// Three roundings of ε/2 each, doubled: a number 3 ε from a whole number is taken for it, one 4 ε
/// away is not.
///
/// Catches: a tolerance that is a bit tighter or looser than the one derived.
#[test]
fn whole_means_to_within_three_units_of_rounding() {
    let beside = |units: f64| Grid::with_duration(1.0, 1.0 + units * f64::EPSILON);
    assert_eq!(beside(3.0).map(|grid| grid.steps()), Ok(1));
    assert_eq!(
        beside(4.0),
        Err(Error::PartialStep { duration: 1.0 + 4.0 * f64::EPSILON, step: 1.0 })
    );
}

/// Catches: a grid that loops for ever or steps by NaN.
#[rstest]
fn a_step_or_duration_out_of_range_is_refused(
    #[values(0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY)] bad: f64,
) {
    assert!(matches!(Grid::with_duration(bad, 1.0), Err(Error::Parameter { .. })));
    assert!(matches!(Grid::with_duration(1.0, bad), Err(Error::Parameter { .. })));
    assert!(matches!(Grid::new(bad, 10), Err(Error::Parameter { .. })));
}

/// Catches: a count of steps that f64 can no longer hold exactly, and an end that overflows.
#[test]
fn too_many_steps_are_refused() {
    assert!(Grid::new(1.0, MAX_STEPS).is_ok());
    assert!(matches!(Grid::new(1.0, MAX_STEPS + 1), Err(Error::TooManySteps { .. })));
    assert_eq!(Grid::with_duration(1e-10, 1e10), Err(Error::TooManySteps { steps: 1e20 }));
    let most = MAX_STEPS as f64;
    assert_eq!(Grid::with_duration(1.0, most).map(|grid| grid.steps()), Ok(MAX_STEPS));
    assert_eq!(
        Grid::with_duration(1.0, most + 2.0),
        Err(Error::TooManySteps { steps: most + 2.0 })
    );
    assert!(matches!(
        Grid::with_duration(f64::MIN_POSITIVE, f64::MAX),
        Err(Error::TooManySteps { .. })
    ));
    assert!(matches!(Grid::new(f64::MAX, 2), Err(Error::Parameter { .. })));
}

/// Catches: time that is accumulated. After a million additions of 0.1 the sum is off by 1.3e-6;
/// the product is off by half an ulp.
#[test]
fn time_is_computed_and_not_accumulated() {
    let grid = Grid::new(0.1, 1_000_000).unwrap();
    assert_eq!(grid.time(0), 0.0);
    assert_eq!(grid.time(1_000_000), 100_000.0);
    assert_eq!(grid.time(123_456), 123_456.0 * 0.1);
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(512)
    })]

    /// Catches: a tolerance for whole numbers that is too tight for some decimal, or so loose that
    /// a fraction of a step passes.
    #[test]
    fn whole_numbers_of_decimal_steps_are_found(
        thousandths in 1_u32..100_000, steps in 1_u32..10_000_000,
    ) {
        let step = f64::from(thousandths) / 1000.0;
        let duration = (u64::from(thousandths) * u64::from(steps)) as f64 / 1000.0;
        let counted = Grid::with_duration(step, duration).map(|grid| grid.steps());
        prop_assert_eq!(counted, Ok(u64::from(steps)));
        let off = duration + 0.01 * step;
        let refusal = Error::PartialStep { duration: off, step };
        prop_assert_eq!(Grid::with_duration(step, off), Err(refusal));
    }
}
