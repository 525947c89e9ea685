//! Three orbits in phase space: the paper's Figure 5.

use pendula::{Grid, Pendulum, Phase};

use super::{MethodRef, samples};

/// The three releases of Figure 5 (rad).
pub const THETA_0: [f64; 3] = [0.5, 1.5, 2.5];
/// Its step (s).
pub const STEP: f64 = 0.01;

/// The orbit of a release from `theta_0` (rad), sampled at each step for one exact period and the
/// step that closes it.
pub fn orbit(method: MethodRef, theta_0: f64) -> Vec<Phase> {
    let period = pendula::exact::period(&Pendulum::PAPER, theta_0).expect("a finite angle");
    let steps = libm::ceil(period / STEP) as u64;
    let grid = Grid::new(STEP, steps).expect("a positive step");
    samples(method, theta_0, &grid).into_iter().map(|(_, z)| z).collect()
}
