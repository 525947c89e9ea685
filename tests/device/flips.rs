//! Double pendulums turn over on a device at the very step at which they do so here. Where
//! there is no device, the test says so, and does not run.

use core::f64::consts::PI;
use core::num::NonZeroU64;

use pendula::fast::first_flips;
use pendula::integrate::Run;
use pendula::methods::table::{Listed, RK4_IN_LANES};
use pendula::methods::{DormandPrince, Rk4};
use pendula::systems::{DoublePhase, Joint};
use pendula::{DoublePendulum, Grid, Info};
use pendula_device::Device;
use pendula_device::kernel::flips::{Recordable, program};

use crate::bits::usable;

type Flips = Vec<Option<NonZeroU64>>;

/// Compares the device's first flips with what `library` says of them.
fn compare<M: Info + Recordable>(
    device: &mut Device,
    method: &M,
    grid: &Grid,
    library: fn(&DoublePendulum, &[DoublePhase], &Grid) -> Flips,
) {
    let (upper, lower) = (Joint { length: 1.0, mass: 2.0 }, Joint { length: 0.7, mass: 0.9 });
    let double = DoublePendulum::new(9.81, upper, lower).expect("positive");
    let start = |i: u32| {
        let [a, b] = [f64::from(2 * (i % 32)), f64::from(2 * (i / 32))];
        let speed = if i.is_multiple_of(4) { 0.3 * b - 9.0 } else { 0.0 };
        let theta = [0.1 * a - 3.13, 0.097 * b - 3.1];
        double.start(theta, [speed, -0.5 * speed]).expect("finite")
    };
    let starts: Vec<DoublePhase> = (0..1024).map(start).collect();
    let width = program(method, &double, grid.step()).expect("it is explicit").numbers;
    // Room for 400 pendulums: two numbers are looked at.
    device.largest_buffer = 400 * 8 * (width as u64 + 2);
    let expected = library(&double, &starts, grid);
    let mut flips = vec![NonZeroU64::new(7); starts.len()];
    device.first_flips(&double, method, &starts, grid, &mut flips).expect("a device that works");
    assert!(flips == expected, "{} on {}, {grid:?}", method.info().name, device.name);
    let count = flips.iter().flatten().count();
    assert!(grid.steps() < 700 || (250..1000).contains(&count), "{count}");
}

/// RK4's, in lanes.
fn in_lanes(double: &DoublePendulum, starts: &[DoublePhase], grid: &Grid) -> Flips {
    let mut flips = vec![None; starts.len()];
    first_flips(double, RK4_IN_LANES, starts, grid, &mut flips);
    flips
}

/// Those of Dormand and Prince's method, each alone.
fn alone(double: &DoublePendulum, starts: &[DoublePhase], grid: &Grid) -> Flips {
    let steps = DoublePendulum::steps(DormandPrince.info().name).expect("it suits");
    let flip = |start: &DoublePhase| {
        let mut flip = None;
        let mut watch = |n, _, z: DoublePhase| {
            if !(z.theta1.abs() <= PI && z.theta2.abs() <= PI) {
                flip = flip.or(NonZeroU64::new(n));
            }
        };
        let mut run = Run::start(double, steps, *start, grid);
        run.advance(grid.steps(), NonZeroU64::MIN, &mut watch).expect("it is explicit");
        flip
    };
    starts.iter().map(flip).collect()
}

/// Releases and throws in three batches, along a long grid, which takes two launches, and along
/// short ones. The second method keeps its last slope for the next step.
///
/// Catches: a sine or a rate with other bits; a flip counted from 0, or again; a batch or a launch
/// that begins where it should not; a pendulum past the vertical that comes back; a flip behind the
/// end of the grid; a carry left out.
#[test]
fn each_first_flip_is_that_in_lanes() {
    for mut device in usable() {
        for (h, steps) in [(0.01, 700), (0.002, 4500), (0.01, 1), (0.01, 0)] {
            compare(&mut device, &Rk4, &Grid::new(h, steps).expect("positive"), in_lanes);
        }
        let grid = Grid::new(0.01, 700).expect("positive");
        compare(&mut device, &DormandPrince, &grid, alone);
    }
}
