//! Run time against error: the cost of a digit with each method.
//!
//! The error is max(|Δθ|, |Δω|/ω₀) at the end, against the closed form. A run of T seconds takes T
//! · 2ᵏ steps, so that the step is a power of two and the run ends exactly at the time of the exact
//! state: a rounded step alone costs 3e-13 at 1000 s.
//!
//! # Which steps count
//! A step at which the error happens to cross zero must not count; the next finer step reveals it
//! ([`is_asymptotic`]). Nor does an error of more than a radian count. Where an error may be
//! [rounding](EndError::rounding), and is not halved by the next step, it is the last: more steps
//! would only add rounding errors.
//!
//! `cargo bench --bench work_precision` takes the median of nine runs; without `--bench` there is
//! one run, to check that the program works.

#[path = "common/machine.rs"]
mod machine;
#[path = "common/mod.rs"]
mod naive;

use std::hint::black_box;

use machine::{instructions, median, seconds};
use naive::NAIVE;
use pendula::metrics::EndError;
use pendula::metrics::order::{is_asymptotic, is_floor};
use pendula::{AnyMethod, Grid, METHODS, Pendulum, Phase};

/// The release angle (rad) and the duration (s).
const SCENES: [(f64, u32); 3] = [(1.0, 100), (3.0, 30), (1.0, 1000)];

/// The errors in the summary.
const GOALS: [f64; 3] = [1e-2, 1e-6, 1e-12];

/// A program: maps a number of steps and their length (s) to the last state.
struct Contender<'a> {
    name: String,
    order: u32,
    run: &'a dyn Fn(u64, f64) -> Phase,
}

/// A line of the table.
struct Row {
    steps: u64,
    error: f64,
    microseconds: f64,
}

struct Problem {
    error: EndError,
    duration: u32,
    runs: usize,
}

impl Problem {
    fn error(&self, contender: &Contender<'_>, steps: u64, step: f64) -> f64 {
        self.error.of((contender.run)(steps, step))
    }

    /// The steps that count, from the coarsest to the first that reaches the finest goal.
    fn rows(&self, contender: &Contender<'_>) -> Vec<Row> {
        let mut rows = Vec::new();
        let mut next = None;
        for k in 2.. {
            let (steps, step) = (u64::from(self.duration) << k, 0.5_f64.powi(k));
            // Low orders gain little from more steps; order 4 needs four million.
            if steps > 1 << (18 + contender.order.min(4)) {
                break;
            }
            let error = next.unwrap_or_else(|| self.error(contender, steps, step));
            let finer = self.error(contender, 2 * steps, 0.5 * step);
            next = Some(finer);
            let rounding = self.error.rounding(2 * steps);
            if error <= 1.0 && is_asymptotic(contender.order, error, finer, rounding) {
                let times = (0..self.runs).map(|_| seconds(|| (contender.run)(steps, step)));
                rows.push(Row { steps, error, microseconds: 1e6 * median(times.collect()) });
                let rounding = self.error.rounding(steps);
                if error <= GOALS[GOALS.len() - 1] || is_floor(error, rounding, finer) {
                    break;
                }
            }
        }
        rows
    }
}

/// The naive loop, if there is one, and the library's.
fn compare(scene: &Problem, method: &dyn AnyMethod, start: Phase) -> Vec<(String, Vec<Row>)> {
    let info = method.info();
    let (name, order) = (info.name, info.order);
    let library = |steps, step| {
        let grid = Grid::new(black_box(step), black_box(steps)).expect("a positive step");
        method.end(&Pendulum::PAPER, black_box(start), &grid)
    };
    let mut contenders = vec![Contender { name: name.into(), order, run: &library }];
    let naive = NAIVE.iter().find(|(of, _)| *of == name).map(|(_, naive)| {
        move |steps, step| naive(black_box(start), black_box(steps), black_box(step))
    });
    if let Some(run) = &naive {
        contenders.push(Contender { name: format!("{name}, naive"), order, run });
    }
    contenders.into_iter().map(|of| (of.name.clone(), scene.rows(&of))).collect()
}

fn main() {
    let runs = if std::env::args().any(|argument| argument == "--bench") { 9 } else { 1 };
    println!("{}", instructions());
    println!("time: median of {runs}, final state only\n");
    println!("{:<20} | {:<24} | {:>8} | {:>8} | {:>10}", "scene", "method", "N", "error", "µs");
    let mut summary = Vec::new();
    for (theta_0, duration) in SCENES {
        let start = Phase::at_rest(theta_0);
        let error = EndError::new(&Pendulum::PAPER, start, f64::from(duration))
            .expect("a pendulum's motion");
        let title = format!("{theta_0} rad to {duration} s");
        let scene = Problem { error, duration, runs };
        for (name, rows) in METHODS.iter().flat_map(|method| compare(&scene, *method, start)) {
            for Row { steps, error, microseconds } in &rows {
                println!(
                    "{title:<20} | {name:<24} | {steps:>8} | {error:>8.1e} | {microseconds:>10.1}"
                );
            }
            summary.push((title.clone(), name, rows));
        }
    }

    println!("\nµs to an error of");
    let goals = GOALS.map(|goal| format!("{goal:>10.0e}")).join(" | ");
    println!("{:<20} | {:<24} | {goals}", "scene", "method");
    for (title, name, rows) in summary {
        let reached = GOALS.map(|goal| match rows.iter().find(|row| row.error <= goal) {
            Some(row) => format!("{:>10.1}", row.microseconds),
            None => format!("{:>10}", "–"),
        });
        println!("{title:<20} | {name:<24} | {}", reached.join(" | "));
    }
}
