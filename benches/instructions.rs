//! One kernel alone, for a tool that counts instructions: their number does not depend on the load
//! of the machine.
//!
//! `count <kernel> <steps>` runs a kernel, anything else lists them. `benches/callgrind.sh` makes a
//! table from it.

mod common;

use std::hint::black_box;

use common::NAIVE;
use pendula::fast::ScaledPendulum;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{Grid, Method, Pendulum, Phase, integrate_fast};

const START: Phase = Phase::at_rest(1.0);
const STEP: f64 = 0.01;

/// The library's loop with a method.
type Fast = fn(&Grid) -> Phase;

/// It for each method that has a naive loop, compiled into this program, as it is for anybody's own
/// method.
const FAST: [(&str, Fast); 4] = [
    ("forward-euler", |grid| fast(&ForwardEuler, grid)),
    ("symplectic-euler", |grid| fast(&SymplecticEuler, grid)),
    ("rk4", |grid| fast(&Rk4, grid)),
    ("stormer-verlet", |grid| fast(&StormerVerlet, grid)),
];

fn fast<M>(method: &M, grid: &Grid) -> Phase
where
    M: Method<Pendulum> + Method<ScaledPendulum>,
{
    integrate_fast(&Pendulum::PAPER, method, black_box(START), grid, &mut ())
}

/// Runs the kernel `method/loop` for `steps` steps, if there is one.
fn count(kernel: &str, steps: u64) -> Option<Phase> {
    let (name, which) = kernel.split_once('/')?;
    if which == "naive" {
        let (_, naive) = NAIVE.iter().find(|(of, _)| *of == name)?;
        return Some(naive(black_box(START), black_box(steps), black_box(STEP)));
    }
    let (_, fast) = FAST.iter().find(|(of, _)| which == "integrate_fast" && *of == name)?;
    Some(fast(&black_box(Grid::new(STEP, steps).ok()?)))
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
    for (name, _) in FAST {
        println!("{name}/naive\n{name}/integrate_fast");
    }
}
