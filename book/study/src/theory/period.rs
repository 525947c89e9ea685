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

//! The same of methods that are no such composition. The implicit midpoint rule has H₂ = −(q²c +
//! s²)/24, and from it τ₂ = ω₀² (E/(8K) − (1 + m)/24). The trapezoidal rule is that from half a
//! step of forward Euler away: from rest at the same angle with the energy higher by x²s₀²/8, which
//! makes it (ω₀²/24) (3⟨cos θ⟩ − cos θ₀). The discrete gradient follows the exact orbit at 1 −
//! (x²/12) cos θ times its pace, from f + h²f'f'f/12. In steps of (2/ω₀) tan(x/2) = h (1 + x²/12 +
//! …) it takes fewer of them by x²/12. Deuflhard's splitting into a rotation and
//! kicks by B = 1 − cos θ − θ²/2 has H₂ = (D²B + B'²/2)/12, where D is the derivative along the
//! exact motion, as Störmer–Verlet has with 1 − cos θ for B: ⟨D²B⟩ = 0.

use pendula::Pendulum;
use pendula::arithmetic::sine::{cos, sin};

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

/// The trapezoidal rule from rest at `theta_0` (rad): τ₂ = (ω₀²/24) (3⟨cos θ⟩ − cos θ₀) (1/s²),
/// twice Störmer–Verlet's with the other sign.
pub fn of_trapezoidal(pendulum: &Pendulum, theta_0: f64) -> f64 {
    -2.0 * of_stormer_verlet(pendulum, theta_0)
}

/// The implicit midpoint rule from rest at `theta_0` (rad): τ₂ = (ω₀²/48) (3⟨cos θ⟩ + cos θ₀)
/// (1/s²).
pub fn of_implicit_midpoint(pendulum: &Pendulum, theta_0: f64) -> f64 {
    let mean = average(pendulum, theta_0, |z| z.c);
    pendulum.frequency_squared() * (3.0 * mean + cos(theta_0)) / 48.0
}

/// The discrete gradient from rest at `theta_0` (rad): τ₂ = (ω₀²/12) ⟨cos θ⟩ (1/s²). It vanishes at
/// 2.2813 rad, where the cosine's mean over the swing does.
pub fn of_discrete_gradient(pendulum: &Pendulum, theta_0: f64) -> f64 {
    pendulum.frequency_squared() * average(pendulum, theta_0, |z| z.c) / 12.0
}

/// Cieśliński's and Ratkiewicz's method from rest at `theta_0` (rad): τ₂ = −(ω₀²/12) (1 − ⟨cos θ⟩)
/// (1/s²), for small swings −ω₀² θ₀²/48. It is smaller than the discrete gradient's up to 1.4988
/// rad, where the cosine's mean over the swing is a half.
pub fn of_cieslinski_ratkiewicz(pendulum: &Pendulum, theta_0: f64) -> f64 {
    of_discrete_gradient(pendulum, theta_0) - pendulum.frequency_squared() / 12.0
}

/// Deuflhard's method from rest at `theta_0` (rad), in 1/s²: with H₂ = (θ₀² − s₀²)/24 at the start
/// and ⟨(θ − s)²⟩/24 on the way,
///
/// τ₂ = (ω₀²/24) ((θ₀² − s₀²) dT/dE − d/dE ∮(θ − s)²dt)/T, where dE = s₀ dθ₀.
///
/// For small swings it is −ω₀² θ₀⁴/2304.
pub fn of_deuflhard(pendulum: &Pendulum, theta_0: f64) -> f64 {
    let period = |amplitude: f64| pendula::exact::period(pendulum, amplitude).unwrap_or(f64::NAN);
    let beyond = |amplitude: f64| {
        let mean = average(pendulum, amplitude, |z| (z.theta - z.s) * (z.theta - z.s));
        mean * period(amplitude)
    };
    // Central differences, extrapolated once: off by η⁴ of the swing or ε/η, 1e-12.
    let slope = |of: &dyn Fn(f64) -> f64| {
        let at = |eta: f64| (of(theta_0 * (1.0 + eta)) - of(theta_0 * (1.0 - eta))) / (2.0 * eta);
        (4.0 * at(1e-3) - at(2e-3)) / (3.0 * theta_0)
    };
    let sine = sin(theta_0);
    let of_the_start = (theta_0 * theta_0 - sine * sine) * slope(&period);
    let change = (of_the_start - slope(&beyond)) / (sine * period(theta_0));
    pendulum.frequency_squared() * change / 24.0
}
