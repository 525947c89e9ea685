//! Dense output: a state at every time within a step.

use crate::systems::{State, Vector};

/// A polynomial that follows the motion through a step: a state at every time, without evaluations
/// of the force.
///
/// With a Runge–Kutta method it is in general of a lower order than the step: 4 for 5, 7 for 8.
/// With [`TaylorSeries`](super::TaylorSeries) it is the series of the step itself.
#[derive(Clone, Copy, Debug)]
pub struct Dense<Z, C> {
    t: f64,
    h: f64,
    /// The end of the step (s), which t + h may miss by rounding.
    pub(super) end: f64,
    z: Z,
    coefficients: C,
}

/// A displacement within a step, as a polynomial.
pub trait Interpolant<D> {
    /// The displacement at the fraction `s` of the step; none if there are no coefficients.
    fn displacement(&self, s: f64) -> Option<D>;
}

impl<D: Vector, const N: usize> Interpolant<D> for [D; N] {
    /// With c₁, c₂, … the coefficients it is
    ///
    /// s (c₁ + (1 − s)(c₂ + s (c₃ + (1 − s)(c₄ + …)))),
    ///
    /// so that at s = 1 it ends on exactly the state of the step (Hairer, Nørsett, Wanner, *Solving
    /// Ordinary Differential Equations I*, Sect. II.6).
    fn displacement(&self, s: f64) -> Option<D> {
        let (last, others) = self.split_last()?;
        let mut sum = *last;
        for (i, c) in others.iter().enumerate().rev() {
            sum = *c + sum * if i % 2 == 0 { 1.0 - s } else { s };
        }
        Some(sum * s)
    }
}

impl<Z: State, C: Interpolant<Z::Displacement>> Dense<Z, C> {
    /// The dense output of a step `h` (s) from `z` at time `t` (s), with the coefficients that
    /// [`Embedded::dense`](crate::methods::runge_kutta::Embedded::dense) gives.
    pub const fn new(t: f64, h: f64, z: Z, coefficients: C) -> Self {
        Self { t, h, end: t + h, z, coefficients }
    }

    /// The state at time `t` (s). Outside the step it is an extrapolation.
    pub fn at(&self, t: f64) -> Z {
        self.after((t - self.t) / self.h)
    }

    /// The time (s) at the fraction `s` of the step: its end at 1, and none later before.
    pub const fn time(&self, s: f64) -> f64 {
        let t = self.t + s * self.h;
        let is_past = if self.h < 0.0 { t < self.end } else { t > self.end };
        if s == 1.0 || (s < 1.0 && is_past) { self.end } else { t }
    }

    /// The state at the fraction `s` of the step.
    pub fn after(&self, s: f64) -> Z {
        self.coefficients.displacement(s).map_or(self.z, |displacement| self.z + displacement)
    }
}
