//! Many pendulums at once: each lane has the same bits as its trajectory computed alone, whatever
//! instructions the processor has. And for how long double pendulums can be told apart from one
//! another.

use std::f64::consts::PI;
use std::num::NonZeroU64;

use pendula::fast::{Ensemble, Instructions};
use pendula::integrate::Every;
use pendula::systems::{DoublePhase, Joint};
use pendula::{
    AnyMethod, Damped, DoublePendulum, Grid, Hamiltonian, Observer, Pendulum, Phase, Rk4,
    integrate_with, method_named,
};

use crate::common::{First, Samples};

/// A hundred pendulums, each with its own g and L, in blocks of lanes of which the last is not
/// full.
fn family() -> (Vec<Pendulum>, Vec<Phase>) {
    let pendulum = |j| Pendulum::new(9.81 + 0.01 * j, 1.0 + 0.005 * j, 1.0).unwrap();
    let start = |j| Phase { theta: -3.3 + 0.066 * j, omega: 0.1 * j - 4.0 };
    let numbers = || (0..100).map(f64::from);
    (numbers().map(pendulum).collect(), numbers().map(start).collect())
}

/// Catches: a lane that reads another's state or parameters; a branch whose two sides differ in a
/// bit; a carry that is not kept; a fused multiply-add where the processor has one.
fn lanes_have_the_bits_of_a_trajectory_alone(method: &dyn AnyMethod) {
    let (pendulums, starts) = family();
    for steps in [0, 1, 2, 1000] {
        let grid = Grid::new(0.017, steps).unwrap();
        let alone: Vec<Phase> = pendulums
            .iter()
            .zip(&starts)
            .map(|(pendulum, start)| method.end(pendulum, *start, &grid))
            .collect();
        let ensemble = Ensemble::with_systems(&pendulums, &starts, grid);
        for instructions in Instructions::ALL {
            let mut ends = vec![Phase::default(); alone.len()];
            ensemble.with_instructions(instructions).ends(method, &mut ends);
            assert_eq!(bits(&ends), bits(&alone), "{instructions:?}, {steps} steps");
        }
    }
}
each_method!(lanes_have_the_bits_of_a_trajectory_alone);

/// The first of these steps leads to 5e16 rad, of which no f64 knows the remainder of a half turn.
///
/// Catches: a sine in lanes that takes for a remainder what is none.
#[test]
fn a_series_beyond_its_radius_fails_as_it_does_alone() {
    let pendulum = Pendulum::new(8.859567507449006, 9.211858544355808, 1.0).unwrap();
    let start = Phase { theta: 4.374730152768134, omega: -3.219533667151895 };
    let grid = Grid::new(6.895306304942781, 2).unwrap();
    let method = method_named("taylor-24").unwrap();
    let alone = method.end(&pendulum, start, &grid);
    let starts = [start];
    for instructions in Instructions::ALL {
        let mut ends = [Phase::default()];
        let ensemble = Ensemble::new(&pendulum, &starts, grid);
        ensemble.with_instructions(instructions).ends(method, &mut ends);
        assert_eq!(bits(&ends), bits(&[alone]), "{instructions:?}: {ends:?}, alone {alone:?}");
    }
}

fn bits(states: &[Phase]) -> Vec<[u64; 2]> {
    states.iter().map(|z| crate::common::bits(*z)).collect()
}

/// In lanes, and beside a start that cannot be computed in lanes.
///
/// Catches: an observer that receives more samples than it wants, or none; one that ends the run of
/// the others.
fn a_satisfied_observer_is_left_alone(method: &dyn AnyMethod) {
    let (grid, every) = (Grid::new(0.01, 10).unwrap(), NonZeroU64::new(2).unwrap());
    for neighbour in [1.0, 1e9] {
        let starts = [Phase::at_rest(0.5), Phase { theta: neighbour, omega: 1.0 }];
        let mut watches = [First::<3>::default(), First::default()];
        let ensemble = Ensemble::new(&Pendulum::PAPER, &starts, grid);
        ensemble.watch(method, every, &mut watches);
        for (start, First(seen)) in starts.iter().zip(watches) {
            let mut alone = vec![];
            let mut watch = Every::new(every, |_, _, z| alone.push(z));
            method.run(&Pendulum::PAPER, *start, &grid, &mut watch);
            // In such a block, time is in seconds only for the start that requires it.
            assert_eq!(bits(&seen), bits(&alone[..3]));
        }
    }
}
each_method!(a_satisfied_observer_is_left_alone);

