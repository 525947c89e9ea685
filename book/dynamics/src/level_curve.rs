//! The level curve of the energy that a symplectic method conserves, and the largest deviation of
//! the pendulum's energy along it.
//!
//! The curve H̃ = H̃₀ through a release from rest is computed in the coordinates (H, φ), with H =
//! 2κ²,
//!
//! sin(θ/2) = κ sin φ,  q = 2κ cos φ.
//!
//! At each φ the energy is the fixed point of H = H̃₀ − (H̃ − H), reached in a dozen iterations as
//! the correction is small. For a curve that leaves the well the result is NaN.

use pendula::arithmetic::sine::{cos, sin};

use crate::point::Dimensionless;

/// Largest |H − H₀| in units of m g L along the curve through the release from rest at `theta_0`
/// (rad); `correction` is H̃ − H.
pub fn largest_energy_error(theta_0: f64, correction: impl Fn(Dimensionless) -> f64) -> f64 {
    let deviation = deviation(theta_0, correction);
    maximum(|phi| libm::fabs(deviation(phi)))
}

/// The curve through the release from rest at `theta_0` (rad), as `count` points at evenly spaced
/// phases, the first repeated at the end.
pub fn points(
    theta_0: f64,
    correction: impl Fn(Dimensionless) -> f64,
    count: u32,
) -> impl Iterator<Item = Dimensionless> {
    let energy = Dimensionless::new(theta_0, 0.0).energy();
    let deviation = deviation(theta_0, correction);
    (0..=count).map(move |n| {
        let phi = 2.0 * core::f64::consts::PI * (f64::from(n % count) / f64::from(count));
        swinging(energy + deviation(phi), phi)
    })
}

/// H − H₀ on the curve, as a function of the phase (rad).
fn deviation(theta_0: f64, correction: impl Fn(Dimensionless) -> f64) -> impl Fn(f64) -> f64 {
    /// Enough for corrections with a slope below ½ in H: an iteration gains a bit.
    const ROUNDS: usize = 60;
    let start = Dimensionless::new(theta_0, 0.0);
    let (energy, offset) = (start.energy(), correction(start));
    move |phi: f64| {
        let mut deviation = 0.0;
        for _ in 0..ROUNDS {
            let next = offset - correction(swinging(energy + deviation, phi));
            if next == deviation {
                break;
            }
            deviation = next;
        }
        deviation
    }
}

/// The point at the phase `phi` (rad) of the exact orbit with that energy.
fn swinging(energy: f64, phi: f64) -> Dimensionless {
    let kappa = libm::sqrt(0.5 * energy);
    let (sine, cosine) = (sin(phi), cos(phi));
    Dimensionless::new(2.0 * libm::asin(kappa * sine), 2.0 * kappa * cosine)
}

/// The largest value of a smooth function of period 2π: the best of a coarse grid, then a
/// golden-section search around it.
fn maximum(f: impl Fn(f64) -> f64) -> f64 {
    /// The spacing is a third of the distance between neighbouring extrema of a harmonic of
    /// order 20.
    const GRID: u32 = 128;
    /// 0.618³⁸ of the bracket is below √ε, within which a maximum is flat.
    const SECTIONS: usize = 38;
    let spacing = 2.0 * core::f64::consts::PI / f64::from(GRID);
    let best = (0..GRID)
        .map(|n| spacing * f64::from(n))
        .max_by(|&a, &b| f(a).total_cmp(&f(b)))
        .unwrap_or(f64::NAN);
    let golden = 0.5 * (libm::sqrt(5.0) - 1.0);
    let (mut low, mut high) = (best - spacing, best + spacing);
    for _ in 0..SECTIONS {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if f(left) > f(right) {
            high = right;
        } else {
            low = left;
        }
    }
    f(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The highest of six maxima is found, to rounding.
    ///
    /// Catches: a grid that misses it, a bracket that does not contain it.
    #[test]
    fn the_highest_of_many_maxima_is_found() {
        for shift in [0.1, 1.3, 2.9, 4.4, 6.1] {
            let f = |phi: f64| cos(6.0 * (phi - shift)) + 0.1 * cos(phi - shift);
            assert!((maximum(f) - 1.1).abs() < 1e-13, "{} at {shift}", maximum(f));
        }
    }
}
