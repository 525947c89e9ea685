//! Numbers on the command line: one, a range of them, `0.1:3:30`, and the number of a part, `2/8`;
//! and angles: radians, multiples of π, degrees.
//!
//! Angles are `1.5`, `pi/3`, `-2pi/3`, `0.5pi`, `60deg`. π/3 is no number of f64, and neither is 60
//! degrees: what is meant is the f64 nearest to the real angle, and it is found in double-double,
//! since π as an f64 divided by three is not always that number.

use std::fmt;
use std::num::NonZeroU64;
use std::ops;
use std::str::FromStr;

use pendula::error::MAX_STEPS;
use pendula::internals::double_double::DoubleDouble;

/// What a number may be.
pub const NUMBER: &str = "it must be a number without a unit, as 0.01 or 1e-3";

/// A count that is refused.
const TOO_MANY: &str =
    "a COUNT of more than 2^53 is beyond what f64 can tell apart: it must be a number";

/// A number. Whether it may be infinite or negative is for the library to say.
pub fn number(text: &str) -> Result<f64, &'static str> {
    text.parse().or(Err(NUMBER))
}

/// A count, zero included.
pub fn count(text: &str) -> Result<u64, &'static str> {
    text.parse().or(Err("it must be a whole number, 0 or greater, below 2^64, in digits"))
}

/// A count, at least one.
pub fn positive_count(text: &str) -> Result<NonZeroU64, &'static str> {
    text.parse().or(Err("it must be a whole number, 1 or greater, below 2^64, in digits"))
}

/// One number, or COUNT of them FROM … TO, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sweep {
    /// A number.
    One(f64),
    /// FROM:TO:COUNT.
    Range(Range),
}

/// COUNT numbers FROM … TO.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The first.
    pub from: f64,
    /// The last.
    pub to: f64,
    /// How many, at least 2.
    pub count: u64,
}

impl Sweep {
    /// What `text` stands for, with `number` for each number in it; what they are is `allowed`.
    pub fn of(
        text: &str,
        allowed: &'static str,
        number: impl Fn(&str) -> Option<f64>,
    ) -> Result<Self, String> {
        let finite = |text| number(text).filter(|x| x.is_finite()).ok_or(allowed);
        let range = |from, to, count: &str| {
            let (from, to) = (finite(from)?, finite(to)?);
            let count = count.parse().ok().filter(|count| *count >= 2).ok_or(NUMBER)?;
            if count > MAX_STEPS {
                return Err(TOO_MANY);
            }
            Ok(Self::Range(Range { from, to, count }))
        };
        let sweep = match text.split(':').collect::<Vec<_>>()[..] {
            [one] => finite(one).map(Self::One),
            [from, to, count] => range(from, to, count),
            _ => Err(NUMBER),
        };
        sweep.map_err(|reason| {
            format!("{reason}, or a range FROM:TO:COUNT with a COUNT of 2 or more, in digits")
        })
    }
}

impl Range {
    /// The `i`-th of equally spaced numbers, counted from zero; the ends are exact.
    pub fn linear(self, i: u64) -> f64 {
        // Multiplication before division: the fourth of 0:1:11 is 0.3 and not the f64 beside it.
        self.inner(i, |i, last| match (self.to - self.from) * i / last {
            beyond if beyond.is_finite() => self.from + beyond,
            // The ends are too far apart for that.
            _ => self.from * (1.0 - i / last) + self.to * (i / last),
        })
    }

    /// The `i`-th of numbers in equal ratios, counted from zero; the ends are exact, and must be
    /// greater than zero.
    pub fn geometric(self, i: u64) -> f64 {
        // libm's power, not the platform's: the same numbers on every machine.
        self.inner(i, |i, last| self.from * libm::pow(self.to / self.from, i / last))
    }

    fn inner(self, i: u64, inner: impl Fn(f64, f64) -> f64) -> f64 {
        let last = self.count - 1;
        match i {
            0 => self.from,
            _ if i == last => self.to,
            _ => inner(i as f64, last as f64),
        }
    }
}

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Self::of(text, NUMBER, |number| number.parse().ok())
    }
}

/// The K-th of N parts of a sweep, K from 1 to N, for one of many machines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    number: u64,
    of: u64,
}

