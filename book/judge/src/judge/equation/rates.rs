//! Which equation has these rates: the force as a function of angle and velocity.

use core::f64::consts::PI;

use super::departure::{Departure, Kind, in_words, short};
use super::field::{FAR, Field, STARTS};
use super::solved::Solved;
use crate::judge::probe::G_OVER_L;
use crate::judge::series::{least_squares, residual};

/// A function of the angle that people write for its sine.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// In a formula.
    pub name: &'static str,
    /// What it is in place of the sine, in words.
    pub words: &'static str,
    pub value: fn(f64) -> f64,
}

const fn shape(name: &'static str, words: &'static str, value: fn(f64) -> f64) -> Shape {
    Shape { name, words, value }
}

/// The sine first.
pub const SHAPES: [Shape; 16] = [
    shape("sin θ", "the sine", libm::sin),
    shape("θ", "the angle stands in place of its sine", |t| t),
    shape("cos θ", "the cosine stands in place of the sine", libm::cos),
    shape("sin θ cos θ", "sin θ cos θ stands in place of sin θ", |t| {
        libm::sin(t) * libm::cos(t)
    }),
    shape("tan θ", "the tangent stands in place of the sine", libm::tan),
    shape("(θ − θ³/6)", "a series that ends with θ³ stands in place of the sine", |t| {
        t - t * t * t / 6.0
    }),
    shape(
        "(θ − θ³/6 + θ⁵/120)",
        "a series that ends with θ⁵ stands in place of the sine",
        |t| t - t * t * t / 6.0 + libm::pow(t, 5.0) / 120.0,
    ),
    shape(
        "(θ − θ³/6 + θ⁵/120 − θ⁷/5040)",
        "a series that ends with θ⁷ stands in place of the sine",
        |t| t - t * t * t / 6.0 + libm::pow(t, 5.0) / 120.0 - libm::pow(t, 7.0) / 5040.0,
    ),
    shape("sin(πθ/180)", "the force is the sine of θ taken in degrees", |t| {
        libm::sin(t * PI / 180.0)
    }),
    shape("cos(πθ/180)", "the force is the cosine of θ taken in degrees", |t| {
        libm::cos(t * PI / 180.0)
    }),
    shape("sin(180θ/π)", "the force is the sine of θ converted into degrees", |t| {
        libm::sin(t * 180.0 / PI)
    }),
    shape("sin² θ", "the square of the sine stands in its place", |t| {
        libm::sin(t) * libm::sin(t)
    }),
    shape("|sin θ|", "the size of the sine stands in its place", |t| libm::sin(t).abs()),
    shape(
        "(1 − cos θ)",
        "1 − cos θ, which is the energy's, stands in place of sin θ",
        |t| 1.0 - libm::cos(t),
    ),
    shape("sin(θ/2)", "the sine of half the angle stands in place of the sine", |t| {
        libm::sin(0.5 * t)
    }),
    shape("sinh θ", "the hyperbolic sine stands in place of the sine", libm::sinh),
];
const DEGREES: usize = 8;

/// Terms of a force beside that of the angle, in units of g/L and with q = ω/√(g/L).
const BESIDE: [fn(f64, f64) -> f64; 3] = [|_, q| -q, |_, q| -q * q.abs(), |_, _| 1.0];
/// Which of them a force has: none, one, or two, the simplest first.
const TERMS: [&[usize]; 6] = [&[], &[0], &[1], &[2], &[0, 2], &[0, 1]];

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

/// How a factor goes with g/L, by its values at g/L, 4 g/L and g/L over 4, each in units of the
/// power of g/L that is right for it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scaling {
    /// As it should.
    Right,
    /// With g/L to this power more than it should.
    Power(f64),
    /// Otherwise.
    Other,
}

fn scaling([one, four, quarter]: [f64; 3], known_to: f64) -> Scaling {
    let near = |power: f64| {
        let off = [four / libm::pow(4.0, power) - one, quarter * libm::pow(4.0, power) - one];
        off.iter().all(|off| off.abs() <= 1e-3 * one.abs() + known_to)
    };
    match [0.0, -1.0, -0.5, 0.5, 1.0, -2.0].into_iter().find(|power| near(*power)) {
        Some(0.0) => Scaling::Right,
        Some(power) => Scaling::Power(power),
        None => Scaling::Other,
    }
}

