//! Numbers with a fixed point and 384 binary digits behind it, for the few differences that take
//! away more digits than a double-double has.

use super::double_double::DoubleDouble;

/// A number from 0 to 2⁶⁴, in multiples of 2⁻³⁸⁴.
///
/// Two words stand before the point and twelve behind it. They have 32 bits, so that the product of
/// two, or one with a remainder before it, is a `u64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fixed([u32; WORDS]);

const WORDS: usize = 14;

/// 2³²: the base of the digits that the words are.
const BASE: f64 = (1_u64 << 32) as f64;

/// π/2, rounded down.
#[rustfmt::skip]
const HALF_PI: Fixed = Fixed([
    0x0000_0000, 0x0000_0001, 0x921f_b544, 0x42d1_8469, 0x898c_c517, 0x01b8_39a2, 0x5204_9c11,
    0x14cf_98e8, 0x0417_7d4c, 0x7627_3644, 0xa294_10f3, 0x1c68_09bb, 0xdf2a_3367, 0x9a74_8636,
]);

impl Fixed {
    /// `x` from 0 to 2⁶⁴, rounded down: exact for 2⁻³³¹ and more.
    pub fn new(x: f64) -> Self {
        let mut rest = x / BASE;
        Self(core::array::from_fn(|_| {
            let word = libm::floor(rest);
            rest = (rest - word) * BASE;
            word as u32
        }))
    }

    /// |x − y|, exactly.
    pub fn distance(self, other: Self) -> Self {
        let (mut larger, smaller) = if self < other { (other, self) } else { (self, other) };
        let mut borrow = false;
        for (x, y) in larger.0.iter_mut().zip(smaller.0).rev() {
            let (difference, first) = x.overflowing_sub(y);
            let (difference, second) = difference.overflowing_sub(u32::from(borrow));
            (*x, borrow) = (difference, first || second);
        }
        larger
    }

    /// x y, too small by at most 2⁻³⁸⁰. It must be below 2⁶⁴.
    pub fn times(self, other: Self) -> Self {
        // The product of the words i and j belongs to the words i + j − 1, above, and i + j − 2,
        // of which the second words are the units.
        let mut sums = [0_u64; WORDS + 2];
        for (i, &x) in self.0.iter().enumerate() {
            for (j, &y) in other.0.iter().enumerate().take(WORDS + 1 - i) {
                let product = u64::from(x) * u64::from(y);
                sums[i + j + 1] += product & u64::from(u32::MAX);
                sums[i + j] += product >> 32;
            }
        }
        let mut carry = 0;
        let mut product = [0; WORDS];
        for (n, sum) in sums.into_iter().enumerate().rev() {
            let sum = sum + carry;
            carry = sum >> 32;
            if let Some(word) = n.checked_sub(2).and_then(|n| product.get_mut(n)) {
                *word = sum as u32;
            }
        }
        Self(product)
    }

    /// x/n for a whole n, rounded down.
    fn over(self, n: u32) -> Self {
        let mut rest = 0;
        Self(self.0.map(|word| {
            let dividend = (rest << 32) | u64::from(word);
            rest = dividend % u64::from(n);
            (dividend / u64::from(n)) as u32
        }))
    }

    /// |cos x| for |x| < 2⁴⁹, within 2⁻³³⁰: the sine of the distance to the nearest zero, so that it
    /// keeps its digits there.
    pub fn cosine(x: f64) -> Self {
        /// The first term left out is at most (π/2)⁸⁸/89! = 2⁻³⁹⁶.
        const PAIRS: u32 = 44;
        let x = libm::fabs(x);
        let odd = 2.0 * libm::floor(x / core::f64::consts::PI) + 1.0;
        let y = Self::new(x).distance(Self::new(odd).times(HALF_PI));
        let (square, one) = (y.times(y), Self::new(1.0));
        y.times((1..PAIRS).rev().fold(one, |inner, pair| {
            one.distance(square.times(inner).over(2 * pair * (2 * pair + 1)))
        }))
    }

    /// Rounded to a double-double.
    pub fn to_double_double(self) -> DoubleDouble {
        let unit = |n: usize| libm::ldexp(1.0, 32 - 32 * n as i32);
        self.0.into_iter().enumerate().rev().fold(DoubleDouble::ZERO, |sum, (n, word)| {
            sum + DoubleDouble::new(f64::from(word) * unit(n))
        })
    }
}
