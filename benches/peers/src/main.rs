//! The library and other crates, in one run, compared with the naive loop.
//!
//! `cargo run --release --manifest-path benches/peers/Cargo.toml` compares run time. With `-- ends`
//! it prints the exact motion for `others.py`, which compares programs that are no crates.
//!
//! The front of run time against error is the shortest time in which each program reaches a given
//! error, on three scenes.
//!
//! The error is max(|Δθ|, |Δω|/ω₀) at the end, against the closed form. Every program has a list of
//! settings, from coarse to fine. With fixed steps, those are all the steps that are exact in f64
//! and end exactly at the duration, d/2ᵏ s where d divides the duration: a rounded step alone costs
//! 3e-13 at 1000 s. With a tolerance, there are four to a decade.
//!
//! The first setting within the goal counts, unless by chance: the next finer one must be within
//! the goal, too, and either its error is at most three times as large, or, as where both are
//! rounding, the one after that is within the goal as well. A program that needs more than
//! [`PATIENCE`] for a run before it reaches the goal is left out, except the naive loop. Where
//! rounding keeps that from the goal, it is shown with as many steps as its order would need, and
//! with the error that it then has. The others are timed in rounds, each at its own setting and
//! several times in a row; the shortest of its times counts.

use std::hint::black_box;
use std::process::ExitCode;

use pendula::adaptive::{Adaptive, TaylorSeries, Tolerance};
use pendula::methods::{BlanesMoan6, Dop853, Taylor24};
use pendula::metrics::EndError;
use pendula::systems::FromRate;
use pendula::{
    AnyMethod, Compensated, CompensatedPhase, Grid, METHODS, Method, Motion, Pendulum, Phase,
    Taylor, integrate,
};

use crates::{CONTROLLED, Controlled, NOWHERE, STEPPED};
use machine::{instructions, seconds};
use naive::NAIVE;

