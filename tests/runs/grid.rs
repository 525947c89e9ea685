//! The grid: integer steps, computed time, and what is refused; and observers: what they see, and
//! in which order.

use std::f64::consts::PI;
use std::num::NonZeroU64;

use pendula::error::MAX_STEPS;
use pendula::integrate::{Every, Record};
use pendula::methods::StormerVerlet;
use pendula::metrics::EnergyDrift;
use pendula::{Error, Grid, Hamiltonian, Observer, Pendulum, Phase, integrate, integrate_with};
use proptest::prelude::*;
use rstest::rstest;

use crate::common::Random;

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

/// The step and the duration that are named where that duration is refused because it is no whole
/// number of such steps.
fn refused_part(step: f64, duration: f64) -> Option<(f64, f64)> {
    match Grid::with_duration(step, duration) {
        Err(Error::PartialStep { duration, step, .. }) => Some((step, duration)),
        _ => None,
    }
}

/// The steps that are named where they are too many.
fn too_many(grid: Result<Grid, Error>) -> Option<f64> {
    match grid {
        Err(Error::TooManySteps { steps, .. }) => Some(steps),
        _ => None,
    }
}

/// Catches: a duration silently rounded to the nearest whole number of steps.
#[rstest]
#[case(1.0, 0.3)]
#[case(0.05, 0.1)]
#[case(1.0, 0.1 + 1e-12)]
fn part_of_a_step_is_refused(#[case] duration: f64, #[case] step: f64) {
    assert_eq!(refused_part(step, duration), Some((step, duration)));
}

/// Three roundings of ε/2 each, doubled: a number 3 ε from a whole number is taken for it, one 4 ε
/// away is not.
///
/// Catches: a tolerance that is a bit tighter or looser than the one derived.
#[test]
fn whole_means_to_within_three_units_of_rounding() {
    let beside = |units: f64| Grid::with_duration(1.0, 1.0 + units * f64::EPSILON);
    assert_eq!(beside(3.0).map(|grid| grid.steps()), Ok(1));
    let duration = 1.0 + 4.0 * f64::EPSILON;
    assert_eq!(beside(4.0), Grid::with_duration(1.0, duration));
    assert_eq!(refused_part(1.0, duration), Some((1.0, duration)));
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
    assert_eq!(too_many(Grid::with_duration(1e-10, 1e10)), Some(1e20));
    let most = MAX_STEPS as f64;
    assert_eq!(Grid::with_duration(1.0, most).map(|grid| grid.steps()), Ok(MAX_STEPS));
    assert_eq!(too_many(Grid::with_duration(1.0, most + 2.0)), Some(most + 2.0));
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
        prop_assert_eq!(refused_part(step, off), Some((step, off)));
    }
}

// -------------------------------------------------------------------------------------------------
// Observers
// -------------------------------------------------------------------------------------------------

const START: Phase = Phase { theta: 1.0, omega: -0.25 };

fn grid() -> Grid {
    Grid::new(0.01, 100).unwrap()
}

/// Catches: a loop that forgets the start or the end, counts from one, or passes the time of
/// another step.
#[test]
fn a_closure_sees_every_sample_with_its_count_and_time() {
    let mut seen = Vec::new();
    let end = integrate_with(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut |n, t, z| {
        seen.push((n, t, z));
    });
    assert_eq!(seen.len(), 101);
    assert_eq!(seen[0], (0, 0.0, START));
    assert_eq!(seen[100], (100, grid().time(100), end));
    for (n, &(count, time, _)) in seen.iter().enumerate() {
        assert_eq!((count, time), (n as u64, n as f64 * 0.01));
    }
}

/// Catches: an observer that changes the trajectory.
#[test]
fn watching_changes_no_bit() {
    let unwatched = integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid());
    let mut watch = (|_, _, _| {}, |_, _, _| {}, ());
    let watched = integrate_with(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!(unwatched, watched);
}

