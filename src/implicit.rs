//! Implicit Runge–Kutta methods, solved by iteration.

use crate::phase::{Components, Vector};
use crate::system::{Rate, System};

/// The coefficients of an implicit Runge–Kutta method of `S` stages: kᵢ = f(t + cᵢ h, z + h Σⱼ aᵢⱼ kⱼ), and the step
/// z + h Σ bᵢ kᵢ.
#[derive(Clone, Copy, Debug)]
pub struct ImplicitTableau<const S: usize> {
    /// The matrix aᵢⱼ.
    pub a: [[f64; S]; S],
    /// The weights bᵢ.
    pub b: [f64; S],
    /// The nodes cᵢ, in steps.
    pub c: [f64; S],
}

/// Sweeps after which the iteration is given up. Where each leaves 0.7 of the distance to the solution, so many leave
/// 3e-16 of it; a step that needs more is too long to be of use.
const SWEEPS: u32 = 100;

/// What a sweep that no longer brings an improvement may still change, relative to the state and to the step: rounding,
/// a few times 1e-16 per stage and component. Where it changes more, there is still an improvement to wait for.
const ROUNDING: f64 = 1e-14;

impl<const S: usize> ImplicitTableau<S> {
    /// The state one step `h` (s) after `z` at time `t` (s).
    ///
    /// The slopes are found by fixed-point iteration from the one at the start of the step, until a sweep changes them
    /// by no more than rounding, and by no less than the sweep before or not at all (Hairer, Lubich, Wanner, *Geometric
    /// Numerical Integration*, Sect. VIII.6). Where the step is so long that the iteration does not converge, no component of
    /// the state returned is a number.
    // ANCHOR: step
    #[inline(always)]
    pub fn step<Sys>(&self, system: &Sys, t: f64, h: f64, z: Sys::State) -> Sys::State
    where
        Sys: System<State: Components>,
    {
        // Sums and no maxima, which would pass over a NaN.
        let size = |slope: Rate<Sys>| {
            let mut sum = 0.0;
            z.compare(z, slope, |_, _, x| sum += x.abs());
            sum
        };
        let mut k = [system.rate(t, z); S];
        let mut state = 0.0;
        z.compare(z, k[0], |x, _, _| state += x.abs());
        let mut before = f64::INFINITY;
        for _ in 0..SWEEPS {
            let (mut change, mut scale) = (0.0, state / h.abs());
            for i in 0..S {
                let slope = sum(&self.a[i], &k);
                let new = system.rate(t + self.c[i] * h, z + slope * h);
                change += size(new + k[i] * -1.0);
                scale += size(new);
                // At once, so that the later stages of this sweep have it.
                k[i] = new;
            }
            // Below the normal numbers rounding is no longer relative.
            let is_rounding = change <= ROUNDING * scale || change <= f64::MIN_POSITIVE;
            if is_rounding && change >= before || change == 0.0 {
                return z + sum(&self.b, &k) * h;
            }
            before = change;
        }
        z + k[0] * f64::NAN
    }
    // ANCHOR_END: step
}

/// Σ weightᵢ kᵢ.
#[inline(always)]
fn sum<D: Vector, const S: usize>(weights: &[f64; S], k: &[D; S]) -> D {
    let mut sum = k[0] * weights[0];
    for i in 1..S {
        sum = sum + k[i] * weights[i];
    }
    sum
}

#[cfg(test)]
mod tests {
    use core::array;

    use super::*;
    use crate::double_double::DoubleDouble;
    use crate::methods::gauss_4::Gauss4;
    use crate::methods::gauss_6::Gauss6;
    use crate::methods::gauss_16::Gauss16;
    use crate::methods::implicit_midpoint::ImplicitMidpoint;

    /// The coefficients of Gauss's method with twice the digits.
    struct Gauss<const S: usize> {
        a: [[DoubleDouble; S]; S],
        b: [DoubleDouble; S],
        c: [DoubleDouble; S],
    }

    fn of(n: usize) -> DoubleDouble {
        DoubleDouble::of(n as f64)
    }

    fn sum(terms: impl Iterator<Item = DoubleDouble>) -> DoubleDouble {
        terms.fold(DoubleDouble::ZERO, |sum, term| sum + term)
    }

    fn power(x: DoubleDouble, n: usize) -> DoubleDouble {
        (0..n).fold(DoubleDouble::ONE, |product, _| product * x)
    }

    /// Legendre's polynomial of `degree` at `y` and its slope there, by the recurrence of three terms.
    fn legendre(degree: usize, y: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
        let (mut before, mut value) = (DoubleDouble::ONE, y);
        for n in 2..=degree {
            let next = (of(2 * n - 1) * y * value - of(n - 1) * before) / of(n);
            (before, value) = (value, next);
        }
        let slope = of(degree) * (before - y * value) / (DoubleDouble::ONE - y * y);
        (value, slope)
    }

