//! A number, or a range of numbers, on the command line: `0.1` or `0.1:3:30`.

use std::fmt;
use std::str::FromStr;

use super::number::{NUMBER, refusal};

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
    /// What `text` stands for, with `number` for each number in it.
    pub fn of(text: &str, number: impl Fn(&str) -> Result<f64, String>) -> Result<Self, String> {
        const ALLOWED: &str = "or a range FROM:TO:COUNT with a COUNT of 2 or more, in digits";
        let or_range = |reason: String| format!("{reason}, {ALLOWED}");
        let parts: Vec<&str> = text.split(':').collect();
        match parts[..] {
            [one] => number(one).map(Self::One).map_err(or_range),
            [from, to, count] => {
                let [from, to] = [number(from), number(to)];
                let count = count.parse().ok().filter(|count| *count >= 2);
                let count = count.ok_or_else(|| NUMBER.to_owned());
                Ok(Self::Range(Range {
                    from: from.map_err(or_range)?,
                    to: to.map_err(or_range)?,
                    count: count.map_err(or_range)?,
                }))
            }
            _ => Err(or_range(NUMBER.to_owned())),
        }
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

impl fmt::Display for Sweep {
    /// The text that it is read from, with numbers that read back to the same f64.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::One(number) => write!(f, "{number:?}"),
            Self::Range(Range { from, to, count }) => write!(f, "{from:?}:{to:?}:{count}"),
        }
    }
}

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
        Self::of(text, |end| number(end).ok_or_else(|| refusal(end, NUMBER)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(text: &str) -> Range {
        match text.parse() {
            Ok(Sweep::Range(range)) => range,
            other => panic!("{text}: {other:?}"),
        }
    }

    /// Catches: a range that stops one short, ends that are rounded, a tenth that is not the f64
    /// nearest to it, an overflow where the ends are far apart.
    #[test]
    fn ranges_have_their_ends_and_their_count() {
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
}
