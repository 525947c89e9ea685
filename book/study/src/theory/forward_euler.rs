//! Forward Euler: the equation it follows, and the regimes it passes through as its energy grows.
//!
//! A step z + x f(z), f = (q, −s), is to order x⁵ the flow over the time x of
//!
//! z' = f + x f₁ + … + x⁵ f₅,  f₁ = −½ f'f,  f₂ = ⅓ f'f'f + (1/12) f''(f, f), …
//!
//! (Hairer, Lubich, Wanner, Sect. IX.1, where the recursion is; it was carried out in exact
//! rational arithmetic). The series is asymptotic: at x = 0.3 its eighth term makes Table 4 worse.
//! Where the pendulum rotates fast, the terms of highest power in q are Bernoulli numbers over
//! factorials, and the series converges while a step turns the pendulum by less than a full turn.

use pendula::Pendulum;
use pendula::arithmetic::sine::{cos, sin};

use super::tools::flow;
use super::{Dimensionless, average, polynomial, scaled};

/// The rates θ' and q' of the equation that forward Euler follows, as coefficients of x⁰, x¹, … x⁵.
pub fn modified_equation_terms(z: Dimensionless) -> [[f64; 6]; 2] {
    let Dimensionless { q, s, c, .. } = z;
    let (q2, s2, c2) = (q * q, s * s, c * c);
    [
        [
            q,
            s / 2.0,
            -q * c / 3.0,
            -s * (q2 + 3.0 * c) / 12.0,
            q * (q2 * c + 54.0 * c2 - 18.0) / 180.0,
            -s * (q2 * q2 - 96.0 * q2 * c - 138.0 * c2 + 18.0) / 720.0,
        ],
        [
            -s,
            q * c / 2.0,
            s * (q2 + 4.0 * c) / 12.0,
            q * (1.0 - 4.0 * c2) / 12.0,
            s * (q2 * q2 - 84.0 * q2 * c - 156.0 * c2 + 12.0) / 720.0,
            -q * (2.0 * q2 * s2 + (51.0 - 111.0 * c2) * c) / 360.0,
        ],
    ]
}

/// The points that forward Euler visits from rest at `theta_0` (rad), computed from its modified
/// equation, at the times 0, h, 2h, … with the step `h` (s).
pub fn trajectory(
    pendulum: &Pendulum,
    theta_0: f64,
    h: f64,
) -> impl Iterator<Item = Dimensionless> {
    /// Steps of the solver in a step of the method: each turns the pendulum by 0.3 rad at the most.
    const SUBSTEPS: u32 = 4;
    let x = scaled(pendulum, h);
    let rate = move |[theta, q]: [f64; 2]| {
        modified_equation_terms(Dimensionless::new(theta, q)).map(|terms| polynomial(x, &terms))
    };
    let mut state = [theta_0, 0.0];
    core::iter::once(Dimensionless::new(theta_0, 0.0)).chain(core::iter::from_fn(move || {
        for _ in 0..SUBSTEPS {
            state = flow(rate, state, x / f64::from(SUBSTEPS));
        }
        Some(Dimensionless::new(state[0], state[1]))
    }))
}

/// Largest energy error (J) of a release from rest at `theta_0` (rad) over `steps` steps of `h`
/// (s).
pub fn largest_energy_error(pendulum: &Pendulum, theta_0: f64, h: f64, steps: u64) -> f64 {
    let initial = Dimensionless::new(theta_0, 0.0).energy();
    let largest = trajectory(pendulum, theta_0, h)
        .take(steps as usize + 1)
        .map(|z| libm::fabs(z.energy() - initial))
        .fold(0.0, libm::fmaximum);
    pendulum.depth() * largest
}

/// Swinging: the factor by which the energy above the bottom of a small swing grows in `steps`
/// steps of `h` (s), (1 + x²)ⁿ. On the linear oscillator it is exact: |1 + ix|² = 1 + x².
pub fn small_angle_growth(pendulum: &Pendulum, h: f64, steps: u64) -> f64 {
    let x = scaled(pendulum, h);
    libm::exp(steps as f64 * libm::log1p(x * x))
}

/// Swinging at any angle: the rate at which energy is gained (W), to order h, dE/dt = m g L ω₀ x
/// ⟨sin²θ⟩, averaged along the swing from `theta_0` (rad). As ⟨q² cos θ⟩ = ⟨sin²θ⟩, both halves of
/// f₁ contribute alike.
pub fn swinging_rate(pendulum: &Pendulum, theta_0: f64, h: f64) -> f64 {
    let x = scaled(pendulum, h);
    pendulum.depth()
        * pendulum.small_angle_frequency()
        * x
        * average(pendulum, theta_0, |z| z.s * z.s)
}

/// Rotating: the mean rate at which energy is gained (W) at the angular velocity `spin` (rad/s), to
/// leading order in (ω₀/Ω)²: dE/dt = m L² (ω₀⁴h/2) (a/2) cot(a/2), where a = Ωh is the angle
/// turned in a step.
///
/// A kick δω = −hω₀² sin θ changes ω²/2 by ω δω + δω²/2. On θₙ = na sums of kicks are geometric: ω
/// ripples about Ω by hω₀² cos(θ − a/2)/(2 sin(a/2)), whose part of ⟨ω δω⟩ cancels ⟨δω²⟩/2; θ
/// ripples by h²ω₀² sin(θ − a)/(4 sin²(a/2)), which leaves Ω⟨δω⟩ = (h²ω₀⁴/4) a cot(a/2). For small
/// a the rate is ω₀⁴h/2; at a = π, half a turn a step, it vanishes: there forward Euler locks.
pub fn rotating_rate(pendulum: &Pendulum, spin: f64, h: f64) -> f64 {
    let a = spin * h;
    let half = 0.5 * a;
    let cotangent = cos(half) / sin(half);
    let inertia = pendulum.mass() * pendulum.length() * pendulum.length();
    let frequency_squared = pendulum.frequency_squared();
    0.5 * inertia * frequency_squared * frequency_squared * h * half * cotangent
}

/// Saturated: the kinetic energy (J) at which it locks, half a turn a step, m L² (π/h)²/2.
pub fn saturation_energy(pendulum: &Pendulum, h: f64) -> f64 {
    let spin = core::f64::consts::PI / h;
    0.5 * pendulum.mass() * pendulum.length() * pendulum.length() * spin * spin
}