/// What the fields at g/L = [`G_OVER_L`], four times and a quarter of it say, which are not all the
/// pendulum's, and the equation that is solved, as far as it is known.
/// `far` is the field of the first from [`FAR`], if there is one.
pub fn told(fields: &[Field; 3], far: Option<&Field>) -> (Departure, Option<Solved>) {
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
        return (values(field), None);
    }
    let forces = forces(field);
    let Some(force) = Force::of(&forces, far, known_to) else { return (values(field), None) };
    // The same model elsewhere.
    let elsewhere: Vec<(Force, f64)> = fields[1..]
        .iter()
        .map(|field| Force::fitted(force.shape, force.terms, &self::forces(field)))
        .collect();
    let coarse =
        fields.iter().fold(known_to, |most, field| libm::fmaximum(most, 10.0 * field.known_to[1]));
    if elsewhere.iter().any(|(_, left)| *left > coarse) {
        return (values(field), None);
    }
    let at =
        |pick: &dyn Fn(&Force) -> f64| [pick(&force), pick(&elsewhere[0].0), pick(&elsewhere[1].0)];
    // What vanishes with the step, and does not vanish at all, is described by its values.
    if force.factor.abs() <= known_to || drift.abs() <= known_to {
        return (values(field), None);
    }
    let Some(told) = Told::of(drift, force.clone(), at, coarse) else {
        return (values(field), None);
    };
    (told.departure(known_to), Some(told.solved(known_to)))
}

fn velocities(field: &Field) -> Vec<f64> {
    field.rate.iter().map(|rate| rate[0]).collect()
}

fn forces(field: &Field) -> Vec<f64> {
    field.rate.iter().map(|rate| rate[1]).collect()
}

/// An equation, and how its numbers go with g/L.
struct Told {
    drift: f64,
    force: Force,
    gravity: Scaling,
    /// Of each term beside the force of the angle.
    beside: Vec<Scaling>,
}

impl Told {
    fn of(
        drift: f64,
        force: Force,
        at: impl Fn(&dyn Fn(&Force) -> f64) -> [f64; 3],
        coarse: f64,
    ) -> Option<Self> {
        let gravity = scaling(at(&|force| force.factor), coarse);
        let beside = force.terms.iter().map(|term| scaling(at(&|f| f.beside[*term]), coarse));
        let beside: Vec<Scaling> = beside.collect();
        let known = |scaling: &Scaling| *scaling != Scaling::Other;
        (known(&gravity) && beside.iter().all(known)).then_some(Self {
            drift,
            force,
            gravity,
            beside,
        })
    }

    fn departure(&self, known_to: f64) -> Departure {
        let Self { drift, ref force, gravity, .. } = *self;
        let Force { shape, factor, terms, .. } = *force;
        let one = |value: f64| (value - 1.0).abs() <= known_to;
        let equation = self.equation(known_to);
        if !terms.is_empty() {
            return self.beside(known_to).solving(equation);
        }
        let departure = if shape != 0 {
            self.other_force(&equation, known_to)
        } else if let Scaling::Power(power) = gravity {
            self.other_power(power, known_to)
        } else if one(-factor) && one(drift) {
            let sentence = "The force has the wrong sign: θ = 0 is where it falls from";
            Departure::new(Kind::Sign, &[factor], sentence)
        } else if (drift - factor).abs() <= known_to + 1e-3 * (drift - 1.0).abs() {
            return of_step(short(drift, known_to)).solving(equation);
        } else if one(drift) {
            let times = short(factor, known_to);
            let rod = if (times - 1.5).abs() < 1e-6 { "; a uniform rod has 1.5 g/L" } else { "" };
            let words = in_words(times, known_to);
            let sentence = format!("Its g/L is {words} times the g/L that is asked for{rod}");
            Departure::new(Kind::Gravity, &[times], sentence)
        } else if one(factor) {
            let times = short(drift, known_to);
            let words = in_words(times, known_to);
            let sentence = format!("The angle goes with {words} times the velocity");
            Departure::new(Kind::Drift, &[times], sentence)
        } else {
            let [a, b] = [drift, factor].map(|x| in_words(x, known_to));
            let sentence = format!(
                "The angle goes with {a} times the velocity, and the velocity with {b} times the \
                 force"
            );
            Departure::new(Kind::Values, &[drift, factor], sentence)
        };
        departure.solving(equation)
    }

