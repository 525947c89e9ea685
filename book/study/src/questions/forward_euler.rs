//! Questions of "Forward Euler".

use core::f64::consts::E;

use pendula::metrics::AngleError;
use pendula::{
    ForwardEuler, Grid, Hamiltonian, Motion, Pendulum, Phase, integrate, integrate_with,
};

use super::{Compute, Truth, Within};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("forward-euler-doubled", doubled),
    ("forward-euler-fastest", fastest),
    ("forward-euler-half-the-step", half_the_step),
];

const PENDULUM: Pendulum = Pendulum::PAPER;

/// The time (s) in which the energy of a small swing grows by this factor, in steps of 0.01 s.
fn time_to(factor: f64) -> f64 {
    let released = Phase::at_rest(1e-4);
    let wanted = factor * PENDULUM.energy(released);
    let mut reached = None;
    let mut watch = |_: u64, t: f64, z: Phase| {
        if PENDULUM.energy(z) >= wanted {
            reached.get_or_insert(t);
        }
    };
    let grid = Grid::with_duration(0.01, 30.0).expect("a grid");
    integrate_with(&PENDULUM, &ForwardEuler, released, &grid, &mut watch);
    reached.expect("it grows")
}

/// The time in which the energy doubles (s), and those that are taken for it.
fn doubled() -> Truth {
    let right = time_to(2.0);
    Truth::Number {
        right,
        // With 10 m/s² for g it is 2 % less, and with π² 0.6 %. Who rounds to 7 s is off by 1 %.
        within: Within::Percent(4.0),
        mistakes: vec![
            ("amplitude", time_to(4.0)),
            ("e", time_to(E)),
            ("frequency", right * PENDULUM.small_angle_frequency()),
        ],
    }
}

/// The energy (J) that a short step gains on average, along the exact motion from `start`.
fn gain(start: Phase) -> f64 {
    const POINTS: u32 = 2_000;
    let motion = Motion::new(&PENDULUM, start).expect("a finite start");
    let period = motion.period().expect("it comes back");
    let one_step = Grid::new(1e-3, 1).expect("a grid");
    let gained = |n: u32| {
        let z = motion.at(period * f64::from(n) / f64::from(POINTS));
        let end = integrate(&PENDULUM, &ForwardEuler, z, &one_step);
        PENDULUM.energy(end) - PENDULUM.energy(z)
    };
    (0..POINTS).map(gained).sum::<f64>() / f64::from(POINTS)
}

/// Motions in the order of what they gain.
fn fastest() -> Truth {
    Truth::ascending(vec![
        ("low", gain(Phase::at_rest(0.5))),
        ("wide", gain(Phase::at_rest(2.0))),
        ("top", gain(Phase::at_rest(3.1))),
        ("turns", gain(Phase { theta: 0.0, omega: 50.0 })),
    ])
}

/// The factor by which half the step lowers the largest error of the angle in one second.
fn half_the_step() -> Truth {
    let start = Phase::at_rest(1.0);
    let motion = Motion::new(&PENDULUM, start).expect("a swing");
    let error = |step: f64| {
        let mut error = AngleError::new(|t| motion.at(t).theta);
        let grid = Grid::with_duration(step, 1.0).expect("a grid");
        integrate_with(&PENDULUM, &ForwardEuler, start, &grid, &mut error);
        error.largest()
    };
    let factor = error(2e-3) / error(1e-3);
    Truth::nearest(factor, &[("none", 1.0), ("global", 2.0), ("local", 4.0)])
}
