//! Other systems: the precession of a Kepler ellipse under Störmer–Verlet, and the stability
//! boundaries of Mathieu's equation y″ + (a − 2q cos 2τ) y = 0, which is that of the upright
//! pendulum with a shaken pivot.
//!
//! Störmer–Verlet in velocity form conserves H + h² (v·V″v/12 − |V′|²/24) + O(h⁴) for a particle of
//! unit mass (Hairer, Lubich, Wanner (2006), Ch. IX), here with V = −μ/r. On an ellipse of energy
//! E = −μ/2a and angular momentum l that correction is
//!
//! h² \[−μE/(3r³) − 3μ²/(8r⁴) + μl²/(4r⁵)\],
//!
//! and its mean over a revolution, with η = √(1 − e²), is h² (μ²/a⁴) (3η⁻⁵ − η⁻³)/48. The
//! pericentre turns at the rate of the derivative of this mean with respect to l = η √(μa) at
//! constant a: first-order perturbation theory in Delaunay's variables.
//!
//! On the boundaries Mathieu's equation has a periodic solution. The coefficients of that
//! solution's Fourier series obey three-term recurrences (DLMF 28.4), so that a is an eigenvalue of
//! a symmetric tridiagonal matrix; here always the smallest.

use core::f64::consts::PI;

use pendula_dynamics::kepler::Ellipse;

/// The angle (rad) by which Störmer–Verlet with the `step` h (s) turns the pericentre in a
/// revolution: −(π/8)(nh)² (4 + e²)/(1 − e²)³ + O(h⁴), against the motion.
pub fn verlet_precession(ellipse: &Ellipse, step: f64) -> f64 {
    let x = ellipse.mean_motion() * step;
    let square = ellipse.eccentricity() * ellipse.eccentricity();
    let flat = 1.0 - square;
    -(PI / 8.0) * (x * x) * (4.0 + square) / (flat * flat * flat)
}

/// Rows of the matrix. The k-th coefficient falls as qᵏ/(4ᵏ k!²): for q ≤ 1 the tenth is below
/// 1e-18.
const ROWS: usize = 16;

/// a₀(q), of the even solution of period π: −q²/2 + 7q⁴/128 − … (DLMF 28.6(i)). Below it y grows
/// without bound.
pub fn a0(q: f64) -> f64 {
    let diagonal = |k: usize| (4 * k * k) as f64;
    // The recurrence has a factor 2 at the constant term; scaling that term by √2 makes the matrix
    // symmetric.
    let squares = |k: usize| if k == 1 { 2.0 * q * q } else { q * q };
    smallest_eigenvalue(diagonal, squares)
}

/// b₁(q), of the odd solution of period 2π: 1 − q − q²/8 + … (DLMF 28.6(i)). Above it, for q > 0, y
/// grows without bound.
pub fn b1(q: f64) -> f64 {
    let diagonal = |k: usize| if k == 0 { 1.0 - q } else { ((2 * k + 1) * (2 * k + 1)) as f64 };
    smallest_eigenvalue(diagonal, |_| q * q)
}

/// The smallest eigenvalue of the symmetric tridiagonal matrix with this diagonal and these
/// squares of the off-diagonal elements, by bisection: below it all pivots of the elimination are
/// positive (Sturm).
fn smallest_eigenvalue(diagonal: impl Fn(usize) -> f64, squares: impl Fn(usize) -> f64) -> f64 {
    let is_below = |x: f64| {
        let mut pivot = diagonal(0) - x;
        for k in 1..ROWS {
            if pivot <= 0.0 {
                return false;
            }
            pivot = diagonal(k) - x - squares(k) / pivot;
        }
        pivot > 0.0
    };
    // At most the first diagonal element, and at least that less the off-diagonal elements √s of a
    // row (Gershgorin), where √s ≤ ½ + ½s.
    let (mut low, mut high) = (diagonal(0) - 2.0 * (squares(1) + squares(2)) - 1.0, diagonal(0));
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
}
