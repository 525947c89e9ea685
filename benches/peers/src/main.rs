//! The library beside other crates, in one run: the time of a step, the final state only, against the naive loop.
//!
//! `cargo run --profile peers -p pendula-peers`. The profile optimises what the crates depend on; the release build
//! does not.
//!
//! Each crate does what it does at its best: `differential-equations` is stepped by hand, which keeps no states; and
//! `ode_solvers` keeps every state, as it cannot do otherwise. Neither has symplectic Euler.

#[path = "../../common/machine.rs"]
mod machine;
#[path = "../../common/mod.rs"]
mod naive;

use std::hint::black_box;

use differential_equations::methods::{ExplicitRungeKutta, SymplecticIntegrator};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use machine::{instructions, median, seconds};
use naive::NAIVE;
use ode_solvers::{System, Vector2};
use pendula::{Described, Grid, METHODS, Pendulum, Phase, methods, swing};

const STEPS: u64 = 10_000;
const STEP: f64 = 0.01;
const END: f64 = 100.0;

/// Rounds, in each of which every contender has its turn.
const ROUNDS: usize = 21;

/// How far (rad, rad/s) two programs of the same method may end from each other: after 100 s, that they round differently
/// has grown to 7e-11. With a margin of 100.
const AGREEMENT: f64 = 1e-8;

/// The paper's pendulum, as the crates want it.
struct Equations;

impl System<f64, Vector2<f64>> for Equations {
    fn system(&self, _t: f64, z: &Vector2<f64>, rate: &mut Vector2<f64>) {
        rate[0] = z[1];
        rate[1] = -9.81 * z[0].sin();
    }
}

impl ODE<f64, [f64; 2]> for Equations {
    fn diff(&self, _t: f64, z: &[f64; 2], rate: &mut [f64; 2]) {
        *rate = [z[1], -9.81 * z[0].sin()];
    }
}

fn ode_solvers_rk4(start: Phase) -> Phase {
    let z = Vector2::new(start.theta, start.omega);
    let mut stepper = ode_solvers::Rk4::new(Equations, 0.0, z, END, STEP);
    stepper.integrate().expect("a fixed step");
    let end = stepper.y_out().last().expect("the start at least");
    Phase { theta: end[0], omega: end[1] }
}

fn differential_equations_rk4(start: Phase) -> Phase {
    stepped_by_hand(ExplicitRungeKutta::rk4(STEP), start)
}

fn differential_equations_verlet(start: Phase) -> Phase {
    stepped_by_hand(SymplecticIntegrator::velocity_verlet(STEP), start)
}

fn differential_equations_euler(start: Phase) -> Phase {
    stepped_by_hand(ExplicitRungeKutta::euler(STEP), start)
}

fn stepped_by_hand(mut method: impl OrdinaryNumericalMethod<f64, [f64; 2]>, start: Phase) -> Phase {
    method.init(&Equations, 0.0, END, &[start.theta, start.omega]).expect("a fixed step");
    for _ in 0..STEPS {
        method.step(&Equations).expect("as many steps as are allowed");
    }
    let [theta, omega] = *method.y();
    Phase { theta, omega }
}

/// The method's name, the crate's, and the way from the start to the end.
type Peer = (&'static str, &'static str, fn(Phase) -> Phase);

/// The crates that have a method of the library's.
const PEERS: [Peer; 4] = [
    ("forward-euler", "differential-equations", differential_equations_euler),
    ("rk4", "ode_solvers", ode_solvers_rk4),
    ("rk4", "differential-equations", differential_equations_rk4),
    ("stormer-verlet", "differential-equations", differential_equations_verlet),
];

/// One who takes part: its name, and the way from the start to the end.
type Contender<'a> = (&'a str, Box<dyn Fn(Phase) -> Phase + 'a>);

macro_rules! every_method {
    ($($module:ident::$method:ident,)+) => {
        /// The library's loop for the method of that name.
        fn library<'a>(name: &str, grid: &'a Grid) -> Option<Contender<'a>> {
            $(
                let method = methods::$module::$method;
                if method.properties().name == name {
                    let run = move |start| {
                        swing(&Pendulum::PAPER, &method, start, black_box(grid), &mut ())
                    };
                    return Some(("pendula", Box::new(run)));
                }
            )+
            None
        }
    };
}
pendula::methods!(every_method);

/// The naive loop first, then the library, then the crates.
fn contenders<'a>(name: &str, grid: &'a Grid) -> Option<Vec<Contender<'a>>> {
    let (_, naive) = NAIVE.iter().find(|(of, _)| *of == name)?;
    let naive = |start| naive(start, black_box(STEPS), black_box(STEP));
    let mut all: Vec<Contender<'a>> = vec![("naive", Box::new(naive)), library(name, grid)?];
    for (_, peer, run) in PEERS.iter().filter(|(of, ..)| *of == name) {
        all.push((peer, Box::new(run)));
    }
    Some(all)
}

fn main() {
    let grid = Grid::over(END, STEP).expect("a whole number of steps");
    assert_eq!(grid.steps(), STEPS, "the same steps for everyone");
    println!("{}", instructions());
    println!("{STEPS} steps of {STEP} s, final state only, median of {ROUNDS}\n");
    println!(
        "{:>6} | {:<16} | {:<24} | {:>9} | {:>14}",
        "θ₀", "method", "program", "ns a step", "naive / it"
    );
    for theta_0 in [1.0, 3.0] {
        let start = Phase::at_rest(theta_0);
        for method in METHODS {
            let name = method.properties().name;
            let Some(contenders) = contenders(name, &grid) else { continue };
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
