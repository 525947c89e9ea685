//! One step of each of the paper's methods, and of each that shares its order and its cost with
//! another, against its equations, written out by hand.
//!
//! g/L = 2.5, so that g in place of g/L or a forgotten L shows, and the step is large, so that
//! every coefficient counts.

use approx::assert_relative_eq;
use pendula::methods::{
    CieslinskiRatkiewicz, Deuflhard, DiscreteGradient, ExplicitMidpoint, ForwardEuler, Gauss4,
    Heun, ImplicitMidpoint, PositionVerlet, Processed4, Rk4, StormerVerlet, SymplecticEuler,
    Trapezoidal,
};
use pendula::{Grid, Info, LinearOscillator, METHODS, Method, Pendulum, Phase, System, integrate};

const H: f64 = 0.3;
const Z: Phase = Phase { theta: 0.8, omega: -0.7 };
/// A few roundings of 1.1e-16 each, in another order than the library's.
const ROUNDING: f64 = 1e-15;

fn pendulum() -> Pendulum {
    Pendulum::new(5.0, 2.0, 3.0).unwrap()
}

fn alpha(theta: f64) -> f64 {
    -2.5 * theta.sin()
}

fn step<S: System<State = Phase>>(system: &S, method: &impl Method<S>, z: Phase) -> Phase {
    integrate(system, method, z, &Grid::new(H, 1).unwrap(), &mut ())
}

fn assert_same(z: Phase, theta: f64, omega: f64) {
    assert_relative_eq!(z.theta, theta, max_relative = ROUNDING);
    assert_relative_eq!(z.omega, omega, max_relative = ROUNDING);
}

/// Paper, Eqs. 6–7. Catches: the new velocity in the angle, which would be symplectic Euler.
#[test]
fn forward_euler_is_equations_6_and_7() {
    let z = step(&pendulum(), &ForwardEuler, Z);
    assert_same(z, 0.8 + H * -0.7, -0.7 + H * alpha(0.8));
}

/// Paper, Eqs. 8–9. Catches: the old velocity in the angle, and drift before kick.
#[test]
fn symplectic_euler_is_equations_8_and_9() {
    let z = step(&pendulum(), &SymplecticEuler, Z);
    let omega = -0.7 + H * alpha(0.8);
    assert_same(z, 0.8 + H * omega, omega);
}

/// Paper, Eqs. 10–12. Catches: the position form, a stale force, a missing half.
#[test]
fn stormer_verlet_is_equations_10_to_12() {
    let z = step(&pendulum(), &StormerVerlet, Z);
    let theta = 0.8 + H * -0.7 + 0.5 * H * H * alpha(0.8);
    assert_same(z, theta, -0.7 + 0.5 * H * (alpha(0.8) + alpha(theta)));
}

/// Paper, Eqs. 10–12, twice. Catches: a force carried from step to step that is not the force at
/// the new angle.
#[test]
fn stormer_verlet_hands_on_the_right_force() {
    let two = Grid::new(H, 2).unwrap();
    let z = integrate(&pendulum(), &StormerVerlet, Z, &two, &mut ());
    let twice = step(&pendulum(), &StormerVerlet, step(&pendulum(), &StormerVerlet, Z));
    // In one run two half kicks are merged into one kick: the same numbers up to a rounding.
    assert_same(z, twice.theta, twice.omega);
}

/// Paper, Algorithm 1. Catches: any of its coefficients changed, stages out of order.
#[test]
fn rk4_is_algorithm_1() {
    let f = |z: [f64; 2]| [z[1], alpha(z[0])];
    let along = |k: [f64; 2], h: f64| [0.8 + h * k[0], -0.7 + h * k[1]];
    let k1 = f([0.8, -0.7]);
    let k2 = f(along(k1, H / 2.0));
    let k3 = f(along(k2, H / 2.0));
    let k4 = f(along(k3, H));
    let mean = |i: usize| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0;
    assert_same(step(&pendulum(), &Rk4, Z), 0.8 + H * mean(0), -0.7 + H * mean(1));
}

/// On the linear oscillator a step of RK4 is the Taylor polynomial of degree 4 of a rotation by x =
/// ω₀h.
///
/// Catches: a stage from another one than the algorithm's, a weight off by a rounding's few units.
#[test]
fn rk4_on_the_linear_oscillator_is_a_taylor_polynomial() {
    let linear = LinearOscillator::new(pendulum());
    let z = step(&linear, &Rk4, Phase::at_rest(1.0));
    let x2 = 2.5 * H * H;
    assert_same(z, 1.0 - x2 / 2.0 + x2 * x2 / 24.0, -2.5 * H * (1.0 - x2 / 6.0));
}

