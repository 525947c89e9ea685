//! The precession of a Kepler ellipse under Störmer–Verlet.
//!
//! In velocity form the method conserves H + h² (v·V″v/12 − |V′|²/24) + O(h⁴) for a particle of
//! unit mass (Hairer, Lubich, Wanner (2006), Ch. IX), here with V = −μ/r. On an ellipse of energy
//! E = −μ/2a and angular momentum l that correction is
//!
//! h² \[−μE/(3r³) − 3μ²/(8r⁴) + μl²/(4r⁵)\],
//!
//! and its mean over a revolution, with η = √(1 − e²), is h² (μ²/a⁴) (3η⁻⁵ − η⁻³)/48. The
//! pericentre turns at the rate of the derivative of this mean with respect to l = η √(μa) at
//! constant a: first-order perturbation theory in Delaunay's variables.

use core::f64::consts::PI;

use pendula::systems::Ellipse;

/// The angle (rad) by which Störmer–Verlet with the `step` h (s) turns the pericentre in a
/// revolution: −(π/8)(nh)² (4 + e²)/(1 − e²)³ + O(h⁴), against the motion.
pub fn verlet_precession(ellipse: &Ellipse, step: f64) -> f64 {
    let x = ellipse.mean_motion() * step;
    let square = ellipse.eccentricity() * ellipse.eccentricity();
    let flat = 1.0 - square;
    -(PI / 8.0) * (x * x) * (4.0 + square) / (flat * flat * flat)
}
