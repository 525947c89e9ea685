//! Equations as formulas.

use core::fmt;

use super::numbers::short;
use crate::judge::equation::Equation;
use crate::judge::equation::form::{Beside, SHAPES, Scaling};

/// g/L to this power.
pub fn power_of_g(power: f64) -> String {
    match power {
        0.5 => "√(g/L)".to_string(),
        1.0 => "(g/L)".to_string(),
        1.5 => "(g/L) √(g/L)".to_string(),
        2.0 => "(g/L)²".to_string(),
        -1.0 => "L/g".to_string(),
        other => format!("g/L to the power {other}"),
    }
}

/// The factor of a term beside the force of the angle, with its unit: 0.1/s, 0.1 √(g/L).
pub fn beside(&Beside { term, value, known_to, power }: &Beside) -> String {
    let value = short(value, known_to);
    match (power, term) {
        (0.0, 0) => format!("{value}/s"),
        (0.0, 1) => value,
        (0.0, _) => format!("{value} 1/s²"),
        (power, _) => format!("{value} {}", power_of_g(power)),
    }
}

impl Equation {
    /// The factor of the function of the angle, with a blank after it: 1.5 (g/L).
    fn gravity(&self) -> String {
        let Self { factor, known_to, .. } = *self;
        let size = factor.abs();
        match self.gravity {
            Scaling::Power(power) => {
                let (factor, known_to) = self.factor_of_g();
                let factor = factor.abs();
                match power {
                    -1.0 => format!("{}/s² ", short(factor, known_to)),
                    _ if (factor - 1.0).abs() <= known_to => power_of_g(power + 1.0) + " ",
                    _ => format!("{} {} ", short(factor, known_to), power_of_g(power + 1.0)),
                }
            }
            Scaling::Right if (size - 1.0).abs() <= known_to => "(g/L) ".to_string(),
            Scaling::Right => format!("{} (g/L) ", short(size, known_to)),
        }
    }
}

/// θ̈ = −(g/L) sin θ − 0.1 θ̇; as two equations where the angle's rate is not ω.
impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { drift, factor, shape, known_to, .. } = *self;
        let is_system = (drift - 1.0).abs() > known_to;
        let minus = if factor < 0.0 { "" } else { "−" };
        let mut right = match factor.abs() <= known_to {
            true => String::new(),
            false => format!("{minus}{}{}", self.gravity(), SHAPES[shape].name),
        };
        for it in self.besides() {
            let words = beside(&it);
            let brakes = it.term != 2;
            let is_negative = words.starts_with('−');
            let words = words.trim_start_matches('−').trim_end_matches("/s");
            let words = words.trim_end_matches(" 1/s²");
            let sign = if brakes == is_negative { " + " } else { " − " };
            let what = match is_system {
                false => [" θ̇", " θ̇ |θ̇|", ""],
                true => [" ω", " ω |ω|", ""],
            }[it.term];
            right = format!("{right}{sign}{words}{what}");
        }
        if right.is_empty() {
            right.push('0');
        }
        match is_system {
            false => write!(f, "θ̈ = {right}"),
            true => write!(f, "θ̇ = {} ω, ω̇ = {right}", short(drift, known_to)),
        }
    }
}
