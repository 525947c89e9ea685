//! Polynomials through measured values, and least squares.

/// The nodes of Chebyshev in (0, `longest`).
pub fn nodes<const N: usize>(longest: f64) -> [f64; N] {
    core::array::from_fn(|i| {
        let angle = core::f64::consts::PI * (i as f64 + 0.5) / N as f64;
        0.5 * longest * (1.0 - libm::cos(angle))
    })
}

/// Weights of the values at the nodes whose sums are the coefficients of 1, x, x², … of the
/// polynomial through them: by Lagrange's polynomials, multiplied out.
pub fn weights<const N: usize, const K: usize>(nodes: &[f64; N]) -> [[f64; N]; K] {
    let mut weights = [[0.0; N]; K];
    for (i, &node) in nodes.iter().enumerate() {
        // The low coefficients of Π (x − xⱼ)/(xᵢ − xⱼ).
        let mut product = [0.0; K];
        product[0] = 1.0;
        for (j, &other) in nodes.iter().enumerate() {
            if i != j {
                for k in (0..K).rev() {
                    let lower = if k == 0 { 0.0 } else { product[k - 1] };
                    product[k] = (lower - other * product[k]) / (node - other);
                }
            }
        }
        for (row, coefficient) in weights.iter_mut().zip(product) {
            row[i] = coefficient;
        }
    }
    weights
}

/// The factors with which the `columns` come nearest to `values`, by the normal equations; not
/// finite where columns depend on each other.
pub fn least_squares(columns: &[Vec<f64>], values: &[f64]) -> Vec<f64> {
    let n = columns.len();
    let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut rows: Vec<Vec<f64>> = columns
        .iter()
        .map(|column| {
            let others = columns.iter().map(|other| product(column, other));
            others.chain([product(column, values)]).collect()
        })
        .collect();
    // Positive definite: no pivoting.
    for i in 0..n {
        let (above, below) = rows.split_at_mut(i + 1);
        for row in below {
            let factor = row[i] / above[i][i];
            for (entry, by) in row[i..].iter_mut().zip(&above[i][i..]) {
                *entry -= factor * by;
            }
        }
    }
    let mut factors = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| rows[i][j] * factors[j]).sum();
        factors[i] = (rows[i][n] - known) / rows[i][i];
    }
    factors
}

/// The largest part of `values` that the columns with these factors leave; NaN if there is one.
pub fn residual(columns: &[Vec<f64>], factors: &[f64], values: &[f64]) -> f64 {
    let left = values.iter().enumerate().map(|(k, value)| {
        let sum: f64 = columns.iter().zip(factors).map(|(column, f)| f * column[k]).sum();
        (value - sum).abs()
    });
    left.fold(0.0, libm::fmaximum)
}
