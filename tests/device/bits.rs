//! A device has the bits of the library. Where there is none, the tests that need one say so, and
//! do not run.

use core::num::NonZeroU64;

use pendula::integrate::Every;
use pendula::metrics::EnergyDrift;
use pendula::{Ensemble, Grid, Pendulum, Phase};
use pendula_device::kernel::Program;
use pendula_device::{Device, OnDevice, devices, method_named, methods};

use crate::common::{Samples, bits};

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

/// Starts of each kind, 1024 in all.
fn starts() -> Vec<Phase> {
    let mut starts = Vec::new();
    for i in 0..256 {
        let part = f64::from(i) / 255.0;
        // Swings, from tiny ones on; rotations of both senses; beside the separatrix; many turns
        // away.
        starts.push(Phase::at_rest(3.1 * part + 1e-9));
        starts.push(Phase { theta: 6.0 * part - 3.0, omega: 7.0 + 5.0 * part });
        starts.push(Phase { theta: core::f64::consts::PI - 1e-3 * part * part, omega: -1e-9 });
        starts.push(Phase { theta: 2e5 * (part - 0.5), omega: -8.0 * part });
    }
    // So fast that in the second scene the angle leaves the range of the sine of the time loop: the
    // energy is then computed on this side.
    starts[0].omega = 1e6;
    starts[1].omega = -1e6;
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

fn compare(device: &Device, method: OnDevice) {
    let mut compiled = device.compile(method).expect("a device that works");
    let host = method.host;
    let name = host.info().name;
    let starts = starts();
    for (pendulum, grid) in &scenes() {
        let ensemble = Ensemble::new(pendulum, &starts, *grid);
        let mut ends = vec![Phase::default(); starts.len()];
        compiled.ends(&ensemble, &mut ends).expect("a device that works");
        let mut watched = vec![(Phase::default(), 0.0); starts.len()];
        compiled.ends_and_energy_errors(&ensemble, &mut watched).expect("the same");
        for ((start, end), (watched_end, error)) in starts.iter().zip(ends).zip(watched) {
            let scene = format!("{name} on {} from {start:?}, {grid:?}", device.name);
            // Lanes have the bits of a trajectory alone; that is tested elsewhere.
            let mut drift = EnergyDrift::new(pendulum);
            let alone = host.run(pendulum, *start, grid, &mut drift);
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
        for method in methods().filter(|one| (one.program)().is_some()) {
            compare(&device, method);
        }
    }
}

/// Each k-th state of three batches, from a grid that is no whole number of them; and of a pendulum
/// that the library does not run in steps of its own, whose angle is too large for it.
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
    for mut device in usable() {
        // Room for forty: a state of this method has ten numbers, a pendulum four constants, and
        // four numbers are looked at.
        device.largest_buffer = 40 * 8 * (10 + 4 + 4);
        let mut seen = vec![Samples::default(); starts.len()];
        let mut compiled = device.compile(method).expect("a device that works");
        compiled.watch(&ensemble, every, &mut seen).expect("a device that works");
        for (start, seen) in starts.iter().zip(seen) {
            let mut watch = Every::new(every, Samples::default());
            method.host.run(&Pendulum::PAPER, *start, &grid, &mut watch);
            assert_eq!(seen.0.len(), 4, "{start:?}");
            assert_eq!(seen, watch.into_inner(), "{start:?}");
        }
    }
}

/// Catches: an implicit method whose sweeps are recorded as if they were always two.
#[test]
fn a_method_that_looks_at_its_numbers_is_refused() {
    let implicit: Vec<_> = methods().filter(|one| one.host.info().implicit).collect();
    assert_eq!(implicit.len(), 7);
    for OnDevice { host, program, .. } in methods() {
        assert_eq!(program().is_none(), host.info().implicit, "{host:?}");
    }
    for device in usable() {
        for &method in &implicit {
            let refused = device.compile(method).err().expect("it is refused");
            let expected =
                "does not run on a device: how many operations a step has depends on the numbers";
            assert_eq!(refused.to_string(), format!("{:?} {expected}", method.host));
        }
    }
}

fn rk4() -> OnDevice {
    method_named("rk4").expect("it is one of the library's")
}

/// The program of RK4, spoilt.
fn spoilt(spoil: impl FnOnce(&mut Program)) -> Option<Program> {
    let mut program = (rk4().program)()?;
    spoil(&mut program);
    Some(program)
}

/// Catches: a refusal of the driver that is a panic, goes unnoticed, or is said in many lines; a
/// memory, or a largest buffer, that is not asked for.
#[test]
fn what_a_device_refuses_is_said() {
    let with = |program| OnDevice { program, ..rk4() };
    let unknown = with(|| spoilt(|program| program.source.push_str("\nno such line;\n")));
    let nameless =
        with(|| spoilt(|program| program.source = program.source.replace("steps", "stairs")));
    let too_large = with(|| spoilt(|program| program.numbers = 1 << 45));
    let starts = [Phase::at_rest(1.0)];
    let ensemble = Ensemble::new(&Pendulum::PAPER, &starts, Grid::new(0.1, 1).expect("positive"));
    for mut device in usable() {
        let why = |device: &Device, method: OnDevice| {
            let compiled = device.compile(method);
            let run =
                compiled.and_then(|mut compiled| compiled.ends(&ensemble, &mut [Phase::default()]));
            run.expect_err("it is refused").to_string()
        };
        let name = device.name.clone();
        let unknown = why(&device, unknown);
        assert!(
            unknown.starts_with(&format!("the driver of {name} does not compile")),
            "{unknown}"
        );
        assert_eq!(unknown.lines().count(), 1);
        let nameless = why(&device, nameless);
        assert!(nameless.ends_with("CL_INVALID_KERNEL_NAME (-46)"), "{nameless}");
        let too_little = format!("{name} has too little memory");
        // Either is too little.
        for sizes in [(100, device.largest_buffer), (device.memory, 100)] {
            let known = (device.memory, device.largest_buffer);
            (device.memory, device.largest_buffer) = sizes;
            assert_eq!(why(&device, rk4()), too_little);
            (device.memory, device.largest_buffer) = known;
        }
        (device.memory, device.largest_buffer) = (u64::MAX, u64::MAX);
        assert_eq!(why(&device, too_large), too_little);
        device.is_double = false;
        assert_eq!(why(&device, rk4()), format!("{name} has no double precision"));
    }
}