/// Every method with the order and the cost of another has its step in this file: nothing else
/// tells them apart but digits.
///
/// Catches: such a method added without its step by hand.
#[test]
fn methods_of_the_same_order_and_cost_are_all_here() {
    let here = [
        ForwardEuler.info(),
        SymplecticEuler.info(),
        Rk4.info(),
        StormerVerlet.info(),
        Heun.info(),
        ExplicitMidpoint.info(),
        PositionVerlet.info(),
        ImplicitMidpoint.info(),
        Trapezoidal.info(),
        DiscreteGradient.info(),
        CieslinskiRatkiewicz.info(),
        Deuflhard.info(),
        Gauss4.info(),
        Processed4.info(),
    ];
    let all = || METHODS.iter().map(|method| method.info());
    for one in all() {
        let twin = all().find(|other| {
            other.name != one.name
                && (other.order, other.force_evaluations) == (one.order, one.force_evaluations)
        });
        let is_here = here.iter().any(|info| info.name == one.name);
        assert!(twin.is_none() || is_here, "{} and {}", one.name, twin.unwrap().name);
    }
}

/// Heun (1900). Catches: the explicit midpoint rule under its name, an end by forward Euler that is
/// not weighted by half.
#[test]
fn heun_is_the_mean_of_both_ends() {
    let (theta, omega) = (0.8 + H * -0.7, -0.7 + H * alpha(0.8));
    let mean = [(-0.7 + omega) / 2.0, (alpha(0.8) + alpha(theta)) / 2.0];
    assert_same(step(&pendulum(), &Heun, Z), 0.8 + H * mean[0], -0.7 + H * mean[1]);
}

/// Runge (1895). Catches: Heun's method under its name, half a step that is a whole one.
#[test]
fn the_explicit_midpoint_is_half_a_step_of_euler() {
    let (theta, omega) = (0.8 + 0.5 * H * -0.7, -0.7 + 0.5 * H * alpha(0.8));
    assert_same(step(&pendulum(), &ExplicitMidpoint, Z), 0.8 + H * omega, -0.7 + H * alpha(theta));
}

/// Drift, kick, drift. Catches: Störmer–Verlet under its name, a force at either end.
#[test]
fn position_verlet_kicks_in_the_middle() {
    let omega = -0.7 + H * alpha(0.8 + 0.5 * H * -0.7);
    let theta = 0.8 + 0.5 * H * (-0.7 + omega);
    assert_same(step(&pendulum(), &PositionVerlet, Z), theta, omega);
}

/// Its equation, solved by Newton's method for the angle in the middle: m = θ + (h/2)(ω + (h/2)
/// α(m)).
///
/// Catches: a Verlet or the trapezoidal rule under its name; an iteration that stops early.
#[test]
fn the_implicit_midpoint_solves_its_equation() {
    let half = 0.5 * H;
    let mut middle = 0.8;
    for _ in 0..20 {
        let miss = middle - 0.8 - half * (-0.7 + half * alpha(middle));
        middle -= miss / (1.0 + half * half * 2.5 * middle.cos());
    }
    let omega = -0.7 + H * alpha(middle);
    let z = step(&pendulum(), &ImplicitMidpoint, Z);
    assert_same(z, 0.8 + half * (-0.7 + omega), omega);
}

/// The angle θ' at the end that solves θ' = θ + (h/2)(ω + ω'(θ')), by the secant method, which
/// needs no derivative.
fn solved(h: f64, velocity_at: impl Fn(f64) -> f64) -> (f64, f64) {
    let miss = |end: f64| end - 0.8 - 0.5 * h * (-0.7 + velocity_at(end));
    let (mut before, mut end) = (0.5, 0.6);
    // A last step by less than rounding divides by nothing.
    while f64::abs(end - before) > 1e-9 {
        let slope = (miss(end) - miss(before)) / (end - before);
        (before, end) = (end, end - miss(end) / slope);
    }
    (end, velocity_at(end))
}

/// Its equations. Catches: the midpoint rule under its name; an iteration that stops early; the
/// slope of either end twice.
#[test]
fn the_trapezoidal_rule_is_the_mean_of_both_ends() {
    let (theta, omega) = solved(H, |end| -0.7 + 0.5 * H * (alpha(0.8) + alpha(end)));
    assert_same(step(&pendulum(), &Trapezoidal, Z), theta, omega);
}

