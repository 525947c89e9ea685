//! Questions of "Higher order".

use pendula::exact::period;
use pendula::methods::BlanesMoan6;
use pendula::metrics::EnergyDrift;
use pendula::{Grid, Motion, Pendulum, Phase, Separable, integrate_with, method_named};

use super::{Compute, Truth};
use crate::experiments::work::error;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("higher-order-middle", middle),
    ("higher-order-work", work),
    ("higher-order-resonant", resonant),
];

const PENDULUM: Pendulum = Pendulum::PAPER;

/// The error of the angle (rad) after three steps of Störmer–Verlet, of lengths wh, (1 − 2w)h and
/// wh with h = 0.01 s: to leading order the sum of the cubes of the lengths, times a constant.
fn off_after_three(w: f64) -> f64 {
    let (start, h) = (Phase { theta: 1.0, omega: 1.0 }, 0.01);
    let end = [w * h, (1.0 - 2.0 * w) * h, w * h].into_iter().fold(start, |z, length| {
        let half = PENDULUM.kick(z, PENDULUM.force(0.0, z), 0.5 * length);
        let there = PENDULUM.drift(half, length);
        PENDULUM.kick(there, PENDULUM.force(0.0, there), 0.5 * length)
    });
    end.theta - Motion::new(&PENDULUM, start).expect("a finite start").at(h).theta
}

/// The w, to a hundredth, at which the leading error vanishes.
fn vanishing() -> Option<f64> {
    let [mut last, mut found] = [off_after_three(0.0), f64::NAN];
    for w in (1..=200).map(|i| 0.01 * f64::from(i)) {
        let off = off_after_three(w);
        if last * off <= 0.0 {
            found = w - 0.005;
        }
        last = off;
    }
    (!found.is_nan()).then_some(found)
}

/// The middle one of three steps that have a higher order together.
fn middle() -> Truth {
    let found = vanishing();
    // The middle one in units of the outer ones.
    let is = |fits: fn(f64) -> bool| found.is_some_and(|w| fits(1.0 / w - 2.0));
    Truth::Which(vec![
        ("equal", is(|length| (0.95..1.05).contains(&length))),
        ("shorter", is(|length| (0.0..0.95).contains(&length))),
        ("back", is(|length| length < 0.0)),
        ("never", found.is_none()),
    ])
}

/// The methods by their errors, for the same number of evaluations.
fn work() -> Truth {
    let off = |name| error(method_named(name).expect("a method of the library"), 1.0, 1000);
    Truth::ascending(vec![
        ("suzuki", off("suzuki-4")),
        ("rk4", off("rk4")),
        ("jump", off("forest-ruth")),
        ("yoshida", off("yoshida-8")),
    ])
}

/// Whether the energy error of a thousand swings from 1 rad is more than twice that of twenty, with
/// so many steps a swing of Blanes and Moan's method of order 6. Its swings take as long as the
/// exact ones, to a millionth.
fn grows(steps_a_swing: u64) -> bool {
    let (released, swing) = (Phase::at_rest(1.0), period(&PENDULUM, 1.0).expect("it swings"));
    let largest = |swings: u64| {
        let grid = Grid::new(swing / steps_a_swing as f64, swings * steps_a_swing);
        let mut drift = EnergyDrift::new(&PENDULUM);
        integrate_with(&PENDULUM, &BlanesMoan6, released, &grid.expect("a grid"), &mut drift);
        drift.largest()
    };
    largest(1000) > 2.0 * largest(20)
}

/// The numbers of steps a swing that let the energy error grow.
fn resonant() -> Truth {
    let found = [6, 7, 8, 9].map(grows);
    Truth::Which(vec![
        ("none", found == [false; 4]),
        ("odd", found == [false, true, false, true]),
        ("even", found == [true, false, true, false]),
        ("all", found == [true; 4]),
    ])
}