    fn other_force(&self, equation: &str, known_to: f64) -> Departure {
        let Force { shape, factor, .. } = self.force;
        let Shape { words, .. } = SHAPES[shape];
        let times = short(factor, known_to);
        if shape == DEGREES && self.gravity == Scaling::Right {
            // The right equation of an angle in degrees has 180/π times that force.
            if (times - 180.0 / PI).abs() <= 60.0 * known_to {
                let sentence = "It works in degrees, and is given radians";
                return Departure::new(Kind::DegreesInAndOut, &[], sentence);
            }
            if (times - 1.0).abs() <= known_to {
                let sentence = "The force is the sine of θ taken in degrees";
                return Departure::new(Kind::SineOfDegrees, &[], sentence);
            }
        }
        let sentence = format!("It solves {equation}: {words}");
        Departure::new(Kind::Force, &[times], sentence)
    }

    fn other_power(&self, power: f64, known_to: f64) -> Departure {
        // The factor of g/L to its power, in 1/s².
        let factor = self.force.factor * libm::pow(G_OVER_L, -power);
        let known_to = known_to * libm::pow(G_OVER_L, -power).max(1.0);
        if power == -1.0 {
            let g_over_l = short(factor, known_to);
            let words = in_words(g_over_l, known_to);
            let sentence = format!("Its g/L is {words} 1/s², whatever is asked for");
            return Departure::new(Kind::FixedGravity, &[g_over_l], sentence);
        }
        let what = power_of_g(power + 1.0);
        let factor = short(factor, known_to);
        let sentence = format!("The force goes with {what}, and not with g/L");
        Departure::new(Kind::GravityPower, &[power + 1.0, factor], sentence)
    }

    /// A damping or a torque.
    fn beside(&self, known_to: f64) -> Departure {
        let (values, words) = self.terms_in_words(known_to);
        let kind = match self.force.terms {
            [2] => Kind::Torque,
            [1] => Kind::QuadraticDamping,
            _ => Kind::Damping,
        };
        let what = match (kind, &words[..]) {
            (Kind::Torque, [torque]) => format!("a torque of {torque} acts on the pendulum"),
            (Kind::QuadraticDamping, [by]) => format!("ω is braked at {by} times its square"),
            (_, [by]) => {
                let driven = if values[0] < 0.0 { "driven" } else { "braked" };
                format!("ω is {driven} at {}", by.trim_start_matches('−'))
            }
            _ => "ω is braked".to_string(),
        };
        let sentence = match kind {
            Kind::Torque => format!("It solves another pendulum: {what}"),
            _ => format!("It solves a damped pendulum: {what}"),
        };
        Departure::new(kind, &values, sentence)
    }

    /// The numbers of the terms beside the force of the angle, and these in words, with the power
    /// of g/L with which they go: 0.1/s, 0.1 √(g/L).
    fn terms_in_words(&self, known_to: f64) -> (Vec<f64>, Vec<String>) {
        let terms = self.force.terms.iter().zip(&self.beside).map(|(&term, scaling)| {
            // What is in units of √(g/L), of nothing and of g/L goes with that if it is right.
            let own = [0.5, 0.0, 1.0][term];
            let power = match scaling {
                Scaling::Power(power) => own + power,
                _ => own,
            };
            let unit = libm::pow(G_OVER_L, own - power);
            let value = short(self.force.beside[term] * unit, known_to * unit);
            let words = in_words(value, known_to * unit);
            let unit = match (power, term) {
                (0.0, 0) => "/s".to_string(),
                (0.0, 1) => String::new(),
                (0.0, _) => " 1/s²".to_string(),
                (power, _) => format!(" {}", power_of_g(power)),
            };
            (value, format!("{words}{unit}"))
        });
        terms.unzip()
    }

