//! The form of an equation that was found: which function of the angle is the force, times what,
//! and what acts besides.

use core::f64::consts::PI;

use super::departure::short;
use crate::judge::probe::G_OVER_L;

/// A function of the angle that people write for its sine.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// In a formula.
    pub name: &'static str,
    /// What it is in place of the sine, for a sentence.
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
    shape("sin(πθ/180)", "the sine in the force takes θ for degrees", |t| {
        libm::sin(t * PI / 180.0)
    }),
    shape("cos(πθ/180)", "the cosine in the force takes θ for degrees", |t| {
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
/// The place of sin(πθ/180) among them.
pub const DEGREES: usize = 8;

/// Terms of a force beside that of the angle, in units of g/L and with q = ω/√(g/L).
pub const BESIDE: [fn(f64, f64) -> f64; 3] = [|_, q| -q, |_, q| -q * q.abs(), |_, _| 1.0];
/// Which of them a force has: none, one, or two, the simplest first.
pub const TERMS: [&[usize]; 6] = [&[], &[0], &[1], &[2], &[0, 2], &[0, 1]];

/// How a factor scales with g/L, beside the power that is right for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scaling {
    /// As it should.
    Right,
    /// With g/L to this power more than it should.
    Power(f64),
}

/// An equation that was found: θ̇ = a ω, ω̇ = −b (g/L) f(θ) and, in units of the small swing, terms
/// that brake or push.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// a.
    pub(crate) drift: f64,
    /// The place of f in [`SHAPES`].
    pub(crate) shape: usize,
    /// b, at g/L = [`G_OVER_L`].
    pub(crate) factor: f64,
    /// How b scales with g/L.
    pub(crate) gravity: Scaling,
    /// Which of [`BESIDE`] it has.
    pub(crate) terms: &'static [usize],
    /// The factors of linear and quadratic damping and of a torque.
    pub(crate) beside: [f64; 3],
    /// How each of `terms` scales with g/L.
    pub(crate) scalings: Vec<Scaling>,
    /// What the numbers are known to.
    pub(crate) known_to: f64,
}

/// A term beside the force of the angle, with the unit in which it does not depend on g/L.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beside {
    /// Which of [`BESIDE`].
    pub term: usize,
    /// Its factor, in units of g/L to `power`.
    pub value: f64,
    /// What that is known to.
    pub known_to: f64,
    /// The power of g/L with which it scales.
    pub power: f64,
}

impl Equation {
    /// b, as short as its uncertainty allows.
    pub(crate) fn times(&self) -> f64 {
        short(self.factor, self.known_to)
    }

    /// a, as short as its uncertainty allows.
    pub(crate) fn drifts(&self) -> f64 {
        short(self.drift, self.known_to)
    }

    /// The power of g/L with which b scales beside the right one.
    pub(crate) const fn power(&self) -> f64 {
        match self.gravity {
            Scaling::Power(power) => power,
            Scaling::Right => 0.0,
        }
    }

    /// b over its power of g/L, and what it is known to.
    pub(crate) fn factor_of_g(&self) -> (f64, f64) {
        let unit = libm::pow(G_OVER_L, -self.power());
        (self.factor * unit, self.known_to * unit.max(1.0))
    }

    /// The terms beside the force of the angle.
    pub(crate) fn besides(&self) -> impl Iterator<Item = Beside> {
        self.terms.iter().zip(&self.scalings).map(|(&term, scaling)| {
            // What is in units of √(g/L), of nothing and of g/L scales with that if it is right.
            let own = [0.5, 0.0, 1.0][term];
            let power = match scaling {
                Scaling::Power(power) => own + power,
                Scaling::Right => own,
            };
            let unit = libm::pow(G_OVER_L, own - power);
            let known_to = self.known_to * unit;
            Beside { term, value: short(self.beside[term] * unit, known_to), known_to, power }
        })
    }

    /// The damping (1/s) of an equation that has no other term.
    pub(crate) fn damping(&self) -> Option<f64> {
        let mut besides = self.besides();
        match (besides.next(), besides.next()) {
            (Some(Beside { term: 0, value, power: 0.0, .. }), None) => Some(value),
            _ => None,
        }
    }
}
