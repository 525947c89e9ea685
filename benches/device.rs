//! Pendulums on a device: `cargo bench --bench device -- [NAME]`.
//!
//! Millions of steps a second on each OpenCL device, or on those with NAME in their names, beside
//! the library's lanes on one core and on all; and the additions, subtractions, multiplications and
//! divisions that the device does a second. Its bound is what it does without fusing products with
//! sums, which would change the bits: half of the figure on its data sheet.

#[path = "common/machine.rs"]
mod machine;
#[path = "common/threads.rs"]
mod threads;

use std::hint::black_box;
use std::num::NonZero;
use std::thread::available_parallelism;

use machine::{instructions, seconds};
use pendula::{AnyMethod, Ensemble, Grid, Pendulum, Phase};
use pendula_device::{Device, devices, method_named};
use threads::with_threads;

/// The methods shown.
const SHOWN: [&str; 7] = [
    "symplectic-euler",
    "stormer-verlet",
    "rk4",
    "blanes-moan-6",
    "dop853",
    "processed-6",
    "taylor-24",
];

/// Enough for each core of a large card to have several.
const PENDULUMS: u32 = 1 << 18;

/// A run takes at least this long (s): starts are prepared on this side and brought to the device,
/// which must not count.
const LONG: f64 = 0.5;

/// The shortest of this number of runs is taken.
const ROUNDS: usize = 3;

/// Releases from 0.01 to 3.1 rad.
fn releases() -> Vec<Phase> {
    let last = f64::from(PENDULUMS - 1);
    (0..PENDULUMS).map(|j| Phase::at_rest(0.01 + 3.09 * f64::from(j) / last)).collect()
}

/// Steps a second of `run`, which takes this number of steps with each pendulum.
fn speed(mut run: impl FnMut(Grid) -> Phase) -> f64 {
    let grid = |steps| Grid::new(0.01, steps).expect("a positive step");
    let mut steps = 16;
    while seconds(|| run(grid(steps))) < LONG {
        steps *= 2;
    }
    let times = (0..ROUNDS).map(|_| seconds(|| run(grid(steps))));
    steps as f64 * f64::from(PENDULUMS) / times.fold(f64::INFINITY, f64::min)
}

/// The same in lanes, with this number of threads.
fn in_lanes(method: &dyn AnyMethod, starts: &[Phase], threads: usize) -> f64 {
    let mut ends = vec![Phase::default(); starts.len()];
    with_threads(threads, || {
        speed(|grid| {
            Ensemble::new(&Pendulum::PAPER, black_box(starts), grid).ends(method, &mut ends);
            ends[0]
        })
    })
}

fn row(name: &str, devices: &[Device], threads: usize) {
    let starts = releases();
    let on_device = method_named(name).expect("one of the library's");
    let info = on_device.host.info();
    let mega = |speed: f64| format!("{:.0}", speed * 1e-6);
    let program = (on_device.program)().expect("a method that runs on devices");
    let mut cells = vec![info.title.to_string(), program.operations.to_string()];
    cells.extend([1, threads].map(|threads| mega(in_lanes(on_device.host, &starts, threads))));
    for device in devices {
        let mut ends = vec![Phase::default(); starts.len()];
        let mut compiled = device.compile(on_device).expect("a device that works");
        let speed = speed(|grid| {
            let ensemble = Ensemble::new(&Pendulum::PAPER, &starts, grid);
            compiled.ends(&ensemble, &mut ends).expect("a device that works");
            ends[0]
        });
        let operations = program.operations as f64 * speed * 1e-9;
        cells.extend([mega(speed), format!("{operations:.1}")]);
    }
    println!("| {} |", cells.join(" | "));
}

fn main() {
    let name = std::env::args().skip(1).find(|word| !word.starts_with('-')).unwrap_or_default();
    let devices = match devices() {
        Ok(devices) => devices,
        Err(error) => {
            println!("nothing measured: {error}");
            return;
        }
    };
    let devices: Vec<Device> = devices
        .into_iter()
        .filter(|device| device.is_double && device.name.contains(&name))
        .collect();
    let threads = available_parallelism().map_or(1, NonZero::get);
    println!("{}\n", instructions());
    println!("Millions of steps a second of {PENDULUMS} pendulums, and 10⁹ operations a second.\n");
    let columns = devices.iter().map(|device| format!(" {} | 10⁹/s |", device.name));
    let columns: String = columns.collect();
    println!("| Method | operations a step | one core | {threads} cores |{columns}");
    println!("|---|--:|--:|--:|{}", "--:|--:|".repeat(devices.len()));
    for name in SHOWN {
        row(name, &devices, threads);
    }
}
