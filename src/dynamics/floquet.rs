//! Periodic orbits of driven systems, and whether they attract.

use super::root::root;
use super::stroboscope::Stroboscope;
use super::variation::{Bundle, Linearised, Variational};
use crate::integrate::Method;
use crate::systems::Phase;

/// What becomes of small displacements from an orbit over its period: the linear map with these two
/// columns.
///
/// Its eigenvalues are the Floquet multipliers. Their product is the determinant, their sum the
/// trace; the orbit attracts if both lie inside the unit circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Monodromy {
    /// What becomes of a unit displacement of θ.
    pub of_theta: Phase,
    /// What becomes of a unit displacement of ω.
    pub of_omega: Phase,
}

impl Monodromy {
    /// The factor by which area grows.
    pub fn determinant(&self) -> f64 {
        self.of_theta.theta * self.of_omega.omega - self.of_omega.theta * self.of_theta.omega
    }

    /// The sum of the multipliers.
    pub fn trace(&self) -> f64 {
        self.of_theta.theta + self.of_omega.omega
    }

    /// (μ₁ − s)(μ₂ − s), with μ the multipliers: zero where s is one of them.
    ///
    /// With s = 1 an orbit meets another and both vanish, or two come out of one; with s = −1 it
    /// doubles its period.
    pub fn characteristic(&self, s: f64) -> f64 {
        s * s - s * self.trace() + self.determinant()
    }

    // ANCHOR: modulus
    /// The modulus of the larger multiplier: below 1 where the orbit attracts.
    pub fn largest_modulus(&self) -> f64 {
        let (half, determinant) = (0.5 * self.trace(), self.determinant());
        let square = half * half - determinant;
        if square < 0.0 {
            // A complex pair: both have the modulus √det.
            libm::sqrt(determinant)
        } else {
            half.abs() + libm::sqrt(square)
        }
    }
    // ANCHOR_END: modulus
}

/// A periodic orbit of a driven system, seen by its stroboscope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicOrbit {
    /// One of its points.
    pub point: Phase,
    /// After how many periods of the drive it is back there.
    pub periods: u32,
    /// What becomes of its neighbours in that time.
    pub monodromy: Monodromy,
}

/// Newton steps before the search for an orbit gives up: from a good guess five are enough.
const PATIENCE: u32 = 30;

/// Where a step is this small (rad), the next would be rounding.
const SETTLED: f64 = 1e-13;

// ANCHOR: newton
/// The orbit near `guess` that is back after so many `periods` of the drive, by Newton's method on
/// the stroboscopic map: whether it attracts or not. The angle counts turns, so that an orbit which
/// goes over the top is not back.
///
/// `None` if the search does not settle: there may be no such orbit near.
pub fn periodic_orbit<'a, S, M>(
    strobe: &Stroboscope<'a, S, M>,
    guess: Phase,
    periods: u32,
) -> Option<PeriodicOrbit>
where
    S: Linearised<State = Phase>,
    M: Method<Variational<'a, S, 2>>,
{
    let mut point = guess;
    for _ in 0..PATIENCE {
        let (end, monodromy) = monodromy(strobe, point, periods);
        // Solve (M − 1) step = −miss.
        let miss = Phase { theta: end.theta - point.theta, omega: end.omega - point.omega };
        let (a, b) = (monodromy.of_theta.theta - 1.0, monodromy.of_omega.theta);
        let (c, d) = (monodromy.of_theta.omega, monodromy.of_omega.omega - 1.0);
        let scale = -1.0 / (a * d - b * c);
        let step = Phase {
            theta: (d * miss.theta - b * miss.omega) * scale,
            omega: (a * miss.omega - c * miss.theta) * scale,
        };
        point = point + step;
        let size = strobe.system().size(step);
        if size <= SETTLED {
            return Some(PeriodicOrbit { point, periods, monodromy });
        }
        if !size.is_finite() {
            return None;
        }
    }
    None
}
// ANCHOR_END: newton

/// The state so many `periods` after `point`, and what becomes of its neighbours.
pub fn monodromy<'a, S, M>(
    strobe: &Stroboscope<'a, S, M>,
    point: Phase,
    periods: u32,
) -> (Phase, Monodromy)
where
    S: Linearised<State = Phase>,
    M: Method<Variational<'a, S, 2>>,
{
    let units = [Phase { theta: 1.0, omega: 0.0 }, Phase { theta: 0.0, omega: 1.0 }];
    let start = Bundle { base: point, tangents: units };
    let Bundle { base, tangents: [of_theta, of_omega] } =
        (0..periods).fold(start, |z, _| strobe.map_bundle(z));
    (base, Monodromy { of_theta, of_omega })
}

// ANCHOR: doubling
/// The parameter between `low` and `high` at which an orbit doubles its period: where one of its
/// multipliers is −1.
///
/// `orbit` gives the orbit for a parameter near one that it is given. It is led from the orbit at
/// `low` to each next one in so many even `paces`, small enough that Newton does not stray to
/// another orbit; then the pace within which a multiplier passes −1 is narrowed. `None` where an
/// orbit is lost, or where no multiplier passes −1.
pub fn period_doubling(
    mut orbit: impl FnMut(f64, Phase) -> Option<PeriodicOrbit>,
    near: Phase,
    (low, high): (f64, f64),
    paces: u32,
) -> Option<f64> {
    let mut last = near;
    let mut distance = |parameter| {
        let orbit = orbit(parameter, last)?;
        last = orbit.point;
        Some(orbit.monodromy.characteristic(-1.0))
    };
    let at = |pace: u32| low + (high - low) * (f64::from(pace) / f64::from(paces));
    let began = distance(low)?;
    for pace in 1..=paces {
        if distance(at(pace))? * began <= 0.0 {
            return root(distance, at(pace - 1), at(pace));
        }
    }
    None
}
// ANCHOR_END: doubling
