//! Double-double arithmetic: a number as the unevaluated sum of two f64, with a relative precision
//! of about 2⁻¹⁰⁴.
//!
//! A phase is reduced by its period: after N periods an error in the period counts N times. The
//! exact solution keeps the few numbers affected in double-double, and everything else in f64. The
//! algorithms are those of Dekker, *Numer. Math.* 18 (1971) 224, and of Joldes, Muller, Popescu,
//! *ACM Trans. Math. Softw.* 44 (2017) 15res; none of them uses a fused multiply-add, which not
//! every machine has in hardware.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// The number hi + lo, where `lo` is at most half a unit in the last place of `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// π/2 in three parts, for a reduction that keeps all digits even beside a multiple of π/2.
const HALF_PI: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

impl DoubleDouble {
    /// 0.
    pub const ZERO: Self = Self::new(0.0);
    /// 1.
    pub const ONE: Self = Self::new(1.0);
    /// π/2.
    pub const HALF_PI: Self = Self { hi: HALF_PI[0], lo: HALF_PI[1] };

    /// `x`, exactly.
    pub const fn new(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// The nearest f64.
    pub const fn rounded(self) -> f64 {
        self.hi
    }

    /// The remainder: this number minus the nearest f64.
    pub const fn remainder(self) -> f64 {
        self.lo
    }

    /// The product of `x` and `y`, exactly, unless it leaves the range of f64.
    pub fn product(x: f64, y: f64) -> Self {
        let (hi, lo) = two_product(x, y);
        Self { hi, lo }
    }

    /// The product with a power of two, which rounds nothing.
    pub fn scaled(self, power_of_two: f64) -> Self {
        Self { hi: self.hi * power_of_two, lo: self.lo * power_of_two }
    }

    /// Its square.
    pub fn squared(self) -> Self {
        self * self
    }

    /// √x for x ≥ 0, by one step of Newton's iteration from the f64 root.
    ///
    /// Its residual x − s² has to be exact, and is lost to underflow when x is tiny: an even power
    /// of two is taken out first.
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::ZERO;
        }
        let (_, exponent) = libm::frexp(self.hi);
        let half = exponent.div_euclid(2);
        let x = self.scaled(libm::ldexp(1.0, -half)).scaled(libm::ldexp(1.0, -half));
        let s = libm::sqrt(x.hi);
        let residual = x - Self::product(s, s);
        Self::sum(s, residual.hi / (2.0 * s)).scaled(libm::ldexp(1.0, half))
    }

    /// x + y where |x| ≥ |y|.
    fn sum(x: f64, y: f64) -> Self {
        let (hi, lo) = fast_two_sum(x, y);
        Self { hi, lo }
    }
}

impl From<f64> for DoubleDouble {
    fn from(x: f64) -> Self {
        Self::new(x)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    /// Joldes, Muller, Popescu, Algorithm 6: relative error at most 3 · 2⁻¹⁰⁶ even when the sum
    /// cancels.
    #[inline]
    fn add(self, other: Self) -> Self {
        let (s_hi, s_lo) = two_sum(self.hi, other.hi);
        let (t_hi, t_lo) = two_sum(self.lo, other.lo);
        let (v_hi, v_lo) = fast_two_sum(s_hi, s_lo + t_hi);
        Self::sum(v_hi, t_lo + v_lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    /// Joldes, Muller, Popescu, Algorithm 10: relative error at most 7 · 2⁻¹⁰⁶.
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (hi, lo) = two_product(self.hi, other.hi);
        Self::sum(hi, lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// Long division: a first quotient, and a second from the remainder.
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let left_over = self - other * Self::new(first);
        Self::sum(first, left_over.hi / other.hi)
    }
}

/// (sin y, cos y, n), where x = n π/2 + y with |y| ≤ π/4 and n is an integer: all digits right for
/// |x| < 2⁵².
pub fn reduced_sine_cosine(x: f64) -> (DoubleDouble, DoubleDouble, f64) {
    let n = libm::rint(x / HALF_PI[0]);
    // The first two lines are exact; the third adds the third part of π/2, which matters when x is
    // very close to n π/2.
    let n_half_pi = DoubleDouble::product(n, HALF_PI[0]);
    let y = DoubleDouble::new(x - n_half_pi.hi) - DoubleDouble::new(n_half_pi.lo);
    let y = y - DoubleDouble::product(n, HALF_PI[1]) - DoubleDouble::product(n, HALF_PI[2]);
    (y * nested(y, 1), nested(y, 0), n)
}

/// 1 − y²/((m+1)(m+2)) (1 − y²/((m+3)(m+4)) (1 − …)): cos y for m = 0 and sin y / y for m = 1 (DLMF
/// 4.19.1–2).
fn nested(y: DoubleDouble, m: u32) -> DoubleDouble {
    /// The first term left out is at most (π/4)²⁸/28! = 2⁻¹⁰⁷·⁷.
    const PAIRS: u32 = 13;
    let square = y.squared();
    (0..PAIRS).rev().fold(DoubleDouble::ONE, |inner, pair| {
        let first = f64::from(m + 2 * pair + 1);
        DoubleDouble::ONE - square * inner / DoubleDouble::new(first * (first + 1.0))
    })
}

/// x + y as a rounded sum and its error, exactly (Knuth).
#[inline]
pub(crate) fn two_sum(x: f64, y: f64) -> (f64, f64) {
    let sum = x + y;
    let from_y = sum - x;
    let from_x = sum - from_y;
    (sum, (x - from_x) + (y - from_y))
}

/// The same in three operations, where |x| ≥ |y| or x = 0 (Dekker).
#[inline]
fn fast_two_sum(x: f64, y: f64) -> (f64, f64) {
    let sum = x + y;
    (sum, y - (sum - x))
}

/// x y as a rounded product and its error, exactly (Dekker).
#[inline]
fn two_product(x: f64, y: f64) -> (f64, f64) {
    let product = x * y;
    let ((x_hi, x_lo), (y_hi, y_lo)) = (split(x), split(y));
    let error = ((x_hi * y_hi - product) + x_hi * y_lo + x_lo * y_hi) + x_lo * y_lo;
    (product, error)
}

/// x as a sum of two halves of 26 bits, whose products are exact (Veltkamp).
#[inline]
fn split(x: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let scaled = SPLITTER * x;
    let hi = scaled - (scaled - x);
    (hi, x - hi)
}
