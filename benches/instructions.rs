//! One kernel alone, for a tool that counts instructions: their number does not depend on the load
//! of the machine.
//!
//! `count <kernel> <steps>` runs a kernel, anything else lists them. `benches/callgrind.sh` makes a
//! table from it.

mod common;

use std::hint::black_box;

use common::NAIVE;
use pendula::{Grid, METHODS, Pendulum, Phase, integrate_fast, methods};

const START: Phase = Phase::at_rest(1.0);
const STEP: f64 = 0.01;

macro_rules! every_method {
    ($($module:ident::$method:ident,)+) => {
        /// The library's loop for the method of that name.
        fn fast_named(name: &str, grid: &Grid) -> Option<Phase> {
            use pendula::Info;
            $(
                let method = methods::$method;
                if method.info().name == name {
                    let start = black_box(START);
                    return Some(integrate_fast(&Pendulum::PAPER, &method, start, grid, &mut ()));
                }
            )+
            None
        }
    };
}
pendula::for_each_method!(every_method);

/// Runs the kernel `method/loop` for `steps` steps, if there is one.
fn count(kernel: &str, steps: u64) -> Option<Phase> {
    let (name, which) = kernel.split_once('/')?;
    match which {
        "naive" => {
            let (_, naive) = NAIVE.iter().find(|(of, _)| *of == name)?;
            Some(naive(black_box(START), black_box(steps), black_box(STEP)))
        }
        "integrate_fast" => fast_named(name, &black_box(Grid::new(STEP, steps).ok()?)),
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
        }
        println!("{name}/integrate_fast");
    }
}
