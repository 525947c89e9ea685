//! Elliptic integrals and functions: complete integrals and Jacobi's functions by the
//! arithmetic–geometric mean, incomplete integrals by Carlson's duplication.
//!
//! All of them take the complementary modulus k' and never form 1 − k²: near the top of the swing k
//! rounds to 1, and only k' still distinguishes one swing from another. Sources are sections of the
//! NIST Digital Library of Mathematical Functions, <https://dlmf.nist.gov>.

use crate::arithmetic::double_double::DoubleDouble;
use crate::arithmetic::sine::{cos, sin};

// ANCHOR: complete_elliptic_k
/// The complete elliptic integral of the first kind K = ∫₀^{π/2} dφ / √(1 − k² sin² φ), from k' =
/// √(1 − k²).
///
/// K = π / (2 M(1, k')), where M is the arithmetic–geometric mean (DLMF 19.8.5). For a pendulum
/// released at θ₀ the complementary modulus k' is cos(θ₀/2). Dimensionless; right to 2e-16 relative
/// for every k' from 1, where K = π/2, down to the smallest f64.
///
/// Beware of the argument: tables and libraries write K(k), of the modulus k = sin(θ₀/2), or K(m),
/// of the parameter m = k², and both look alike. This function takes neither.
///
/// # Errors
/// None: K(0) is +∞, and k' outside 0 … 1 gives NaN.
pub fn complete_elliptic_k(complementary_modulus: f64) -> f64 {
    if complementary_modulus == 0.0 {
        return f64::INFINITY;
    }
    if !(0.0..=1.0).contains(&complementary_modulus) {
        return f64::NAN;
    }
    let mean = arithmetic_geometric_mean(complementary_modulus.into(), |_, _, _| {});
    (DoubleDouble::HALF_PI / mean).rounded()
}
// ANCHOR_END: complete_elliptic_k

/// M(1, b): the common limit of the arithmetic and the geometric means of 1 and b, for 0 < b ≤ 1
/// (DLMF 19.8.1–4).
///
/// Each step (a, b) → ((a + b)/2, √(a b)) squares the distance. `visit` is called with a, b and the
/// next a.
pub fn arithmetic_geometric_mean(
    b: DoubleDouble,
    mut visit: impl FnMut(DoubleDouble, DoubleDouble, DoubleDouble),
) -> DoubleDouble {
    /// 2⁻⁵⁶: from here on M = (a + b)/2 − (a − b)²/(16 a) + … is (a + b)/2, to the last digit of a
    /// double-double.
    const CLOSE: f64 = 1.0 / (1_u64 << 56) as f64;
    let half = |x: DoubleDouble| x.scaled(0.5);
    let (mut a, mut b) = (DoubleDouble::ONE, b);
    while (a - b).rounded() > CLOSE * a.rounded() {
        let next = half(a + b);
        visit(a, b, next);
        (a, b) = (next, (a * b).sqrt());
    }
    half(a + b)
}

/// Carlson's symmetric integral R_F(x, y, z) = ½ ∫₀^∞ dt / √((t+x)(t+y)(t+z)) (DLMF 19.16.1).
///
/// None of the arguments may be negative, and at most one zero.
pub fn carlson_rf(x: DoubleDouble, y: DoubleDouble, z: DoubleDouble) -> DoubleDouble {
    /// The series below leaves out terms of the sixth power: 2⁻¹⁰⁸.
    const SPREAD: f64 = 1.0 / (1_u64 << 18) as f64;
    let (mut x, mut y, mut z) = (x, y, z);
    loop {
        let mean = (x + y + z) / DoubleDouble::new(3.0);
        let (dx, dy) = (DoubleDouble::ONE - x / mean, DoubleDouble::ONE - y / mean);
        let dz = -(dx + dy);
        let spread = [dx, dy, dz].map(|d| libm::fabs(d.rounded()));
        if spread.into_iter().all(|d| d < SPREAD) {
            // DLMF 19.36.1, in the elementary symmetric functions E₂, E₃ of the three small
            // differences.
            let (e2, e3) = (dx * dy - dz.squared(), dx * dy * dz);
            let over = |x: DoubleDouble, divisor: f64| x / DoubleDouble::new(divisor);
            let series =
                DoubleDouble::ONE - over(e2, 10.0) + over(e3, 14.0) + over(e2.squared(), 24.0)
                    - over(e2 * e3, 44.0 / 3.0);
            return series / mean.sqrt();
        }
        // Duplication brings the arguments four times closer (DLMF 19.26.18).
        let (rx, ry, rz) = (x.sqrt(), y.sqrt(), z.sqrt());
        let lambda = rx * ry + ry * rz + rz * rx;
        let quarter = |x: DoubleDouble| (x + lambda).scaled(0.25);
        (x, y, z) = (quarter(x), quarter(y), quarter(z));
    }
}

