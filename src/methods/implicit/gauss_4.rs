//! The Gauss method of two stages.

use crate::methods::implicit::ImplicitTableau;
use crate::methods::{Info, MethodInfo};

/// The Gauss method of two stages: collocation at the zeros of a Legendre polynomial.
///
/// Order 4, symplectic for every Hamiltonian system, separable or not, symmetric; a step evaluates
/// the force at each stage in each sweep, and once to begin. Hairer, Lubich, Wanner, *Geometric
/// Numerical Integration*, Sects. II.1.3 and VIII.6. Also called Gauss–Legendre or
/// Kuntzmann–Butcher.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gauss4;

impl Info for Gauss4 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Gauss 4",
            aliases: &["Hammer–Hollingsworth", "Kuntzmann–Butcher 4"],
            symplectic: true,
            symmetric: true,
            implicit: true,
            force_evaluations: 2,
            reference: "Hairer, Lubich, Wanner (2006), Sect. II.1.3",
            ..MethodInfo::new("gauss-4", 4)
        }
    }
}

impl Gauss4 {
    /// The coefficients, computed with 60 digits from the zeros of the Legendre polynomial of
    /// degree 2.
    pub const TABLEAU: ImplicitTableau<2> = ImplicitTableau::symplectic(
        [-0.077_350_269_189_625_76],
        [0.5, 0.5],
        [0.211_324_865_405_187_1, 0.788_675_134_594_812_9],
    );
}
