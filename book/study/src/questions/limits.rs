//! Questions of "Where it breaks".

use core::f64::consts::PI;

use pendula::exact::period;
use pendula::methods::{StormerVerlet, SymplecticEuler};
use pendula::{Grid, LinearOscillator, Pendulum, Phase, integrate};

use super::{Compute, Truth, Within};
use crate::experiments::standard_map;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("limits-longest-step", longest_step),
    ("limits-four-times", four_times),
    ("limits-ten-times-nearer", ten_times_nearer),
];

/// The longest step (s) with which a small swing of Störmer–Verlet stays small for a thousand
/// steps.
fn longest_step() -> Truth {
    let pendulum = Pendulum::PAPER;
    let swings = |step: f64| {
        let grid = Grid::new(step, 1000).expect("a positive step");
        let oscillator = LinearOscillator::new(pendulum);
        let end = integrate(&oscillator, &StormerVerlet, Phase::at_rest(1.0), &grid);
        end.theta.abs() < 2.0
    };
    let swing = pendulum.small_angle_period();
    let (mut stable, mut unstable) = (0.01 * swing, swing);
    for _ in 0..20 {
        let middle = 0.5 * (stable + unstable);
        *(if swings(middle) { &mut stable } else { &mut unstable }) = middle;
    }
    let radian = 1.0 / pendulum.small_angle_frequency();
    Truth::Number {
        right: stable,
        // A reader who has only the question's two seconds is off by 0.3 %, and one who gives two
        // digits by 0.2 %. Every step that is longer explodes.
        within: Within::Percent(0.5),
        mistakes: vec![("samples", 0.5 * swing), ("radian", radian)],
    }
}

/// The factor by which four times as many steps raise the root mean square of u in the chaotic sea.
fn four_times() -> Truth {
    let factor = typical(1200) / typical(300);
    Truth::nearest(factor, &[("all", 4.0), ("squares", 2.0), ("none", 1.0)])
}

/// The root mean square of ω (rad/s) after so many steps of symplectic Euler, far beyond the last
/// fence, from starts beside the top.
fn typical(steps: u64) -> f64 {
    const STARTS: u32 = 400;
    let grid = Grid::new(standard_map::step(5.0), steps).expect("a positive step");
    let squares = (1..=STARTS).map(|j| {
        let start = Phase::at_rest(PI - 1e-3 * f64::from(j));
        let end = integrate(&Pendulum::PAPER, &SymplecticEuler, start, &grid);
        end.omega * end.omega
    });
    libm::sqrt(squares.sum::<f64>() / f64::from(STARTS))
}

/// How much later (s) the pendulum passes the bottom if it is released ten times nearer to the top.
fn ten_times_nearer() -> Truth {
    let pendulum = Pendulum::PAPER;
    let bottom =
        |from_the_top: f64| 0.25 * period(&pendulum, PI - from_the_top).expect("a finite angle");
    let right = bottom(1e-9) - bottom(1e-8);
    let tenfold = 9.0 * bottom(1e-8);
    let e_fold = 1.0 / pendulum.small_angle_frequency();
    Truth::Number {
        right,
        // In the head it is 2.3 over 3, which is off by 4.3 %.
        within: Within::Percent(5.0),
        mistakes: vec![("tenfold", tenfold), ("e-fold", e_fold)],
    }
}