/// A step of the length h of the discrete gradient, with the difference quotient of the potential
/// as it stands: the angles are apart by 0.3, so that it rounds by a few 1e-16, and the velocity by
/// 2.5 h times that.
fn assert_along_the_gradient(z: Phase, h: f64) {
    let quotient = |end: f64| (0.8_f64.cos() - end.cos()) / (end - 0.8);
    let (theta, omega) = solved(h, |end| -0.7 - 2.5 * h * quotient(end));
    assert_relative_eq!(z.theta, theta, max_relative = 5.0 * ROUNDING);
    assert_relative_eq!(z.omega, omega, max_relative = 5.0 * ROUNDING);
}

/// Its equations.
///
/// Catches: the midpoint or the trapezoidal rule under its name, a mean over half or twice the way.
#[test]
fn the_discrete_gradient_is_the_quotient_of_the_differences() {
    assert_along_the_gradient(step(&pendulum(), &DiscreteGradient, Z), H);
}

/// The same in a step of (2/ω₀) tan(ω₀h/2), and back.
///
/// Catches: the discrete gradient under its name; a frequency without its root; a tangent of the
/// whole angle; a length that takes no sign.
#[test]
fn cieslinski_and_ratkiewicz_take_a_longer_step() {
    let length = |h: f64| (0.5 * 2.5_f64.sqrt() * h).tan() / (0.5 * 2.5_f64.sqrt());
    let z = step(&pendulum(), &CieslinskiRatkiewicz, Z);
    assert_along_the_gradient(z, length(H));
    let mut pace = CieslinskiRatkiewicz.start(&pendulum(), 0.0, -H, z);
    let back = CieslinskiRatkiewicz.step(&pendulum(), 0.0, -H, z, &mut pace);
    assert_same(back, Z.theta, Z.omega);
}

/// Half a kick by θ − sin θ, a rotation, half a kick, about the bottom and about one two turns on.
///
/// Catches: rotation, kick, rotation; a kick by all of the force; a frequency without its root; an
/// angle that is not taken from its own bottom.
#[test]
fn deuflhard_kicks_rotates_and_kicks() {
    let (frequency, h) = (2.5_f64.sqrt(), H);
    let kick = |theta: f64| 0.5 * h * 2.5 * (theta - theta.sin());
    let omega = -0.7 + kick(0.8);
    let (sin, cos) = (frequency * h).sin_cos();
    let theta = 0.8 * cos + omega / frequency * sin;
    let omega = omega * cos - 0.8 * frequency * sin;
    let omega = omega + kick(theta);
    assert_same(step(&pendulum(), &Deuflhard, Z), theta, omega);
    // The angle is rounded by 1e-15 at the start.
    let turns = 4.0 * std::f64::consts::PI;
    let z = step(&pendulum(), &Deuflhard, Phase { theta: 0.8 + turns, ..Z });
    assert_relative_eq!(z.theta - turns, theta, max_relative = 10.0 * ROUNDING);
    assert_relative_eq!(z.omega, omega, max_relative = 10.0 * ROUNDING);
}

/// Its equations with the nodes ½ ∓ √3/6, solved by sweeps, each of which leaves a fifth or less.
///
/// Catches: the processed method under its name; a node on the wrong side; weights that are not
/// equal.
#[test]
fn gauss_4_solves_its_equations() {
    let off = 3.0_f64.sqrt() / 6.0;
    let a = [[0.25, 0.25 - off], [0.25 + off, 0.25]];
    let mut k = [[-0.7, alpha(0.8)]; 2];
    for _ in 0..60 {
        k = a.map(|row| {
            let along = |i: usize| H * (row[0] * k[0][i] + row[1] * k[1][i]);
            [-0.7 + along(1), alpha(0.8 + along(0))]
        });
    }
    let mean = |i: usize| 0.5 * (k[0][i] + k[1][i]);
    assert_same(step(&pendulum(), &Gauss4, Z), 0.8 + H * mean(0), -0.7 + H * mean(1));
}

/// The change of variables solved by sweeps, half a drift, a kick with the gradient, half a drift,
/// and the change undone.
///
/// Catches: Gauss's method under its name; a gradient or a change of variables with another sign or
/// factor, in either direction.
#[test]
fn processed_4_is_position_verlet_with_the_gradient_between_changes_of_variables() {
    let (shift, stretch) =
        (|y: f64| -H * H / 24.0 * alpha(y), |y: f64| 1.0 + H * H / 24.0 * 2.5 * y.cos());
    let mut theta = 0.8;
    for _ in 0..40 {
        theta = 0.8 - shift(theta);
    }
    let mut omega = -0.7 * stretch(theta);
    theta += 0.5 * H * omega;
    omega += H * alpha(theta) * (1.0 - H * H / 12.0 * 2.5 * theta.cos());
    theta += 0.5 * H * omega;
    assert_same(step(&pendulum(), &Processed4, Z), theta + shift(theta), omega / stretch(theta));
}