/// Catches: a loop that goes on after the observer is satisfied, ends a step late, or ends at once
/// for `()`.
#[test]
fn a_satisfied_observer_ends_the_loop() {
    struct Until(u64, u64);
    impl Observer<Phase> for Until {
        fn observe(&mut self, n: u64, _t: f64, _z: Phase) {
            self.1 = n;
        }
        fn is_satisfied(&self) -> bool {
            self.1 >= self.0
        }
    }
    let mut watch = Until(40, 0);
    let early = integrate_with(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    let forty = Grid::new(0.01, 40).unwrap();
    assert_eq!(early, integrate(&Pendulum::PAPER, &StormerVerlet, START, &forty));
    assert_eq!(watch.1, 40);

    // The observer receives every tenth sample only, and so is satisfied at the 40th.
    let mut watch = Every::new(NonZeroU64::new(10).unwrap(), Until(35, 0));
    integrate_with(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!(watch.into_inner().1, 40);

    // Two observers are satisfied when both are.
    let mut watch = (Until(40, 0), Until(60, 0));
    integrate_with(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!((watch.0.1, watch.1.1), (60, 60));
}

/// Catches: a recorder that shifts samples by one, or writes past its storage.
#[test]
fn a_record_holds_the_samples_that_fit() {
    let mut all = vec![Phase::default(); grid().samples() as usize];
    let mut watch = Record::new(&mut all);
    let end = integrate_with(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!((all[0], all[100]), (START, end));

    let mut some = vec![Phase::default(); 10];
    integrate_with(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut Record::new(&mut some));
    assert_eq!(some, all[..10]);
}

/// Angles within (0, π], where a sine needs no reduction, within (π, 2π], beyond, and mixed, of
/// either sign and in blocks of any length: the energies of many states are those of each.
///
/// Catches: a batch that reduces no angle where one needs it, or beyond π where it must; one that
/// leaves out the last states of a block, or writes beyond its slots.
#[test]
fn energies_have_the_bits_of_each_energy() {
    let pendulum = Pendulum::new(9.81, 1.7, 0.6).unwrap();
    let mut random = Random::new(23);
    let edges = [PI, PI.next_up(), PI.next_down(), 2.0 * PI, 3.0 * PI, 0.0];
    for (least, most) in [(0.0, PI), (PI, 2.0 * PI), (2.0 * PI, 1e3), (0.0, 10.0), (0.0, 1e7)] {
        for count in [0, 1, 2, 31, 63, 64, 65, 200] {
            let mut states: Vec<Phase> = (0..count)
                .map(|_| Phase {
                    theta: random.one_of(&[-1.0, 1.0]) * random.between(least, most),
                    omega: random.between(-5.0, 5.0),
                })
                .collect();
            if let Some(z) = states.first_mut() {
                let edge = random.one_of(&edges);
                z.theta = if (least..=most).contains(&edge) { edge } else { z.theta };
            }
            let alone: Vec<u64> = states.iter().map(|z| pendulum.energy(*z).to_bits()).collect();
            for slots in [count, count / 2, count + 3] {
                let mut energies = vec![-1.0; slots];
                pendulum.energies(&states, &mut energies);
                let (of, beyond) = energies.split_at(slots.min(count));
                assert!(of.iter().zip(&alone).all(|(e, alone)| e.to_bits() == *alone));
                assert!(beyond.iter().all(|energy| *energy == -1.0));
            }
            let mut drift = EnergyDrift::new(&pendulum);
            let mut largest = 0.0_f64;
            for (n, z) in (0..).zip(&states) {
                drift.observe(n, 0.0, *z);
                largest = largest.max((pendulum.energy(*z) - pendulum.energy(states[0])).abs());
                assert_eq!(drift.largest().to_bits(), largest.to_bits(), "{n} of {count}");
            }
        }
    }
}

/// Catches: an error that tells what is wrong and leaves the user to find what is right; a step
/// that is told and refused in its turn.
#[test]
fn the_steps_that_an_error_names_fit() {
    let mut random = Random::new(5);
    let mut named = 0;
    for _ in 0..10_000 {
        let duration = 10_f64.powf(random.between(-12.0, 12.0));
        let step = duration * 10_f64.powf(random.between(-12.0, 1.0));
        let Err(error) = Grid::with_duration(step, duration) else { continue };
        let said = error.to_string();
        let (_, fitting) = said.split_once("whole number of steps. ").unwrap();
        for word in fitting.split(' ') {
            if let Ok(fits) = word.parse() {
                assert!(Grid::with_duration(fits, duration).is_ok(), "{error}");
                named += 1;
            }
        }
    }
    assert!(named > 15_000, "{named}");
}
