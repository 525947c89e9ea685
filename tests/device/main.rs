//! A device has the bits of the library. Where there is none, the tests that need one say so, and
//! do not run.

mod contracted;
mod recorded;

use core::num::NonZeroU64;

use pendula::integrate::Every;
use pendula::metrics::EnergyDrift;
use pendula::{Ensemble, Grid, Observer, Pendulum, Phase};
use pendula_device::{Device, METHODS, OnDevice, devices, method_named};

/// The devices with double precision.
fn usable() -> Vec<Device> {
    match devices() {
        Ok(devices) => devices.into_iter().filter(|device| device.is_double).collect(),
        Err(error) => {
            println!("not run: {error}");
            Vec::new()
        }
    }
}

/// Starts of each kind, 4096 in all.
fn starts() -> Vec<Phase> {
    let mut starts = Vec::new();
    for i in 0..1024 {
        let part = f64::from(i) / 1023.0;
        // Swings, from tiny ones on; rotations of both senses; beside the separatrix; many turns
        // away.
        starts.push(Phase::at_rest(3.1 * part + 1e-9));
        starts.push(Phase { theta: 6.0 * part - 3.0, omega: 7.0 + 5.0 * part });
        starts.push(Phase { theta: core::f64::consts::PI - 1e-3 * part * part, omega: -1e-9 });
        starts.push(Phase { theta: 2e5 * (part - 0.5), omega: -8.0 * part });
    }
    starts
}

/// Pendulum, step (s) and number of steps.
fn scenes() -> [(Pendulum, Grid); 4] {
    let moon = Pendulum::new(1.62, 0.3, 2.0).expect("positive");
    [
        (Pendulum::PAPER, Grid::new(0.01, 120).expect("positive")),
        (Pendulum::PAPER, Grid::new(0.3, 60).expect("positive")),
        (moon, Grid::new(0.05, 80).expect("positive")),
        (Pendulum::PAPER, Grid::new(0.02, 1).expect("positive")),
    ]
}

fn bits(z: Phase) -> [u64; 2] {
    // The payload of a NaN is no result.
    [z.theta, z.omega].map(|x| if x.is_nan() { u64::MAX } else { x.to_bits() })
}

fn compare(device: &Device, method: &dyn OnDevice) {
    let name = method.info().name;
    let starts = starts();
    for (pendulum, grid) in &scenes() {
        let ensemble = Ensemble::new(pendulum, &starts, *grid);
        let mut ends = vec![Phase::default(); starts.len()];
        device.ends(&ensemble, method, &mut ends).expect("a device that works");
        let mut watched = vec![(Phase::default(), 0.0); starts.len()];
        device.ends_and_energy_errors(&ensemble, method, &mut watched).expect("the same");
        for ((start, end), (watched_end, error)) in starts.iter().zip(ends).zip(watched) {
            let scene = format!("{name} on {} from {start:?}, {grid:?}", device.name);
            // Lanes have the bits of a trajectory alone; that is tested elsewhere.
            let mut drift = EnergyDrift::new(pendulum);
            let alone = method.run(pendulum, *start, grid, &mut drift);
            assert_eq!(bits(end), bits(alone), "{scene}");
            assert_eq!(bits(watched_end), bits(alone), "{scene}, watched");
            let [error, expected] = [error, drift.largest()];
            let same = error.to_bits() == expected.to_bits() || error.is_nan() && expected.is_nan();
            assert!(same, "{scene}: {error:e} J on the device, and not {expected:e}");
        }
    }
}

/// Catches: a product fused with a sum; a reduction by another multiple of π; a sign that does not
/// follow the half turns; an order of the sums of its own; a carry that is not handed on between
/// launches, or one from before the last step; the energy of a state half a kick away.
#[test]
fn every_method_has_the_bits_of_a_trajectory_alone() {
    for device in usable() {
        for method in METHODS {
            if method.program().is_some() {
                compare(&device, *method);
            }
        }
    }
}

/// Each k-th state of two batches, from a grid that is no whole number of them; and a pendulum that
/// the library does not run in steps of its own, whose angle is too large for it.
///
/// Catches: a batch that goes on where the last one ended, states of the wrong pendulum, a step too
/// many or too few between two of them, a start that is left out.
#[test]
fn every_kth_state_is_that_of_a_trajectory_alone() {
    let mut starts = starts();
    starts.truncate(100);
    starts.push(Phase::at_rest(1e7));
    let grid = Grid::new(0.01, 1000).expect("positive");
    let ensemble = Ensemble::new(&Pendulum::PAPER, &starts, grid);
    let every = NonZeroU64::new(300).expect("positive");
    let method = method_named("blanes-moan-6").expect("it is one of the library's");
    for device in usable() {
        let mut seen = vec![Record::default(); starts.len()];
        device.watch(&ensemble, method, every, &mut seen).expect("a device that works");
        for (start, seen) in starts.iter().zip(seen) {
            let mut alone = Record::default();
            let mut watch = Every::new(every, |n, t, z| alone.observe(n, t, z));
            let _ = method.run(&Pendulum::PAPER, *start, &grid, &mut watch);
            assert_eq!(seen.0.len(), 4, "{start:?}");
            assert_eq!(seen.0, alone.0, "{start:?}");
        }
    }
}

/// Step, time and state of each sample.
#[derive(Clone, Default)]
struct Record(Vec<(u64, u64, [u64; 2])>);

impl Observer<Phase> for Record {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        self.0.push((n, t.to_bits(), bits(z)));
    }
}

/// Catches: an implicit method whose sweeps are recorded as if they were always two.
#[test]
fn a_method_that_looks_at_its_numbers_is_refused() {
    let implicit = METHODS.iter().filter(|method| method.info().implicit);
    assert_eq!(implicit.clone().count(), 6);
    for method in METHODS {
        assert_eq!(method.program().is_none(), method.info().implicit, "{:?}", method.info().name);
    }
    for device in usable() {
        let starts = [Phase::at_rest(1.0)];
        let grid = Grid::new(0.1, 1).expect("positive");
        let ensemble = Ensemble::new(&Pendulum::PAPER, &starts, grid);
        for method in implicit.clone() {
            let refused = device.ends(&ensemble, *method, &mut [Phase::default()]).unwrap_err();
            let expected =
                "does not run on a device: how many operations a step has depends on the numbers";
            assert_eq!(refused.to_string(), format!("{} {expected}", method.info().name));
        }
    }
}