/// The Jacobian elliptic functions of one modulus, prepared for many arguments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jacobi {
    /// k'.
    pub(super) complementary_modulus: f64,
    /// K, where sn has its maximum.
    pub(super) quarter_period: DoubleDouble,
    /// M(1, k').
    mean: f64,
    /// The steps from a trigonometric function up to the elliptic one, the last to be taken first.
    steps: [Step; Self::STEPS],
    /// How many of them there are.
    count: usize,
}

/// One step of Gauss's transformation.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    /// aₙ₊₁ bₙ.
    numerator: f64,
    /// aₙ₊₁ aₙ.
    denominator: f64,
}

/// The Jacobian elliptic functions at one argument.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values {
    /// sc = sn/cn, the tangent of the amplitude.
    pub(super) sc: f64,
    /// sn, the sine of the amplitude.
    pub(super) sn: f64,
    /// cn, the cosine of the amplitude.
    pub(super) cn: f64,
    /// dn = √(k'² + k² cn²).
    pub(super) dn: f64,
}

impl Jacobi {
    /// One more than the smallest f64 needs.
    const STEPS: usize = 14;

    /// For the complementary modulus k', 0 < k' ≤ 1.
    pub(super) fn new(complementary_modulus: DoubleDouble) -> Self {
        let mut steps = [Step::default(); Self::STEPS];
        let mut count = 0;
        let mean = arithmetic_geometric_mean(complementary_modulus, |a, b, next| {
            steps[count] =
                Step { numerator: (next * b).rounded(), denominator: (next * a).rounded() };
            count += 1;
        });
        Self {
            complementary_modulus: complementary_modulus.rounded(),
            quarter_period: DoubleDouble::HALF_PI / mean,
            mean: mean.rounded(),
            steps,
            count,
        }
    }

    // ANCHOR: jacobi
    /// sn, cn and dn of `quarters` K, for |quarters| ≤ ½.
    ///
    /// Along the arithmetic–geometric mean the modulus falls to zero, where sc is the tangent;
    /// Gauss's transformation leads back up (DLMF 22.7.2–4, Abramowitz & Stegun 16.12). In terms of
    /// T = sc(a u)/a it reads
    ///
    /// Tₙ = Tₙ₊₁ / dnₙ₊₁,  dnₙ = (1 + aₙ₊₁ bₙ Tₙ₊₁²) / (1 + aₙ₊₁ aₙ Tₙ₊₁²),
    ///
    /// with every term positive, so that there is no cancellation. The usual recipe, Landen's
    /// transformation of the amplitude (DLMF 22.20(ii)), takes arcsines close to 1 where k is near
    /// 1, and loses half the digits.
    #[inline]
    pub(super) fn at(&self, quarters: f64) -> Values {
        let phi = core::f64::consts::FRAC_PI_2 * quarters;
        let mut t = sin(phi) / cos(phi) / self.mean;
        let mut dn = 1.0;
        for step in self.steps[..self.count].iter().rev() {
            let square = t * t;
            t /= dn;
            dn = (1.0 + step.numerator * square) / (1.0 + step.denominator * square);
        }
        let sc = t;
        let cn = 1.0 / libm::sqrt(1.0 + sc * sc);
        let sn = sc * cn;
        Values { sc, sn, cn, dn }
    }
    // ANCHOR_END: jacobi
}
