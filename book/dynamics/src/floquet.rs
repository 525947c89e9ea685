//! Periodic orbits of driven systems, and whether they attract.

use pendula::{Driven, Method, Phase};

use crate::linearised::Linearised;
use crate::root::root;
use crate::stroboscope::Stroboscope;
use crate::variation::{Bundle, Variational};

/// The monodromy matrix: the linear map of small displacements from an orbit over its period, by
/// its two columns.
///
/// Its eigenvalues are the Floquet multipliers. Their product is the determinant, their sum the
/// trace; the orbit attracts if both lie inside the unit circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Monodromy {
    /// The image of a unit displacement of θ.
    pub of_theta: Phase,
    /// The image of a unit displacement of ω.
    pub of_omega: Phase,
}

impl Monodromy {
    /// The factor by which area in phase space grows.
    pub fn determinant(&self) -> f64 {
        self.of_theta.theta * self.of_omega.omega - self.of_omega.theta * self.of_theta.omega
    }

    /// The sum of the multipliers.
    pub fn trace(&self) -> f64 {
        self.of_theta.theta + self.of_omega.omega
    }

    /// (μ₁ − s)(μ₂ − s), with μ the multipliers: zero where s is one of them.
    ///
    /// A multiplier of 1 is where two orbits meet and vanish, or one splits; a multiplier of −1
    /// where an orbit doubles its period.
    pub fn characteristic(&self, s: f64) -> f64 {
        s * s - s * self.trace() + self.determinant()
    }

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
}

/// The factor by which area in phase space shrinks in a period of the drive, exp(−2β · 2π/Ω): the
/// determinant of every monodromy matrix (Liouville's formula; the divergence of the flow is −2β
/// everywhere).
pub fn contraction(driven: &Driven) -> f64 {
    libm::exp(-2.0 * driven.damped().damping() * driven.period())
}

/// A periodic orbit of a driven system, seen by its stroboscope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicOrbit {
    /// One of its points.
    pub point: Phase,
    /// The number of periods of the drive after which it returns there.
    pub periods: u32,
    /// The linear map of its neighbours over that time.
    pub monodromy: Monodromy,
}

/// Newton steps before the search for an orbit stops: from a good guess five are enough.
const PATIENCE: u32 = 30;

/// The size (rad) of the last Newton step: the next would be rounding.
const SETTLED: f64 = 1e-13;

/// The orbit near `guess` that returns after `periods` periods of the drive, attracting or not, by
/// Newton's method on the stroboscopic map. The angle is not reduced, so that an orbit that goes
/// over the top does not return.
///
/// `None` if it does not converge: there may be no such orbit near.
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

/// The state `periods` periods after `point`, and the linear map of its neighbours.
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

/// The parameter between `low` and `high` at which an orbit doubles its period: one of its
/// multipliers is −1.
///
/// `orbit` finds the orbit for a parameter, near a given point. From `low` to `high` the orbit is
/// continued in `paces` equal paces, small enough that Newton's method does not stray to another
/// orbit; then a root finder narrows the pace within which a multiplier passes −1. `None` if an
/// orbit is lost, or if no multiplier passes −1.
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
