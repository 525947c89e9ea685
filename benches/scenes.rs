//! The cost of each scene and the work it skips, compared with the naive loop: `cargo bench --bench
//! scenes`.
//!
//! Prints the table of the book's chapter on what a step costs. Every number is a median of one
//! run, and only the ratios in it are meaningful: the machine may be busy otherwise.

mod common;
#[path = "common/machine.rs"]
mod machine;
#[path = "common/threads.rs"]
mod threads;

use std::hint::black_box;
use std::num::NonZeroU64;

use common::NAIVE;
use pendula::fast::Ensemble;
use pendula::integrate::{Every, Record};
use pendula::methods::{Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::EnergyDrift;
use pendula::{
    Grid, LinearOscillator, Motion, Pendulum, Phase, integrate, integrate_fast, integrate_fast_with,
};

const STEPS: u64 = 10_000;
const STEP: f64 = 0.01;

/// The median of many runs of `scene`, in ns per item, of `count` items.
fn median(count: usize, mut scene: impl FnMut() -> f64) -> f64 {
    let mut times = [(); 25].map(|()| machine::seconds(&mut scene));
    times.sort_by(f64::total_cmp);
    times[12] * 1e9 / count as f64
}

fn naive(name: &str, start: Phase) -> f64 {
    let (_, run) = NAIVE.iter().find(|(of, _)| *of == name).expect("a naive loop");
    median(STEPS as usize, || run(black_box(start), black_box(STEPS), black_box(STEP)).theta)
}

struct Table(Vec<[String; 4]>);

impl Table {
    fn row(&mut self, scene: &str, skipped: &str, nanoseconds: f64, naive: f64) {
        let ratio = format!("{:.2}", naive / nanoseconds);
        self.0.push([scene.into(), skipped.into(), format!("{nanoseconds:.1}"), ratio]);
    }

    fn print(&self) {
        println!("| Scene | what is skipped | ns a step | times as fast |\n|---|---|--:|--:|");
        for row in &self.0 {
            println!("| {} |", row.join(" | "));
        }
    }
}

fn main() {
    threads::with_threads(1, measure);
}

fn measure() {
    let pendulum = Pendulum::PAPER;
    let grid = Grid::new(STEP, STEPS).expect("a positive step");
    let [one, three] = [1.0, 3.0].map(Phase::at_rest);
    let steps = STEPS as usize;
    let mut table = Table(vec![]);

    let verlet = naive("stormer-verlet", one);
    table.row("the naive loop, Störmer–Verlet, from 1 rad", "nothing", verlet, verlet);
    let time = median(steps, || {
        integrate(&pendulum, &StormerVerlet, black_box(one), black_box(&grid)).theta
    });
    table.row("`integrate`, the end only", "one half kick of two", time, verlet);
    let time = median(steps, || {
        integrate_fast(&pendulum, &StormerVerlet, black_box(one), black_box(&grid)).theta
    });
    let skipped = "and every factor h, the reduction of θ, the wait for the last product";
    table.row("`integrate_fast`, the end only", skipped, time, verlet);
    let mut every_100th = |_: u64, _: f64, z: Phase| {
        black_box(z);
    };
    let hundred = NonZeroU64::new(100).expect("not zero");
    let time = median(steps, || {
        let mut watch = Every::new(hundred, &mut every_100th);
        integrate_fast_with(&pendulum, &StormerVerlet, black_box(one), black_box(&grid), &mut watch)
            .theta
    });
    table.row("… every 100th state", "the half kick and ω for the others", time, verlet);
    let mut states = vec![Phase::default(); grid.samples() as usize];
    let time = median(steps, || {
        let mut record = Record::new(&mut states);
        integrate_fast_with(
            &pendulum,
            &StormerVerlet,
            black_box(one),
            black_box(&grid),
            &mut record,
        )
        .theta
    });
    table.row("… every state kept", "", time, verlet);
    let mut angles = vec![0.0; grid.samples() as usize];
    let time = median(steps, || {
        let mut slots = angles.iter_mut();
        let mut watch = |_: u64, _: f64, z: Phase| {
            if let Some(slot) = slots.next() {
                *slot = z.theta;
            }
        };
        integrate_fast_with(&pendulum, &StormerVerlet, black_box(one), black_box(&grid), &mut watch)
            .theta
    });
    table.row("… every θ kept", "the half kick and ω", time, verlet);
    let time = median(steps, || {
        let mut drift = EnergyDrift::new(&pendulum);
        integrate_fast_with(
            &pendulum,
            &StormerVerlet,
            black_box(one),
            black_box(&grid),
            &mut drift,
        );
        drift.largest()
    });
    table.row("… the largest energy error", "a cosine: 2 sin² θ/2, in blocks", time, verlet);
    let linear = LinearOscillator::new(pendulum);
    let time = median(steps, || {
        integrate(&linear, &StormerVerlet, black_box(one), black_box(&grid)).theta
    });
    table.row("the linear oscillator", "the sine", time, verlet);

    let naive_from_three = naive("stormer-verlet", three);
    let time = median(steps, || {
        integrate_fast(&pendulum, &StormerVerlet, black_box(three), black_box(&grid)).theta
    });
    table.row("`integrate_fast` from 3 rad", "", time, naive_from_three);
    for (start, from) in [(one, "1 rad"), (three, "3 rad")] {
        let time = median(steps, || {
            integrate_fast(&pendulum, &SymplecticEuler, black_box(start), black_box(&grid)).theta
        });
        let scene = format!("symplectic Euler, from {from}");
        table.row(&scene, "", time, naive("symplectic-euler", start));
        let time = median(steps, || {
            integrate_fast(&pendulum, &Rk4, black_box(start), black_box(&grid)).theta
        });
        table.row(&format!("RK4, from {from}"), "", time, naive("rk4", start));
    }

    let starts: Vec<Phase> =
        (1..=3328).map(|i| Phase::at_rest(3.0 / 3328.0 * f64::from(i))).collect();
    let mut ends = vec![Phase::default(); starts.len()];
    let short = Grid::new(STEP, 300).expect("a positive step");
    let count = starts.len() * 300;
    let ensemble = Ensemble::new(&pendulum, &starts, short);
    let mut one_by_one = |name: &str| {
        let (_, run) = NAIVE.iter().find(|(of, _)| *of == name).expect("a naive loop");
        median(count, || starts.iter().map(|start| run(*start, 300, black_box(STEP)).theta).sum())
    };
    let naives = ["symplectic-euler", "stormer-verlet", "rk4"].map(&mut one_by_one);
    let times = [
        median(count, || {
            ensemble.ends(&SymplecticEuler, black_box(&mut ends));
            ends[0].theta
        }),
        median(count, || {
            ensemble.ends(&StormerVerlet, black_box(&mut ends));
            ends[0].theta
        }),
        median(count, || {
            ensemble.ends(&Rk4, black_box(&mut ends));
            ends[0].theta
        }),
    ];
    let titles = ["symplectic Euler", "Störmer–Verlet", "RK4"];
    for ((title, time), naive) in titles.into_iter().zip(times).zip(naives) {
        table.row(&format!("an ensemble, {title}"), "the branch in the reduction", time, naive);
    }

    let exact = Motion::new(&pendulum, one).expect("in range");
    let times: Vec<f64> = (0..steps).map(|n| 0.037 * n as f64).collect();
    let time = median(steps, || times.iter().map(|t| exact.at(*t).theta).sum());
    table.row("the exact state at any time", "all steps", time, verlet);

    println!("Medians of one run, {}; ns a step, or a state.\n", machine::instructions());
    table.print();
}
