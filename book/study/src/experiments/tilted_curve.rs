//! The level curve of symplectic Euler's H̃, term by term of its series, and the method's points.

use pendula::{Pendulum, Phase, method_named};

use super::{MethodRef, level_curves};
use crate::theory::symplectic_euler::level_curve_to_order;

/// The method's step (s): large enough to tell the first term of the series from all seven.
/// A swing is not a whole number of such steps.
pub const STEP: f64 = 0.25;
/// The orders in h to which the series of H̃ is drawn: none, the first, all that are known.
pub const ORDERS: [usize; 3] = [0, 1, 7];
/// Points on a curve.
const POINTS: u32 = 400;

/// What is drawn.
#[derive(Clone, Debug)]
pub struct Run {
    /// Symplectic Euler.
    pub method: MethodRef,
    /// Its step (s).
    pub step: f64,
    /// The points that it visits.
    pub points: Vec<Phase>,
    /// The level curves through the start, each with its order.
    pub curves: [(usize, Vec<Phase>); 3],
}

/// The points of the method and the curves.
pub fn run() -> Run {
    let method = method_named("symplectic-euler").expect("one of the library's methods");
    let curve = |order: usize| {
        let (pendulum, theta_0) = (&Pendulum::PAPER, level_curves::THETA_0);
        (order, level_curve_to_order(order, pendulum, theta_0, STEP, POINTS).collect())
    };
    Run {
        method,
        step: STEP,
        points: level_curves::points(method, STEP),
        curves: ORDERS.map(curve),
    }
}