impl Part {
    /// All there is.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether it is the first of the parts.
    pub const fn is_first(self) -> bool {
        self.number == 1
    }

    /// Which of `count` items are in this part. The parts follow each other, and the first ones
    /// have one item more than the others, if all cannot have the same number.
    pub fn among(self, count: u64) -> ops::Range<u64> {
        let (each, more) = (count / self.of, count % self.of);
        // At most `count`: no product overflows.
        let items = |parts: u64| parts * each + parts.min(more);
        items(self.number - 1)..items(self.number)
    }
}

impl fmt::Display for Part {
    /// The text that it is read from.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Part {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let part = text.split_once('/').and_then(|(number, of)| {
            Some(Self { number: number.parse().ok()?, of: of.parse().ok()? })
        });
        part.filter(|part| (1..=part.of).contains(&part.number))
            .ok_or("it must be K/N, whole numbers with K from 1 to N")
    }
}

/// What an angle may be.
const ANGLE: &str =
    "it must be an angle: radians as 1.5, multiples of π as -2pi/3 or 0.5pi, degrees as 60deg";

/// An angle (rad). Whether it may be infinite is for the library to say.
pub fn angle(text: &str) -> Result<f64, &'static str> {
    read(text).ok_or(ANGLE)
}

/// An angle, or a range of them.
pub fn angles(text: &str) -> Result<Sweep, String> {
    Sweep::of(text, ANGLE, read)
}

fn read(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| multiple_of_pi(text))
}

/// `2pi/3` or `60deg`: the f64 nearest to the real angle, unless its first 53 bits and the next 45
/// or so are a tie.
fn multiple_of_pi(text: &str) -> Option<f64> {
    let text = text.trim().to_lowercase();
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.strip_prefix('+').unwrap_or(&text)),
    };
    let (factor, divisor) = match text.strip_suffix("deg").or_else(|| text.strip_suffix('°')) {
        Some(degrees) => (decimal(degrees.trim_end())?, exactly(180)),
        None => {
            let (factor, rest) = text.split_once("pi").or_else(|| text.split_once('π'))?;
            let factor = factor.trim_end().strip_suffix('*').unwrap_or(factor).trim_end();
            let factor = if factor.is_empty() { DoubleDouble::ONE } else { decimal(factor)? };
            match rest {
                "" => (factor, DoubleDouble::ONE),
                rest => (factor, decimal(rest.strip_prefix('/')?)?),
            }
        }
    };
    let pi = DoubleDouble::HALF_PI.scaled(2.0);
    (divisor != DoubleDouble::ZERO).then(|| sign * (pi * factor / divisor).rounded())
}

