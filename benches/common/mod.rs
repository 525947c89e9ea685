//! The naive loops, as one would write them first, with the platform's sine: the baseline for the
//! library.

use pendula::Phase;

/// A naive loop: the start, the number of steps and their length (s).
pub type Naive = fn(Phase, u64, f64) -> Phase;

/// The loop for each method of the library that has an obvious one, by the method's name.
pub const NAIVE: &[(&str, Naive)] = &[
    ("forward-euler", forward_euler),
    ("symplectic-euler", symplectic_euler),
    ("rk4", rk4),
    ("stormer-verlet", stormer_verlet),
];

/// Forward Euler as two statements.
fn forward_euler(Phase { mut theta, mut omega }: Phase, steps: u64, h: f64) -> Phase {
    for _ in 0..steps {
        let alpha = -9.81 * theta.sin();
        theta += omega * h;
        omega += alpha * h;
    }
    Phase { theta, omega }
}

/// Symplectic Euler as two statements.
fn symplectic_euler(Phase { mut theta, mut omega }: Phase, steps: u64, h: f64) -> Phase {
    for _ in 0..steps {
        omega -= 9.81 * theta.sin() * h;
        theta += omega * h;
    }
    Phase { theta, omega }
}

/// Störmer–Verlet as the paper writes it, with the force kept for the next step.
fn stormer_verlet(Phase { mut theta, mut omega }: Phase, steps: u64, h: f64) -> Phase {
    let mut alpha = -9.81 * theta.sin();
    for _ in 0..steps {
        theta += omega * h + 0.5 * alpha * h * h;
        let next = -9.81 * theta.sin();
        omega += 0.5 * (alpha + next) * h;
        alpha = next;
    }
    Phase { theta, omega }
}

/// RK4 as the paper writes it.
fn rk4(Phase { mut theta, mut omega }: Phase, steps: u64, h: f64) -> Phase {
    let f = |theta: f64, omega: f64| (omega, -9.81 * theta.sin());
    for _ in 0..steps {
        let (a1, b1) = f(theta, omega);
        let (a2, b2) = f(theta + 0.5 * h * a1, omega + 0.5 * h * b1);
        let (a3, b3) = f(theta + 0.5 * h * a2, omega + 0.5 * h * b2);
        let (a4, b4) = f(theta + h * a3, omega + h * b3);
        theta += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        omega += h / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4);
    }
    Phase { theta, omega }
}
