//! One kernel alone, for a tool that counts instructions: their number does not depend on the load
//! of the machine.
//!
//! `count <kernel> <steps>` runs a kernel, anything else lists them. `benches/callgrind.sh` makes a
//! table from it.
//!
//! The paper's methods are known here by their types, and their `integrate_fast` is compiled into
//! this program, as it is for anybody's own method. Every method has an `end`, which is compiled
//! once, in the library, and `lanes`: [`PENDULUMS`] at once, in the vector instructions that
//! callgrind knows. A part of a step that is not inlined there shows as several times the count.

mod common;
#[path = "common/threads.rs"]
mod threads;

use std::hint::black_box;

use common::NAIVE;
use pendula::fast::{Ensemble, Instructions};
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{Grid, METHODS, Pendulum, Phase, integrate_fast, method_named};

const START: Phase = Phase::at_rest(1.0);
const STEP: f64 = 0.01;

/// A multiple of the number of lanes.
const PENDULUMS: usize = 16;

/// `integrate_fast` for the method of the paper of that name.
fn fast_named(name: &str, grid: &Grid) -> Option<Phase> {
    let (pendulum, start) = (Pendulum::PAPER, black_box(START));
    match name {
        "forward-euler" => Some(integrate_fast(&pendulum, &ForwardEuler, start, grid)),
        "symplectic-euler" => Some(integrate_fast(&pendulum, &SymplecticEuler, start, grid)),
        "rk4" => Some(integrate_fast(&pendulum, &Rk4, start, grid)),
        "stormer-verlet" => Some(integrate_fast(&pendulum, &StormerVerlet, start, grid)),
        _ => None,
    }
}

/// Many pendulums in lanes, and where the first of them ends.
fn lanes_named(name: &str, grid: Grid) -> Option<Phase> {
    let starts = black_box([START; PENDULUMS]);
    let mut ends = starts;
    Ensemble::new(&Pendulum::PAPER, &starts, grid)
        .with_instructions(Instructions::Avx2)
        .ends(method_named(name)?, &mut ends);
    Some(ends[0])
}

/// Runs the kernel `method/loop` for `steps` steps, if there is one.
fn count(kernel: &str, steps: u64) -> Option<Phase> {
    let (name, which) = kernel.split_once('/')?;
    let start = black_box(START);
    let grid = black_box(Grid::new(STEP, steps).ok()?);
    match which {
        "naive" => {
            let (_, naive) = NAIVE.iter().find(|(of, _)| *of == name)?;
            Some(naive(start, black_box(steps), black_box(STEP)))
        }
        "integrate_fast" => fast_named(name, &grid),
        "end" => Some(method_named(name)?.end(&Pendulum::PAPER, start, &grid)),
        "lanes" => threads::with_threads(1, || lanes_named(name, grid)),
        _ => None,
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [verb, kernel, steps, ..] = &arguments[..]
        && verb == "count"
    {
        let end = steps.parse().ok().and_then(|steps| count(kernel, steps));
        black_box(end.expect("count <kernel> <steps>, with one of the kernels listed"));
        return;
    }
    for method in METHODS {
        let name = method.info().name;
        if NAIVE.iter().any(|(of, _)| *of == name) {
            println!("{name}/naive");
            println!("{name}/integrate_fast");
        }
        println!("{name}/end");
        println!("{name}/lanes");
    }
}
