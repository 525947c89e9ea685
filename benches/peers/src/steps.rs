//! The time of a step, the final state only.

use std::hint::black_box;

use pendula::{AnyMethod, Grid, METHODS, Pendulum, Phase};

use crate::crates::STEPPED;
use crate::machine::{instructions, median, seconds};
use crate::naive::NAIVE;

const STEPS: u64 = 10_000;
const STEP: f64 = 0.01;
const END: f64 = 100.0;

/// Rounds, in each of which every contender is timed once.
const ROUNDS: usize = 21;

/// The largest difference (rad, rad/s) between the ends of two programs of the same method: after
/// 100 s, differences in rounding have grown to 7e-11. With a margin of 100.
const AGREEMENT: f64 = 1e-8;

/// A program: its name, and the function from the start to the end.
type Contender<'a> = (&'a str, Box<dyn Fn(Phase) -> Phase + 'a>);

/// The naive loop first, then the library, then the crates.
fn contenders<'a>(method: &'a dyn AnyMethod, grid: &'a Grid) -> Option<Vec<Contender<'a>>> {
    let name = method.info().name;
    let (_, naive) = NAIVE.iter().find(|(of, _)| *of == name)?;
    let naive = |start| naive(start, black_box(STEPS), black_box(STEP));
    let library = move |start| method.end(&Pendulum::PAPER, start, black_box(grid));
    let mut all: Vec<Contender<'a>> =
        vec![("naive", Box::new(naive)), ("pendula", Box::new(library))];
    for (_, peer, run) in STEPPED.iter().filter(|(of, ..)| *of == name) {
        all.push((peer, Box::new(|start| run(start, black_box(STEPS), black_box(STEP)))));
    }
    Some(all)
}

/// Prints the table.
pub fn compare() {
    let grid = Grid::with_duration(STEP, END).expect("a whole number of steps");
    assert_eq!(grid.steps(), STEPS, "the same steps for everyone");
    println!("{}", instructions());
    println!("{STEPS} steps of {STEP} s, final state only, median of {ROUNDS}\n");
    println!(
        "{:>6} | {:<16} | {:<24} | {:>9} | {:>14}",
        "θ₀", "method", "program", "ns a step", "naive / it"
    );
    for theta_0 in [1.0, 3.0] {
        let start = Phase::at_rest(theta_0);
        for &method in METHODS {
            let name = method.info().name;
            let Some(contenders) = contenders(method, &grid) else { continue };
            let ends: Vec<Phase> = contenders.iter().map(|(_, run)| run(start)).collect();
            for ((program, _), end) in contenders.iter().zip(&ends) {
                let apart =
                    f64::max((end.theta - ends[0].theta).abs(), (end.omega - ends[0].omega).abs());
                assert!(apart < AGREEMENT, "{program} takes other steps of {name}: {apart:e}");
            }

            // Ratios are taken within a round, so that a slow moment of the machine slows both.
            let mut times = vec![Vec::new(); contenders.len()];
            for _ in 0..ROUNDS {
                for ((_, run), times) in contenders.iter().zip(&mut times) {
                    times.push(seconds(|| run(black_box(start))));
                }
            }
            for ((program, _), own) in contenders.iter().zip(&times) {
                let ratios = times[0].iter().zip(own).map(|(naive, own)| naive / own);
                println!(
                    "{theta_0:>6} | {name:<16} | {program:<24} | {:>9.1} | {:>13.2}×",
                    1e9 * median(own.clone()) / STEPS as f64,
                    median(ratios.collect()),
                );
            }
        }
    }
}
