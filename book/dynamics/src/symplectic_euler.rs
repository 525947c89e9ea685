//! Symplectic Euler, kick then drift: the energy it conserves, and the error of the pendulum's
//! energy.
//!
//! A step is exp(xD_V) exp(xD_T), the kick and the drift as flows of V = −c and T = q²/2. By the
//! Baker–Campbell–Hausdorff formula it is exp(xD_H̃) with
//!
//! H̃ = T + V + (x/2) [T, V] + (x²/12) ([T, [T, V]] + [V, [V, T]]) + …,
//!
//! in Poisson brackets (Hairer, Lubich, Wanner, Sect. IX.4, Example IX.3.4). Every bracket is a
//! polynomial in q, s and c.
//!
//! The brackets up to x⁷ were expanded in exact rational arithmetic with Varadarajan's recursion
//! for the formula (ibid., Eq. III.4.11; *Lie Groups, Lie Algebras, and Their Representations*
//! (1984), Sect. 2.15). In the coordinates of Störmer–Verlet, which is symmetric, the odd powers
//! vanish: so each odd term follows from the even ones before it.

use pendula::{Pendulum, Phase};

use crate::level_curve;
use crate::point::{Dimensionless, polynomial, scaled};

/// The terms of the conserved energy H̃ = H + x H₁ + x² H₂ + … at `z`, from H₁ to H₇, in units of m
/// g L.
pub fn modified_hamiltonian_terms(z: Dimensionless) -> [f64; 7] {
    let Dimensionless { q, s, c, .. } = z;
    let (q2, s2, c2) = (q * q, s * s, c * c);
    [
        -q * s / 2.0,
        (q2 * c + s2) / 12.0,
        -q * s * c / 12.0,
        (q2 * q2 * c + 6.0 * q2 * (3.0 * c2 - 1.0) + 12.0 * c * s2) / 720.0,
        -q * s * (q2 * c + 9.0 * c2 - 3.0) / 360.0,
        q2 * c * (q2 * q2 + 54.0 * (5.0 * c2 - 3.0)) / 30240.0
            + q2 * q2 * (27.0 * c2 - 11.0) / 10080.0
            + s2 * (13.0 * c2 - 4.0) / 2520.0,
        -q * s * (q2 * q2 * c + 2.0 * q2 * (27.0 * c2 - 11.0) + 4.0 * c * (26.0 * c2 - 17.0))
            / 10080.0,
    ]
}

/// H̃ at `z`, above the bottom of H, to the given order in the step `h` (s), in J; to order 0 it is
/// H.
pub fn modified_energy(order: usize, pendulum: &Pendulum, h: f64, z: Phase) -> f64 {
    let (x, z) = (scaled(pendulum, h), Dimensionless::from_phase(pendulum, z));
    pendulum.depth() * (z.energy() + correction_to_order(order, z, x))
}

/// H̃ − H at `z` for the step `x`, to order x⁷, in units of m g L.
pub fn correction(z: Dimensionless, x: f64) -> f64 {
    correction_to_order(7, z, x)
}

/// H̃ − H at `z` for the step `x`, to the given order in x, at most 7, in units of m g L.
pub fn correction_to_order(order: usize, z: Dimensionless, x: f64) -> f64 {
    let terms = modified_hamiltonian_terms(z);
    x * polynomial(x, terms.get(..order).unwrap_or(&terms))
}

/// Largest energy error (J) of a swing released from rest at `theta_0` (rad), with the step `h`
/// (s): the maximum of |H − H₀| on the level curve of H̃, to order h⁷.
pub fn largest_energy_error(pendulum: &Pendulum, theta_0: f64, h: f64) -> f64 {
    let x = scaled(pendulum, h);
    pendulum.depth() * level_curve::largest_energy_error(theta_0, |z| correction(z, x))
}

/// The level curve of H̃, to order h⁷, through a release from rest at `theta_0` (rad) with the step
/// `h` (s): `count` points in phase space, the first repeated at the end. NaN where the curve
/// leaves the well.
pub fn level_curve(
    pendulum: &Pendulum,
    theta_0: f64,
    h: f64,
    count: u32,
) -> impl Iterator<Item = Phase> {
    level_curve_to_order(7, pendulum, theta_0, h, count)
}

/// [`level_curve()`] to the given order in h, at most 7; to order 0 it is the true orbit.
pub fn level_curve_to_order(
    order: usize,
    pendulum: &Pendulum,
    theta_0: f64,
    h: f64,
    count: u32,
) -> impl Iterator<Item = Phase> {
    let x = scaled(pendulum, h);
    let correction = move |z| correction_to_order(order, z, x);
    level_curve::points(theta_0, correction, count).map(|z| z.phase(pendulum))
}
