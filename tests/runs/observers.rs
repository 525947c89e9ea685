//! Observers: what they see, and in which order.

use std::f64::consts::PI;
use std::num::NonZeroU64;

use pendula::integrate::{Every, Record};
use pendula::methods::StormerVerlet;
use pendula::metrics::EnergyDrift;
use pendula::{Grid, Hamiltonian, Observer, Pendulum, Phase, integrate};

use crate::common::Random;

const START: Phase = Phase { theta: 1.0, omega: -0.25 };

fn grid() -> Grid {
    Grid::new(0.01, 100).unwrap()
}

/// Catches: a loop that forgets the start or the end, counts from one, or passes the time of
/// another step.
#[test]
fn a_closure_sees_every_sample_with_its_count_and_time() {
    let mut seen = Vec::new();
    let end = integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut |n, t, z| {
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
    let unwatched = integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut ());
    let mut watch = (|_, _, _| {}, |_, _, _| {}, ());
    let watched = integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!(unwatched, watched);
}

/// Catches: every k-th sample counted from the wrong one, or one too few at the end.
#[test]
fn every_kth_sample_includes_the_start() {
    for (every, last) in [(1, 100), (7, 98), (10, 100), (100, 100), (101, 0)] {
        let mut seen = Vec::new();
        let mut watch =
            Every::new(NonZeroU64::new(every).unwrap(), |n: u64, _, _: Phase| seen.push(n));
        integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
        assert_eq!(seen, (0..=last).step_by(every as usize).collect::<Vec<_>>());
    }
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
    let early = integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    let forty = Grid::new(0.01, 40).unwrap();
    assert_eq!(early, integrate(&Pendulum::PAPER, &StormerVerlet, START, &forty, &mut ()));
    assert_eq!(watch.1, 40);

    // The observer receives every tenth sample only, and so is satisfied at the 40th.
    let mut watch = Every::new(NonZeroU64::new(10).unwrap(), Until(35, 0));
    integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!(watch.into_inner().1, 40);

    // Two observers are satisfied when both are.
    let mut watch = (Until(40, 0), Until(60, 0));
    integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!((watch.0.1, watch.1.1), (60, 60));
}

/// Catches: a recorder that shifts samples by one, or writes past its storage.
#[test]
fn a_record_holds_the_samples_that_fit() {
    let mut all = vec![Phase::default(); grid().samples() as usize];
    let mut watch = Record::new(&mut all);
    let end = integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut watch);
    assert_eq!((all[0], all[100]), (START, end));

    let mut some = vec![Phase::default(); 10];
    integrate(&Pendulum::PAPER, &StormerVerlet, START, &grid(), &mut Record::new(&mut some));
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
