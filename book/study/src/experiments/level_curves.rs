//! The curve that a symplectic method follows, beside the exact orbit.

use pendula::exact::Motion;
use pendula::{Grid, Pendulum, Phase, method_named};

use super::{MethodRef, released};
use crate::theory::{stormer_verlet, symplectic_euler};

/// Released at rest from here (rad).
pub const THETA_0: f64 = 1.0;
/// Points on a curve; the first is repeated at its end.
const POINTS: u32 = 400;
/// Steps of each method: many points that can still be told apart.
const STEPS: u64 = 25;

/// A method with its curve.
#[derive(Clone, Debug)]
pub struct Row {
    /// The method.
    pub method: MethodRef,
    /// Its step (s).
    pub step: f64,
    /// The level curve of the energy that it conserves, computed from theory.
    pub curve: Vec<Phase>,
    /// The points that it visits.
    pub points: Vec<Phase>,
}

/// The true orbit.
pub fn orbit() -> Vec<Phase> {
    let motion = Motion::new(&Pendulum::PAPER, released(THETA_0)).expect("a finite angle");
    let period = motion.period().expect("it swings");
    let share = |n: u32| f64::from(n % POINTS) / f64::from(POINTS);
    (0..=POINTS).map(|n| motion.at(period * share(n))).collect()
}

/// Runs both methods, with steps large enough to tell the curves apart, of which a swing is not a
/// whole number. Larger ones would show the truncation of the series of H̃: Störmer–Verlet's ω₀h is
/// nearly 1.
pub fn run() -> [Row; 2] {
    let (euler, verlet) = (0.2, 0.29);
    let of_euler = symplectic_euler::level_curve(&Pendulum::PAPER, THETA_0, euler, POINTS);
    let of_verlet = stormer_verlet::level_curve(&Pendulum::PAPER, THETA_0, verlet, POINTS);
    [
        row("symplectic-euler", euler, of_euler.collect()),
        row("stormer-verlet", verlet, of_verlet.collect()),
    ]
}

fn row(name: &str, step: f64, curve: Vec<Phase>) -> Row {
    let method = method_named(name).expect("one of the library's methods");
    Row { method, step, curve, points: points(method, step) }
}

/// The points that a method visits with steps of `step` (s).
pub fn points(method: MethodRef, step: f64) -> Vec<Phase> {
    let grid = Grid::new(step, STEPS).expect("a positive step");
    let mut points = Vec::new();
    method.run(&Pendulum::PAPER, released(THETA_0), &grid, &mut |_, _, z: Phase| points.push(z));
    points
}
