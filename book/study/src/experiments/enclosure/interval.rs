//! Intervals with bounds that are rounded outwards: what an operation gives on any of the numbers
//! in its operands lies in its result.
//!
//! The f64 nearest to a sum or product is within half a unit in the last place of it, so the next
//! f64 below is a lower bound and the next above an upper one. No rounding mode is switched, and
//! the bits are the same everywhere (Rump, Zimmermann, Boldo, Melquiond: Computing predecessor and
//! successor in rounding to nearest, *BIT* 49 (2009) 419).

use core::ops::{Add, Div, Mul, Neg, Sub};

/// The numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower bound.
    pub low: f64,
    /// The upper bound.
    pub high: f64,
}

// ANCHOR: outwards
impl Interval {
    /// From bounds that are rounded to nearest: one f64 further on either side.
    fn outwards(low: f64, high: f64) -> Self {
        Self { low: low.next_down(), high: high.next_up() }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::outwards(self.low + other.low, self.high + other.high)
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let ends = [self.low * other.low, self.low * other.high, self.high * other.low];
        let last = self.high * other.high;
        Self::outwards(
            ends.iter().fold(last, |a, b| a.min(*b)),
            ends.iter().fold(last, |a, b| a.max(*b)),
        )
    }
}
// ANCHOR_END: outwards

impl Interval {
    /// 0.
    pub const ZERO: Self = Self { low: 0.0, high: 0.0 };

    /// The numbers from `low` to `high`.
    pub fn new(low: f64, high: f64) -> Self {
        assert!(low <= high, "no interval: {low} to {high}");
        Self { low, high }
    }

    /// From −`radius` to `radius`.
    pub fn about_zero(radius: f64) -> Self {
        Self::new(-radius, radius)
    }

    /// A number in the middle, or beside it.
    pub fn middle(self) -> f64 {
        self.low + 0.5 * (self.high - self.low)
    }

    /// An upper bound of its width.
    pub fn width(self) -> f64 {
        (self.high - self.low).next_up()
    }

    /// The largest absolute value in it.
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The smallest interval that contains both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether all of `other` lies in it.
    pub fn contains(self, other: Self) -> bool {
        self.low <= other.low && other.high <= self.high
    }

    /// Whether `x` + `rest` lies in it, where |`rest`| is at most half a unit in the last place of
    /// `x`.
    pub fn contains_sum(self, x: f64, rest: f64) -> bool {
        let above = self.low < x || (self.low == x && rest >= 0.0);
        let below = x < self.high || (x == self.high && rest <= 0.0);
        above && below
    }

    /// The numbers from `lower` up and from `upper` down are cut off.
    fn cut(self, lower: f64, upper: f64) -> Self {
        Self { low: self.low.max(lower), high: self.high.min(upper) }
    }

    /// Its sine and cosine, for |x| ≤ 4.
    ///
    /// Both are Taylor series at the middle. The terms alternate and end with one that is below the
    /// one before, so that what is left out is at most as large as it; 4⁴⁰/40! is 1.5e-24. Neither
    /// function changes by more than its argument.
    pub fn sine_cosine(self) -> (Self, Self) {
        assert!(self.magnitude() <= 4.0, "the series are for |x| ≤ 4");
        const TERMS: u32 = 20;
        let middle = Self::from(self.middle());
        let square = middle * middle;
        let left_out = |last: Self| Self::about_zero(last.magnitude());
        // From the innermost bracket of 1 − x²/(2·3) (1 − x²/(4·5) (…)) outwards, and the first
        // term that is left out.
        let series = |first: u32, start: Self| {
            let (mut sum, mut term) = (Self::from(1.0), start);
            for k in (1..TERMS).rev() {
                let divisor = Self::from(f64::from((2 * k - 1 + first) * (2 * k + first)));
                sum = Self::from(1.0) - square / divisor * sum;
            }
            for k in 1..=TERMS {
                let divisor = Self::from(f64::from((2 * k - 1 + first) * (2 * k + first)));
                term = term * square / divisor;
            }
            start * sum + left_out(term)
        };
        let moved = (self - middle).magnitude();
        let [sine, cosine] = [series(1, middle), series(0, Self::from(1.0))];
        [sine, cosine].map(|x| (x + Self::about_zero(moved)).cut(-1.0, 1.0)).into()
    }
}

