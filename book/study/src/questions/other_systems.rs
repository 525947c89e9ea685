//! Questions of "Other systems".

use pendula::methods::{Rk4, StormerVerlet};
use pendula::{Grid, Hamiltonian, Method, integrate};
use pendula_dynamics::kepler::{Ellipse, Kepler};

use super::{Compute, Truth};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] =
    &[("other-systems-planet", planet), ("other-systems-magnetic", magnetic)];

/// By how much, relative to themselves, energy and angular momentum are off after the chapter's ten
/// revolutions.
fn off(method: &impl Method<Kepler>) -> [f64; 2] {
    let centre = Kepler::new(1.0).expect("an attraction");
    let ellipse = Ellipse::new(&centre, 1.0, 0.6).expect("an ellipse");
    let (start, step) = (ellipse.at(0.0), ellipse.period() / 100.0);
    let grid = Grid::new(step, 1000).expect("a positive step");
    let end = integrate(&centre, method, start, &grid, &mut ());
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

/// The lines of velocity Verlet in a magnetic field.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Line {
    First,
    Drift,
    Last,
}

/// x and v, each in the plane.
type Particle = [[f64; 2]; 2];

fn plus([x, y]: [f64; 2], [dx, dy]: [f64; 2], h: f64) -> [f64; 2] {
    [x + h * dx, y + h * dy]
}

/// The acceleration in a field that turns velocities at 1 rad/s.
fn acceleration([vx, vy]: [f64; 2]) -> [f64; 2] {
    [vy, -vx]
}

/// The v′ = v + h a(v′), solved.
fn implicit(v: [f64; 2], h: f64) -> [f64; 2] {
    plus(v, acceleration(v), h).map(|component| component / (1.0 + h * h))
}

/// A step of velocity Verlet with the old velocity in both forces. The line that is mended has the
/// velocity to which it leads; in the drift it is the mean of those at both ends.
fn step([x, u]: Particle, h: f64, mended: Option<Line>) -> Particle {
    let half_kick = |line, v| match mended == Some(line) {
        true => implicit(v, 0.5 * h),
        false => plus(v, acceleration(u), 0.5 * h),
    };
    let half = half_kick(Line::First, u);
    let end = half_kick(Line::Last, half);
    let drifting =
        if mended == Some(Line::Drift) { plus(u, plus(end, u, -1.0), 0.5) } else { half };
    [plus(x, drifting, h), end]
}

/// The order, from the error after 4.7 s on a circle of 1 m.
fn order(mended: Option<Line>) -> f64 {
    const DURATION: f64 = 4.7;
    let (sin, cos) = (libm::sin(DURATION), libm::cos(DURATION));
    let exact = [sin, cos, cos, -sin];
    let error = |steps: u32| {
        let h = DURATION / f64::from(steps);
        let end = (0..steps).fold([[0.0, 1.0], [1.0, 0.0]], |z, _| step(z, h, mended));
        let squares = end.as_flattened().iter().zip(exact).map(|(found, exact)| {
            let off = found - exact;
            off * off
        });
        libm::sqrt(squares.sum())
    };
    libm::log2(error(500) / error(1000))
}

/// The line that has to be mended, so that the order is 2 again.
fn magnetic() -> Truth {
    let mends = |line| order(None) < 1.1 && order(Some(line)) > 1.9;
    Truth::Which(vec![
        ("first", mends(Line::First)),
        ("drift", mends(Line::Drift)),
        ("last", mends(Line::Last)),
    ])
}
