//! The implicit midpoint rule.

use crate::integrate::{Method, Unsolved};
use crate::methods::implicit::{ImplicitTableau, Iteration};
use crate::methods::{Info, MethodInfo};
use crate::systems::{Measurable, System};

/// The implicit midpoint rule: the slope at the midpoint between the start and the end of the step,
/// for the whole step.
///
/// Order 2, symplectic for every Hamiltonian system, separable or not, symmetric; a step evaluates
/// the force once in each sweep, and once to begin. Hairer, Lubich, Wanner, *Geometric Numerical
/// Integration*, Sects. II.1.3 and VIII.6.
#[derive(Clone, Copy, Debug, Default)]
pub struct ImplicitMidpoint;

impl Info for ImplicitMidpoint {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "implicit-midpoint",
            title: "Implicit midpoint",
            aliases: &["Gauss 2"],
            order: 2,
            symplectic: true,
            symmetric: true,
            implicit: true,
            force_evaluations: 1,
            start_evaluations: 0,
            reference: "Hairer, Lubich, Wanner (2006), Sect. II.1.3",
        }
    }
}

impl ImplicitMidpoint {
    /// The coefficients, computed with 60 digits from the zeros of the Legendre polynomial of
    /// degree 1.
    pub const TABLEAU: ImplicitTableau<1> = ImplicitTableau { a: [[0.5]], b: [1.0], c: [0.5] };
}

impl<S: System<State: Measurable>> Method<S> for ImplicitMidpoint {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        Self::TABLEAU.step(system, t, h, z)
    }

    #[inline(always)]
    fn try_step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        _carry: &mut (),
    ) -> Result<S::State, Unsolved> {
        Self::TABLEAU.try_step(system, t, h, z, Iteration::TO_ROUNDING)
    }
}
