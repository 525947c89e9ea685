//! Runge–Kutta methods that estimate their own error.

use crate::systems::{RateOf, System, Vector};

/// A Runge–Kutta method that estimates its own error and has dense output.
pub trait Embedded: Copy {
    /// The order k of the estimate, O(hᵏ): the step size control uses it to choose the next step.
    const ESTIMATE_ORDER: u32;

    /// The stages of a step.
    type Stages<D: Vector>: Copy;

    /// The coefficients of dense output: as many as its degree.
    type Dense<D: Vector>: Copy + AsRef<[D]> + Interpolant<D>;

    /// Tries a step `h` (s) from `z` at time `t` (s), where the slope is `slope`: the state that it
    /// leads to, and its stages.
    fn attempt<S: System>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        slope: RateOf<S>,
    ) -> (S::State, Self::Stages<RateOf<S>>);

    /// The error of the step with these `stages`, in tolerances. `size` measures a displacement per
    /// h in tolerances.
    fn error<D: Vector>(&self, stages: &Self::Stages<D>, size: impl Fn(D) -> f64) -> f64;

    /// The slope at the end of the step with these `stages`, the state `z` at time `t` (s).
    fn end_slope<S: System>(
        &self,
        system: &S,
        t: f64,
        z: S::State,
        stages: &Self::Stages<RateOf<S>>,
    ) -> RateOf<S>;

    /// The coefficients of [`Dense`](crate::adaptive::Dense), for a step `h` (s) from `z` at time
    /// `t` (s) with these `stages`.
    fn dense<S: System>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        stages: &Self::Stages<RateOf<S>>,
        end_slope: RateOf<S>,
    ) -> Self::Dense<RateOf<S>>;
}

/// The first three coefficients of dense output, which match the state and the slope at both ends
/// of a step: Hermite's cubic of the whole displacement `step` with the slopes at both ends, times
/// h.
pub fn hermite<D: Vector>(step: D, start_slope: D, end_slope: D) -> [D; 3] {
    let second = start_slope + step * -1.0;
    let third = step + end_slope * -1.0 + second * -1.0;
    [step, second, third]
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
