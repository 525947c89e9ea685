//! The device has the bits of the library. Where there is no device, the tests say so, and do not
//! run.

use pendula::metrics::EnergyDrift;
use pendula::{Ensemble, Grid, Pendulum, Phase};
use pendula_device::{Device, METHODS, OnDevice, devices};

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
        (Pendulum::PAPER, Grid::new(0.01, 300).expect("positive")),
        (Pendulum::PAPER, Grid::new(0.3, 100).expect("positive")),
        (moon, Grid::new(0.05, 200).expect("positive")),
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
