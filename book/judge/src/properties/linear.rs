//! The linear oscillator: the matrix of a step.
//!
//! At θ = 2⁻⁴⁰ the sine of θ and θ are the same f64, and the pendulum *is* the linear oscillator,
//! to the last bit. In the dimensionless θ, q = ω/ω₀ and x = ω₀h, a step is a matrix of polynomials
//! in x.

use super::{CheckResult, beyond, near, pendulum, run};
use pendula::arithmetic::sine::{cos, sin};
use pendula::{AnyMethod, Phase};

/// The size of the state (rad).
const TINY: f64 = 1.0 / (1_u64 << 40) as f64;

/// The matrix ((θθ, θq), (qθ, qq)) of a linear map of (θ, q).
pub type Matrix = [[f64; 2]; 2];

/// Some twenty roundings of ε/2 each, in ω₀ and in the steps, of entries below 2.
const ROUNDING: f64 = 20.0 * f64::EPSILON;

/// The known matrix of a method, by its name.
pub fn known(name: &str, x: f64) -> Option<Matrix> {
    let x2 = x * x;
    Some(match name {
        // I + xA with A = ((0, 1), (−1, 0)).
        "forward-euler" => [[1.0, x], [-x, 1.0]],
        // Kick ((1, 0), (−x, 1)), then drift ((1, x), (0, 1)).
        "symplectic-euler" => [[1.0 - x2, x], [-x, 1.0]],
        // Half a kick, a drift, half a kick.
        "stormer-verlet" => [[1.0 - 0.5 * x2, x], [-x * (1.0 - 0.25 * x2), 1.0 - 0.5 * x2]],
        // Half a drift, a kick of x − x³/12, half a drift, with θ in units of 1 + x²/24 and q in
        // its reciprocal.
        "processed-4" => {
            let (kick, unit) = (x * (1.0 - x2 / 12.0), 1.0 + x2 / 24.0);
            let (c, s) = (1.0 - 0.5 * x * kick, x - 0.25 * x2 * kick);
            [[c, s * (unit * unit)], [-kick / (unit * unit), c]]
        }
        // I + xA + (xA)²/2 + (xA)³/6 + (xA)⁴/24 with A² = −I.
        "rk4" => {
            let (c, s) = (1.0 - x2 / 2.0 + x2 * x2 / 24.0, x - x * x2 / 6.0);
            [[c, s], [-s, c]]
        }
        // Cayley's transform, (I − xA/2)⁻¹ (I + xA/2): on a linear force the three are the same.
        "implicit-midpoint" | "trapezoidal" | "discrete-gradient" => {
            let (c, s) = ((1.0 - x2 / 4.0) / (1.0 + x2 / 4.0), x / (1.0 + x2 / 4.0));
            [[c, s], [-s, c]]
        }
        "deuflhard" | "cieslinski-ratkiewicz" => rotation(x),
        _ => return None,
    })
}

/// The exact flow: a rotation.
fn rotation(x: f64) -> Matrix {
    [[cos(x), sin(x)], [-sin(x), cos(x)]]
}

