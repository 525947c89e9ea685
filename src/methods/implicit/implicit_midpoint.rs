//! The implicit midpoint rule.

use crate::methods::implicit::ImplicitTableau;
use crate::methods::{Info, MethodInfo};

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
            title: "Implicit midpoint",
            aliases: &["Gauss 2"],
            symplectic: true,
            symmetric: true,
            implicit: true,
            force_evaluations: 1,
            reference: "Hairer, Lubich, Wanner (2006), Sect. II.1.3",
            ..MethodInfo::new("implicit-midpoint", 2)
        }
    }
}

impl ImplicitMidpoint {
    /// The coefficients, computed with 60 digits from the zeros of the Legendre polynomial of
    /// degree 1.
    pub const TABLEAU: ImplicitTableau<1> = ImplicitTableau::symplectic([], [1.0], [0.5]);
}
