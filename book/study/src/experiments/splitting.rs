//! How far apart Störmer–Verlet tears the separatrix, measured in double-double.
//!
//! The pendulum's separatrix leads from the upper equilibrium to the upper equilibrium. Of the
//! method's orbits those that leave it lie on one curve and those that arrive on another, and the
//! two cross at the bottom at an angle: the chaotic layer of the standard map is about them. With
//! e^λ for the factor by which the method leaves the equilibrium in a step, 2 sinh(λ/2) = x, the
//! invariant of the crossing (the area that is spanned by both curves' velocities, in θ and u = xq)
//! is
//!
//! (4π/λ²) e^{−π²/λ} (Θ + O(λ²)),  Θ = 1118.8277…
//!
//! (Lazutkin 1984; V. G. Gelfreich, *Commun. Math. Phys.* 201 (1999) 155).

use core::f64::consts::PI;

use pendula::arithmetic::double_double::DoubleDouble;
use pendula::methods::StormerVerlet;
use pendula::{Grid, integrate};

use super::precise::{Point, Precise};

/// Θ above.
pub const LAZUTKIN: f64 = 1_118.827_706;

/// λ for the step x = ω₀h.
pub fn exponent(x: f64) -> f64 {
    2.0 * libm::asinh(0.5 * x)
}

/// The slope −dq/dθ at the bottom, in steps of `x`, of the curve of orbits that leave the upper
/// equilibrium. The curve of those that arrive is its mirror image, so that for a separatrix it
/// would be 0.
///
/// An orbit that begins on the line along which the equilibrium is left is on the curve but for the
/// cube of its distance, about 1e-27, and comes closer with every step; the distance is chosen such
/// that the orbit passes the bottom after a whole number of steps. (Half a step later the two
/// curves cross again, the other way round.) Below x = 0.17 the result is lost in rounding.
pub fn slope(x: f64) -> f64 {
    // The matrix of a step at the top has the trace 2 + x² and sends (1, s) to a multiple of it,
    // with s² = 1 + x²/4.
    let quarter = DoubleDouble::product(x, x).scaled(0.25);
    let direction = [DoubleDouble::ONE, (DoubleDouble::ONE + quarter).sqrt()];
    let steps = libm::round(22.0 / exponent(x));
    let grid = Grid::new(x, steps as u64).expect("a positive step");
    // On the separatrix 4 atan eᵗ, until π at t = 0.
    let mut distance = DoubleDouble::new(4.0 * libm::exp(-steps * exponent(x)));
    let end = |distance: DoubleDouble| {
        let start = Point {
            theta: distance - DoubleDouble::HALF_PI.scaled(2.0),
            q: distance * direction[1],
            beside: direction,
        };
        integrate(&Precise, &StormerVerlet, start, &grid, &mut ())
    };
    // Newton's iteration doubles the digits.
    for _ in 0..7 {
        let end = end(distance);
        distance = distance - end.theta / end.beside[0];
    }
    let [theta, q] = end(distance).beside;
    -(q / theta).rounded()
}

/// Θ as the slope at the step `x` has it.
///
/// By symmetry the velocities of the two curves at the bottom are (v, ∓vs) with the slope s and v =
/// 2 + O(x²), in θ and q: together they span 2v²s, and x times that in θ and u.
pub fn lazutkin(x: f64) -> f64 {
    let lambda = exponent(x);
    x * 8.0 * slope(x) * lambda * lambda / (4.0 * PI) * libm::exp(PI * PI / lambda)
}

/// The slope as an energy (m g L): as time passes along one of the curves, its energy beside that
/// of the other is a wave with a period of a step, whose amplitude this is. Where the wave passes
/// zero it rises at the rate 2π/x times its amplitude, and that is what the velocities span.
pub fn energy(x: f64) -> f64 {
    8.0 * slope(x) * x / (2.0 * PI)
}
