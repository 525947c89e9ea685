//! The Gauss method of three stages.

use crate::methods::implicit::ImplicitTableau;
use crate::methods::{Info, MethodInfo};

/// The Gauss method of three stages: collocation at the zeros of a Legendre polynomial.
///
/// Order 6, symplectic for every Hamiltonian system, separable or not, symmetric; a step evaluates
/// the force at each stage in each sweep, and once to begin. Hairer, Lubich, Wanner, *Geometric
/// Numerical Integration*, Sects. II.1.3 and VIII.6. Also called Gauss–Legendre or
/// Kuntzmann–Butcher.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gauss6;

impl Info for Gauss6 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Gauss 6",
            aliases: &["Kuntzmann–Butcher 6"],
            symplectic: true,
            symmetric: true,
            implicit: true,
            force_evaluations: 3,
            reference: "Hairer, Lubich, Wanner (2006), Sect. II.1.3",
            ..MethodInfo::new("gauss-6", 6)
        }
    }
}

impl Gauss6 {
    /// The coefficients, computed with 60 digits from the zeros of the Legendre polynomial of
    /// degree 3.
    pub const TABLEAU: ImplicitTableau<3> = ImplicitTableau::symplectic(
        [-0.080_947_501_931_112_54, 0.035_241_998_455_109_974, -0.080_947_501_931_112_54],
        [0.277_777_777_777_777_8, 0.444_444_444_444_444_4, 0.277_777_777_777_777_8],
        [0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7],
    );
}