/// Forty starts are more than a block of them, and each has a system of its own.
///
/// Catches: a start with its neighbour's system, in the second block with one of the first; one
/// system for all; samples left out.
#[test]
fn any_system_gets_the_bits_of_integrate() {
    let system = |j| Damped::new(Pendulum::new(9.81, 1.0 + 0.01 * j, 1.0).unwrap(), 0.02 * j);
    let systems: Vec<Damped> = (0..40).map(|j| system(f64::from(j)).unwrap()).collect();
    let starts: Vec<Phase> =
        (0..40).map(|j| Phase { theta: 1.0, omega: 0.1 * f64::from(j) }).collect();
    let grid = Grid::new(0.017, 100).unwrap();
    let ensemble = Ensemble::with_systems(&systems, &starts, grid);
    let mut ends = vec![Phase::default(); 40];
    ensemble.ends_one_by_one(&Rk4, &mut ends);
    let mut told = vec![Samples::default(); 40];
    ensemble.watch_one_by_one(&Rk4, &mut told);
    for (i, told) in told.into_iter().enumerate() {
        let mut alone = Samples::default();
        let end = integrate_with(&systems[i], &Rk4, starts[i], &grid, &mut alone);
        assert_eq!(bits(&[ends[i]]), bits(&[end]));
        assert_eq!((told.0.len(), &told), (101, &alone));
    }
    // And not of one system for all: they end where they should not.
    let mut ends_of_one = vec![Phase::default(); 40];
    Ensemble::new(&systems[3], &starts, grid).ends_one_by_one(&Rk4, &mut ends_of_one);
    assert_eq!(ends_of_one[3], ends[3]);
    assert_ne!(ends_of_one[39], ends[39]);
}

/// Catches: a start without a system, or a system that is left out.
#[test]
#[should_panic(expected = "one start for each system")]
fn an_ensemble_wants_a_start_for_each_system() {
    let (pendulums, starts) = ([Pendulum::PAPER; 3], [Phase::default(); 2]);
    let _ = Ensemble::with_systems(&pendulums, &starts, Grid::new(0.01, 1).unwrap());
}

/// Catches: out-of-bounds lanes, a slot written that has no start.
#[test]
#[should_panic(expected = "one slot for each start")]
fn an_ensemble_wants_a_slot_for_each_start() {
    let starts = [Phase::at_rest(1.0); 2];
    let grid = Grid::new(0.01, 1).unwrap();
    Ensemble::new(&Pendulum::PAPER, &starts, grid).ends(&Rk4, &mut [Phase::default(); 3]);
}

/// Notes the time (s) of the first state with a rod past the upward vertical.
#[derive(Default)]
struct FirstFlip(Option<f64>);

impl Observer<DoublePhase> for FirstFlip {
    fn observe(&mut self, _n: u64, t: f64, z: DoublePhase) {
        if !(z.theta1.abs() <= PI && z.theta2.abs() <= PI) {
            self.0 = Some(t);
        }
    }

    fn is_satisfied(&self) -> bool {
        self.0.is_some()
    }
}

/// Of 150 × 150 releases, those that turn over within 5 s do so at the same time with half the
/// step, but for one in a hundred beside the threads; of those after 15 s hardly more than half do.
/// Of a million it is one in a thousand, and 58 in a hundred.
///
/// Catches: steps too long for the smooth parts of the picture; a step that is not halved, so that
/// all runs would agree; a motion that is not chaotic.
#[test]
fn only_the_early_flips_are_the_motions_own() {
    const SIZE: i32 = 150;
    let double = DoublePendulum::of_equals(9.81, Joint { length: 1.0, mass: 1.0 }).unwrap();
    let middle = |i: i32| PI * f64::from(2 * i + 1 - SIZE) / f64::from(SIZE);
    // The other half is the mirror image.
    let start = |i: i32| double.start([middle(i % SIZE), middle(i / SIZE)], [0.0; 2]).unwrap();
    let starts: Vec<DoublePhase> = (0..SIZE * SIZE / 2).map(start).collect();
    let [long, short] = [0.01, 0.005].map(|h| Grid::with_duration(h, 20.0).unwrap());
    let flip = |start: DoublePhase, grid: &Grid| {
        let mut flip = FirstFlip::default();
        integrate_with(&double, &Rk4, start, grid, &mut flip);
        flip.0
    };
    // With less energy there is none.
    let able = starts.into_iter().filter(|z| double.energy(*z) >= double.least_flip_energy());
    let flips = able.filter_map(|z| Some((z, flip(z, &long)?)));
    // In the window of the late ones, and of the early ones.
    let both = flips.filter(|(_, t)| *t <= 5.0 || *t > 15.0);
    let both: Vec<_> = both.map(|(z, t)| (t, flip(z, &short))).collect();
    let share = |from: f64, to: f64| {
        let pairs: Vec<_> = both.iter().filter(|(long, _)| from < *long && *long <= to).collect();
        assert!(pairs.len() > 100, "{}", pairs.len());
        // Within a step.
        let same =
            pairs.iter().filter(|(long, short)| short.is_some_and(|t| (t - long).abs() < 0.0101));
        (same.count() as f64 / pairs.len() as f64, pairs.len() as f64)
    };
    let ((early, _), (late, count)) = (share(0.0, 5.0), share(15.0, 20.0));
    // Five standard deviations, of some 190 that are chosen from that million at random.
    let scatter = 5.0 * (0.58 * 0.42 / count).sqrt();
    assert!(early > 0.99 && (late - 0.58).abs() < scatter, "{early} {late} ± {scatter}");
}