    impl<const S: usize> Gauss<S> {
        /// By Newton's method from the nodes of `table`, and from there on knowing no table: the weights are
        /// 1/((1 − y²) P'(y)²), and aᵢⱼ = ∫₀^cᵢ ℓⱼ, which the weights themselves integrate exactly.
        fn near(table: &ImplicitTableau<S>) -> Self {
            let y = table.c.map(|c| {
                let start = DoubleDouble::of(2.0 * c - 1.0);
                (0..3).fold(start, |y, _| {
                    let (value, slope) = legendre(S, y);
                    y - value / slope
                })
            });
            let c = y.map(|y| (y + DoubleDouble::ONE).scaled(0.5));
            let b = y.map(|y| {
                let (_, slope) = legendre(S, y);
                DoubleDouble::ONE / ((DoubleDouble::ONE - y * y) * slope.squared())
            });
            let lagrange = |j: usize, t: DoubleDouble| {
                (0..S)
                    .filter(|m| *m != j)
                    .fold(DoubleDouble::ONE, |product, m| product * ((t - c[m]) / (c[j] - c[m])))
            };
            let a = array::from_fn(|i| {
                array::from_fn(|j| c[i] * sum((0..S).map(|k| b[k] * lagrange(j, c[i] * c[k]))))
            });
            Self { a, b, c }
        }

        /// What is wrong with the simplifying assumptions, at most: B(2s), Σ bᵢ cᵢ^q⁻¹ = 1/q; C(s), Σⱼ aᵢⱼ cⱼ^q⁻¹ = cᵢ^q/q;
        /// D(s), Σᵢ bᵢ cᵢ^q⁻¹ aᵢⱼ = bⱼ(1 − cⱼ^q)/q. Together they are order 2s (Butcher 1964; Hairer, Nørsett, Wanner,
        /// *Solving Ordinary Differential Equations I*, Theorem II.7.4 and Sect. II.7).
        fn worst_defect(&self) -> f64 {
            let Self { a, b, c } = self;
            let mut worst = 0.0_f64;
            let mut meets = |left: DoubleDouble, right: DoubleDouble| {
                worst = worst.max((left - right).rounded().abs());
            };
            for q in 1..=2 * S {
                meets(sum((0..S).map(|i| b[i] * power(c[i], q - 1))), DoubleDouble::ONE / of(q));
            }
            for q in 1..=S {
                for i in 0..S {
                    let left = sum((0..S).map(|j| a[i][j] * power(c[j], q - 1)));
                    meets(left, power(c[i], q) / of(q));
                    let left = sum((0..S).map(|k| b[k] * power(c[k], q - 1) * a[k][i]));
                    meets(left, b[i] * (DoubleDouble::ONE - power(c[i], q)) / of(q));
                }
            }
            worst
        }
    }

    /// Holds a table against the coefficients with twice the digits, which hold themselves against the assumptions.
    fn check<const S: usize>(table: &ImplicitTableau<S>) {
        let gauss = Gauss::near(table);
        // A thousand roundings of 2⁻¹⁰⁴ = 5e-32, of numbers that nowhere exceed 1 by much.
        assert!(gauss.worst_defect() < 5e-29, "{S} stages: {:e}", gauss.worst_defect());
        assert!(table.c.is_sorted_by(|x, y| x < y) && table.c[0] > 0.0 && table.c[S - 1] < 1.0);
        let nearest = |x: f64, exact: DoubleDouble, what: &str| {
            assert_eq!(x.to_bits(), exact.rounded().to_bits(), "{what} of {S} stages: {x:e}");
        };
        for i in 0..S {
            nearest(table.c[i], gauss.c[i], "a node");
            nearest(table.b[i], gauss.b[i], "a weight");
            for j in 0..S {
                nearest(table.a[i][j], gauss.a[i][j], "a coefficient");
            }
        }
    }

    /// Catches: a wrong digit anywhere in a table, the last one too.
    #[test]
    fn every_coefficient_is_the_nearest_number() {
        check(&ImplicitMidpoint::TABLEAU);
        check(&Gauss4::TABLEAU);
        check(&Gauss6::TABLEAU);
        check(&Gauss16::TABLEAU);
    }

    /// Catches: assumptions that anything would meet, and digits that nobody looks at.
    #[test]
    fn a_last_digit_off_is_seen() {
        let mut gauss = Gauss::near(&Gauss6::TABLEAU);
        gauss.a[2][0] = gauss.a[2][0] + DoubleDouble::of(1e-24);
        assert!(gauss.worst_defect() > 1e-26);
        let mut table = Gauss16::TABLEAU;
        table.a[7][3] = table.a[7][3].next_up();
        assert!(std::panic::catch_unwind(|| check(&table)).is_err());
    }

    /// Symplectic: bᵢaᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ; symmetric: the table turned by half a turn is bⱼ − aᵢⱼ (Hairer, Lubich, Wanner,
    /// Theorems VI.4.3 and V.2.3). Each number is off by half a unit of its last place, 5.6e-17 at the most, and so is
    /// each product.
    ///
    /// Catches: rows in another order than weights or nodes.
    #[test]
    fn the_tables_are_symplectic_and_symmetric() {
        fn check<const S: usize>(table: &ImplicitTableau<S>) {
            let ImplicitTableau { a, b, .. } = table;
            for i in 0..S {
                for j in 0..S {
                    let defect = b[i] * a[i][j] + b[j] * a[j][i] - b[i] * b[j];
                    assert!(defect.abs() < 3.0 * 5.6e-17, "{defect:e} at {i}, {j} of {S}");
                    let turned = a[S - 1 - i][S - 1 - j] + a[i][j] - b[j];
                    assert!(turned.abs() < 3.0 * 5.6e-17, "{turned:e} at {i}, {j} of {S}");
                }
            }
        }
        check(&ImplicitMidpoint::TABLEAU);
        check(&Gauss4::TABLEAU);
        check(&Gauss6::TABLEAU);
        check(&Gauss16::TABLEAU);
    }
}
