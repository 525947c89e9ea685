//! How well Störmer–Verlet conserves its modified energy when the series of it is cut off after N
//! terms: better and better up to some N, which depends on the step, and then worse and worse.
//!
//! All in double-double, since what is to be measured is below the rounding of an f64: the method
//! is the library's, the state and the sine have twice the digits.

use core::f64::consts::PI;
use std::sync::LazyLock;

use pendula::exact::complete_elliptic_k;
use pendula::internals::double_double::DoubleDouble;
use pendula::methods::StormerVerlet;
use pendula::{Grid, integrate_with};

use super::splitting::{self, Point, Precise, sine_cosine};
use crate::theory::ModifiedSeries;

/// The power of the step with which the series ends: N = 0, 2, …, 40.
pub const ORDER: usize = 40;
/// The angle of release (rad) of the curves against N.
pub const THETA_0: f64 = 1.0;
/// Their steps x = ω₀h.
pub const STEPS: [f64; 3] = [1.0, 0.6, 0.4];
/// The angles of release (rad) of the points against the step.
pub const STARTS: [f64; 2] = [1.0, 3.0];
/// Of each run, the time in units of 1/ω₀.
const DURATION: f64 = 40.0;

/// The largest changes, over some swings from rest at `theta_0` (rad) in steps of `x`, of the
/// modified energy cut off after the powers 0, 2, …, [`ORDER`] of x, in units of m g L.
pub fn errors(theta_0: f64, x: f64) -> Vec<f64> {
    static SERIES: LazyLock<ModifiedSeries> = LazyLock::new(|| ModifiedSeries::new(ORDER));
    let sums = |z: Point| {
        let (mut power, mut sum) = (DoubleDouble::ONE, DoubleDouble::ZERO);
        let square = DoubleDouble::product(x, x);
        let values = SERIES.values(z.q, sine_cosine(z.theta).1).into_iter();
        let sums = values.map(|value| {
            sum = sum + value * power;
            power = power * square;
            sum
        });
        sums.collect::<Vec<_>>()
    };
    let start = Point::at_rest(theta_0);
    let initial = sums(start);
    let mut largest = vec![0.0_f64; initial.len()];
    let grid = Grid::new(x, (DURATION / x) as u64).expect("a positive step");
    integrate_with(&Precise, &StormerVerlet, start, &grid, &mut |_: u64, _: f64, z: Point| {
        for (largest, (sum, initial)) in largest.iter_mut().zip(sums(z).iter().zip(&initial)) {
            *largest = largest.max((*sum - *initial).rounded().abs());
        }
    });
    largest
}

/// The smallest of [`errors`], and the power of the step with which that series ends.
pub fn best(theta_0: f64, x: f64) -> (usize, f64) {
    let errors = errors(theta_0, x).into_iter().enumerate();
    let (k, least) = errors.min_by(|a, b| a.1.total_cmp(&b.1)).expect("an order");
    (2 * k, least)
}

/// 2πK' for a release from rest at `theta_0` (rad): what x has to be small beside.
///
/// The motion θ(t), continued to complex times, has its singularities nearest to the real axis at
/// iK'/ω₀ above and below where it passes the bottom, K' being the complete elliptic integral of
/// the complementary modulus: those of the function sn (DLMF 22.4). The n-th derivative grows as
/// n!/(K')ⁿ there, and with it the terms of the series, as Bernoulli's numbers over factorials: as
/// n!/(2πK'/x)ⁿ. The smallest of them is about e^{−2πK'/x}.
pub fn exponent(theta_0: f64) -> f64 {
    // K of a modulus, from its complementary one.
    2.0 * PI * complete_elliptic_k(pendula::arithmetic::sine::sin(0.5 * theta_0))
}

/// About the size of [`best`] for a release from rest at `theta_0` (rad) in steps of `x` (m g L):
/// 2Θ/x² e^{−2πK'/x}, with the constant of the separatrix's splitting, since the motion's
/// singularities are all alike. Beside the separatrix K' is π/2, and this the size of the splitting
/// itself, as [`splitting::energy`] has it.
pub fn law(theta_0: f64, x: f64) -> f64 {
    2.0 * splitting::LAZUTKIN / (x * x) * libm::exp(-exponent(theta_0) / x)
}

/// The values of 1/x, from 1 to [`FINEST`].
pub fn inverse_steps() -> impl Iterator<Item = f64> {
    (0..=40).map(|i| 1.0 + 0.1 * f64::from(i))
}

/// The largest 1/x.
pub const FINEST: f64 = 5.0;

/// Pairs of 1/x and the smallest error at the step x, from rest at `theta_0` (rad), as far as the
/// series with the smallest error is not the longest one. A method that is not symplectic has no
/// such series, and the shortest is best at every step.
pub fn least(theta_0: f64) -> Vec<(f64, f64)> {
    let inverse = inverse_steps();
    let points = inverse.map(|inverse| (inverse, best(theta_0, 1.0 / inverse)));
    let short = points.take_while(|(_, (power, _))| *power < ORDER);
    short.map(|(inverse, (_, error))| (inverse, error)).collect()
}

/// Pairs of 1/x and the splitting of the separatrix as an energy (m g L).
pub fn split() -> Vec<(f64, f64)> {
    let inverse = (0..=16).map(|i| 1.0 + 0.25 * f64::from(i));
    inverse.map(|inverse| (inverse, splitting::energy(1.0 / inverse))).collect()
}
