//! Four pendulums from the same start, each with the same number of force evaluations a second: the
//! moving picture at the top of the README.

use pendula::exact::Motion;
use pendula::methods::hermite;
use pendula::{Grid, Pendulum, Phase, System};

use super::{MethodRef, each_of_the_paper, samples};

/// Released at rest from here (rad). It is the paper's angle to the other side, so that forward
/// Euler goes over the top with a positive angular velocity.
pub const THETA_0: f64 = -1.0;
/// The run lasts so long (s).
pub const DURATION: f64 = 12.0;
/// Time for an evaluation of the force (s): a method with four of them takes steps four times as
/// long. At a step of ten to the second each method shows how it errs within a few swings.
pub const EVALUATION: f64 = 0.1;
/// Samples after the first, one for each evaluation.
const SAMPLES: u64 = 120;

/// A method and where its pendulum is.
#[derive(Clone, Debug)]
pub struct Row {
    /// The method.
    pub method: MethodRef,
    /// Its step (s).
    pub step: f64,
    /// Its states, [`EVALUATION`] apart. Within a step of several evaluations they lie on the
    /// cubic through both ends with the rates there.
    pub samples: Vec<Phase>,
}

/// Runs the methods of the paper.
pub fn run() -> Vec<Row> {
    each_of_the_paper(|method| {
        let evaluations = method.info().force_evaluations;
        let step = EVALUATION * evaluations as f64;
        let grid = Grid::with_duration(step, DURATION).expect("a whole number of steps");
        let states = samples(method, THETA_0, &grid);
        let within = states.windows(2).flat_map(|ends| {
            let [(_, from), (_, to)] = [ends[0], ends[1]];
            (0..evaluations).map(move |n| cubic(step, from, to, n as f64 / evaluations as f64))
        });
        let samples = within.chain(states.last().map(|(_, z)| *z)).collect();
        Row { method, step, samples }
    })
}

/// The exact motion at the same times.
pub fn truth() -> Vec<Phase> {
    let motion = Motion::new(&Pendulum::PAPER, Phase::at_rest(THETA_0)).expect("a finite angle");
    (0..=SAMPLES).map(|n| motion.at(DURATION * (n as f64 / SAMPLES as f64))).collect()
}

/// The cubic of Hermite between the ends of a step, after the fraction `s` of it.
fn cubic(step: f64, from: Phase, to: Phase, s: f64) -> Phase {
    let slope = |z: Phase| Pendulum::PAPER.rate(0.0, z) * step;
    let [whole, bend, skew] = hermite(to + from * -1.0, slope(from), slope(to));
    from + (whole + (bend + skew * s) * (1.0 - s)) * s
}
