//! Systems whose force has a potential, and with it a discrete gradient.

use super::{Counting, LinearOscillator, Measurable, Pendulum, Phase, RateOf, Separable, System};
use crate::arithmetic::sine::sinc;

/// A system whose force is the gradient of a potential, of which it knows the mean along a way.
///
/// The mean force times the way is the work: with the sign changed, it is a discrete gradient of
/// the potential.
pub trait MeanForce: System<State: Measurable> {
    /// The rate of change in the state `middle`, with the mean of the force over a drift of the
    /// time `h` (s), or one for each lane, of which `middle` is the middle, in place of the force
    /// there.
    fn mean_force_rate(
        &self,
        middle: Self::State,
        h: <Self::State as Measurable>::Number,
    ) -> RateOf<Self>;
}

// ANCHOR: mean_force
impl MeanForce for Pendulum {
    /// The mean of sin between θ − δ and θ + δ is sin θ times sin δ/δ: the difference of two
    /// cosines over 2δ without the cancellation.
    #[inline]
    fn mean_force_rate(&self, middle: Phase, h: f64) -> Phase {
        let half_the_way = 0.5 * h * middle.omega;
        let force = self.force(0.0, middle) * sinc(half_the_way);
        Phase { theta: middle.omega, omega: force }
    }
}
// ANCHOR_END: mean_force

impl MeanForce for LinearOscillator {
    /// The mean of a linear force is the one in the middle.
    #[inline]
    fn mean_force_rate(&self, middle: Phase, _h: f64) -> Phase {
        self.rate(0.0, middle)
    }
}

impl<S: MeanForce> MeanForce for Counting<S> {
    /// Counts as two evaluations: for the pendulum it takes two sines.
    fn mean_force_rate(&self, middle: S::State, h: <S::State as Measurable>::Number) -> RateOf<S> {
        self.count(2);
        self.system().mean_force_rate(middle, h)
    }
}