/// The product a b.
pub fn product(a: Matrix, b: Matrix) -> Matrix {
    let entry = |i: usize, k: usize| a[i][0] * b[0][k] + a[i][1] * b[1][k];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

/// The determinant.
pub fn determinant([[a, b], [c, d]]: Matrix) -> f64 {
    a * d - b * c
}

/// The trace.
pub fn trace([[a, _], [_, d]]: Matrix) -> f64 {
    a + d
}

/// The matrix of a linear `map` of states, in θ and q.
pub fn matrix_of(frequency: f64, map: impl Fn(Phase) -> Phase) -> Matrix {
    let first = map(Phase { theta: TINY, omega: 0.0 });
    let second = map(Phase { theta: 0.0, omega: TINY * frequency });
    [
        [first.theta / TINY, second.theta / TINY],
        [first.omega / TINY / frequency, second.omega / TINY / frequency],
    ]
}

/// Compares `matrix` with `expected`, entry by entry.
pub fn compare(what: &str, matrix: Matrix, expected: Matrix, tolerance: f64) -> CheckResult {
    for (i, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        near(format_args!("{what}, entry {i}{k}"), matrix[i][k], expected[i][k], tolerance)?;
    }
    Ok(())
}

/// Symmetric: with F the flip of the velocity, F M F M = I.
fn there_and_back(matrix: Matrix) -> Matrix {
    let mirrored = [[matrix[0][0], -matrix[0][1]], [-matrix[1][0], matrix[1][1]]];
    product(mirrored, matrix)
}

/// If the entry says that the method is not symplectic, or not symmetric, then `matrix`, as a
/// function of x, must show it: area is not preserved, or the way back misses the start. Where the
/// known matrix of the method preserves area, only a force that is not linear can show it.
///
/// At x = 0.3 RK4's −x⁶/72 is 1e-5, the smallest of the paper's methods. The higher the order, the
/// longer the step at which the defect shows: x²⁶/26! and similar terms, of order 24, are 0.1 at
/// x = 9.6. There the powers that add up to a matrix are as large as eˣ, and round by as much more.
pub fn check_denials(method: &dyn AnyMethod, matrix: impl Fn(f64) -> Matrix) -> CheckResult {
    let entry = method.info();
    let ladder =
        || [0.3, 0.6, 1.2, 2.4, 4.8, 9.6].map(|x: f64| (matrix(x), ROUNDING * libm::exp(x)));
    // A defect above rounding counts, but not in the large matrix of a step that is far too long.
    let moderate = |matrix: &Matrix| matrix.as_flattened().iter().all(|x| x.abs() < 2.0);
    let largest = |defect: fn(Matrix) -> f64| {
        let rungs = ladder().into_iter().filter(|(matrix, _)| moderate(matrix));
        rungs.map(|(matrix, rounding)| defect(matrix) / rounding).fold(0.0, f64::max)
    };
    let keeps_area = |matrix: Matrix| (determinant(matrix) - 1.0).abs() < ROUNDING;
    if !entry.symplectic && !known(entry.name, 0.6).is_some_and(keeps_area) {
        beyond("|det − 1| in roundings", largest(|m| (determinant(m) - 1.0).abs()), 1e6)?;
    }
    if !entry.symmetric {
        let miss = |m| {
            let [[a, b], [c, d]] = there_and_back(m);
            (a - 1.0).abs() + b.abs() + c.abs() + (d - 1.0).abs()
        };
        beyond("symmetric after all: the miss in roundings", largest(miss), 10.0)?;
    }
    Ok(())
}

/// Checks the matrix of one step of x: what must hold for any method, and what is known for the
/// method of this name.
pub fn check_matrix(method: &dyn AnyMethod, x: f64, matrix: Matrix) -> CheckResult {
    let entry = method.info();
    // The tolerance covers the first term of the exponential that the method may lack,
    // x^(p+1)/(p+1)!, and the term it may have instead, a few times that: symplectic Euler's is
    // twice.
    compare("near the rotation", matrix, rotation(x), libm::pow(x, f64::from(entry.order + 1)))?;
    if entry.symplectic {
        near("det − 1", determinant(matrix) - 1.0, 0.0, ROUNDING)?;
    }
    if entry.symmetric {
        compare("there and back", there_and_back(matrix), rotation(0.0), ROUNDING)?;
    }
    let Some(expected) = known(entry.name, x) else { return Ok(()) };
    near("trace", trace(matrix), trace(expected), ROUNDING)?;
    near("det", determinant(matrix), determinant(expected), ROUNDING)?;
    compare("known", matrix, expected, ROUNDING)
}

/// Whether the matrix of a step at the bottom is the known one, near the rotation, and as
/// symplectic and symmetric as the entry says.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let pendulum = pendulum();
    let frequency = pendulum.small_angle_frequency();
    let power =
        |x: f64, steps| matrix_of(frequency, |z| run(method, &pendulum, z, x / frequency, steps));
    for x in [0.3, 0.7] {
        let one = power(x, 1);
        check_matrix(method, x, one)?;
        // What a step carries to the next must not change the result.
        compare("three steps", power(x, 3), product(one, product(one, one)), 4.0 * ROUNDING)?;
    }
    check_denials(method, |x| power(x, 1))
}