impl From<f64> for Interval {
    fn from(x: f64) -> Self {
        Self { low: x, high: x }
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Div for Interval {
    type Output = Self;

    /// By an interval without 0.
    fn div(self, other: Self) -> Self {
        assert!(other.low > 0.0 || other.high < 0.0, "division by an interval with 0 in it");
        self * Self::outwards(1.0 / other.high, 1.0 / other.low)
    }
}

#[cfg(test)]
mod tests {
    use pendula::internals::double_double::DoubleDouble;

    use super::*;

    /// Numbers of all sizes and signs, the same in each run.
    fn numbers() -> impl Iterator<Item = f64> {
        let mut bits = 1_u64;
        core::iter::repeat_with(move || {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let mantissa = (bits >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            libm::ldexp(mantissa, (bits >> 5 & 31) as i32 - 16)
        })
    }

    fn pairs() -> impl Iterator<Item = (f64, f64)> {
        numbers().zip(numbers().skip(7)).take(10_000)
    }

    fn contains(interval: Interval, exact: DoubleDouble) -> bool {
        interval.contains_sum(exact.rounded(), exact.remainder())
    }

    /// A sum or product of two f64s is a sum of two f64s, exactly, and a rounding either way is
    /// among ten thousand of them.
    ///
    /// Catches: a bound that is rounded to nearest, inwards, or both bounds in one direction.
    #[test]
    fn the_exact_sum_and_product_are_inside() {
        for (x, y) in pairs() {
            let (a, b) = (Interval::from(x), Interval::from(y));
            let (exact_x, exact_y) = (DoubleDouble::new(x), DoubleDouble::new(y));
            assert!(contains(a + b, exact_x + exact_y), "{x:e} + {y:e}: {:?}", a + b);
            assert!(contains(a - b, exact_x - exact_y), "{x:e} - {y:e}: {:?}", a - b);
            assert!(contains(a * b, DoubleDouble::product(x, y)), "{x:e} {y:e}: {:?}", a * b);
            // The quotient of a product.
            assert!((a * b / b).contains(a), "{x:e} {y:e} / {y:e}");
        }
    }

    /// All four ends of a product of intervals can be the outermost, by the signs of theirs.
    ///
    /// Catches: a product of the low ends for the lower bound.
    #[test]
    fn products_of_the_ends_are_inside() {
        for ((x, y), (u, v)) in pairs().zip(pairs().skip(11)) {
            let (a, b) = (Interval::new(x.min(y), x.max(y)), Interval::new(u.min(v), u.max(v)));
            for (p, q) in [(x, u), (x, v), (y, u), (y, v)] {
                assert!(contains(a * b, DoubleDouble::product(p, q)), "{a:?} {b:?}");
            }
        }
    }

    /// The intervals are a few units in the last place wide; at 4, where the terms of the series
    /// are up to e⁴ large, some hundreds.
    ///
    /// Catches: the two series exchanged; a sign; a remainder that is left out where it counts,
    /// near 4; the width of the argument forgotten; bounds too far apart to be of use.
    #[test]
    fn sine_and_cosine_are_inside() {
        let file = include_str!("../../../../../tests/data/sine.csv");
        let mut seen = 0;
        for line in file.lines().skip(1) {
            let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
            let [x, sine, sine_rest, cosine, cosine_rest] = fields[..] else { panic!("{line}") };
            if x.abs() > 3.9 {
                continue;
            }
            seen += 1;
            for radius in [0.0, 1e-9, 0.05] {
                // The argument need not be in the middle.
                let (s, c) = Interval::new(x - radius, x + 0.3 * radius).sine_cosine();
                assert!(s.contains_sum(sine, sine_rest), "sin {x}: {s:?}");
                assert!(c.contains_sum(cosine, cosine_rest), "cos {x}: {c:?}");
                let allowed = 3.0 * radius + 2e-16 * 10.0_f64.max(8.0 * libm::exp(x.abs()));
                assert!(s.width() < allowed && c.width() < allowed, "{x}: {s:?} {c:?}");
                // The ends, whose sines are known to a unit in the last place or so.
                for end in [x - radius, x + 0.3 * radius] {
                    let slack = Interval::about_zero(3e-16);
                    assert!((s + slack).contains(libm::sin(end).into()), "sin {end}: {s:?}");
                    assert!((c + slack).contains(libm::cos(end).into()), "cos {end}: {c:?}");
                }
            }
        }
        assert!(seen > 150, "{seen}");
    }
}
