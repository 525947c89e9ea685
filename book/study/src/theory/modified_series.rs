//! Störmer–Verlet's modified energy H̃ = H + x²H₂ + x⁴H₄ + … to any order, by recursion.
//!
//! A step S = exp(xD_V/2) exp(xD_T) exp(xD_V/2) is the flow of Z = xH̃ for a unit of time. With L
//! for the logarithmic derivative S'S⁻¹ by x, and D for the bracket with Z,
//!
//! Z' = D/(eᴰ − 1) L = (D/sinh D) M, M = (L + S⁻¹S')/2,
//!
//! since S⁻¹S' = e⁻ᴰL (Hairer, Lubich, Wanner, Sect. III.4, Lemma 4.2 and what follows it). S is
//! symmetric, so that S⁻¹S' is L at −x, and M the even part of
//!
//! L = V/2 + e^{xad V/2} (T + e^{xad T} V/2).
//!
//! Each order of Z' needs only lower ones of Z. The coefficients are rational numbers, here in
//! double-double.
//!
//! With T = q²/2 and V = −cos θ a bracket of a T's and b V's is q to the power a − b + 1 times a
//! sum of e^{imθ}, with |m| ≤ b and m − b even. In r = −iq and u = e^{iθ} everything is real:
//! T = −r²/2, V = −(u + 1/u)/2, and the bracket of uᵐrᵖ with uⁿrᵏ is (mk − pn) uᵐ⁺ⁿrᵖ⁺ᵏ⁻¹.

use pendula::internals::double_double::DoubleDouble;

/// A sum of brackets of T and V, each with the same number `brackets` of brackets: for each number
/// b of V's the coefficients of u⁻ᵇ, u²⁻ᵇ, …, uᵇ, times a power of r.
#[derive(Clone, Debug)]
struct Polynomial {
    brackets: usize,
    rows: Vec<Vec<DoubleDouble>>,
}

impl Polynomial {
    fn zero(brackets: usize) -> Self {
        let rows = (0..=brackets / 2 + 1).map(|b| vec![DoubleDouble::ZERO; b + 1]).collect();
        Self { brackets, rows }
    }

    /// T, the kinetic energy.
    fn kinetic() -> Self {
        let mut kinetic = Self::zero(0);
        kinetic.rows[0][0] = DoubleDouble::new(-0.5);
        kinetic
    }

    /// V, the potential energy.
    fn potential() -> Self {
        let mut potential = Self::zero(0);
        potential.rows[1] = vec![DoubleDouble::new(-0.5); 2];
        potential
    }

    /// The power of r (and of q) in the row of `b` V's: there are `brackets` + 1 − b T's.
    fn power(&self, b: usize) -> usize {
        self.brackets + 2 - 2 * b
    }

    // ANCHOR: bracket
    /// Adds the Poisson bracket of `a` with `b`.
    fn add_bracket(&mut self, a: &Self, b: &Self) {
        for (i, row_a) in a.rows.iter().enumerate() {
            for (j, row_b) in b.rows.iter().enumerate() {
                let (p, k) = (a.power(i) as i32, b.power(j) as i32);
                if p + k == 0 {
                    continue;
                }
                let row = &mut self.rows[i + j];
                for (s, x) in row_a.iter().enumerate() {
                    let m = 2 * s as i32 - i as i32;
                    for (t, y) in row_b.iter().enumerate() {
                        let n = 2 * t as i32 - j as i32;
                        let factor = DoubleDouble::new(f64::from(m * k - p * n));
                        row[s + t] = row[s + t] + factor * *x * *y;
                    }
                }
            }
        }
    }
    // ANCHOR_END: bracket

    fn add_times(&mut self, factor: DoubleDouble, other: &Self) {
        for (row, other) in self.rows.iter_mut().zip(&other.rows) {
            for (x, y) in row.iter_mut().zip(other) {
                *x = *x + factor * *y;
            }
        }
    }

    fn times(mut self, factor: DoubleDouble) -> Self {
        self.rows.iter_mut().flatten().for_each(|x| *x = *x * factor);
        self
    }
}

/// A series in x: the coefficient of xⁿ has n brackets.
type Series = Vec<Polynomial>;

fn bracket(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let mut sum = Polynomial::zero(a.brackets + b.brackets + 1);
    sum.add_bracket(a, b);
    sum
}

/// exp(x `share` ad `of`) applied to a series.
fn exponential(of: &Polynomial, share: f64, series: &Series) -> Series {
    let (mut sum, mut term) = (series.clone(), series.clone());
    for k in 1..series.len() {
        let factor = DoubleDouble::new(share) / DoubleDouble::new(k as f64);
        // One bracket more each time, and one power of x.
        term = term[..term.len() - 1].iter().map(|p| bracket(of, p).times(factor)).collect();
        for (n, p) in term.iter().enumerate() {
            sum[n + k].add_times(DoubleDouble::ONE, p);
        }
    }
    sum
}

