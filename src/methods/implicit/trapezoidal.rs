//! The trapezoidal rule.

use crate::methods::implicit::ImplicitTableau;
use crate::methods::{Info, MethodInfo};

/// The trapezoidal rule: the mean of the slopes at the start and at the end of the step.
///
/// Order 2, symmetric and not symplectic. A step is half a step of forward Euler and then half a
/// step of backward Euler; the implicit midpoint rule takes the same two in the other order. So the
/// rule is the midpoint rule seen from half a step of forward Euler away, and keeps what that keeps
/// there: its energy error stays bounded, and the pendulum's area with the weight 1 + (h²g/4L) cos
/// θ is conserved exactly. A step evaluates the force once in each sweep, and once to begin. Also
/// called the Crank–Nicolson method; Lobatto's method IIIA of two stages. Hairer, Lubich, Wanner,
/// *Geometric Numerical Integration*, Sects. II.1.1 and VI.8.
#[derive(Clone, Copy, Debug, Default)]
pub struct Trapezoidal;

impl Info for Trapezoidal {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Trapezoidal rule",
            aliases: &["Lobatto IIIA 2", "Crank–Nicolson"],
            symmetric: true,
            implicit: true,
            force_evaluations: 1,
            reference: "Hairer, Lubich, Wanner (2006), Sects. II.1.1 and VI.8",
            ..MethodInfo::new("trapezoidal", 2)
        }
    }
}

impl Trapezoidal {
    /// The coefficients.
    pub const TABLEAU: ImplicitTableau<2> =
        ImplicitTableau { parts: [[0.0, 0.0], [1.0, 1.0]], b: [0.5, 0.5], c: [0.0, 1.0] };
}
