//! Orbits in phase space: three of the paper's Figure 5, and the curves that symplectic methods
//! follow, beside the exact orbit.

use pendula::exact::Motion;
use pendula::{Grid, Pendulum, Phase, method_named};

use super::{MethodRef, samples};
use crate::theory::{stormer_verlet, symplectic_euler};

/// The three releases of Figure 5 (rad).
pub const PORTRAIT: [f64; 3] = [0.5, 1.5, 2.5];
/// Its step (s).
const PORTRAIT_STEP: f64 = 0.01;

/// The orbit in Figure 5 of a release from `theta_0` (rad), sampled at each step for one exact
/// period and the step that closes it.
pub fn portrait(method: MethodRef, theta_0: f64) -> Vec<Phase> {
    let period = pendula::exact::period(&Pendulum::PAPER, theta_0).expect("a finite angle");
    visited(method, theta_0, PORTRAIT_STEP, libm::ceil(period / PORTRAIT_STEP) as u64)
}

/// Released at rest from here (rad) to follow the curves.
pub const THETA_0: f64 = 1.0;
/// Points on a curve; the first is repeated at its end.
const POINTS: u32 = 400;
/// Steps of each method: many points that can still be told apart.
const STEPS: u64 = 25;
/// The step (s) of [`tilted`]: large enough to tell the first term of the series from all seven. A
/// swing is not a whole number of such steps.
pub const TILTED_STEP: f64 = 0.25;
/// The orders in h to which the series of H̃ is drawn there: none, the first, all that are known.
pub const ORDERS: [usize; 3] = [0, 1, 7];

/// A method with its curves.
#[derive(Clone, Debug)]
pub struct Run {
    /// The method.
    pub method: MethodRef,
    /// Its step (s).
    pub step: f64,
    /// Curves through the start, the true orbit first.
    pub curves: Vec<Vec<Phase>>,
    /// The points that it visits.
    pub points: Vec<Phase>,
}

/// The true orbit.
fn orbit() -> Vec<Phase> {
    let motion = Motion::new(&Pendulum::PAPER, Phase::at_rest(THETA_0)).expect("a finite angle");
    let period = motion.period().expect("it swings");
    let share = |n: u32| f64::from(n % POINTS) / f64::from(POINTS);
    (0..=POINTS).map(|n| motion.at(period * share(n))).collect()
}

/// The step (s) of [`own`], the same for both methods, so that one can compare how far their curves
/// are from the true orbit: large enough to tell the curves apart, and not a part of a swing.
/// Larger ones would show the truncation of the series of H̃.
const OWN_STEP: f64 = 0.25;

/// Both methods with the level curves of the energies that they conserve, computed from theory.
pub fn own() -> [Run; 2] {
    let h = OWN_STEP;
    let of_euler = symplectic_euler::level_curve(&Pendulum::PAPER, THETA_0, h, POINTS);
    let of_verlet = stormer_verlet::level_curve(&Pendulum::PAPER, THETA_0, h, POINTS);
    [
        run("symplectic-euler", h, vec![orbit(), of_euler.collect()]),
        run("stormer-verlet", h, vec![orbit(), of_verlet.collect()]),
    ]
}

/// Symplectic Euler with the level curves of its H̃ to the [`ORDERS`].
pub fn tilted() -> Run {
    let curve = |order: usize| {
        let (pendulum, h) = (&Pendulum::PAPER, TILTED_STEP);
        symplectic_euler::level_curve_to_order(order, pendulum, THETA_0, h, POINTS).collect()
    };
    run("symplectic-euler", TILTED_STEP, ORDERS.map(curve).into())
}

fn run(name: &str, step: f64, curves: Vec<Vec<Phase>>) -> Run {
    let method = method_named(name).expect("one of the library's methods");
    Run { method, step, curves, points: points(method, step) }
}

/// The points that a method visits with steps of `step` (s).
pub fn points(method: MethodRef, step: f64) -> Vec<Phase> {
    visited(method, THETA_0, step, STEPS)
}

fn visited(method: MethodRef, theta_0: f64, step: f64, steps: u64) -> Vec<Phase> {
    let grid = Grid::new(step, steps).expect("a positive step");
    samples(method, theta_0, &grid).into_iter().map(|(_, z)| z).collect()
}