    /// The equation, in words.
    fn equation(&self, known_to: f64) -> String {
        let Self { drift, ref force, gravity, .. } = *self;
        // Where the angle goes with another rate than ω, both are written.
        let system = (drift - 1.0).abs() > known_to;
        let factor = force.factor;
        let minus = if factor < 0.0 { "" } else { "−" };
        let size = factor.abs();
        let gravity = match gravity {
            Scaling::Power(power) => {
                let factor = size * libm::pow(G_OVER_L, -power);
                let known_to = known_to * libm::pow(G_OVER_L, -power).max(1.0);
                match power {
                    -1.0 => format!("{}/s² ", in_words(factor, known_to)),
                    _ if (factor - 1.0).abs() <= known_to => power_of_g(power + 1.0) + " ",
                    _ => format!("{} {} ", in_words(factor, known_to), power_of_g(power + 1.0)),
                }
            }
            _ if (size - 1.0).abs() <= known_to => "(g/L) ".to_string(),
            _ => format!("{} (g/L) ", in_words(size, known_to)),
        };
        let mut right = match size <= known_to {
            true => String::new(),
            false => format!("{minus}{gravity}{}", SHAPES[force.shape].name),
        };
        for (term, words) in force.terms.iter().zip(self.terms_in_words(known_to).1) {
            let against = *term != 2;
            let negative = words.starts_with('−');
            let words = words.trim_start_matches('−').trim_end_matches("/s");
            let sign = if against == negative { " + " } else { " − " };
            let words = words.trim_end_matches(" 1/s²");
            let what = match system {
                false => [" θ̇", " θ̇ |θ̇|", ""],
                true => [" ω", " ω |ω|", ""],
            }[*term];
            right = format!("{right}{sign}{words}{what}");
        }
        if right.is_empty() {
            right.push('0');
        }
        match system {
            false => format!("θ̈ = {right}"),
            true => format!("θ̇ = {} ω, ω̇ = {}", in_words(drift, known_to), right),
        }
    }

    /// The same as a system, on which methods can be tried.
    fn solved(&self, known_to: f64) -> Solved {
        let Self { drift, ref force, gravity, .. } = *self;
        let frequency = libm::sqrt(G_OVER_L);
        let exponent = match gravity {
            Scaling::Power(power) => power,
            _ => 0.0,
        };
        let factor = short(force.factor * libm::pow(G_OVER_L, -exponent), known_to);
        let [linear, quadratic, torque] = force.beside;
        let factor = match force.shape {
            DEGREES if (factor - 180.0 / PI).abs() <= 60.0 * known_to => 180.0 / PI,
            _ => factor,
        };
        Solved {
            drift: short(drift, known_to),
            force: SHAPES[force.shape].value,
            g_over_l: factor * libm::pow(G_OVER_L, exponent + 1.0),
            linear: short(linear * frequency, known_to * frequency),
            quadratic: short(quadratic, known_to),
            torque: short(torque * G_OVER_L, known_to * G_OVER_L),
            known_to,
        }
    }
}

/// A step of so many times the length.
pub fn of_step(times: f64) -> Departure {
    let sentence = match times {
        -1.0 => "Its step is −h: it runs backwards".to_string(),
        0.001 => "Its step is 0.001 h: milliseconds are taken for seconds".to_string(),
        1000.0 => "Its step is 1000 h: seconds are taken for milliseconds".to_string(),
        _ => format!("Its step is {} h", in_words(times, 1e-12)),
    };
    Departure::new(Kind::Step, &[times], sentence)
}

/// g/L to this power.
fn power_of_g(power: f64) -> String {
    match power {
        0.5 => "√(g/L)".to_string(),
        1.0 => "(g/L)".to_string(),
        1.5 => "(g/L) √(g/L)".to_string(),
        2.0 => "(g/L)²".to_string(),
        -1.0 => "L/g".to_string(),
        other => format!("g/L to the power {other}"),
    }
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
    let place = format!(
        "at θ = {} rad and ω = {}",
        in_words(theta, 1e-12),
        match q {
            0.0 => "0".to_string(),
            q => format!("{} rad/s", in_words(q * frequency, 5e-3)),
        }
    );
    let (value, right, sentence) = if part == 1 {
        let (value, right) = (rate * G_OVER_L, -libm::sin(theta) * G_OVER_L);
        let known_to = (known_to * G_OVER_L).max(5e-3 * right.abs().min(1.0));
        let known_to = known_to.min(0.05 * (value - right).abs());
        let [a, b] = [value, right].map(|x| in_words(x, known_to));
        (value, right, format!("{place} the force is {a}, not {b} 1/s²"))
    } else {
        let (value, right) = (rate * frequency, q * frequency);
        let known_to = (known_to * frequency).max(5e-3).min(0.05 * (value - right).abs());
        let [a, b] = [value, right].map(|x| in_words(x, known_to));
        (value, right, format!("{place} the angle's rate is {a}, not {b} rad/s"))
    };
    let sentence = format!("It solves another equation: {sentence}");
    Departure::new(Kind::Values, &[value, right], sentence)
}
