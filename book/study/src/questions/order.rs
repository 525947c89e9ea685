//! Questions of "Measuring order, and your own error".

use pendula::exact::{Motion, period};
use pendula::methods::{Rk4, StormerVerlet, SymplecticEuler};
use pendula::systems::Damped;
use pendula::{Grid, Pendulum, Phase, integrate, integrate_with};

use super::{Compute, Truth, Within};
use crate::experiments::{STEPS, convergence};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] =
    &[("order-whole-swing", whole_swing), ("order-of-energy", of_energy), ("order-change", change)];

/// Which of symplectic Euler's errors falls to a quarter with half the step: the largest one of a
/// whole swing, or the one at the end of a quarter of it or of all of it.
fn whole_swing() -> Truth {
    let (pendulum, released) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let swing = period(&pendulum, 1.0).expect("it swings");
    let motion = Motion::new(&pendulum, released).expect("a finite start");
    // The largest error of the state, and the last.
    let errors = |swings: f64, steps: u64| {
        let grid = Grid::new(swings * swing / steps as f64, steps).expect("a grid");
        let (mut largest, mut last) = (0.0, 0.0);
        let mut watch = |_: u64, t: f64, z: Phase| {
            let off = z - motion.at(t);
            last = libm::hypot(off.theta, off.omega / pendulum.small_angle_frequency());
            largest = f64::max(largest, last);
        };
        integrate_with(&pendulum, &SymplecticEuler, released, &grid, &mut watch);
        [largest, last]
    };
    let [largest, whole] = [0, 1].map(|which| errors(1.0, 500)[which] / errors(1.0, 1000)[which]);
    let quarter = errors(0.25, 500)[1] / errors(0.25, 1000)[1];
    let is_four = |factor: f64| libm::fabs(libm::log(factor / 4.0)) < 0.1;
    Truth::Which(vec![
        ("largest", is_four(largest)),
        ("quarter-swing", is_four(quarter)),
        ("whole-swing", is_four(whole)),
    ])
}

/// The slope of RK4's largest energy error over the whole of the paper's ladder.
fn of_energy() -> Truth {
    let [coarse, .., fine] = STEPS;
    let [largest, least] = [coarse, fine].map(|step| convergence::drift(&Rk4, step));
    let slope = libm::log(largest / least) / libm::log(coarse / fine);
    Truth::nearest(slope, &[("swing", 4.0), ("loss", 5.0), ("step", 6.0)])
}

/// How far Störmer–Verlet's angle of the pendulum with friction is still off where half the step
/// has changed it by 300 (µrad).
fn change() -> Truth {
    const CHANGE: f64 = 300.0;
    let damped = Damped::new(Pendulum::PAPER, 0.1).expect("a damping");
    let grid = |steps: u64| Grid::new(10.0 / steps as f64, steps).expect("a grid");
    let released = Phase::at_rest(1.0);
    let truth = integrate(&damped, &Rk4, released, &grid(8000)).theta;
    let [old, new] =
        [1000, 2000].map(|steps| integrate(&damped, &StormerVerlet, released, &grid(steps)).theta);
    let factor = (old - truth) / (new - truth);
    Truth::Number {
        right: CHANGE * (new - truth) / (old - new),
        // A third of the change, if the old error is four times the new one, which it is to much
        // less than this.
        within: Within::Percent(1.0),
        mistakes: vec![
            ("all", CHANGE),
            ("quarter", CHANGE / factor),
            // By the factor of the error of a single step.
            ("one-step", CHANGE / (2.0 * factor - 1.0)),
        ],
    }
}
