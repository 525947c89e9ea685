//! Questions of "Friction and drives".

use core::f64::consts::TAU;

use pendula::{Driven, Pendulum, Phase};
use pendula_dynamics::root;

use super::{Compute, Truth, Within};
use crate::experiments::beyond::{self, Boundary};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("friction-and-drives-magnetic", magnetic),
    ("friction-and-drives-stronger", stronger),
    ("friction-and-drives-upright", upright),
];

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

/// How the motion of the chapter's pendulum repeats that a drive of 1.07 keeps going.
fn stronger() -> Truth {
    let driven = Driven::taylor(1.07).expect("a drive");
    let strobe = beyond::seen(&driven, beyond::COARSE);
    let settled = beyond::attractor(&driven);
    let once = strobe.map(settled);
    let twice = strobe.map(once);
    let far = |z: Phase| (z.theta - settled.theta).abs() > 1e-2;
    let back = |z: Phase| (z.theta - settled.theta).abs() < 1e-6;
    Truth::Which(vec![
        ("each", back(once)),
        ("two", far(once) && back(twice)),
        ("never", far(once) && far(twice)),
    ])
}

/// How often a second the pivot of the paper's pendulum has to go up and down by 0.05 m, so that it
/// holds the pendulum upright.
fn upright() -> Truth {
    const AMPLITUDE: f64 = 0.05;
    let pendulum = Pendulum::PAPER;
    // The pivot that just holds it goes up and down by so much more than by the amplitude.
    let more = |times: f64| {
        let least = beyond::upright(&pendulum, TAU * times, Boundary::Falling, 200)?;
        Some(least - AMPLITUDE)
    };
    let energy = 2.0 * pendulum.gravity() * pendulum.length();
    let (speed, fastest) = (libm::sqrt(energy), libm::sqrt(pendulum.gravity() / AMPLITUDE));
    Truth::Number {
        right: root(more, 10.0, 20.0).expect("a frequency"),
        // Kapitza's rule is a mean: it is off by 0.3 %. Two digits are off by 0.8 %.
        within: Within::Percent(2.0),
        mistakes: vec![
            ("radians", speed / AMPLITUDE),
            ("weight", fastest / TAU),
            ("half", libm::sqrt(0.5) * speed / AMPLITUDE / TAU),
        ],
    }
}
