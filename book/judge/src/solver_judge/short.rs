//! The order, from runs of half a swing.
//!
//! An error of the energy is one of the frequency, which grows with the time in the phase: in long
//! runs it covers the error that has the power of the order. A method of even order p hardly loses
//! energy by its leading term, whose sign turns with the motion, but by the next, of power p + 1;
//! so the error of a long run falls with a power between p and p + 1. In half a swing neither has
//! had time to grow. The mean square of six starts has no error that vanishes by chance.

use super::asked::{Asked, Power, power};
use super::ladder::{LAST, Ladder};
use crate::judge::verdict::{Measured, Trouble};

/// θ and ω/ω₀ at the starts: swings of 0.6 to 2 rad on their way to either side, and rotations.
const STARTS: [(f64, f64); 6] = [
    (0.0, 1.326),
    (-0.31, -0.54),
    (-2.941, 2.712),
    (0.475, -0.729),
    (0.077, 1.671),
    (-1.354, 2.479),
];
/// How long they are, ω₀t: a small swing takes 2π.
const LONG: f64 = 4.0;

/// The power of the number of evaluations with which the error falls; nothing of a solver that does
/// not answer, or does not count.
pub fn order(asked: Asked<'_>, ladder: &Ladder) -> Measured<Option<Power>> {
    if !ladder.counts() {
        return Ok(None);
    }
    let scenes = asked.scenes;
    let long = LONG / scenes.frequency();
    let mut points = Vec::new();
    for rung in ladder.quick() {
        let (mut squares, mut evaluations) = (0.0, 0);
        for (theta, omega) in STARTS {
            let request = scenes.run(scenes.state(theta, omega), rung.tolerance).to(&[long]);
            let reply = match asked.reply(&request) {
                Ok(reply) => reply,
                Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
                Err(_) => return Ok(None),
            };
            let Some(count) = reply.evaluations else { return Ok(None) };
            let error = super::asked::errors(&request, &reply.states)[0];
            squares += error * error;
            evaluations += count;
        }
        let error = libm::sqrt(squares / STARTS.len() as f64);
        let rounding = scenes.rounding_in(evaluations / STARTS.len() as u64, long);
        if error > 3.0 * rounding && error < 0.1 {
            points.push((libm::log(evaluations as f64), -libm::log(error)));
        }
    }
    let points = above_floor(&points);
    Ok(power(&points[points.len().saturating_sub(LAST)..]))
}

/// Without the points whose error is the floor to which it falls, as that of states with few
/// digits: if the last four, which are a decade and a half of tolerances, do not fall by a factor
/// of 6, as those of an order of 2 do and more.
fn above_floor(points: &[(f64, f64)]) -> &[(f64, f64)] {
    let falls = |four: &[(f64, f64)]| four[3].1 - four[0].1 > libm::log(6.0);
    if points.windows(4).last().is_none_or(falls) {
        return points;
    }
    let least = points.iter().map(|point| point.1).fold(f64::NEG_INFINITY, f64::max);
    let end = points.iter().position(|point| point.1 > least - libm::log(30.0));
    &points[..end.unwrap_or(points.len())]
}
