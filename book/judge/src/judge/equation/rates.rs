//! Which equation has these rates: the force as a function of angle and velocity.

use core::f64::consts::PI;

use super::departure::{Departure, Of};
use super::field::{FAR, Field, STARTS};
use super::form::{BESIDE, DEGREES, Equation, SHAPES, Scaling, TERMS};
use super::solved::Solved;
use crate::judge::probe::G_OVER_L;
use crate::judge::series::{least_squares, residual};

/// A force: which function of the angle, times what, and the terms beside it, in units of g/L.
#[derive(Clone, Debug)]
struct Force {
    shape: usize,
    terms: &'static [usize],
    factor: f64,
    /// Linear and quadratic damping, and a torque.
    beside: [f64; 3],
}

fn columns(shape: usize, terms: &[usize]) -> Vec<Vec<f64>> {
    let column = |value: &dyn Fn(f64, f64) -> f64| STARTS.map(|[t, q]| value(t, q)).to_vec();
    let first = column(&|t, _| -(SHAPES[shape].value)(t));
    let others = terms.iter().map(|term| column(&BESIDE[*term]));
    [first].into_iter().chain(others).collect()
}

impl Force {
    fn fitted(shape: usize, terms: &'static [usize], forces: &[f64]) -> (Self, f64) {
        let columns = columns(shape, terms);
        let factors = least_squares(&columns, forces);
        let left = residual(&columns, &factors, forces);
        let mut beside = [0.0; 3];
        for (term, factor) in terms.iter().zip(&factors[1..]) {
            beside[*term] = *factor;
        }
        (Self { shape, terms, factor: factors[0], beside }, left)
    }

    /// Whether it has the values of `far`, from [`FAR`], where its factor, known to `known_to`,
    /// matters so many times more.
    fn reaches(&self, far: Option<&Field>, known_to: f64) -> bool {
        let Some(far) = far else { return true };
        let there = far.rate.iter().zip(FAR).map(|(rate, [theta, _])| {
            let own = self.beside[2] - self.factor * (SHAPES[self.shape].value)(theta);
            let room = 10.0 * far.known_to[1] + 1e2 * known_to + 1e-3 * own.abs();
            (rate[1] - own).abs() <= room
        });
        there.into_iter().all(|near| near)
    }

    /// The simplest that has these values at the starts, to `known_to`, and those of `far`; none if
    /// there is none, or if two with other functions of the angle have.
    fn of(forces: &[f64], far: Option<&Field>, known_to: f64) -> Option<Self> {
        for terms in TERMS {
            let all = (0..SHAPES.len()).map(|shape| Self::fitted(shape, terms, forces));
            let fit: Vec<Self> =
                all.filter(|(_, left)| *left <= known_to).map(|(force, _)| force).collect();
            // A function that grows without end, or has poles, is held to what is near.
            let fit: Vec<Self> = match fit.len() {
                ..=1 if fit.iter().all(|force| ![1, DEGREES].contains(&force.shape)) => fit,
                _ => fit.into_iter().filter(|force| force.reaches(far, known_to)).collect(),
            };
            match &fit[..] {
                [] => {}
                [one] => return Some(one.clone()),
                // What can be the sine is taken for it; else what needs no factor, if that is one.
                [first, ..] if first.shape == 0 => return Some(first.clone()),
                _ => {
                    let plain = |force: &&Self| (force.factor.abs() - 1.0).abs() <= known_to;
                    let plain: Vec<&Self> = fit.iter().filter(plain).collect();
                    return if let [one] = plain[..] { Some(one.clone()) } else { None };
                }
            }
        }
        None
    }
}

/// How a factor scales with g/L, by its values at g/L, 4 g/L and g/L over 4, each in units of the
/// power of g/L that is right for it; `None` if with no power.
fn scaling([one, four, quarter]: [f64; 3], known_to: f64) -> Option<Scaling> {
    let near = |power: f64| {
        let off = [four / libm::pow(4.0, power) - one, quarter * libm::pow(4.0, power) - one];
        off.iter().all(|off| off.abs() <= 1e-3 * one.abs() + known_to)
    };
    match [0.0, -1.0, -0.5, 0.5, 1.0, -2.0].into_iter().find(|power| near(*power))? {
        0.0 => Some(Scaling::Right),
        power => Some(Scaling::Power(power)),
    }
}

/// What the fields at g/L = [`G_OVER_L`], four times and a quarter of it say, which are not all the
/// pendulum's, and the equation that is solved, as far as it is known.
/// `far` is the field of the first from [`FAR`], if there is one.
pub fn told(fields: &[Field; 3], far: Option<&Field>) -> (Departure, Option<Solved>) {
    let [field, ..] = fields;
    match equation(fields, far) {
        Some(equation) => {
            let solved = Solved::of(&equation);
            (departure(equation), Some(solved))
        }
        // What vanishes with the step, and does not vanish at all, is described by its values.
        None => (values(field), None),
    }
}

