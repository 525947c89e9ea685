//! What a step that is ever shorter leaves of a state, where that is not the state itself.

use core::f64::consts::PI;

use super::departure::{Departure, Of, short};
use super::field::{Field, STARTS};
use super::output::Undo;
use crate::integrator::Request;
use crate::judge::probe::{G_OVER_L, Probe, frequency, step};
use crate::judge::series::{least_squares, residual};
use crate::judge::verdict::Measured;
use pendula::systems::Phase;

const DEGREES: f64 = 180.0 / PI;

/// What is found: what is said, and what undoes it, if anything does.
pub type Found = (Departure, Vec<Undo>);

/// The state that a step of no length leaves, as an affine map of θ (rad) and ω (rad/s): θ and ω
/// by the factors of θ, of ω, and what is added. `None` if it is no such map.
struct Affine {
    factors: [[f64; 3]; 2],
    known_to: f64,
}

fn affine(field: &Field) -> Option<Affine> {
    let known_to = 10.0 * field.known_to[0] + 1e-12;
    let frequency = frequency();
    let unit = [1.0, frequency];
    let columns = [
        STARTS.map(|[theta, _]| theta).to_vec(),
        STARTS.map(|[_, q]| q * frequency).to_vec(),
        vec![1.0; STARTS.len()],
    ];
    let mut factors = [[0.0; 3]; 2];
    for part in 0..2 {
        let ends: Vec<f64> = field
            .jump
            .iter()
            .zip(STARTS)
            .map(|(jump, start)| (start[part] + jump[part]) * unit[part])
            .collect();
        let fitted = least_squares(&columns, &ends);
        let size = fitted[..2].iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        if residual(&columns, &fitted, &ends) > known_to * unit[part] + 1e-9 * size {
            return None;
        }
        factors[part] = [fitted[0], fitted[1], fitted[2]];
    }
    Some(Affine { factors, known_to: known_to * frequency })
}

