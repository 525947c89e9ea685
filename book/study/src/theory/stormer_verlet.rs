//! Störmer–Verlet: the energy it conserves, and the error of the pendulum's energy.
//!
//! The velocity form (half a kick, a drift, half a kick) is conjugate to symplectic Euler by half
//! a kick, and the position form (half a drift, a kick, half a drift) by half a drift. In
//! operators, with K for a kick and D for a drift, each of half a step,
//!
//! K DD K = K⁻¹ (KK first, then DD) K,  D KK D = D (KK first, then DD) D⁻¹,
//!
//! where the step written last is taken last. So all three conserve the same H̃, each at its
//! conjugate point, and no further polynomials are needed; in the coordinates of either Verlet form
//! the odd powers of h cancel, as they must for a symmetric method. Hairer, Lubich, Wanner, Sect.
//! V.3.3 (conjugacy), IX.2 (symmetric methods), IX.4 (the energies that splittings conserve).

use pendula::arithmetic::sine::{cos, sin};
use pendula::{Pendulum, Phase};

use super::{Dimensionless, level_curve, scaled, symplectic_euler};

/// H̃ − H of the velocity form (kick–drift–kick) at `z`, to order x⁷, in units of m g L:
/// x²(q²c/12 − s²/24) + x⁴(q⁴c/720 + q²(3c² − 1)/120 − c s²/240) + ….
pub fn correction(z: Dimensionless, x: f64) -> f64 {
    // The conjugate point: half a kick back.
    let shift = 0.5 * x * z.s;
    let kicked = Dimensionless { q: z.q + shift, ..z };
    // H there minus H here, without cancellation.
    shift * (z.q + 0.5 * shift) + symplectic_euler::correction(kicked, x)
}

/// H̃ − H of the position form (drift–kick–drift) at `z`, to order x⁷, in units of m g L: x²(s²/12
/// − q²c/24) + ….
pub fn correction_of_position_form(z: Dimensionless, x: f64) -> f64 {
    let drifted = Dimensionless::new(z.theta + 0.5 * x * z.q, z.q);
    drifted.energy() - z.energy() + symplectic_euler::correction(drifted, x)
}

/// Largest energy error (J) of the velocity form from rest at `theta_0` (rad) with the step `h`
/// (s), on the level curve of H̃ to order h⁷. Below 1 rad the [closed form](energy_error) is more
/// accurate: what it leaves out is of third order in 1 − c₀.
pub fn largest_energy_error(pendulum: &Pendulum, theta_0: f64, h: f64) -> f64 {
    let x = scaled(pendulum, h);
    pendulum.depth() * level_curve::largest_energy_error(theta_0, |z| correction(z, x))
}

/// The level curve of H̃ of the velocity form, to order h⁷, through a release from rest at
/// `theta_0` (rad) with the step `h` (s): `count` points in phase space, the first repeated at the
/// end. NaN where the curve leaves the well.
pub fn level_curve(
    pendulum: &Pendulum,
    theta_0: f64,
    h: f64,
    count: u32,
) -> impl Iterator<Item = Phase> {
    let x = scaled(pendulum, h);
    let points = level_curve::points(theta_0, move |z| correction(z, x), count);
    points.map(|z| z.phase(pendulum))
}

/// The largest energy error of the velocity form in closed form (J), m g L (1 − c₀) [x²(5 +
/// c₀)/24 + x⁴(1 − c₀)²/240].
///
/// On the exact orbit q² = 2(c − c₀), so that to order h² H − H₀ = −(x²/24)(5c + c₀)(c − c₀). Its
/// magnitude is largest at the bottom, c = 1, for every θ₀. There H̃ = H̃₀ is an equation for q²
/// alone; solved to the next order it gives x⁴, and after that x⁶(1 − c₀)²(100 + 33c₀)/30240.
pub fn energy_error(pendulum: &Pendulum, theta_0: f64, h: f64) -> f64 {
    let (x, c0) = (scaled(pendulum, h), cos(theta_0));
    let (x2, fall) = (x * x, versine(theta_0));
    pendulum.depth() * fall * x2 * ((5.0 + c0) / 24.0 + x2 * fall * fall / 240.0)
}

/// The position form's largest energy error in closed form (J), m g L (1 − c₀) [x²(2 + c₀)/12 +
/// x⁴(13 + 9c₀ + 8c₀²)/480].
///
/// It follows in the same way from H − H₀ = (x²/12)(2c + c₀)(c − c₀).
pub fn energy_error_of_position_form(pendulum: &Pendulum, theta_0: f64, h: f64) -> f64 {
    let (x, c0) = (scaled(pendulum, h), cos(theta_0));
    let (x2, fall) = (x * x, versine(theta_0));
    let second = (13.0 + c0 * (9.0 + 8.0 * c0)) / 480.0;
    pendulum.depth() * fall * x2 * ((2.0 + c0) / 12.0 + x2 * second)
}

/// 1 − cos θ, without cancellation.
fn versine(theta: f64) -> f64 {
    let s = sin(0.5 * theta);
    2.0 * s * s
}