/// The equation with these rates, if its form is known and is the same at every g/L.
fn equation(fields: &[Field; 3], far: Option<&Field>) -> Option<Equation> {
    let [field, ..] = fields;
    let known_to = 10.0 * field.known_to[1] + 1e-11;
    let drifts = velocities(field);
    let velocity = [STARTS.map(|[_, q]| q).to_vec()];
    let drift = least_squares(&velocity, &drifts);
    let left = residual(&velocity, &drift, &drifts);
    let drift = drift[0];
    let same = |field: &Field| {
        let drifts = velocities(field);
        let there = least_squares(&velocity, &drifts)[0];
        (there - drift).abs() <= 10.0 * field.known_to[1] + known_to + 1e-3 * (drift - 1.0).abs()
    };
    if left > known_to || !fields[1..].iter().all(same) {
        return None;
    }
    let force = Force::of(&forces(field), far, known_to)?;
    // The same model elsewhere.
    let elsewhere: Vec<(Force, f64)> = fields[1..]
        .iter()
        .map(|field| Force::fitted(force.shape, force.terms, &forces(field)))
        .collect();
    let coarse =
        fields.iter().fold(known_to, |most, field| libm::fmaximum(most, 10.0 * field.known_to[1]));
    if elsewhere.iter().any(|(_, left)| *left > coarse) {
        return None;
    }
    if force.factor.abs() <= known_to || drift.abs() <= known_to {
        return None;
    }
    let at =
        |pick: &dyn Fn(&Force) -> f64| [pick(&force), pick(&elsewhere[0].0), pick(&elsewhere[1].0)];
    let gravity = scaling(at(&|force| force.factor), coarse)?;
    let scalings = force.terms.iter().map(|term| scaling(at(&|f| f.beside[*term]), coarse));
    let scalings = scalings.collect::<Option<_>>()?;
    let Force { shape, terms, factor, beside } = force;
    Some(Equation { drift, shape, factor, gravity, terms, beside, scalings, known_to })
}

fn velocities(field: &Field) -> Vec<f64> {
    field.rate.iter().map(|rate| rate[0]).collect()
}

fn forces(field: &Field) -> Vec<f64> {
    field.rate.iter().map(|rate| rate[1]).collect()
}

/// In what this equation departs from the pendulum's.
fn departure(equation: Equation) -> Departure {
    let Equation { drift, shape, factor, known_to, .. } = equation;
    let one = |value: f64| (value - 1.0).abs() <= known_to;
    match equation.terms {
        [] => {}
        [2] => return Departure::Torque(equation),
        [1] => return Departure::QuadraticDamping(equation),
        _ => return Departure::Damping(equation),
    }
    if shape != 0 {
        return other_force(equation);
    }
    match equation.gravity {
        Scaling::Power(-1.0) => Departure::FixedGravity(equation),
        Scaling::Power(_) => Departure::GravityPower(equation),
        Scaling::Right if one(-factor) && one(drift) => Departure::Sign(equation),
        Scaling::Right if (drift - factor).abs() <= known_to + 1e-3 * (drift - 1.0).abs() => {
            Departure::Step { times: equation.drifts(), equation: Some(equation) }
        }
        Scaling::Right if one(drift) => Departure::Gravity(equation),
        Scaling::Right if one(factor) => Departure::Drift(equation),
        Scaling::Right => Departure::Rates(equation),
    }
}

fn other_force(equation: Equation) -> Departure {
    let Equation { shape, known_to, gravity, .. } = equation;
    let times = equation.times();
    if shape == DEGREES && gravity == Scaling::Right {
        // The right equation of an angle in degrees has 180/π times that force.
        if (times - 180.0 / PI).abs() <= 60.0 * known_to {
            return Departure::DegreesInAndOut(equation);
        }
        if (times - 1.0).abs() <= known_to {
            return Departure::SineOfDegrees(equation);
        }
    }
    Departure::Force(equation)
}

/// What is none of these: the rate or the force that is furthest from the right one, at 1 rad if it
/// is far there.
fn values(field: &Field) -> Departure {
    let frequency = libm::sqrt(G_OVER_L);
    let known_to = 10.0 * field.known_to[1] + 1e-11;
    let off = |(rate, [theta, q]): (&[f64; 2], [f64; 2])| {
        [rate[0] - q, rate[1] + libm::sin(theta)].map(f64::abs)
    };
    let all: Vec<[f64; 2]> = field.rate.iter().zip(STARTS).map(off).collect();
    let largest = |part: usize| all.iter().map(|off| off[part]).fold(0.0, libm::fmaximum);
    let part = usize::from(largest(1) > known_to);
    let far = |off: &[f64; 2]| off[part] > 0.1 * largest(part);
    let k = all.iter().position(far).unwrap_or(0);
    let [theta, q] = STARTS[k];
    let rate = field.rate[k][part];
    let at = [theta, q * frequency];
    if part == 1 {
        let (value, right) = (rate * G_OVER_L, -libm::sin(theta) * G_OVER_L);
        Departure::Rate { at, of: Of::Velocity, value, right, known_to: known_to * G_OVER_L }
    } else {
        let (value, right) = (rate * frequency, q * frequency);
        Departure::Rate { at, of: Of::Angle, value, right, known_to: known_to * frequency }
    }
}