mod crates;
#[path = "../../common/machine.rs"]
mod machine;
#[path = "../../common/mod.rs"]
mod naive;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => compare(),
        ["ends"] => ends(),
        _ => {
            eprintln!("pendula-peers: nothing, or ends");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

/// The release angle (rad) and the duration (s).
const SCENES: [(f64, u32); 3] = [(1.0, 100), (3.0, 30), (1.0, 1000)];

/// The errors asked for.
const GOALS: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// Rounds, in each of which every contender is timed.
const ROUNDS: usize = 5;

/// Runs in a row in a round, the shortest of which counts. So its code is in the caches, as that of
/// the programs of `others.py` is: a series is 10 kB of instructions.
const IN_A_ROW: usize = 7;

/// The longest run (s) after which a finer setting is still tried; and that of the naive loop.
const PATIENCE: f64 = 0.1;
const PATIENCE_WITH_NAIVE: f64 = 1.0;

/// A program that takes this many times the shortest time is not timed in rounds.
const BEHIND: f64 = 40.0;

/// The number of the library's methods that are shown, the fastest ones.
const SHOWN: usize = 3;

/// The longest step (s), and k of the shortest, a divisor of the duration times 2⁻ᵏ.
const LONGEST: f64 = 0.5;
const FINEST: u32 = 16;

/// Fixed steps: their number, and their length (s).
#[derive(Clone, Copy)]
struct Steps {
    count: u64,
    length: f64,
}

/// All steps that are exact in f64 and end exactly at `end` (s), the longest first.
fn exact_steps(end: u32) -> Vec<Steps> {
    let odd = (1..=end).step_by(2).filter(|d| end.is_multiple_of(*d));
    let mut all: Vec<Steps> = odd
        .flat_map(|d| {
            (1..=FINEST).map(move |k| Steps {
                count: u64::from(end / d) << k,
                length: f64::from(d) * 0.5_f64.powi(k as i32),
            })
        })
        .filter(|steps| steps.length <= LONGEST)
        .collect();
    all.sort_by_key(|steps| steps.count);
    all
}

/// A program in the comparison.
struct Contender {
    name: String,
    kind: Kind,
    /// The number of steps of each setting, from coarse to fine; empty where the steps are not
    /// fixed.
    counts: Vec<u64>,
    settings: Vec<Box<dyn Fn() -> Phase>>,
    /// The error (rad) and the time (s) of each setting tried so far.
    tried: Vec<(f64, f64)>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Naive,
    Library,
    /// The library, which knows nothing but the rate.
    Closure,
    Crate,
}

impl Contender {
    fn of_steps(
        name: impl Into<String>,
        kind: Kind,
        steps: &[Steps],
        run: impl Fn(u64, f64) -> Phase + Copy + 'static,
    ) -> Self {
        let setting = |steps: &Steps| {
            let Steps { count, length } = *steps;
            Box::new(move || run(black_box(count), black_box(length))) as Box<dyn Fn() -> Phase>
        };
        let settings = steps.iter().map(setting).collect();
        let counts = steps.iter().map(|steps| steps.count).collect();
        Self { name: name.into(), kind, counts, settings, tried: Vec::new() }
    }

    fn of_tolerances(name: &str, kind: Kind, run: impl Fn(f64) -> Phase + Copy + 'static) -> Self {
        let setting =
            |tolerance: f64| Box::new(move || run(black_box(tolerance))) as Box<dyn Fn() -> Phase>;
        let settings = tolerances().map(setting).collect();
        Self { name: name.into(), kind, counts: Vec::new(), settings, tried: Vec::new() }
    }

    fn climb(&mut self, error: &EndError) {
        let patience = if self.kind == Kind::Naive { PATIENCE_WITH_NAIVE } else { PATIENCE };
        for run in &self.settings {
            let mut end = Phase::default();
            let time = seconds(|| end = run());
            self.tried.push((error.of(end), time));
            let is_there = self.setting_for(GOALS[GOALS.len() - 1]).is_some();
            if is_there || time > patience {
                break;
            }
        }
    }

    /// The coarsest setting that is within the goal, and not by chance.
    fn setting_for(&self, goal: f64) -> Option<usize> {
        let is_within = |i: usize| self.tried.get(i).is_some_and(|(error, _)| *error <= goal);
        let is_asymptotic = |i: usize| self.tried[i + 1].0 <= 3.0 * self.tried[i].0;
        (0..self.tried.len())
            .find(|&i| is_within(i) && is_within(i + 1) && (is_asymptotic(i) || is_within(i + 2)))
    }

    /// For RK4, where rounding keeps it from the goal: as many steps as its order would need.
    fn setting_by_order(&self, goal: f64) -> Option<usize> {
        let reached = GOALS.iter().rev().find_map(|reached| self.setting_for(*reached))?;
        let more = (self.tried[reached].0 / goal).powf(0.25);
        let needed = self.counts[reached] as f64 * more;
        (0..self.tried.len()).find(|&i| self.counts[i] as f64 >= needed)
    }
}

/// A method of the library, from `theta_0`.
fn of_library(method: &'static dyn AnyMethod, theta_0: f64, steps: &[Steps]) -> Contender {
    let name = method.info().name;
    Contender::of_steps(name, Kind::Library, steps, move |count, length| {
        let grid = Grid::new(length, count).expect("a positive step");
        method.end(&Pendulum::PAPER, black_box(Phase::at_rest(theta_0)), &grid)
    })
}

/// A method of the library with compensated sums, from `theta_0`.
fn compensated<M>(name: &str, method: M, theta_0: f64, steps: &[Steps]) -> Contender
where
    M: Method<Compensated<Pendulum>> + Copy + 'static,
{
    let name = format!("{name}, compensated");
    Contender::of_steps(name, Kind::Library, steps, move |count, length| {
        let grid = Grid::new(length, count).expect("a positive step");
        let start = CompensatedPhase::from(black_box(Phase::at_rest(theta_0)));
        integrate(&Compensated::new(Pendulum::PAPER), &method, start, &grid).phase
    })
}

/// The Taylor series with compensated sums.
fn series(start: Phase, end: f64, tolerance: f64) -> Phase {
    // The library refuses the finest.
    let Ok(tolerance) = Tolerance::uniform(tolerance) else { return NOWHERE };
    let (adaptive, system) =
        (Adaptive::new(TaylorSeries, tolerance), Compensated::new(Pendulum::PAPER));
    let run = adaptive.integrate(&system, CompensatedPhase::from(start), 0.0, end);
    run.map_or(NOWHERE, |(z, _)| z.phase)
}

/// DOP853 of a system of which the library knows as much as the other crates do: its rate.
fn of_closure(start: Phase, end: f64, tolerance: f64) -> Phase {
    let Ok(tolerance) = Tolerance::uniform(tolerance) else { return NOWHERE };
    let system =
        FromRate::new(|_t, z: Phase| Phase { theta: z.omega, omega: -9.81 * z.theta.sin() });
    let run = Adaptive::new(Dop853, tolerance).integrate(&system, start, 0.0, end);
    run.map_or(NOWHERE, |(z, _)| z)
}

/// What a user of the library calls with a tolerance.
const OURS: [(&str, Kind, Controlled); 2] = [
    ("Taylor series, compensated", Kind::Library, series),
    ("Dop853 on a closure", Kind::Closure, of_closure),
];

/// Four to a decade.
fn tolerances() -> impl Iterator<Item = f64> {
    (4..=60).map(|quarters| 10.0_f64.powf(-0.25 * f64::from(quarters)))
}

/// All contenders, the naive RK4 first.
fn contenders(theta_0: f64, end: u32) -> Vec<Contender> {
    let steps = exact_steps(end);
    let start = Phase::at_rest(theta_0);
    let (_, rk4) = *NAIVE.iter().find(|(name, _)| *name == "rk4").expect("a naive RK4");
    let naive = move |count, length| rk4(black_box(start), count, length);
    let mut all = vec![Contender::of_steps("rk4, naive", Kind::Naive, &steps, naive)];
    all.extend(METHODS.iter().map(|method| of_library(*method, theta_0, &steps)));
    all.push(compensated("blanes-moan-6", BlanesMoan6, theta_0, &steps));
    all.push(compensated("taylor-24", Taylor24, theta_0, &steps));
    all.push(compensated("Taylor<30>", Taylor::<30>, theta_0, &steps));
    let end = f64::from(end);
    for (name, kind, run) in OURS {
        let run = move |tolerance| run(black_box(start), black_box(end), tolerance);
        all.push(Contender::of_tolerances(name, kind, run));
    }
    for (method, name, run) in STEPPED {
        let run = move |count, length| run(black_box(start), count, length);
        let name = format!("{name} {method}");
        all.push(Contender::of_steps(name, Kind::Crate, &steps, run));
    }
    for (name, run) in CONTROLLED {
        let run = move |tolerance| run(black_box(start), end, tolerance);
        all.push(Contender::of_tolerances(name, Kind::Crate, run));
    }
    all
}

/// A contender, its setting, and the shortest of its times (s).
type Row<'a> = (&'a Contender, usize, f64);

