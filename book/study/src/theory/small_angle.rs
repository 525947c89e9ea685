//! The small swing of Table 6: the error of each method's angle against θ₀ cos ω₀t.
//!
//! Two errors add. The method has the wrong phase even on the linear oscillator, and the formula
//! ignores the longer period of the pendulum. To leading order e(t) = (c₁t + c₀) sin ω₀t: c₁ is
//! θ₀ω₀(θ₀²/16 − x²/24) for Störmer–Verlet and symplectic Euler and θ₀ω₀(θ₀²/16 + x⁴/120) for RK4;
//! c₀ is −θ₀x/2 for symplectic Euler and 0 for the others.
//!
//! The sums here use the whole linear recurrence. On the linear oscillator every method multiplies
//! a complex amplitude by ρ e^{iφ} each step; the pendulum slows φ by the factor 1 − A²/16 at the
//! amplitude A, and bends the cosine by a third harmonic (Landau & Lifshitz, *Mechanics* (1976),
//! §28):
//!
//! θ = A cos Φ − (A³/192) (cos 3Φ − cos Φ).

use pendula::arithmetic::sine::cos;
use pendula::systems::LinearOscillator;
use pendula::{Pendulum, Phase};

use super::scaled;

/// What one step of a method does to the linear oscillator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRecurrence {
    /// The factor ρ on the amplitude.
    pub growth: f64,
    /// The phase φ of one step (rad), ω₀h for the exact flow.
    pub advance: f64,
    /// The phase at a release from rest (rad): where on its ellipse the method starts.
    pub lag: f64,
}

impl LinearRecurrence {
    /// Forward Euler: 1 + ix.
    pub fn forward_euler(pendulum: &Pendulum, h: f64) -> Self {
        Self::multiplying_by(1.0, scaled(pendulum, h))
    }

    /// RK4: 1 + ix − x²/2 − ix³/6 + x⁴/24.
    pub fn rk4(pendulum: &Pendulum, h: f64) -> Self {
        let x = scaled(pendulum, h);
        let x2 = x * x;
        Self::multiplying_by(1.0 - x2 / 2.0 + x2 * x2 / 24.0, x * (1.0 - x2 / 6.0))
    }

    /// Störmer–Verlet: θₙ₊₁ − 2θₙ + θₙ₋₁ = −x²θₙ, so that sin(φ/2) = x/2.
    pub fn stormer_verlet(pendulum: &Pendulum, h: f64) -> Self {
        let advance = 2.0 * libm::asin(0.5 * scaled(pendulum, h));
        Self { growth: 1.0, advance, lag: 0.0 }
    }

    /// Symplectic Euler: the same recurrence, begun half a step late, as it drifts with the
    /// velocity after the kick.
    pub fn symplectic_euler(pendulum: &Pendulum, h: f64) -> Self {
        let verlet = Self::stormer_verlet(pendulum, h);
        Self { lag: 0.5 * verlet.advance, ..verlet }
    }

    fn multiplying_by(real: f64, imaginary: f64) -> Self {
        Self {
            growth: libm::sqrt(real * real + imaginary * imaginary),
            advance: libm::atan2(imaginary, real),
            lag: 0.0,
        }
    }

    /// The angles (rad) from rest at `theta_0` (rad), step by step, on the pendulum to order θ₀³.
    pub fn angles(self, theta_0: f64) -> impl Iterator<Item = f64> {
        let mut amplitude = theta_0 / cos(self.lag);
        // The lag is part of a step's advance, and the pendulum slows it too.
        let mut phase = self.lag * slowed(amplitude);
        core::iter::from_fn(move || {
            let bend = amplitude * amplitude / 192.0;
            let angle = amplitude * (cos(phase) - bend * (cos(3.0 * phase) - cos(phase)));
            phase += self.advance * slowed(amplitude);
            amplitude *= self.growth;
            Some(angle)
        })
    }
}

/// The factor on the frequency at that amplitude (rad), to order A².
fn slowed(amplitude: f64) -> f64 {
    1.0 - amplitude * amplitude / 16.0
}

/// Root mean square, over the N + 1 samples of the first `steps` steps of `h` (s), and largest
/// value of the error of `angles` (rad) against θ₀ cos ω₀t (rad).
pub fn errors(
    pendulum: &Pendulum,
    theta_0: f64,
    h: f64,
    steps: u64,
    angles: impl Iterator<Item = f64>,
) -> (f64, f64) {
    let formula = LinearOscillator::new(*pendulum);
    let (mut squares, mut largest) = (0.0, 0.0);
    for (n, angle) in (0..=steps).zip(angles) {
        let error = angle - formula.exact(Phase::at_rest(theta_0), n as f64 * h).theta;
        squares += error * error;
        largest = f64::max(largest, libm::fabs(error));
    }
    (libm::sqrt(squares / (steps + 1) as f64), largest)
}

/// The root mean square (rad) that is left at h → 0 after the time `duration` (s), θ₀³ω₀t/(16√6):
/// the paper's "floor". It is the formula's error, not a method's, and grows with time.
pub fn floor(pendulum: &Pendulum, theta_0: f64, duration: f64) -> f64 {
    let frequency = pendulum.small_angle_frequency();
    theta_0 * theta_0 * theta_0 * frequency * duration / (16.0 * libm::sqrt(6.0))
}

/// The root mean square (rad) of Störmer–Verlet's own error, against the pendulum it integrates,
/// after the time `duration` (s): θ₀ω₀t x²/(24√6) with the step `h` (s). Its phase is ahead by the
/// fraction x²/24, as the formula's is by θ₀²/16.
pub fn own_error_of_stormer_verlet(
    pendulum: &Pendulum,
    theta_0: f64,
    h: f64,
    duration: f64,
) -> f64 {
    let x = scaled(pendulum, h);
    let frequency = pendulum.small_angle_frequency();
    libm::fabs(theta_0) * frequency * duration * x * x / (24.0 * libm::sqrt(6.0))
}

/// The step (s) at which Störmer–Verlet's error cancels the formula's and c₁ vanishes: x =
/// θ₀√(3/2).
pub fn cancelling_step(pendulum: &Pendulum, theta_0: f64) -> f64 {
    libm::fabs(theta_0) * libm::sqrt(1.5) / pendulum.small_angle_frequency()
}