/// A decimal number without sign, of up to 19 digits, to 100 bits or more.
fn decimal(text: &str) -> Option<DoubleDouble> {
    let (digits, exponent) = match text.split_once('e') {
        Some((digits, exponent)) => (digits, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let all = format!("{whole}{part}");
    if !all.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let power = exponent.checked_sub(i32::try_from(part.len()).ok()?)?;
    let ten = exactly(10_u64.checked_pow(power.unsigned_abs())?);
    let number = exactly(all.parse().ok()?);
    Some(if power < 0 { number / ten } else { number * ten })
}

fn exactly(whole: u64) -> DoubleDouble {
    let nearest = whole as f64;
    let rest = i128::from(whole) - nearest as i128;
    DoubleDouble::new(nearest) + DoubleDouble::new(rest as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a range that stops one short, ends that are rounded, a tenth that is not the f64
    /// nearest to it, an overflow where the ends are far apart.
    #[test]
    fn ranges_have_their_ends_and_their_count() {
        let range = |text: &str| match text.parse() {
            Ok(Sweep::Range(range)) => range,
            other => panic!("{text}: {other:?}"),
        };
        let linear = |text: &str| {
            let range = range(text);
            (0..range.count).map(|i| range.linear(i)).collect::<Vec<_>>()
        };
        assert_eq!(linear("0:1:11"), [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]);
        let decades = [0, 1, 2].map(|i| range("0.1:0.001:3").geometric(i));
        assert_eq!((decades[0], decades[2]), (0.1, 0.001));
        assert!((decades[1] / 0.01 - 1.0).abs() < 1e-15, "{decades:?}");
        assert_eq!(linear("-1:1:2"), [-1.0, 1.0]);
        assert_eq!(linear("-1e308:1e308:3"), [-1e308, 0.0, 1e308]);
        // Three times the second overflows.
        assert!(linear("0:-1.6e308:4").iter().all(|x| x.is_finite()));
    }

    /// Catches: an item that is in no part or in two, parts that differ by two items or more, a
    /// number of parts that overflows.
    #[test]
    fn parts_follow_each_other_and_differ_by_one() {
        for count in (0..40).chain([u64::MAX - 1, u64::MAX]) {
            for of in 1..50 {
                let mut next = 0;
                for part in (1..=of).map(|number| Part { number, of }.among(count)) {
                    assert_eq!(part.start, next, "{count} in {of}");
                    let items = part.end - part.start;
                    assert!([0, 1].contains(&(items - count / of)), "{count} in {of}: {part:?}");
                    next = part.end;
                }
                assert_eq!(next, count, "{of}");
            }
        }
        let last = Part { number: u64::MAX, of: u64::MAX };
        assert_eq!((last.among(5), last.among(u64::MAX)), (5..5, u64::MAX - 1..u64::MAX));
        assert_eq!(Part { number: 1, ..last }.among(5), 0..1);
    }

    /// The nearest f64 by π to 120 digits, from Machin's formula in integers of Python; π as an f64
    /// gives another for each of the first, in either order of operations.
    ///
    /// Catches: π/3 as the quotient of two f64; degrees turned to radians by a factor that is
    /// rounded; a quotient cut off instead of rounded, or rounded from its first 64 bits; a sign, a
    /// factor or a divisor that is lost.
    #[test]
    fn an_angle_is_the_nearest_f64() {
        for (text, bits) in [
            ("pi/3", 0x3ff0_c152_382d_7366),
            ("60deg", 0x3ff0_c152_382d_7366),
            ("2pi/3", 0x4000_c152_382d_7366),
            ("pi/6", 0x3fe0_c152_382d_7366),
            ("11pi/12", 0x4007_09d1_0d3e_7eac),
            ("59deg", 0x3ff0_79d5_1da4_28f1),
            ("61deg", 0x3ff1_08cf_52b6_bdda),
            ("65°", 0x3ff2_26c3_bcdb_e7ae),
            ("1e0 deg", 0x3f91_df46_a252_9d39),
            ("5*PI/6", 0x4004_f1a6_c638_d03f),
            ("0.5pi", std::f64::consts::FRAC_PI_2.to_bits()),
            ("π/2.5e-1", (4.0 * std::f64::consts::PI).to_bits()),
            ("180deg", std::f64::consts::PI.to_bits()),
            ("+pi", std::f64::consts::PI.to_bits()),
            ("0pi", 0.0_f64.to_bits()),
            ("1048576pi", (1_048_576.0 * std::f64::consts::PI).to_bits()),
            // Its leading 64 bits alone are a tie.
            ("10767pi", 0x40e0_8430_e634_7d93),
            (
                "9223372036854775808pi",
                (9_223_372_036_854_775_808.0 * std::f64::consts::PI).to_bits(),
            ),
        ] {
            assert_eq!(angle(text).map(f64::to_bits), Ok(bits), "{text}");
            if !text.starts_with('+') {
                let negative = angle(&format!("-{text}"));
                assert_eq!(negative.map(f64::to_bits), Ok(bits | 1 << 63), "-{text}");
            }
        }
        assert_eq!(angles("-pi/3:60deg:3"), "-1.0471975511965979:1.0471975511965979:3".parse());
    }

    /// Catches: nonsense that is taken for a number.
    #[test]
    fn what_is_no_angle_is_refused() {
        for text in [
            "pi/0", "deg", "pi/", "pi/3/4", "2pi3x", "--pi", "six", "", "1e40pi", "pi/-3", "1/3pi",
            "60d", "-pi/x",
        ] {
            assert_eq!(angle(text), Err(ANGLE), "{text}");
        }
        assert!(angles("inf").is_err() && angles("0:pi:1").is_err() && angles("0:pi").is_err());
    }
}