/// Times the contenders that reach the goal in a comparable time, the quickest first.
fn race(contenders: &[Contender], goal: f64) -> Vec<Row<'_>> {
    let setting = |contender: &Contender| match contender.kind {
        Kind::Naive => contender.setting_for(goal).or_else(|| contender.setting_by_order(goal)),
        _ => contender.setting_for(goal),
    };
    let row = |contender| setting(contender).map(|i| (contender, i, contender.tried[i].1));
    let mut rows: Vec<Row> = contenders.iter().filter_map(row).collect();
    let shortest = rows.iter().map(|row| row.2).fold(f64::INFINITY, f64::min);
    rows.retain(|row| row.0.kind == Kind::Naive || row.2 < BEHIND * shortest);
    // In rounds, so that a slow moment of the machine slows them all.
    for _ in 0..ROUNDS {
        for (contender, setting, shortest) in &mut rows {
            let run = &contender.settings[*setting];
            *shortest = (0..IN_A_ROW).map(|_| seconds(run)).fold(*shortest, f64::min);
        }
    }
    rows.sort_by(|a, b| a.2.total_cmp(&b.2));
    rows
}

/// Prints the front.
fn compare() {
    println!("{}", instructions());
    let times = ROUNDS * IN_A_ROW;
    println!("the shortest of {times} times, final state only, and the ratio to naive RK4\n");
    println!(
        "{:<15} | {:>6} | {:<37} | {:>8} | {:>9} | {:>10}",
        "scene", "goal", "program", "error", "µs", "naive / it"
    );
    for (theta_0, end) in SCENES {
        let error = EndError::new(&Pendulum::PAPER, Phase::at_rest(theta_0), f64::from(end))
            .expect("a release that has a motion");
        let mut contenders = contenders(theta_0, end);
        for contender in &mut contenders {
            contender.climb(&error);
        }
        for goal in GOALS {
            let mut rows = race(&contenders, goal);
            let naive = rows.iter().find(|row| row.0.kind == Kind::Naive);
            let naive = naive.map_or(f64::NAN, |row| row.2);
            let mut of_library = 0;
            rows.retain(|(contender, ..)| {
                of_library += usize::from(contender.kind == Kind::Library);
                contender.kind != Kind::Library || of_library <= SHOWN
            });
            for (contender, setting, time) in rows {
                println!(
                    "{:<15} | {goal:>6.0e} | {:<37} | {:>8.1e} | {:>9.1} | {:>9.2}×",
                    format!("{theta_0} rad, {end} s"),
                    contender.name,
                    contender.tried[setting].0,
                    1e6 * time,
                    naive / time,
                );
            }
        }
    }
}

/// The pendulums of the ensemble: their number, the first and last release angle (rad), the
/// duration (s).
const ENSEMBLE: (u32, f64, f64, f64) = (9984, 0.01, 3.1, 10.0);

/// Prints the exact end of each scene, and of each pendulum of an ensemble: release angle (rad),
/// duration (s), angle (rad), angular velocity (rad/s).
fn ends() {
    let line = |kind: &str, theta_0: f64, end: f64| {
        let start = Phase::at_rest(theta_0);
        let z = Motion::new(&Pendulum::PAPER, start).expect("a finite start").at(end);
        println!("{kind} {theta_0:?} {end:?} {:?} {:?}", z.theta, z.omega);
    };
    for (theta_0, end) in SCENES {
        line("scene", theta_0, end.into());
    }
    let (count, first, last, end) = ENSEMBLE;
    for n in 0..count {
        line("ensemble", first + (last - first) * f64::from(n) / f64::from(count - 1), end);
    }
}