/// A series with one term.
fn constant(term: &Polynomial, length: usize) -> Series {
    let higher = (1..length).map(Polynomial::zero);
    core::iter::once(term.clone()).chain(higher).collect()
}

/// L of the text above, up to xⁿ with n below `length`.
fn logarithmic_derivative(length: usize) -> Series {
    let (kinetic, potential) = (Polynomial::kinetic(), Polynomial::potential());
    let half = potential.clone().times(DoubleDouble::new(0.5));
    let mut series = exponential(&kinetic, 1.0, &constant(&half, length));
    series[0].add_times(DoubleDouble::ONE, &kinetic);
    let mut series = exponential(&potential, 0.5, &series);
    series[0].add_times(DoubleDouble::ONE, &half);
    series
}

/// The coefficients of y⁰, y², … in y/sinh y.
fn over_sinh(count: usize) -> Vec<DoubleDouble> {
    // 1/(2j + 1)!, the coefficients of sinh y/y.
    let inverse = |j: usize| {
        let factorial = (2..=2 * j + 1).map(|k| DoubleDouble::new(k as f64));
        DoubleDouble::ONE / factorial.fold(DoubleDouble::ONE, |product, k| product * k)
    };
    let mut quotient = vec![DoubleDouble::ONE];
    for n in 1..count {
        let sum = (1..=n).fold(DoubleDouble::ZERO, |sum, j| sum + inverse(j) * quotient[n - j]);
        quotient.push(-sum);
    }
    quotient
}

/// Terms of H̃ of Störmer–Verlet's velocity form.
#[derive(Clone, Debug)]
pub struct ModifiedSeries {
    /// H, H₂, H₄, ….
    terms: Vec<Polynomial>,
}

impl ModifiedSeries {
    /// H, H₂, …, up to the coefficient of xⁿ with n = `order`, an even number.
    pub fn new(order: usize) -> Self {
        let even = logarithmic_derivative(order + 1);
        let factors = over_sinh(order / 2 + 1);
        let mut terms: Vec<Polynomial> = Vec::new();
        // Dᵏ M for each k, the coefficients of xᵏ, xᵏ⁺², ….
        let mut powers: Vec<Series> = vec![Vec::new(); order + 1];
        for n in (0..=order).step_by(2) {
            // What the terms up to xⁿ⁻² make of those of M: first of odd powers, then of even ones.
            for (k, n) in odd(n).map(|k| (k, n - 1)).chain(odd(n).map(|k| (k + 1, n))) {
                let mut sum = Polynomial::zero(n);
                for (j, term) in terms.iter().enumerate().take((n - k) / 2 + 1) {
                    sum.add_bracket(term, &powers[k - 1][(n - k) / 2 - j]);
                }
                powers[k].push(sum);
            }
            powers[0].push(even[n].clone());
            let mut next = Polynomial::zero(n);
            for k in (0..=n).step_by(2) {
                next.add_times(factors[k / 2], &powers[k][(n - k) / 2]);
            }
            terms.push(next.times(DoubleDouble::ONE / DoubleDouble::new((n + 1) as f64)));
        }
        Self { terms }
    }

    /// The values of H, H₂, H₄, … in units of m g L, where q = ω/ω₀; H from the height of the
    /// pivot.
    pub fn values(&self, q: DoubleDouble, cosine: DoubleDouble) -> Vec<DoubleDouble> {
        let count = 2 * self.terms.len();
        let (squares, cosines) = (powers(q * q, count), multiples(cosine, count));
        let value = |term: &Polynomial| {
            let rows = term.rows.iter().enumerate();
            rows.fold(DoubleDouble::ZERO, |sum, (b, row)| {
                let waves = row.iter().enumerate().fold(DoubleDouble::ZERO, |sum, (j, x)| {
                    sum + *x * cosines[(2 * j).abs_diff(b)]
                });
                // rᵖ = (−q²)^{p/2}.
                let half = term.power(b) / 2;
                let sign = if half.is_multiple_of(2) { 1.0 } else { -1.0 };
                sum + waves * squares[half].scaled(sign)
            })
        };
        self.terms.iter().map(value).collect()
    }
}

/// 1, 3, …, up to n − 1.
fn odd(n: usize) -> impl Iterator<Item = usize> {
    (1..n).step_by(2)
}

/// x⁰, x¹, …, `count` of them.
fn powers(x: DoubleDouble, count: usize) -> Vec<DoubleDouble> {
    let next = |power: &DoubleDouble| Some(*power * x);
    core::iter::successors(Some(DoubleDouble::ONE), next).take(count).collect()
}

/// cos 0, cos θ, cos 2θ, …, `count` of them and at least two, from cos θ.
fn multiples(cosine: DoubleDouble, count: usize) -> Vec<DoubleDouble> {
    let mut all = vec![DoubleDouble::ONE, cosine];
    for m in 2..count {
        all.push(cosine.scaled(2.0) * all[m - 1] - all[m - 2]);
    }
    all
}
