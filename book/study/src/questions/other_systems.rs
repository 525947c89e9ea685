//! Questions of "Other systems".

use pendula::methods::{Rk4, StormerVerlet};
use pendula::{Grid, Hamiltonian, Method, integrate};
use pendula_dynamics::kepler::{Ellipse, Kepler};

use super::{Compute, Truth};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[("other-systems-planet", planet)];

/// By how much, relative to themselves, energy and angular momentum are off after the chapter's ten
/// revolutions.
fn off(method: &impl Method<Kepler>) -> [f64; 2] {
    let centre = Kepler::new(1.0).expect("an attraction");
    let ellipse = Ellipse::new(&centre, 1.0, 0.6).expect("an ellipse");
    let (start, step) = (ellipse.at(0.0), ellipse.period() / 100.0);
    let grid = Grid::new(step, 1000).expect("a positive step");
    let end = integrate(&centre, method, start, &grid);
    let energy = centre.energy(end) / centre.energy(start) - 1.0;
    let momentum = centre.angular_momentum(end) / centre.angular_momentum(start) - 1.0;
    [energy.abs(), momentum.abs()]
}

/// Which of Störmer–Verlet and RK4 keeps the energy better, and which the angular momentum.
fn planet() -> Truth {
    let (verlet, rk4) = (off(&StormerVerlet), off(&Rk4));
    // By a factor of ten at least, so that it is no matter of the moment.
    let by_verlet = [0, 1].map(|i| 10.0 * verlet[i] < rk4[i]);
    let by_rk4 = [0, 1].map(|i| 10.0 * rk4[i] < verlet[i]);
    Truth::Which(vec![
        ("verlet", by_verlet[0] && by_verlet[1]),
        ("rk4", by_rk4[0] && by_rk4[1]),
        ("each", by_rk4[0] && by_verlet[1]),
        ("crossed", by_verlet[0] && by_rk4[1]),
    ])
}