/// What the states that steps of no length leave say.
pub fn told(probe: &Probe<'_>, field: &Field) -> Measured<Found> {
    let Some(Affine { factors, known_to }) = affine(field) else {
        return Ok((without_step(field).unwrap_or_else(|| other(field)), Vec::new()));
    };
    let near = |wanted: [[f64; 3]; 2]| {
        let pairs = factors.as_flattened().iter().zip(wanted.as_flattened().to_vec());
        pairs.clone().all(|(a, b)| (a - b).abs() <= known_to + 1e-6 * b.abs())
    };
    let scaled = |a: f64, b: f64| near([[a, 0.0, 0.0], [0.0, b, 0.0]]);
    let output = |departure, undo: &[Undo]| Ok((departure, undo.to_vec()));
    if scaled(DEGREES, DEGREES) {
        return output(Departure::DegreesOut(Of::Both), &[Undo::Out([DEGREES, DEGREES])]);
    }
    if scaled(DEGREES, 1.0) {
        return output(Departure::DegreesOut(Of::Angle), &[Undo::Out([DEGREES, 1.0])]);
    }
    if scaled(1.0, DEGREES) {
        return output(Departure::DegreesOut(Of::Velocity), &[Undo::Out([1.0, DEGREES])]);
    }
    if scaled(1.0 / DEGREES, 1.0 / DEGREES) {
        let undo = Undo::In([1.0 / DEGREES, 1.0 / DEGREES]);
        return output(Departure::DegreesIn(Of::Both), &[undo]);
    }
    if scaled(1.0 / DEGREES, 1.0) {
        return output(Departure::DegreesIn(Of::Angle), &[Undo::In([1.0 / DEGREES, 1.0])]);
    }
    if near([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]) {
        let undo = [Undo::SwappedOut, Undo::SwappedIn];
        return output(Departure::Swapped { taken_too: false }, &undo);
    }
    for raised in [PI, -PI] {
        if near([[1.0, 0.0, raised], [0.0, 1.0, 0.0]]) {
            if keeps_rising(probe)? {
                return output(Departure::TurnedEachStep, &[]);
            }
            return output(Departure::FromTheTop, &[Undo::Raised(raised)]);
        }
    }
    if near([[1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]) {
        return output(Departure::WithoutStep(Of::Angle), &[]);
    }
    if scaled(1.0, 0.0) && !begins_at_rest(probe)? {
        return output(Departure::VelocityVanishes, &[]);
    }
    if scaled(1.0, 0.0) {
        return output(Departure::StartIgnored(Of::Velocity), &[]);
    }
    if scaled(0.0, 1.0) {
        return output(Departure::StartIgnored(Of::Angle), &[]);
    }
    let [angle, share] = [factors[0][0], factors[1][1]];
    if scaled(1.0, share) && share > 0.0 && keeps_losing(probe, share)? {
        let left = short(share, known_to);
        return output(Departure::DragEachStep { left, known_to }, &[]);
    }
    // Off, but by less than a factor can be told to: where it leads says more.
    if scaled(1.0, 1.0) {
        return output(other(field), &[]);
    }
    if scaled(angle, share) && angle != 0.0 && share != 0.0 {
        // A factor of a few digits is meant to have no more.
        let times = [angle, share].map(|x| {
            let few = short(x, 1e-9);
            if (few - x).abs() <= known_to && few == short(x, 1e-7) { few } else { x }
        });
        let departure = Departure::Scaled { times, taken: false, known_to };
        return output(departure, &[Undo::Out(times), Undo::In(times)]);
    }
    output(other(field), &[])
}

/// Whether each step adds to the angle what the first one does, and not only what is returned.
fn keeps_rising(probe: &Probe<'_>) -> Measured<bool> {
    let states = probe.states(Request::run(Phase { theta: 0.1, omega: 0.0 }, step(1e-5), 2))?;
    Ok((states[1].theta - states[0].theta).abs() > 1.0)
}

/// Whether the velocity of the start does nothing in a step that is not short.
fn begins_at_rest(probe: &Probe<'_>) -> Measured<bool> {
    let end = |omega| probe.end(Request::run(Phase { theta: 0.4, omega }, step(0.3), 1));
    Ok((end(2.0)?.theta - end(-2.0)?.theta).abs() <= 0.01)
}

/// Whether each step leaves this share of the velocity, and not only what is returned.
fn keeps_losing(probe: &Probe<'_>, share: f64) -> Measured<bool> {
    let start = Phase { theta: 0.1, omega: 1.0 };
    let end = probe.end(Request::run(start, step(1e-5), 4))?;
    Ok((end.omega - libm::pow(share, 4.0)).abs() < 0.1 * (end.omega - share).abs())
}

/// A kick that is not multiplied by the step.
fn without_step(field: &Field) -> Option<Departure> {
    let known_to = 10.0 * field.known_to[0] + 1e-12;
    let frequency = frequency();
    let sines = [STARTS.map(|[theta, _]| -libm::sin(theta)).to_vec()];
    let kicks: Vec<f64> = field.jump.iter().map(|jump| jump[1]).collect();
    let factor = least_squares(&sines, &kicks);
    let still = field.jump.iter().all(|jump| jump[0].abs() <= known_to);
    let right = (factor[0] * frequency / G_OVER_L - 1.0).abs() <= 1e-3;
    let told = still && right && residual(&sines, &factor, &kicks) <= known_to;
    told.then_some(Departure::WithoutStep(Of::Velocity))
}

/// A state that a step of no length moves, described by where it goes.
fn other(field: &Field) -> Departure {
    let frequency = frequency();
    let far = |k: &usize| {
        let [theta, q] = field.jump[*k];
        libm::fmaximum(theta.abs(), q.abs())
    };
    let k = (0..STARTS.len()).max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0);
    let [theta, q] = STARTS[k];
    let [moved, kicked] = field.jump[k];
    let known_to = field.known_to[0].max(5e-4).min(0.05 * far(&k));
    Departure::Jump {
        from: [theta, q * frequency],
        to: [theta + moved, (q + kicked) * frequency],
        known_to,
    }
}
