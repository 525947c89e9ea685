//! How much Störmer–Verlet and symplectic Euler change the period: T̃/T = 1 + h²τ₂ + O(h⁴), for
//! every amplitude.
//!
//! A perturbation H + h²H₂ changes the action J(E) = ∮ω dθ by −h²∮H₂dt at the same energy, and so
//! the period dJ/dE. For Störmer–Verlet x²H₂ = x²(q²c/12 − s²/24), and ∮q²c dt = ∮s²dt since
//! (qs)' = q²c − s². With the energy of the start, E = H₀ + x²H₂(θ₀, 0),
//!
//! x²τ₂T = −(x²/24) (s₀² dT/dE + d/dE ∮s²dt).
//!
//! In elliptic integrals of m = sin²(θ₀/2), T = 4K, s₀² dT/dE = 4(E − (1−m)K) and d/dE ∮s²dt = 4(2E
//! − K), so that τ₂ = (ω₀²/24) (2 − m − 3E/K), and as ⟨cos θ⟩ = 2E/K − 1 along the orbit, τ₂ =
//! (ω₀²/48) (cos θ₀ − 3⟨cos θ⟩).
//!
//! Symplectic Euler from rest is Störmer–Verlet from half a kick away: at the same angle with the
//! energy higher by x²s₀²/8. That adds (s₀²/8)(dT/dE)/T = (E/K − 1 + m)/8; the elliptic integrals
//! cancel, and τ₂ = −(ω₀²/24) cos θ₀ is left.
//!
//! Perturbation of the action: Landau & Lifshitz, *Mechanics* (1976), §49–50; DLMF 19.4 for the
//! derivatives of K and E.

use pendula::Pendulum;
use pendula::arithmetic::sine::cos;

use super::average;

/// Störmer–Verlet, velocity form, from rest at `theta_0` (rad): τ₂ = (ω₀²/48) (cos θ₀ − 3⟨cos θ⟩)
/// (1/s²), the mean taken over the exact swing. It vanishes at θ₀ = 2.7448 rad, where two errors
/// cancel.
pub fn of_stormer_verlet(pendulum: &Pendulum, theta_0: f64) -> f64 {
    let mean = average(pendulum, theta_0, |z| z.c);
    pendulum.frequency_squared() * (cos(theta_0) - 3.0 * mean) / 48.0
}

/// Symplectic Euler, kick then drift, from rest at `theta_0` (rad): τ₂ = −(ω₀²/24) cos θ₀ (1/s²).
/// It vanishes at θ₀ = π/2.
///
/// The amplitude is the angle of release. The numerical orbit itself swings a little further: it is
/// at rest half a kick before.
pub fn of_symplectic_euler(pendulum: &Pendulum, theta_0: f64) -> f64 {
    -pendulum.frequency_squared() * cos(theta_0) / 24.0
}
