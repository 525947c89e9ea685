//! Questions of "Symplectic Euler".

use core::f64::consts::FRAC_PI_3;

use pendula::arithmetic::sine::{cos, sin};
use pendula::metrics::EnergyDrift;
use pendula::{Grid, Hamiltonian, Pendulum, Phase, Separable, SymplecticEuler, integrate_with};
use pendula_dynamics::shapes;

use super::{Compute, Truth, Within};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("symplectic-euler-mean", mean),
    ("symplectic-euler-longer", longer),
    ("symplectic-euler-area", area),
];

const PENDULUM: Pendulum = Pendulum::PAPER;

/// The largest energy error in the first 10 s from 1 rad (J), where the angle moves with this share
/// of the new velocity, and the rest of the old one.
fn strays(share: f64) -> f64 {
    const STEP: f64 = 1e-3;
    let released = Phase::at_rest(1.0);
    let energy = PENDULUM.energy(released);
    let (mut z, mut largest) = (released, 0.0);
    for _ in 0..10_000 {
        let omega = z.omega + STEP * PENDULUM.force(0.0, z);
        let velocity = share * omega + (1.0 - share) * z.omega;
        z = Phase { theta: z.theta + STEP * velocity, omega };
        largest = libm::fmax(largest, (PENDULUM.energy(z) - energy).abs());
    }
    largest
}

/// What the energy does where the angle moves with the mean of both velocities.
fn mean() -> Truth {
    let [old, both, new] = [0.0, 0.5, 1.0].map(strays);
    let is_of_old = |part: f64| (both / old / part - 1.0).abs() < 0.1;
    Truth::Which(vec![("better", both < new), ("half", is_of_old(0.5)), ("same", is_of_old(1.0))])
}

/// How many times larger the largest energy error of 1000 s is than that of 50 s.
fn longer() -> Truth {
    const DURATIONS: [f64; 2] = [50.0, 1000.0];
    let [short, long] = DURATIONS.map(|duration| {
        let grid = Grid::with_duration(0.01, duration).expect("a grid");
        let mut drift = EnergyDrift::new(&PENDULUM);
        integrate_with(&PENDULUM, &SymplecticEuler, Phase::at_rest(FRAC_PI_3), &grid, &mut drift);
        drift.largest()
    });
    let longer = DURATIONS[1] / DURATIONS[0];
    Truth::Number {
        right: long / short,
        // Once as large. What the longer run finds besides lies between the steps of the shorter.
        within: Within::Percent(1.0),
        mistakes: vec![("steady", longer), ("random", libm::sqrt(longer))],
    }
}

/// Which kick changes the area, followed by a drift.
fn area() -> Truth {
    const STEP: f64 = 0.1;
    const SIDE: f64 = 1e-4;
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let square =
        corners.map(|(right, up)| Phase { theta: 0.5 + SIDE * right, omega: 0.7 + SIDE * up });
    let changes = |kick: fn(Phase) -> f64| {
        let image = square.map(|z| {
            let omega = z.omega - STEP * kick(z);
            Phase { theta: z.theta + STEP * omega, omega }
        });
        (shapes::area(image) / shapes::area(square) - 1.0).abs() > 1e-3
    };
    Truth::Which(vec![
        ("cosine", changes(|z| 9.81 * cos(z.theta))),
        ("twice", changes(|z| 2.0 * 9.81 * sin(z.theta))),
        ("friction", changes(|z| 9.81 * sin(z.theta) + z.omega)),
    ])
}
