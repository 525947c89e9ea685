//! Systems that know the derivative of their rate of change.

use super::{Phase, RateOf, System};

/// A system with the derivative of its rate of change: what the [analysis](crate::dynamics) of its
/// neighbouring motions needs.
pub trait Linearised: System {
    /// The derivative of [`System::rate`] at time `t` (s) and the state `z` along the displacement
    /// `v`: the right-hand side of the variational equation v̇ = Df(t, z) v.
    fn tangent(&self, t: f64, z: Self::State, v: RateOf<Self>) -> RateOf<Self>;

    /// The size of a displacement, in a norm that makes its components comparable.
    fn size(&self, v: RateOf<Self>) -> f64;
}

/// √(θ² + ω²/ω₀²) (rad), with ω₀ = `frequency` (rad/s).
pub(super) fn size(v: Phase, frequency: f64) -> f64 {
    let omega = v.omega / frequency;
    libm::sqrt(v.theta * v.theta + omega * omega)
}
