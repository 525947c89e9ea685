//! A step that goes another distance, or solves another equation, than is asked for.

use core::fmt;

use super::expansion::{self, Deviation};
use super::probe::{G_OVER_L, Probe};
use super::verdict::Measured;

/// A step that goes another distance, or solves another equation, than is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scaled {
    /// The step is this many times as long.
    Step(f64),
    /// g/L is this many times as large.
    Gravity(f64),
    /// g/L is this (1/s²), whatever is asked for.
    Fixed(f64),
}

impl Scaled {
    /// By the factors of h: those of ω in θ and of α in ω.
    pub fn of(probe: &Probe<'_>, found: &Deviation) -> Measured<Option<Self>> {
        let [drift, kick] = [found.excess[0], found.excess[1]];
        let small = |x: f64, beside: f64| x.abs() <= 1e-3 * beside.abs() + found.known_to;
        if small(drift - kick, drift) {
            return Ok(Some(Self::Step(1.0 + drift)));
        }
        if !small(drift, kick) {
            return Ok(None);
        }
        // Asked for twice as much, is it twice as much?
        let solved = G_OVER_L * (1.0 + kick);
        let twice = expansion::deviation_with(probe, 2.0 * G_OVER_L, expansion::STARTS)?;
        let other = twice.filter(|twice| twice.power == 1).map_or(0.0, |twice| twice.excess[1]);
        let other = 2.0 * G_OVER_L * (1.0 + other);
        let fixed = (other - solved).abs() <= 1e-3 * solved.abs();
        Ok(Some(if fixed { Self::Fixed(solved) } else { Self::Gravity(1.0 + kick) }))
    }
}

impl fmt::Display for Scaled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Step(times) if (times + 1.0).abs() < 1e-6 => f.write_str("run backwards"),
            Self::Step(times) => {
                write!(f, "its step is {} h{}", times_in_words(times), right_to(times))
            }
            Self::Gravity(times) => {
                let (times, right) = (times_in_words(times), right_to(times));
                write!(f, "its kicks add up to {times} times the g/L that is asked for{right}")
            }
            Self::Fixed(g_over_l) => {
                let text = format!("{g_over_l:.6}");
                let text = text.trim_end_matches('0').trim_end_matches('.');
                write!(f, "its g/L is {text} 1/s², whatever is asked for")
            }
        }
    }
}

/// A factor near 1 with the digits that it needs: 1.00001.
fn times_in_words(times: f64) -> String {
    let digits = libm::ceil(2.0 - libm::log10((times - 1.0).abs()));
    let digits = digits.clamp(2.0, 12.0) as usize;
    let text = format!("{times:.digits$}").replace('-', "−");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// To how many digits a factor is 1, where that looks like a coefficient with too few of them.
fn right_to(times: f64) -> String {
    let off = (times - 1.0).abs();
    if off >= 1e-2 {
        return String::new();
    }
    let digits = libm::round(-libm::log10(off));
    format!(", right to {digits} digits: a coefficient, or g or L, has too few")
}
