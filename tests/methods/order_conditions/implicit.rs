//! The tables of the implicit methods: Gauss's against the conditions of their order, in twice the
//! digits of f64, and the trapezoidal rule's by hand.

use std::array;

use pendula::internals::double_double::DoubleDouble;
use pendula::methods::{Gauss4, Gauss6, Gauss16, ImplicitMidpoint, ImplicitTableau, Trapezoidal};

/// The coefficients of Gauss's method with twice the digits.
struct Gauss<const S: usize> {
    a: [[DoubleDouble; S]; S],
    b: [DoubleDouble; S],
    c: [DoubleDouble; S],
}

fn of(n: usize) -> DoubleDouble {
    DoubleDouble::new(n as f64)
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
    /// Newton's method starts from the nodes of `table`, and nothing else of it is used: the
    /// weights are 1/((1 − y²) P'(y)²), and aᵢⱼ = ∫₀^cᵢ ℓⱼ, which the quadrature with these weights
    /// integrates exactly.
    fn near(table: &ImplicitTableau<S>) -> Self {
        let y = table.c.map(|c| {
            let start = DoubleDouble::new(2.0 * c - 1.0);
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

    /// The largest defect in the simplifying assumptions: B(2s), Σ bᵢ cᵢ^q⁻¹ = 1/q; C(s), Σⱼ aᵢⱼ
    /// cⱼ^q⁻¹ = cᵢ^q/q; D(s), Σᵢ bᵢ cᵢ^q⁻¹ aᵢⱼ = bⱼ(1 − cⱼ^q)/q. Together they imply order 2s
    /// (Butcher 1964; Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, Theorem
    /// II.7.4 and Sect. II.7).
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

/// The parts of the weights are multiples of this. Rounded from the nearest number, which is off by
/// 2⁻⁵⁷ at most, they may be off by that much more than a half.
const UNIT: f64 = f64::EPSILON * (1.0 + 1.0 / 32.0);

/// Compares a table with the coefficients with twice the digits, which are themselves checked
/// against the simplifying assumptions.
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
            let part = gauss.a[i][j] / gauss.b[j];
            let off = (DoubleDouble::new(table.parts[i][j]) - part).rounded().abs();
            assert!(off <= 0.5 * UNIT, "a part of {S} stages: {:e}", table.parts[i][j]);
        }
    }
}

/// Catches: a wrong digit anywhere in a table, the last one too; rows in another order than weights
/// or nodes.
#[test]
fn every_coefficient_is_the_nearest_number() {
    check(&ImplicitMidpoint::TABLEAU);
    check(&Gauss4::TABLEAU);
    check(&Gauss6::TABLEAU);
    check(&Gauss16::TABLEAU);
}

/// Catches: conditions that any coefficients would meet, and digits that are not checked.
#[test]
fn a_last_digit_off_is_seen() {
    let mut gauss = Gauss::near(&Gauss6::TABLEAU);
    gauss.a[2][0] = gauss.a[2][0] + DoubleDouble::new(1e-24);
    assert!(gauss.worst_defect() > 1e-26);
    let mut table = Gauss16::TABLEAU;
    table.parts[7][3] -= f64::EPSILON;
    assert!(std::panic::catch_unwind(|| check(&table)).is_err());
}

/// The matrix of a table, bⱼ partsᵢⱼ, without a rounding.
fn matrix<const S: usize>(table: &ImplicitTableau<S>) -> [[DoubleDouble; S]; S] {
    table.parts.map(|row| array::from_fn(|j| DoubleDouble::product(row[j], table.b[j])))
}

/// What a step of the method with this matrix and these weights adds to |y|², for y' = f(y) (−y₂,
/// y₁) with f = 1 + y₁/2, whose solutions stay on circles: in twice the digits of f64.
///
/// A method keeps every quadratic form that the equation keeps if bᵢaᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ (Hairer,
/// Lubich, Wanner, *Geometric Numerical Integration*, Theorem IV.2.2), and for a method that is
/// only symmetric f is not symmetric enough.
fn growth<const S: usize>(a: &[[DoubleDouble; S]; S], b: &[f64; S]) -> f64 {
    const H: f64 = 0.25;
    let f = |y: [DoubleDouble; 2]| {
        let speed = DoubleDouble::ONE + y[0].scaled(0.5);
        [-speed * y[1], speed * y[0]]
    };
    let square = |y: [DoubleDouble; 2]| y[0].squared() + y[1].squared();
    let start = [0.75, 0.5].map(DoubleDouble::new);
    let ahead = |k: &[[DoubleDouble; 2]; S], weights: &[DoubleDouble; S]| {
        array::from_fn(|c| start[c] + sum((0..S).map(|j| weights[j] * k[j][c])).scaled(H))
    };
    let mut k = [f(start); S];
    // The slope of f is below 2, so that a sweep leaves at most half of what is missing.
    for _ in 0..120 {
        for i in 0..S {
            k[i] = f(ahead(&k, &a[i]));
        }
    }
    (square(ahead(&k, &b.map(DoubleDouble::new))) - square(start)).rounded()
}

/// The condition of symplecticity is met to the last bit, and so no energy drifts; with the nearest
/// number to each coefficient, as it is usually written down, it would.
///
/// Twice the digits leave a hundred roundings of 2⁻¹⁰⁴; a coefficient that is rounded is off by
/// some 2⁻⁵⁶.
///
/// Catches: a matrix of the nearest numbers, whose energy rises by 3.5e-19 of itself in each step
/// of Gauss 16; parts that do not add up to 1.
#[test]
fn no_rounding_of_the_coefficients_makes_the_energy_drift() {
    fn check<const S: usize>(table: &ImplicitTableau<S>) {
        for i in 0..S {
            for j in 0..S {
                // Both are multiples of 2⁻⁵² below 2, and so is their sum.
                assert_eq!(table.parts[i][j] + table.parts[j][i], 1.0, "{S} stages, {i}, {j}");
            }
        }
        let grown = growth(&matrix(table), &table.b);
        assert!(grown.abs() < 100.0 * 2.0_f64.powi(-104), "{S} stages: {grown:e}");
        // Beside weights of ½ and 1 the nearest numbers meet the condition, too.
        if S > 2 {
            let nearest = matrix(table).map(|row| row.map(|a| DoubleDouble::new(a.rounded())));
            let grown = growth(&nearest, &table.b);
            assert!(grown.abs() > 1e-22, "{S} stages, the nearest numbers: {grown:e}");
        }
    }
    check(&ImplicitMidpoint::TABLEAU);
    check(&Gauss4::TABLEAU);
    check(&Gauss6::TABLEAU);
    check(&Gauss16::TABLEAU);
}

/// Half of each end; c is the sum of a row, and the table rotated by 180° is bⱼ − aᵢⱼ, so that it
/// is symmetric. It is not symplectic: b₁a₁₁ + b₁a₁₁ − b₁² = −1/4.
///
/// Catches: another weight than a half, a node that is not the end of the step.
#[test]
fn the_trapezoidal_rule_is_half_of_each_end() {
    let ImplicitTableau { parts, b, c } = Trapezoidal::TABLEAU;
    assert_eq!((b, c), ([0.5, 0.5], [0.0, 1.0]));
    let a = parts.map(|row| [row[0] * b[0], row[1] * b[1]]);
    for i in 0..2 {
        assert_eq!(a[i][0] + a[i][1], c[i]);
        for j in 0..2 {
            assert_eq!(a[1 - i][1 - j] + a[i][j], b[j]);
        }
    }
    assert_eq!(2.0 * b[0] * a[0][0] - b[0] * b[0], -0.25);
}
