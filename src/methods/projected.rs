//! Projection onto the energy of the start.

use core::borrow::Borrow;

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo, Rk4};
use crate::systems::{Hamiltonian, Pendulum, Phase, Separable};

/// A method whose every step is followed by a projection onto the energy of the start: one step of
/// Newton's iteration along the gradient of the energy.
///
/// With q = θ, u = ω/ω₀ and E = ½u² + 1 − cos q the projection subtracts (E − E₀)/|∇E|² ∇E. A step
/// of order p misses the energy by O(hᵖ⁺¹), and the projection by the square of that. The order
/// stays that of the method; the energy no longer drifts, but the motion along the curve is the
/// method's own, and not symplectic. Each step takes one more evaluation of the force, for the
/// gradient, and one of the energy, which isn't counted. Hairer, Lubich, Wanner, *Geometric
/// Numerical Integration*, Algorithm IV.4.2.
///
/// ```
/// use pendula::methods::Projected;
/// use pendula::metrics::EnergyDrift;
/// use pendula::{Grid, Pendulum, Phase, Rk4, integrate_with};
///
/// let grid = Grid::with_duration(0.05, 1000.0)?;
/// let mut drifts = [EnergyDrift::new(&Pendulum::PAPER), EnergyDrift::new(&Pendulum::PAPER)];
/// integrate_with(&Pendulum::PAPER, &Rk4, Phase::at_rest(1.0), &grid, &mut drifts[0]);
/// integrate_with(&Pendulum::PAPER, &Projected(Rk4), Phase::at_rest(1.0), &grid, &mut drifts[1]);
/// assert!(drifts[0].largest() > 1e-3 && drifts[1].largest() < 1e-11);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Projected<M>(pub M);

impl Info for Projected<Rk4> {
    fn info(&self) -> MethodInfo {
        let rk4 = self.0.info();
        MethodInfo {
            title: "RK4, projected",
            force_evaluations: rk4.force_evaluations + 1,
            reference: "Hairer, Lubich, Wanner (2006), Algorithm IV.4.2",
            ..MethodInfo::new("rk4-projected", rk4.order)
        }
    }
}

// ANCHOR: step
impl<S, M> Method<S> for Projected<M>
where
    S: Separable<State = Phase, Force = f64> + Borrow<Pendulum>,
    M: Method<S, Carry = ()>,
{
    /// The energy at the start (J).
    type Carry = f64;

    fn start(&self, system: &S, _t: f64, _h: f64, z: Phase) -> f64 {
        let pendulum: &Pendulum = system.borrow();
        pendulum.energy(z)
    }

    fn step(&self, system: &S, t: f64, h: f64, z: Phase, start: &mut f64) -> Phase {
        let pendulum: &Pendulum = system.borrow();
        let z = self.0.step(system, t, h, z, &mut ());
        let frequency = pendulum.small_angle_frequency();
        let (sine, u) = (-system.force(t, z) / pendulum.frequency_squared(), z.omega / frequency);
        let gained = (pendulum.energy(z) - *start) / pendulum.depth();
        // At the bottom, at rest, there is no gradient, and nothing to be gained.
        let part = if gained == 0.0 { 0.0 } else { gained / (sine * sine + u * u) };
        Phase { theta: z.theta - part * sine, omega: z.omega - part * u * frequency }
    }
}
// ANCHOR_END: step
