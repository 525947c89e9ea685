//! Systems that know the derivative of their rate of change.

use pendula::arithmetic::sine::cos;
use pendula::{Damped, Driven, Phase, RateOf, Shaken, System};

/// A system with the derivative of its rate of change: what the [analysis](super) of its
/// neighbouring motions needs.
pub trait Linearised: System {
    /// The derivative of [`System::rate`] at time `t` (s) and the state `z` along the displacement
    /// `v`: the right-hand side of the variational equation v̇ = Df(t, z) v.
    fn tangent(&self, t: f64, z: Self::State, v: RateOf<Self>) -> RateOf<Self>;

    /// The size of a displacement, in a norm that makes its components comparable.
    fn size(&self, v: RateOf<Self>) -> f64;
}

/// √(θ² + ω²/ω₀²) (rad), with ω₀ = `frequency` (rad/s).
fn size(v: Phase, frequency: f64) -> f64 {
    let omega = v.omega / frequency;
    libm::sqrt(v.theta * v.theta + omega * omega)
}

impl Linearised for Damped {
    #[inline]
    fn tangent(&self, _t: f64, z: Phase, v: Phase) -> Phase {
        let restoring = self.pendulum().frequency_squared() * cos(z.theta) * v.theta;
        Phase { theta: v.omega, omega: -restoring - 2.0 * self.damping() * v.omega }
    }

    fn size(&self, v: Phase) -> f64 {
        size(v, self.pendulum().small_angle_frequency())
    }
}

impl Linearised for Driven {
    /// The drive does not depend on the state and drops out of the derivative.
    #[inline]
    fn tangent(&self, t: f64, z: Phase, v: Phase) -> Phase {
        self.damped().tangent(t, z, v)
    }

    fn size(&self, v: Phase) -> f64 {
        self.damped().size(v)
    }
}

impl Linearised for Shaken {
    #[inline]
    fn tangent(&self, t: f64, z: Phase, v: Phase) -> Phase {
        Phase { theta: v.omega, omega: -self.frequency_squared(t) * cos(z.theta) * v.theta }
    }

    fn size(&self, v: Phase) -> f64 {
        size(v, self.pendulum().small_angle_frequency())
    }
}
