//! Double pendulums turn over on a device at the very step at which they do so in lanes. Where
//! there is no device, the test says so, and does not run.

use core::num::NonZeroU64;

use pendula::fast::{DoubleInLanes, first_flips};
use pendula::methods::{DormandPrince, Rk4};
use pendula::systems::{DoublePhase, Joint};
use pendula::{DoublePendulum, Grid, Info};
use pendula_device::Device;
use pendula_device::kernel::flips::{Recordable, program};

use crate::bits::usable;

fn compare<M: DoubleInLanes + Info + Recordable>(device: &mut Device, method: &M, grid: &Grid) {
    let (upper, lower) = (Joint { length: 1.0, mass: 2.0 }, Joint { length: 0.7, mass: 0.9 });
    let double = DoublePendulum::new(9.81, upper, lower).expect("positive");
    let start = |i: u32| {
        let [a, b] = [f64::from(i % 64), f64::from(i / 64)];
        let speed = if i.is_multiple_of(4) { 0.3 * b - 9.0 } else { 0.0 };
        let theta = [0.1 * a - 3.13, 0.097 * b - 3.1];
        double.start(theta, [speed, -0.5 * speed]).expect("finite")
    };
    let starts: Vec<DoublePhase> = (0..4096).map(start).collect();
    let width = program(method, &double, grid.step()).expect("it is explicit").numbers;
    // Room for 1500 pendulums: two numbers are looked at.
    device.largest_buffer = 1500 * 8 * (width as u64 + 2);
    let mut expected = vec![None; starts.len()];
    first_flips(&double, method, &starts, grid, &mut expected);
    let mut flips = vec![NonZeroU64::new(7); starts.len()];
    device.first_flips(&double, method, &starts, grid, &mut flips).expect("a device that works");
    assert!(flips == expected, "{} on {}, {grid:?}", method.info().name, device.name);
    let count = flips.iter().flatten().count();
    assert!(grid.steps() < 700 || (1000..4000).contains(&count), "{count}");
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
            compare(&mut device, &Rk4, &Grid::new(h, steps).expect("positive"));
        }
        compare(&mut device, &DormandPrince, &Grid::new(0.01, 700).expect("positive"));
    }
}
