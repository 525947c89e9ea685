//! A part of a sweep, for one of many machines: `2/8`, the second of eight.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use super::number::refusal;

/// The K-th of N parts, K from 1 to N.
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
    pub fn among(self, count: u64) -> Range<u64> {
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
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const ALLOWED: &str = "it must be K/N, whole numbers with K from 1 to N";
        let part = text.split_once('/').and_then(|(number, of)| {
            Some(Self { number: number.parse().ok()?, of: of.parse().ok()? })
        });
        part.filter(|part| (1..=part.of).contains(&part.number))
            .ok_or_else(|| refusal(text, ALLOWED))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: an item that is in no part or in two, parts that differ by two items or more, a
    /// number of parts that overflows.
    #[test]
    fn parts_follow_each_other_and_differ_by_one() {
        for count in (0..40).chain([u64::MAX - 1, u64::MAX]) {
            for of in 1..50 {
                let parts: Vec<Range<u64>> =
                    (1..=of).map(|number| Part { number, of }.among(count)).collect();
                let mut next = 0;
                for part in &parts {
                    assert_eq!(part.start, next, "{count} in {of}");
                    let items = part.end - part.start;
                    assert!(items.abs_diff(count / of) <= 1, "{count} in {of}: {parts:?}");
                    assert!(items >= count / of, "{count} in {of}: {parts:?}");
                    next = part.end;
                }
                assert_eq!(next, count, "{of}");
            }
            assert_eq!(Part::WHOLE.among(count), 0..count);
        }
        let last = Part { number: u64::MAX, of: u64::MAX };
        assert_eq!((last.among(5), last.among(u64::MAX)), (5..5, u64::MAX - 1..u64::MAX));
        assert_eq!(Part { number: 1, ..last }.among(5), 0..1);
    }
}
